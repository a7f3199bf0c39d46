//! Light around any surface against closed formulas and numbers from books.

use std::f64::consts::PI;
use std::fs;

use nalgebra::DMatrix;
use serde_json::Value;
use vfold::camera::CameraResponse;
use vfold::forward::FacetModel;
use vfold::forward::nonuniform::surface_rgb;
use vfold::geometry::accordion::Accordion;
use vfold::geometry::{FacetGrid, Fold, LightSource, Shape, Vec3};
use vfold::kernel::surface::SurfaceKernel;
use vfold::kernel::surface::direct::DirectLight;
use vfold::kernel::surface::lit::LitSurface;
use vfold::kernel::surface::patches::{Division, patches};
use vfold::kernel::surface::skylight::{backs, skylight};
use vfold::kernel::surface::sunlight::solid_angle;
use vfold::response::Exchange;

use crate::common::is_there;

fn shape(vertices: Vec<[f64; 3]>, faces: Vec<Vec<usize>>) -> Shape {
    Shape::new(vertices, faces, vec![]).unwrap().0
}

/// A square that faces up, and one that faces east.
fn two_squares() -> Shape {
    let far = 1e6; // so far from each other that they do not meet
    let up = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let east = [[far, 0.0, 0.0], [far, 1.0, 0.0], [far, 1.0, 1.0], [far, 0.0, 1.0]];
    shape([up, east].concat(), vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]])
}

/// Panels of a square each, valleys and ridges of 60°.
fn accordion(creases: usize) -> Shape {
    let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 2, cols: 2 }).unwrap();
    Accordion { valley, creases, ridge_deg: 60.0, bow_deg: 0.0 }.shape().unwrap()
}

fn light(shape: &Shape, source: LightSource) -> DirectLight {
    let patches = patches(shape, Division::NONE);
    let kernel = SurfaceKernel::new(shape, &patches, 1e-6).unwrap();
    DirectLight::of(&source, shape, &patches, &kernel)
}

/// A wall receives 0.396 of what the open ground does (R. G. Hopkinson, P. Petherbridge, J. Longmore, *Daylighting*, 1966, has 0.396;
/// the integral is (π/6 + 4/9)/(7π/9)).
#[test]
fn an_overcast_sky_lights_ground_and_wall() {
    let DirectLight { irradiance, standard_error } =
        light(&two_squares(), LightSource::overcast_sky([0.0, 0.0, 2.0], 3.0).unwrap());
    let wall = (PI / 6.0 + 4.0 / 9.0) / (7.0 * PI / 9.0);
    assert!((wall - 0.396).abs() < 5e-4);
    assert!(standard_error < 1e-2, "{standard_error}");
    assert!((irradiance[0] - 3.0).abs() < 4.0 * standard_error.max(1e-4), "{irradiance:?}");
    assert!((irradiance[1] - 3.0 * wall).abs() < 4.0 * standard_error, "{irradiance:?}");
}

/// The sky's share of the view is what the kernel leaves over, by other means: rays.
#[test]
fn rays_see_of_a_uniform_sky_what_the_kernel_leaves_over() {
    for creases in [1, 3] {
        let shape = accordion(creases);
        let exact = light(&shape, LightSource::uniform_sky(0.5).unwrap());
        assert!(exact.standard_error.abs() < 1e-15, "an accordion shows no backs");
        let (sampled, error) = skylight(&shape, &patches(&shape, Division::NONE), |_| 0.5);
        for (exact, sampled) in exact.irradiance.iter().zip(&sampled) {
            assert!((exact - sampled).abs() < 4.0 * error, "{exact} {sampled} ± {error}");
        }
    }
}

/// A square under the back of another: that of two parallel unit squares a unit apart is 0.19982 of its view (Howell, C-11).
#[test]
fn backs_hide_the_sky() {
    let square = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
    let shape = shape([square(0.0), square(1.0)].concat(), vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]]);
    let (seen, error) = backs(&shape, &patches(&shape, Division::NONE));
    assert!((seen[0] - 0.19982).abs() < 4.0 * error && seen[1].abs() < 1e-15, "{seen:?} ± {error}");
    let sky = light(&shape, LightSource::uniform_sky(1.0).unwrap());
    assert!((sky.irradiance[0] + seen[0] - 1.0).abs() < 1e-12);
}

/// A lamp far away is a sun.
#[test]
fn a_distant_lamp_is_a_sun() {
    let (shape, towards) = (accordion(2), [0.3, 0.2, 1.0]);
    let sun = light(&shape, LightSource::directional(towards, 2.0).unwrap());
    let lamp = Vec3::from(towards).normalize() * 1e5;
    let lamp = light(&shape, LightSource::point(lamp.into(), 2.0, 1e5).unwrap());
    for (sun, lamp) in sun.irradiance.iter().zip(&lamp.irradiance) {
        assert!((sun - lamp).abs() < 1e-4, "{sun} {lamp}");
    }
}

/// A disc's worth of squares under a lamp: the inverse square and the cosine, at the middle of a small facet.
#[test]
fn a_lamp_obeys_the_inverse_square() {
    let small = 1e-3;
    let square = |x: f64| [[x, 0.0, 0.0], [x + small, 0.0, 0.0], [x + small, small, 0.0], [x, small, 0.0]];
    let shape = shape([square(0.0), square(2.0)].concat(), vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]]);
    let lamp = light(&shape, LightSource::point([0.0, 0.0, 1.5], 1.0, 1.0).unwrap());
    assert!((lamp.irradiance[0] - 1.0 / 2.25).abs() < 1e-3);
    let square_distance = 4.0 + 2.25;
    assert!((lamp.irradiance[1] - 1.5 / 2.5 / square_distance).abs() < 1e-3);
}

/// The Cornell box, where its published measurements are at hand, with a lamp in its middle: all light that does not leave by the open
/// front falls on a wall, and what walls do not absorb leaves in the end.
#[test]
fn the_cornell_box_keeps_its_energy() {
    let path = "../shared/data/scenes/cornell_box_empty.json";
    if !is_there(path) {
        return;
    }
    let text = fs::read_to_string(path).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    let walls = json["surfaces"].as_array().unwrap();
    let corners =
        |wall: &Value| -> Vec<[f64; 3]> { serde_json::from_value(wall["vertices"].clone()).unwrap() };
    let vertices: Vec<_> = walls.iter().flat_map(&corners).collect();
    // Walls are not quite flat: two triangles each.
    let halves =
        |wall: usize| [[0, 1, 2], [0, 2, 3]].map(|half| half.map(|corner| 4 * wall + corner).to_vec());
    let faces = (0..walls.len()).flat_map(halves).collect();
    let shape = shape(vertices, faces);
    let lamp = Vec3::new(278.0, 273.0, 280.0);
    let patches = patches(&shape, Division { cells: 3, graded: false });
    let sources = [LightSource::point(lamp.into(), 1.0, 100.0).unwrap()];
    let lit = LitSurface::new(&shape, &sources, &patches, 1e-3).unwrap();
    let areas: Vec<f64> = lit.kernel.root_areas().iter().map(|root| root * root).collect();
    let power = |of: &[f64]| of.iter().zip(&areas).map(|(e, area)| e * area).sum::<f64>();

    // The front is where floor and ceiling begin, z = 0.
    let front = [[552.8, 0.0, 0.0], [556.0, 548.8, 0.0], [0.0, 548.8, 0.0], [0.0, 0.0, 0.0]].map(Vec3::from);
    let inside = 1e4 * (4.0 * PI - solid_angle(&lamp, &front));
    let direct = &lit.lights[0].irradiance;
    assert!((power(direct) / inside - 1.0).abs() < 2e-3, "{} {inside}", power(direct));

    let is_white = |facet: &usize| walls[facet / 2]["reflectance"] == "white";
    let r: Vec<f64> = lit.kernel.facet_of().iter().map(|f| if is_white(f) { 0.75 } else { 0.3 }).collect();
    let eye = CameraResponse::from_weights(vec![vec![1.0]]);
    let lights = [(direct.clone(), eye.clone())];
    let reflectance = DMatrix::from_column_slice(r.len(), 1, &r);
    let radiance = surface_rgb(&Singles::of(&lit.kernel), &lights, &reflectance).unwrap();
    let sums = lit.kernel.row_sums();
    let lost: Vec<_> = (0..r.len()).map(|i| radiance[i] * ((1.0 - r[i]) / r[i] + 1.0 - sums[i])).collect();
    assert!((power(&lost) / power(direct) - 1.0).abs() < 1e-9);

    // By elimination of what is known in place of conjugate gradients.
    let parts: Vec<usize> = (0..shape.len()).map(|facet| usize::from(is_white(&facet))).collect();
    let reduced = lit.reduce(&parts, 1e-8).unwrap();
    let model = FacetModel::beside_known(&reduced, &[None, Some(vec![0.75])], &[eye]).unwrap();
    let means = lit.kernel.facet_means(&lit.kernel.start(radiance.as_slice()));
    for (ours, mean) in model.facet_rgb(&[0.3]).iter().zip(&means) {
        assert!((ours / mean - 1.0).abs() < 1e-6, "{ours} {mean}");
    }
}

/// The patches of a surface, each a facet of its own.
struct Singles<'a>(&'a SurfaceKernel, Vec<usize>);

impl<'a> Singles<'a> {
    fn of(kernel: &'a SurfaceKernel) -> Self {
        Self(kernel, (0..kernel.unknowns()).collect())
    }
}

impl Exchange for Singles<'_> {
    fn root_areas(&self) -> &[f64] {
        self.0.root_areas()
    }

    fn facet_of(&self) -> &[usize] {
        &self.1
    }

    fn apply(&self, x: &[f64], out: &mut [f64]) {
        self.0.apply(x, out);
    }
}

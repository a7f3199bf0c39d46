//! Light around any surface against closed formulas and numbers from books.

use std::f64::consts::PI;
use std::fs;

use nalgebra::DMatrix;
use serde_json::Value;
use vfold::camera::CameraResponse;
use vfold::forward::FacetModel;
use vfold::geometry::{FacetGrid, Fold, LightSource, Panel, StandardSky, Vec3};
use vfold::paper::nonuniform::surface_rgb;
use vfold::surfaces::kernel::SurfaceKernel;
use vfold::surfaces::kernel::direct::DirectLight;
use vfold::surfaces::kernel::lit::LitSurface;
use vfold::surfaces::kernel::patches::{Division, patches};
use vfold::surfaces::kernel::skylight::{backs, skylight};
use vfold::surfaces::kernel::sunlight::solid_angle;
use vfold::surfaces::{Accordion, Exchange, Shape};

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

/// A wall receives 0.396 of what the open ground does (R. G. Hopkinson, P. Petherbridge, J. Longmore,
/// *Daylighting*, 1966, has 0.396; the integral is (π/6 + 4/9)/(7π/9)).
#[test]
fn an_overcast_sky_lights_ground_and_wall() {
    let DirectLight { irradiance, standard_error } =
        light(&two_squares(), LightSource::overcast_sky([0.0, 0.0, 2.0], 3.0).unwrap());
    let wall = (PI / 6.0 + 4.0 / 9.0) / (7.0 * PI / 9.0);
    assert!((wall - 0.396).abs() < 5e-4);
    assert!(standard_error.abs() < 1e-15, "{standard_error}");
    assert!((irradiance[0] - 3.0).abs() < 1e-4, "{irradiance:?}");
    assert!((irradiance[1] - 3.0 * wall).abs() < 1e-4, "{irradiance:?}");
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

/// A square under the back of another: that of two parallel unit squares a unit apart is 0.19982 of its view
/// (Howell, C-11).
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

/// Whether a ray from `point` meets a panel of a fold.
fn is_hidden(panels: &[Panel; 2], point: Vec3, towards: Vec3) -> bool {
    panels.iter().any(|panel| {
        let [origin, along, _, out] = panel.corners;
        let [along, out] = [along - origin, out - origin];
        let normal = along.cross(&out);
        let distance = normal.dot(&(origin - point)) / normal.dot(&towards);
        let met = point + distance * towards - origin;
        let [u, v] = [along, out].map(|side| met.dot(&side) / side.norm_squared());
        distance > 1e-6 && (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
    })
}

/// Means over the facets of a fold of what `irradiance` gives a point of a panel with that normal, at so many
/// points along each side.
fn facet_means(fold: &Fold, points: usize, irradiance: impl Fn(Vec3, Vec3) -> f64) -> Vec<f64> {
    let shape = fold.shape().unwrap();
    let place = |n: usize| (n as f64 + 0.5) / points as f64;
    let mean = |facet: usize| {
        let polygon = shape.facet(facet);
        let at = |n: usize| polygon.at(place(n / points), place(n % points)).0;
        let sum: f64 = (0..points * points).map(|n| irradiance(at(n), polygon.normal())).sum();
        sum / (points * points) as f64
    };
    (0..shape.len()).map(mean).collect()
}

fn assert_near(found: &[f64], wanted: &[f64], most: f64) {
    assert!(wanted.iter().any(|light| *light > 0.1), "{wanted:?}");
    for (facet, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        assert!((found - wanted).abs() < most, "facet {facet}: {found} for {wanted}");
    }
}

/// Skies with a horizon against sums over small parts of the sky.
#[test]
fn skies_light_a_fold() {
    let fold = Fold::new(70.0, 1.0, 1.0, FacetGrid { rows: 3, cols: 2 }).unwrap();
    let panels = fold.panels();
    for (zenith, number) in [([0.0, 0.0, 1.0], 1), ([0.1, 0.7, 0.7], 12), ([0.8, 0.0, 0.6], 5)] {
        let (sky, up) = (StandardSky::of_type(number).unwrap(), Vec3::from(zenith).normalize());
        let source = LightSource::standard_sky(sky, zenith, [0.0, 0.1, 1.0], 1.0).unwrap();
        let sun = Vec3::new(0.0, 0.1, 1.0).normalize();
        let (heights, turns) = (120_usize, 240_usize);
        let open = sky.irradiance(up.dot(&sun));
        let east = up.cross(&Vec3::new(0.3, -0.9, 0.2)).normalize();
        let parts: Vec<(Vec3, f64)> = (0..heights * turns)
            .map(|n| {
                let height = ((n / turns) as f64 + 0.5) / heights as f64;
                let turn = 2.0 * PI * ((n % turns) as f64 + 0.5) / turns as f64;
                let beside = (1.0 - height * height).sqrt();
                let towards = height * up + beside * (turn.cos() * east + turn.sin() * up.cross(&east));
                (
                    towards,
                    sky.radiance(height, towards.dot(&sun)) * 2.0 * PI / (heights * turns) as f64 / open,
                )
            })
            .collect();
        let wanted = facet_means(&fold, 6, |point, normal| {
            let seen = parts.iter().filter(|(towards, _)| normal.dot(towards) > 0.0);
            seen.filter(|(towards, _)| !is_hidden(&panels, point, *towards))
                .map(|(towards, light)| light * normal.dot(towards))
                .sum()
        });
        let found = light(&fold.shape().unwrap(), source);
        assert!(found.standard_error.abs() < 1e-15);
        assert_near(&found.irradiance, &wanted, 4e-3);
    }
}

/// A window before a fold, and one aside that a panel hides in part, against sums over small parts of it.
#[test]
fn windows_light_a_fold() {
    let fold = Fold::new(60.0, 1.5, 1.0, FacetGrid { rows: 3, cols: 2 }).unwrap();
    let panels = fold.panels();
    let middle = panels.iter().flat_map(|panel| panel.corners).sum::<Vec3>() / 8.0;
    for (at, size) in [([0.2, -0.5, 2.5], [1.0, 2.0]), ([2.0, 0.3, 0.9], [1.5, 1.0])] {
        let source = LightSource::area(at, middle, size, 2.0).unwrap();
        let LightSource::Area { corners, distance, .. } = source else { panic!() };
        let facing = (corners[1] - corners[0]).cross(&(corners[3] - corners[0])).normalize();
        let parts = 60_usize;
        let place = |n: usize| (n as f64 + 0.5) / parts as f64;
        let part = |n: usize| {
            corners[0]
                + place(n / parts) * (corners[1] - corners[0])
                + place(n % parts) * (corners[3] - corners[0])
        };
        let of_part = |point: Vec3, normal: Vec3, part: Vec3| {
            let way = part - point;
            let cosines = normal.dot(&way).max(0.0) * (-facing.dot(&way)).max(0.0);
            cosines / way.norm_squared().powi(2)
        };
        let before = corners.iter().sum::<Vec3>() / 4.0 + distance * facing;
        let open: f64 = (0..parts * parts).map(|n| of_part(before, -facing, part(n))).sum();
        let wanted = facet_means(&fold, 6, |point, normal| {
            let seen = (0..parts * parts).map(part).filter(|part| !is_hidden(&panels, point, part - point));
            2.0 / open * seen.map(|part| of_part(point, normal, part)).sum::<f64>()
        });
        assert_near(&light(&fold.shape().unwrap(), source).irradiance, &wanted, 1e-2);
    }
}

/// The Cornell box, where its published measurements are at hand, with a lamp in its middle: all light that
/// does not leave by the open front falls on a wall, and what walls do not absorb leaves in the end.
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
    let model = FacetModel::with_known(&reduced, &[None, Some(vec![0.75])], &[eye]).unwrap();
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

//! Sheets that are not Lambertian: facets of folds against path-traced photographs and against light
//! transport of its own.
//!
//! The numbers come from `tests/data/sheets/make.py`.

use nalgebra::{Point3, Vector3};
use ndarray::{Array3, Axis};
use serde::Deserialize;
use vfold::geometry::{FacetGrid, Fold};
use vfold::kernel::quadrature::Lagrange;
use vfold::kernel::refinement;
use vfold::response::{ModeLight, Response};
use vfold::sheet::{Family, Shape, measured, measured_names};
use vfold::transport::departures;

#[derive(Deserialize)]
struct Data {
    photographs: [Photograph; 2],
    material: Material,
}

/// A photograph's facets, means of rows of both panels by channels, and what they are computed from.
#[derive(Deserialize)]
struct Photograph {
    angle_deg: f64,
    eye: [f64; 3],
    /// At 45:0.
    reflectance: Vec<f64>,
    /// Of each waveband in each channel.
    weights: [Vec<f64>; 3],
    rows: [[f64; 3]; 10],
}

/// A measured material's facets by directed radiances between flat patches.
#[derive(Deserialize)]
struct Material {
    name: String,
    angle_deg: f64,
    tilt_deg: f64,
    #[serde(rename = "reflectance_45_0")]
    reflectance_factor_45_0: [f64; 3],
    eye: [f64; 3],
    rows: [[f64; 3]; 10],
}

fn data() -> Data {
    serde_json::from_str(include_str!("../data/sheets/sheets.json")).unwrap()
}

/// A fold in the sun with a sheet of one shape, of whatever albedo.
struct Scene {
    shape: Shape,
    nodes: Vec<f64>,
    lagrange: Lagrange,
    beyond: Array3<f64>,
    lambertian: Response,
    sun: ModeLight,
}

impl Scene {
    fn new(angle_deg: f64, tilt_deg: f64, eye: [f64; 3], shape: Shape) -> Self {
        let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 }).unwrap();
        let node = |k: u8| 0.5 - 0.5 * (std::f64::consts::PI * (f64::from(k) + 0.5) / 10.0).cos();
        let nodes: Vec<f64> = (0..10).map(node).collect();
        let (x, z) = tilt_deg.to_radians().sin_cos();
        let beyond = departures(
            &fold,
            &Vector3::new(x, 0.0, z),
            &Point3::from(eye),
            std::slice::from_ref(&shape),
            &nodes,
        );
        let on_panels = [tilt_deg, -tilt_deg].map(|tilt| (0.5 * angle_deg + tilt).to_radians().sin());
        let lambertian = refinement::refine(&fold, 1e-5).unwrap().response;
        Self {
            shape,
            lagrange: Lagrange::new(&nodes),
            nodes,
            beyond,
            lambertian,
            sun: ModeLight::Sun(on_panels),
        }
    }

    /// Mean radiance of the facets of each row, for a reflectance at 45:0.
    fn rows(&self, reflectance: f64) -> [f64; 10] {
        let [slope, offset] = self.shape.slope_and_offset();
        let albedo = (reflectance - offset) / slope;
        let mut weights = vec![0.0; self.nodes.len()];
        self.lagrange.at(albedo, &mut weights);
        let facet = |panel: usize, facet: usize| {
            let values = self.beyond.index_axis(Axis(0), 0).row(100 * panel + facet).to_owned();
            let beyond: f64 = values.iter().zip(&weights).map(|(value, weight)| value * weight).sum();
            albedo * self.lambertian.irradiance(panel, facet, self.sun, [albedo; 2]) + beyond
        };
        std::array::from_fn(|row| {
            (0..10).map(|col| facet(0, 10 * row + col) + facet(1, 10 * row + col)).sum::<f64>() / 20.0
        })
    }
}

/// Rows 1 to 9 within half a percent, the row at the crease within one and a half.
#[test]
fn rendered_sheets_look_like_their_photographs() {
    let glossy = Family { specular_weight: 0.5, roughness: 0.4, ..Family::default() };
    let rough = Family { body_roughness_deg: 20.0, ..Family::default() };
    for (photograph, family) in data().photographs.iter().zip([glossy, rough]) {
        let scene = Scene::new(photograph.angle_deg, 0.0, photograph.eye, family.into());
        let bands: Vec<_> = photograph.reflectance.iter().map(|r| scene.rows(*r)).collect();
        for (row, seen) in photograph.rows.iter().enumerate() {
            for (channel, weights) in photograph.weights.iter().enumerate() {
                let told: f64 = bands.iter().zip(weights).map(|(rows, weight)| rows[row] * weight).sum();
                let off = told / seen[channel] - 1.0;
                let bound = if row == 0 { 0.015 } else { 0.0055 };
                assert!(off.abs() < bound, "{family:?}: row {row}, channel {channel} is {off:+.4} off");
            }
        }
    }
}

/// Flat patches are themselves a few percent off, and more at the crease.
#[test]
fn a_measured_sheet_agrees_with_patches() {
    let material = data().material;
    let number = measured_names().position(|name| name == material.name).unwrap();
    let shape = measured().unwrap()[number].clone();
    let scene = Scene::new(material.angle_deg, material.tilt_deg, material.eye, shape);
    for (channel, reflectance) in material.reflectance_factor_45_0.into_iter().enumerate() {
        let rows = scene.rows(reflectance);
        for (row, (found, patches)) in rows.iter().zip(&material.rows).enumerate().skip(2) {
            let off = found / patches[channel] - 1.0;
            assert!(off.abs() < 0.04, "row {row}, channel {channel} is {off:+.4} off");
        }
    }
}

#[test]
fn shapes_do_not_depend_on_their_company() {
    let fold = Fold::new(60.0, 1.0, 0.8, FacetGrid { rows: 3, cols: 2 }).unwrap();
    let unequal = fold.with_panel1_depth(1.3).unwrap();
    let eye = Point3::new(0.4, 0.3, 6.0);
    let shapes = [
        Family::default(),
        Family { specular_weight: 0.4, roughness: 0.5, body_roughness_deg: 10.0, sheen: 0.1 },
    ]
    .map(Shape::from);
    for fold in [fold, unequal] {
        let both = departures(&fold, &Vector3::z(), &eye, &shapes, &[0.2, 0.9]);
        let one = departures(&fold, &Vector3::z(), &eye, &shapes[1..], &[0.9]);
        for facet in 0..12 {
            assert!((both[[1, facet, 1]] - one[[0, facet, 0]]).abs() < 1e-12);
            assert!(both[[0, facet, 1]].abs() < 1e-12);
        }
    }
}

/// Mirrored along the crease and across it, a fold looks mirrored.
#[test]
fn mirrored_scenes_look_mirrored() {
    let fold = Fold::new(50.0, 1.2, 1.0, FacetGrid { rows: 4, cols: 6 }).unwrap();
    let shape = [measured().unwrap()[0].clone()];
    let at = |x: f64, y: f64, tilt: f64| {
        departures(&fold, &Vector3::new(tilt, 0.05, 1.0), &Point3::new(x, y, 7.0), &shape, &[0.5])
    };
    let (seen, across) = (at(1.0, 0.8, 0.1), at(-1.0, 0.8, -0.1));
    for facet in 0..24 {
        assert!((seen[[0, facet, 0]] - across[[0, 24 + facet, 0]]).abs() < 1e-6);
    }
}

//! Skips on the way from light to colour: solutions, bounces and wavebands.

use nalgebra::DMatrix;
use vfold::camera::CameraResponse;
use vfold::forward::{FacetModel, Lighting};
use vfold::geometry::Light;
use vfold::paper::{FoldKernel, form_factors, nonuniform};
use vfold::response::{PanelOperator, Response};
use vfold::spectrum::{Outside, WavelengthGrid, camera, illuminant, reflectances};

use super::{ANGLE_DEG, Skip};
use crate::common::fold;
use crate::solutions::operator;

const N: usize = 10;
/// Residual that rounding leaves.
const ROUNDING: f64 = 1e-14;
/// Sun off the bisecting plane of the fold, and a sky, where there are any.
const TILT_DEG: f64 = 8.0;
const SKY: f64 = 0.2;

pub fn rows() -> Vec<String> {
    let visible = WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap();
    let wide = WavelengthGrid::uniform(380.0, 780.0, 5.0).unwrap();
    vec![
        second_solves("a tilted sun", &Scene::new(&visible, TILT_DEG, 0.0, false)),
        second_solves("a tilted sun and a sky", &Scene::new(&visible, TILT_DEG, SKY, false)),
        second_solves("a reference card", &Scene::new(&visible, 0.0, 0.0, true)),
        summed_bounces(&Scene::new(&visible, 0.0, 0.0, false)),
        unseen_bands(&Scene::new(&wide, 0.0, 0.0, false)),
        unseen_solutions(&Scene::new(&wide, 0.0, 0.0, false)),
    ]
}

/// A sheet under light, seen by a camera.
struct Scene {
    kernel: FoldKernel,
    lighting: Lighting,
    sheet: Vec<f64>,
    /// Reflectance of panel 1, if it is a card.
    card: Option<Vec<f64>>,
}

impl Scene {
    fn new(grid: &WavelengthGrid, tilt_deg: f64, sky: f64, card: bool) -> Self {
        let fold = fold(ANGLE_DEG, N);
        let on_grid = |name: &str| reflectances(name).unwrap()[0].on(grid, Outside::Refuse).unwrap();
        // Its sensitivities end at 400 and 680 nm.
        let channels = camera("sigma-sd-merrill").unwrap().channels;
        let channels: Vec<_> =
            channels.iter().map(|channel| channel.on(grid, Outside::Zero).unwrap()).collect();
        let light = |name: &str| illuminant(name).unwrap().on(grid, Outside::Refuse).unwrap();
        let sun = CameraResponse::new(grid, &channels, &light("D65")).unwrap();
        let sky_camera = sun.to_other_light(grid, &channels, &light("A")).unwrap();
        let light = Light::new(&fold, tilt_deg, 0.0, sky).unwrap();
        Self {
            kernel: form_factors(&fold),
            lighting: Lighting { light, sun, sky: sky_camera },
            sheet: on_grid("cc24:white"),
            card: card.then(|| on_grid("cc24:red")),
        }
    }

    fn response(&self) -> Response {
        Response::solve(&operator(&self.kernel), ROUNDING).unwrap().0
    }

    fn model(&self, response: &Response) -> FacetModel {
        match &self.card {
            Some(card) => FacetModel::with_card(response, &self.lighting, 1, card.clone()),
            None => FacetModel::one_sheet(response, &self.lighting),
        }
    }

    /// Facet RGB by the poles of one solution.
    fn by_poles(&self) -> Vec<f64> {
        self.model(&self.response()).facet_rgb(&self.sheet).as_slice().to_vec()
    }

    /// Facet RGB by one solution a light and a waveband.
    fn by_solutions(&self, lighting: &Lighting) -> Vec<f64> {
        let facets = 2 * self.kernel.facets().len();
        let panels = [&self.sheet, self.card.as_ref().unwrap_or(&self.sheet)];
        let of_facet = |facet: usize, band: usize| panels[2 * facet / facets][band];
        let reflectance = DMatrix::from_fn(facets, self.sheet.len(), of_facet);
        nonuniform::facet_rgb(&self.kernel, lighting, &reflectance).unwrap().as_slice().to_vec()
    }

    /// Facet RGB of evenly lit panels by eqs. (11) to (14): bounce after bounce in every waveband, until
    /// nothing is added.
    fn by_bounces(&self) -> Vec<f64> {
        let (operator, facets) = (operator(&self.kernel), self.kernel.facets().len());
        let direct = self.lighting.light.panel_irradiance()[0];
        let camera = &self.lighting.sun;
        let mut rgb = DMatrix::zeros(2 * facets, camera.channels());
        for (band, r) in self.sheet.iter().enumerate() {
            let (mut bounce, mut next) = (vec![r * direct; facets], vec![0.0; facets]);
            let mut all = bounce.clone();
            while bounce.iter().any(|light| *light > 1e-17) {
                operator.apply(0, &bounce, &mut next);
                bounce.iter_mut().zip(&next).for_each(|(bounce, light)| *bounce = r * light);
                all.iter_mut().zip(&bounce).for_each(|(all, bounce)| *all += bounce);
            }
            for (facet, light) in all.iter().chain(&all).enumerate() {
                for channel in 0..camera.channels() {
                    rgb[(facet, channel)] += camera.channel(channel)[band] * light;
                }
            }
        }
        rgb.as_slice().to_vec()
    }

    /// The same lights and a camera that is blind to no waveband: zeros are numbers that change nothing.
    fn never_blind(&self) -> Lighting {
        let sun = &self.lighting.sun;
        let channel = |n: usize| sun.channel(n).iter().map(|weight| weight.max(1e-300)).collect();
        let sun = CameraResponse::from_weights((0..sun.channels()).map(channel).collect());
        Lighting { sun, ..self.lighting.clone() }
    }
}

fn second_solves(what: &str, scene: &Scene) -> String {
    let lights = scene.lighting.sources().count();
    let skip = Skip::new(
        format!("second solves for {what}"),
        format!("{} solutions by conjugate gradients", lights * scene.sheet.len()),
        "the poles of one Lanczos solution",
    );
    skip.row(|| scene.by_solutions(&scene.lighting), || scene.by_poles())
}

fn summed_bounces(scene: &Scene) -> String {
    let skip = Skip::new(
        "summing bounces",
        format!("bounces of a white sheet until none adds anything, in {} wavebands", scene.sheet.len()),
        "their sum in closed form, Lanczos included",
    );
    skip.row(|| scene.by_bounces(), || scene.by_poles())
}

fn seen(scene: &Scene) -> String {
    format!("the {} that the camera sees", scene.lighting.seen_bands().len())
}

fn unseen_bands(scene: &Scene) -> String {
    let response = scene.response();
    let (all, some) = (FacetModel::one_sheet(&response, &scene.never_blind()), scene.model(&response));
    let skip = Skip::new(
        "unseen wavebands, one sheet",
        format!("all {} wavebands from 380 to 780 nm", scene.sheet.len()),
        seen(scene),
    );
    let rgb = |model: &FacetModel| model.facet_rgb(&scene.sheet).as_slice().to_vec();
    skip.row(|| rgb(&all), || rgb(&some))
}

fn unseen_solutions(scene: &Scene) -> String {
    let all = scene.never_blind();
    let skip = Skip::new(
        "unseen wavebands, one reflectance per facet",
        format!("{} solutions", scene.sheet.len()),
        seen(scene),
    );
    skip.row(|| scene.by_solutions(&all), || scene.by_solutions(&scene.lighting))
}

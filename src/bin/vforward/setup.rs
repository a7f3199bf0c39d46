//! Samples and photographs of what is folded, in one scene.

use std::path::{Path, PathBuf};

use nalgebra::DMatrix;
use vfold::camera::CameraResponse;
use vfold::colorimetry::{Colorimeter, Observer};
use vfold::forward::bounces::Bounces;
use vfold::forward::noise::Noise;
use vfold::forward::render::{FoldView, Picture, ShapeView};
use vfold::forward::{FacetModel, Lighting};
use vfold::parallel::{Item, in_order};
use vfold::stream::{Corners, GivenKernel, Output, Sample, Scene, read_matrix};
use vfold::{Error, Result};

use super::Args;
use super::nonuniform::Nonuniform;
use super::render::say_corners;
use super::subject::{Sheet, Subject};

/// Samples a thread that are computed before the first of them is written.
const AHEAD: usize = 16;

/// What the samples of one scene need.
pub struct Setup<'a> {
    args: &'a Args,
    scene: &'a Scene,
    given: Option<&'a GivenKernel>,
    noise: Noise,
    bounces: Bounces,
    model: FacetModel,
}

impl<'a> Setup<'a> {
    pub fn new(
        args: &'a Args,
        noise: Noise,
        scene: &'a Scene,
        given: Option<&'a GivenKernel>,
    ) -> Result<Self> {
        Ok(Self { args, scene, given, noise, bounces: args.bounces.of(scene)?, model: scene.model()? })
    }

    /// Writes a sample a sheet or file; the first says where its panels are `seen`.
    pub fn samples(&self, subject: &Subject, seen: &[(usize, Corners)], out: &mut Output) -> Result<()> {
        match subject {
            Subject::Sheets { sheets, .. } => self.sheets(sheets, seen, out),
            Subject::Facets(files) => self.facets(files, out),
        }
    }

    fn sheets(&self, sheets: &[Sheet], seen: &[(usize, Corners)], out: &mut Output) -> Result<()> {
        let ahead = AHEAD * rayon::current_num_threads();
        let make = |(n, sheet): (usize, _)| self.of_sheet(sheet, n as u64, seen);
        in_order(sheets.iter().enumerate().map(Item::ToDo), ahead, make, |sample| out.sample(&sample?))
    }

    fn of_sheet(&self, sheet: &Sheet, stream: u64, seen: &[(usize, Corners)]) -> Result<Sample> {
        let (rgb, truncation) = self.bounces.facet_rgb(&self.model, &sheet.spectrum.reflectance);
        let mut sample = self.sample(&sheet.id, rgb, stream)?;
        truncation.as_ref().map_or(Ok(()), |truncation| sample.set_bounces(truncation))?;
        sample.set_truth(&sheet.spectrum)?;
        if let (0, Some(path)) = (stream, &self.args.render.render) {
            sample.set_panel_regions(path, self.args.render.size(), seen)?;
        }
        Ok(sample)
    }

    /// One after the other: each keeps all threads busy.
    fn facets(&self, files: &[PathBuf], out: &mut Output) -> Result<()> {
        let surface = Nonuniform::of(self.scene, self.given)?;
        for (n, path) in files.iter().enumerate() {
            let rgb = surface.facet_rgb(&self.facet_reflectance(path)?)?;
            let id = path.file_stem().unwrap_or_default().to_string_lossy();
            out.sample(&self.sample(&id, rgb, n as u64)?)?;
        }
        Ok(())
    }

    fn facet_reflectance(&self, path: &Path) -> Result<DMatrix<f64>> {
        let shape = [(self.scene.facets()?, "facets"), (self.scene.grid()?.len(), "wavebands")];
        let reflectance = read_matrix(path, shape)?;
        match reflectance.iter().find(|r| !(0.0..=1.0).contains(*r)) {
            Some(r) => Err(Error::Array {
                path: path.display().to_string(),
                problem: format!("{r} is not a reflectance; give numbers from 0 to 1"),
            }),
            None => Ok(reflectance),
        }
    }

    /// A sample of what the camera sees, noise included, from facet RGB at exposure 1.
    fn sample(&self, id: &str, rgb: DMatrix<f64>, stream: u64) -> Result<Sample> {
        // A photograph has its own noise, pixel by pixel.
        let noise = if self.args.render.render.is_some() { Noise::default() } else { self.noise };
        let clean = (self.args.exposure * rgb).transpose();
        let mut values = clean.as_slice().to_vec();
        noise.add(&mut values, self.args.seed, stream);
        let rows = |values: &[f64]| values.chunks(clean.nrows()).map(|rgb| Some(rgb.to_vec())).collect();
        let sd: Vec<f64> = clean.iter().map(|signal| noise.sd_at(*signal)).collect();
        let mut sample = Sample::new(&self.scene.id()?, id)?;
        let sd = (!noise.is_none()).then(|| rows(&sd));
        sample.set_facets(&rows(&values), sd.as_ref(), self.scene.pictures()?)?;
        sample.fields.set("exposure", self.args.exposure)?;
        Ok(sample)
    }

    /// Takes the photograph that `--render` asks for, of the first sheet; where the panels are in it.
    pub fn photograph(&self, subject: &Subject) -> Result<Vec<(usize, Corners)>> {
        let (Some(path), Subject::Sheets { sheets, .. }) = (&self.args.render.render, subject) else {
            return Ok(Vec::new());
        };
        let for_screen = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        let reflectance = &sheets[0].spectrum.reflectance;
        let (mut picture, seen) = if self.scene.is_fold()? {
            self.fold_picture(for_screen, reflectance)?
        } else {
            self.shape_picture(for_screen, reflectance)?
        };
        self.noise.add(picture.pixels_mut(), self.args.seed, u64::MAX);
        if for_screen {
            picture.save_for_screen(path)?;
        } else {
            picture.save(path)?;
        }
        if !self.args.common.quiet {
            say_corners(path, &seen);
        }
        Ok(seen)
    }

    fn fold_picture(
        &self,
        for_screen: bool,
        reflectance: &[f64],
    ) -> Result<(Picture, Vec<(usize, Corners)>)> {
        let eye = self.eye()?;
        let render = &self.args.render;
        let view = FoldView::new(&self.scene.fold()?, &render.viewpoint(), render.frame()?)?;
        let lighting = if for_screen {
            Lighting { light: self.scene.light()?, sun: eye.clone(), sky: eye }
        } else {
            self.scene.lighting()?
        };
        let model = self.scene.fine_model(view.grid(), &lighting)?;
        Ok((view.take(&self.light(&model, reflectance)), view.corners()))
    }

    fn shape_picture(
        &self,
        for_screen: bool,
        reflectance: &[f64],
    ) -> Result<(Picture, Vec<(usize, Corners)>)> {
        let eye = self.eye()?;
        let (render, sources) = (&self.args.render, self.scene.sources()?);
        let view = ShapeView::new(&self.scene.shape()?, &sources, &render.viewpoint(), render.frame()?)?;
        let light = if for_screen {
            let model = self.scene.surface_model_seen_by(vec![eye; sources.len()])?;
            self.light(&model, reflectance)
        } else {
            self.light(&self.model, reflectance)
        };
        Ok((view.take(&light), view.corners()))
    }

    fn light(&self, model: &FacetModel, reflectance: &[f64]) -> DMatrix<f64> {
        self.args.exposure * self.bounces.facet_rgb(model, reflectance).0
    }

    /// The response of an eye that is adapted to the light.
    fn eye(&self) -> Result<CameraResponse> {
        let optics = &self.args.optics;
        let illuminant = optics.one_illuminant("give one with --render: a photograph has one light")?;
        let illuminant = self.args.common.illuminant(illuminant)?;
        let eye = Colorimeter::new(&optics.wavelengths_nm, &illuminant, Observer::Cie1931_2deg)?;
        Ok(CameraResponse::from_weights(eye.screen_weights()))
    }
}

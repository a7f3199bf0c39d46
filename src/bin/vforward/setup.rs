//! Computes samples in one scene.

use std::path::{Path, PathBuf};

use nalgebra::DMatrix;
use vfold::forward::noise::Noise;
use vfold::forward::render::FoldView;
use vfold::forward::{BispectralSheet, FacetModel, FacetValues, Fluorescing};
use vfold::paper::bounces::{Bounces, Truncation};
use vfold::parallel::{Item, in_order};
use vfold::scene::{ExternalKernel, FoldedSheet, Setting};
use vfold::stream::{Corners, Output, ReflectanceRecord, Sample, Scene, read_matrix};
use vfold::{Error, Result};

use super::Args;
use super::fluorescence::Emission;
use super::nonuniform::Nonuniform;
use super::subject::{Sheet, Subject};

/// Samples per thread that are computed before the first of them is written.
const AHEAD: usize = 16;

/// Common context of the samples of one scene.
pub struct Setup<'a> {
    pub(super) args: &'a Args,
    pub(super) scene: &'a Scene,
    pub(super) setting: Setting<'a>,
    external: Option<&'a ExternalKernel>,
    pub(super) noise: Noise,
    pub(super) bounces: Bounces,
    pub(super) model: FacetModel,
    /// A sheet that is not perfectly matte.
    sheet: Option<FoldedSheet>,
    emission: &'a Emission,
}

impl<'a> Setup<'a> {
    pub fn new(
        args: &'a Args,
        noise: Noise,
        scene: &'a Scene,
        external: Option<&'a ExternalKernel>,
        emission: &'a Emission,
    ) -> Result<Self> {
        let setting = Setting::of(scene)?;
        if let Emission::Excited(lights) = emission {
            lights.check(&setting)?;
        }
        let (bounces, model) = (args.bounces.of(scene)?, setting.model()?);
        let sheet = args.sheet.shape()?.map(|shape| match &setting {
            Setting::Fold(fold) => {
                let view = FoldView::new(&fold.fold, &args.render.viewpoint(), args.render.frame()?)?;
                fold.folded_sheet(shape, view.eye(), None)
            }
            Setting::Surface(_) => Err(Error::field(
                "geometry",
                "only folds of two panels are computed for sheets that are not perfectly matte",
            )),
        });
        let sheet = sheet.transpose()?;
        Ok(Self { args, scene, setting, external, noise, bounces, model, sheet, emission })
    }

    /// Writes one sample per sheet or file; the first states the positions `seen` of its panels.
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
        let (rgb, truncation) = self.facet_rgb(sheet)?;
        let mut sample = self.sample(&sheet.id, rgb, stream)?;
        truncation.as_ref().map_or(Ok(()), |truncation| sample.set_bounces(truncation))?;
        let total_radiance_factor = self.total_radiance_factor(sheet)?;
        sample.set_truth(&ReflectanceRecord { total_radiance_factor, ..sheet.spectrum.clone() })?;
        if let (0, Some(path)) = (stream, &self.args.render.render) {
            sample.set_panel_regions(path, self.args.render.size(), seen)?;
        }
        Ok(sample)
    }

    /// Facet RGB at exposure 1.
    fn facet_rgb(&self, sheet: &Sheet) -> Result<(DMatrix<f64>, Option<Truncation>)> {
        let Some(folded) = &self.sheet else { return self.matt_rgb(&self.model, sheet) };
        let albedo = folded.albedo(&sheet.spectrum.reflectance)?;
        let (matt, truncation) = self.bounces.facet_rgb(&self.model, &albedo);
        Ok((matt + folded.beyond(&albedo), truncation))
    }

    /// Facet RGB at exposure 1 for a perfectly matte sheet.
    pub(super) fn matt_rgb(
        &self,
        model: &FacetModel,
        sheet: &Sheet,
    ) -> Result<(DMatrix<f64>, Option<Truncation>)> {
        let reflectance = &sheet.spectrum.reflectance;
        Ok(match (self.emission, &sheet.bispectral) {
            (Emission::Part(part), _) => {
                self.bounces.fluorescing_rgb(&Fluorescing::new(model, reflectance, part)?)
            }
            (Emission::Excited(lights), Some(bispectral)) => {
                let lights = lights.on(bispectral, &self.setting, &self.scene.grid()?)?;
                self.bounces.bispectral_rgb(&BispectralSheet::new(model, bispectral, &lights)?)
            }
            _ => self.bounces.facet_rgb(model, reflectance),
        })
    }

    /// The total radiance factor of the flat sheet in the scene's light, or in the first of several lights,
    /// if it fluoresces.
    fn total_radiance_factor(&self, sheet: &Sheet) -> Result<Option<Vec<f64>>> {
        Ok(match (self.emission, &sheet.bispectral) {
            (Emission::Part(part), _) => {
                let parts = sheet.spectrum.reflectance.iter().zip(part);
                Some(parts.map(|(reflected, emitted)| reflected + emitted).collect())
            }
            (Emission::Excited(lights), Some(bispectral)) => {
                let lights = lights.on(bispectral, &self.setting, &self.scene.grid()?)?;
                Some(BispectralSheet::new(&self.model, bispectral, &lights)?.total_radiance_factor())
            }
            _ => None,
        })
    }

    /// One after the other: each uses all threads.
    fn facets(&self, files: &[PathBuf], out: &mut Output) -> Result<()> {
        let surface = Nonuniform::of(&self.setting, self.external)?;
        for (n, path) in files.iter().enumerate() {
            let rgb = surface.facet_rgb(&self.facet_reflectance(path)?)?;
            let id = path.file_stem().unwrap_or_default().to_string_lossy();
            out.sample(&self.sample(&id, rgb, n as u64)?)?;
        }
        Ok(())
    }

    fn facet_reflectance(&self, path: &Path) -> Result<DMatrix<f64>> {
        let shape = [(self.setting.facets()?, "facet"), (self.scene.grid()?.len(), "waveband")];
        let reflectance = read_matrix(path, shape)?;
        match reflectance.iter().find(|r| !(0.0..=1.0).contains(*r)) {
            Some(r) => Err(Error::Array {
                path: path.display().to_string(),
                problem: format!("{r} is not a reflectance; give numbers from 0 to 1"),
            }),
            None => Ok(reflectance),
        }
    }

    /// A sample from facet RGB at exposure 1, with noise.
    fn sample(&self, id: &str, rgb: DMatrix<f64>, stream: u64) -> Result<Sample> {
        // a photograph has its own noise, pixel by pixel
        let noise = if self.args.render.render.is_some() { Noise::default() } else { self.noise };
        let clean = self.args.exposure * rgb;
        let sd = (!noise.is_none()).then(|| FacetValues::from(&clean.map(|signal| noise.sd_at(signal))));
        // facet by facet, in the order of the noise
        let mut noisy = clean.transpose();
        noise.add(noisy.as_mut_slice(), self.args.seed, stream);
        let mut sample = Sample::new(&self.scene.id()?, id)?;
        sample.set_facets(&FacetValues::from(&noisy.transpose()), sd.as_ref(), self.setting.pictures()?)?;
        sample.fields.set("exposure", self.args.exposure)?;
        Ok(sample)
    }
}

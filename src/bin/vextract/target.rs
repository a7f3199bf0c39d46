//! Patches of known reflectance in a photograph.

use std::path::Path;

use vfold::calibrate::{Calibration, Patch};
use vfold::camera::{ChartCamera, ChartPatch};
use vfold::error::counted;
use vfold::forward::OpenLight;
use vfold::image::{
    FacetMeasurement, Grid, Homography, Lens, Photograph, Point, corner_orders, measure_patches,
};
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};
use vfold::stream::{CalibrationRecord, Corners};
use vfold::{Error, Result};

/// Hot pixels are harmless; a patch with a larger clipped fraction is too bright.
const CLIPPED: f64 = 0.01;
/// Residuals below this indicate a chart in the right order.
const GOOD_RESIDUAL: f64 = 0.05;
/// A chart with a darker brightest patch is too dark to determine a camera.
const DARK: f64 = 0.02;

/// A chart, or a white card as a chart of one patch.
pub struct Target {
    /// Its name in the record.
    name: &'static str,
    /// The flag that states its position.
    flag: &'static str,
    rows: usize,
    cols: usize,
    /// Cosine of the incidence of sunlight on it.
    cos: f64,
    /// Name and reflectance, one number per waveband, row by row.
    patches: Vec<(String, Vec<f64>)>,
}

/// A photograph with its light and lens.
pub struct View<'a> {
    pub path: &'a Path,
    pub photograph: &'a Photograph,
    pub light: &'a OpenLight,
    pub lens: Lens,
}

impl Target {
    pub fn new(
        (name, flag): (&'static str, &'static str),
        (rows, cols): (usize, usize),
        cos: f64,
        spectra: &[Spectrum],
        grid: &WavelengthGrid,
    ) -> Result<Self> {
        let patch = |patch: &Spectrum| Ok((patch.name().to_owned(), patch.on(grid, Outside::Refuse)?));
        let patches = spectra.iter().map(patch).collect::<Result<_>>()?;
        Ok(Self { name, flag, rows, cols, cos, patches })
    }

    /// A target of one patch that reflects the same in all wavebands.
    pub fn even(
        (name, flag): (&'static str, &'static str),
        cos: f64,
        reflectance: f64,
        grid: &WavelengthGrid,
    ) -> Self {
        let patches = vec![(name.to_owned(), vec![reflectance; grid.len()])];
        Self { name, flag, rows: 1, cols: 1, cos, patches }
    }

    /// Cosine of the incidence of sunlight on it.
    pub fn cos(&self) -> f64 {
        self.cos
    }

    /// Light of its first patch at exposure 1, one number per channel.
    pub fn expected(&self, light: &OpenLight) -> Vec<f64> {
        light.flat_rgb(self.cos, &self.patches[0].1)
    }

    /// Its patches between `corners`.
    pub fn grid(&self, lens: Lens, corners: Corners) -> Result<Grid> {
        Ok(Grid::even(Homography::through(lens, corners)?, [self.rows, self.cols]))
    }

    /// The calibration by this target between `corners`.
    pub fn calibrate(&self, view: &View, corners: Corners) -> Result<(Calibration, CalibrationRecord)> {
        let found = |corners| self.fit(view, corners);
        let as_stated = found(corners);
        let residual = as_stated.as_ref().map_or(f64::INFINITY, |(_, record)| record.residual());
        if residual < GOOD_RESIDUAL {
            return as_stated;
        }
        let better = corner_orders(corners)
            .into_iter()
            .skip(1)
            .filter_map(|order| Some((order, found(order).ok()?.1.residual())))
            .filter(|(_, other)| *other < residual / 2.0)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((order, other)) = better else { return as_stated };
        Err(self.turned(view.path, order, other))
    }

    fn fit(&self, view: &View, corners: Corners) -> Result<(Calibration, CalibrationRecord)> {
        let patches = self.measure(view, corners)?;
        let calibration = Calibration::fit(&patches, view.light.sun().reference_channel()).map_err(|e| {
            let remedy = format!("check {}, its reference, --camera, --illuminant and --transfer", self.flag);
            Error::picture(view.path, format!("{}: {e}", self.name), remedy)
        })?;
        let place = ([self.rows, self.cols], self.cos, corners);
        let record = CalibrationRecord::new(self.name, place, &calibration, &patches);
        Ok((calibration, record))
    }

    /// Its patches as measured in a photograph.
    pub fn measure(&self, view: &View, corners: Corners) -> Result<Vec<Patch>> {
        let (seen, known) = (view.photograph.channels(), view.light.sun().channels());
        if seen != known {
            let problem = format!("the photograph has {}, the camera {known}", counted(seen, "channel"));
            return Err(Error::picture(view.path, problem, "give the photograph's --camera"));
        }
        let patch = |(seen, (name, reflectance)): (Seen, &(String, Vec<f64>))| Patch {
            name: name.clone(),
            measured: seen.mean,
            standard_error: seen.standard_error,
            expected: view.light.flat_rgb(self.cos, reflectance),
        };
        let seen = self.seen((view.path, view.photograph), view.lens, corners)?;
        Ok(seen.into_iter().zip(&self.patches).map(patch).collect())
    }

    /// The measurement of each patch.
    fn seen(
        &self,
        (path, photograph): (&Path, &Photograph),
        lens: Lens,
        corners: Corners,
    ) -> Result<Vec<Seen>> {
        let measured = measure_patches(photograph, self.name, corners, lens, [self.rows, self.cols])?;
        let patch = |(measured, (name, _)): (FacetMeasurement, &(String, Vec<f64>))| {
            let clipped = measured.clipped as f64;
            let wrong = |problem: &str, remedy: String| {
                Error::picture(path, format!("{}: patch '{name}' {problem}", self.name), remedy)
            };
            if clipped > CLIPPED * (measured.pixels + clipped) {
                return Err(wrong("is clipped", "expose less, or check --white-level".to_owned()));
            }
            match (measured.mean, measured.standard_error) {
                (Some(mean), Some(standard_error)) => Ok(Seen { mean, standard_error }),
                _ => Err(wrong("has too few pixels", format!("check {}", self.flag))),
            }
        };
        measured.into_iter().zip(&self.patches).map(patch).collect()
    }

    /// The camera that recorded this target between `corners`, in light with this power per waveband.
    pub fn camera(
        &self,
        of: (&Path, &Photograph),
        lens: Lens,
        corners: Corners,
        light: (&WavelengthGrid, &[f64]),
    ) -> Result<ChartCamera> {
        let found = |corners| self.fit_camera(of, lens, corners, light);
        let as_stated = found(corners);
        let residual = as_stated.as_ref().map_or(f64::INFINITY, |camera| camera.residual);
        if residual < GOOD_RESIDUAL {
            return as_stated;
        }
        let other_orders = corner_orders(corners).into_iter().skip(1);
        let fits = |order: &[Point; 4]| found(*order).is_ok_and(|camera| camera.residual < residual / 2.0);
        let Some(order) = other_orders.into_iter().find(fits) else { return as_stated };
        Err(self.turned(of.0, order, found(order)?.residual))
    }

    fn fit_camera(
        &self,
        of: (&Path, &Photograph),
        lens: Lens,
        corners: Corners,
        (grid, power): (&WavelengthGrid, &[f64]),
    ) -> Result<ChartCamera> {
        let (path, photograph) = of;
        if photograph.channels() != 3 {
            let problem = format!("the photograph has {}", counted(photograph.channels(), "channel"));
            return Err(Error::picture(path, problem, "--save-camera needs R, G and B"));
        }
        let seen = self.seen(of, lens, corners)?;
        let brightest = seen.iter().flat_map(|patch| &patch.mean).copied().fold(0.0, f64::max);
        if brightest < DARK {
            let problem =
                format!("the chart is too dark: its brightest patch is {brightest:.1e} of the white level");
            return Err(Error::picture(
                path,
                problem,
                "expose more, or check --black-level and --white-level",
            ));
        }
        let patch = |(seen, (name, reflectance)): (Seen, &(String, Vec<f64>))| {
            let (measured, standard_error) = (array(seen.mean), array(seen.standard_error));
            if measured.iter().any(|value| *value <= 0.0) {
                let problem = format!("the chart is too dark: patch '{name}' is no brighter than black");
                return Err(Error::picture(path, problem, "expose more, or check --black-level"));
            }
            Ok(ChartPatch { reflectance: reflectance.clone(), measured, standard_error })
        };
        let patches: Vec<_> = seen.into_iter().zip(&self.patches).map(patch).collect::<Result<_>>()?;
        ChartCamera::new(grid, power, &patches).map_err(|e| {
            let remedy = format!("check {}, its reference, --illuminant and --transfer", self.flag);
            Error::picture(path, format!("{}: {e}", self.name), remedy)
        })
    }

    fn turned(&self, path: &Path, order: [Point; 4], residual: f64) -> Error {
        let problem = format!(
            "the {} is turned or mirrored: in another order its corners fit to {:.2} %",
            self.name,
            100.0 * residual
        );
        let corners = order.map(|corner| format!("{},{}", corner.x, corner.y)).join(" ");
        Error::picture(path, problem, format!("give {} \"{corners}\"", self.flag))
    }
}

/// Measurement of a patch, per channel.
struct Seen {
    mean: Vec<f64>,
    standard_error: Vec<f64>,
}

fn array(channels: Vec<f64>) -> [f64; 3] {
    std::array::from_fn(|channel| channels[channel])
}

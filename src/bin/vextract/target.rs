//! Patches of known reflectance in a photograph.

use std::path::Path;

use vfold::calibrate::{Calibration, Patch};
use vfold::forward::OpenLight;
use vfold::image::{FacetMeasurement, Grid, Homography, Lens, Photograph, corner_orders, measure_patches};
use vfold::spectrum::{Outside, Spectrum, WavelengthGrid};
use vfold::stream::{CalibrationRecord, Corners};
use vfold::{Error, Result};

/// Hot pixels do no harm; a patch of which a larger share is clipped is too bright.
const CLIPPED: f64 = 0.01;
/// Residuals below this are those of a chart in its right order.
const GOOD_RESIDUAL: f64 = 0.05;

/// A chart, or a white card as a chart of one patch.
pub struct Target {
    /// What it is, as the record says it.
    name: &'static str,
    /// The flag that says where it is.
    flag: &'static str,
    rows: usize,
    cols: usize,
    /// Cosine of the angle at which the sun meets it.
    cos: f64,
    /// Name and reflectance, one number per waveband, row by row.
    patches: Vec<(String, Vec<f64>)>,
}

/// A photograph, and the light and lens through which it is seen.
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

    /// Its patches between `corners`.
    pub fn grid(&self, lens: Lens, corners: Corners) -> Result<Grid> {
        Ok(Grid::even(Homography::through(lens, corners)?, [self.rows, self.cols]))
    }

    /// The calibration by this target between `corners`.
    pub fn calibrate(&self, view: &View, corners: Corners) -> Result<(Calibration, CalibrationRecord)> {
        let found = |corners| self.fit(view, corners);
        let given = found(corners);
        let residual = given.as_ref().map_or(f64::INFINITY, |(_, record)| record.residual());
        if residual < GOOD_RESIDUAL {
            return given;
        }
        let better = corner_orders(corners)
            .into_iter()
            .skip(1)
            .filter_map(|order| Some((order, found(order).ok()?.1.residual())))
            .filter(|(_, other)| *other < residual / 2.0)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((order, other)) = better else { return given };
        let problem = format!(
            "the {} is turned or mirrored: its corners fit in another order, within {:.2} %",
            self.name,
            100.0 * other
        );
        let corners = order.map(|corner| format!("{},{}", corner.x, corner.y)).join(" ");
        Err(Error::picture(view.path, problem, format!("give {} \"{corners}\"", self.flag)))
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

    fn measure(&self, view: &View, corners: Corners) -> Result<Vec<Patch>> {
        let (seen, known) = (view.photograph.channels(), view.light.sun().channels());
        if seen != known {
            let problem = format!("the photograph has {seen} channels, the camera {known}");
            return Err(Error::picture(view.path, problem, "give the photograph's --camera"));
        }
        let measured =
            measure_patches(view.photograph, self.name, corners, view.lens, [self.rows, self.cols])?;
        let patch = |(measured, (name, reflectance)): (FacetMeasurement, &(String, Vec<f64>))| {
            let clipped = measured.clipped as f64;
            let wrong = |problem: &str, remedy: String| {
                Error::picture(view.path, format!("{}: patch '{name}' {problem}", self.name), remedy)
            };
            if clipped > CLIPPED * (measured.pixels + clipped) {
                return Err(wrong("is clipped", "expose less, or check --white-level".to_owned()));
            }
            let (Some(mean), Some(standard_error)) = (measured.mean, measured.standard_error) else {
                return Err(wrong("has too few pixels", format!("check {}", self.flag)));
            };
            let expected = view.light.flat_rgb(self.cos, reflectance);
            Ok(Patch { name: name.clone(), measured: mean, standard_error, expected })
        };
        measured.into_iter().zip(&self.patches).map(patch).collect()
    }
}

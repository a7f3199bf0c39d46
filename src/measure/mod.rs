//! From a photograph to the spectrum of its sheet in one call, as the tools do by default.

mod camera;
mod light;

use std::collections::BTreeMap;
use std::sync::Arc;

pub use camera::{Camera, camera_of};
pub use light::{LightTaken, light_of};

use crate::error::{Error, Result};
use crate::estimate::Exposure;
use crate::estimate::emission::Backing;
use crate::estimate::light::Candidate;
use crate::estimate::measured::Measured;
use crate::estimate::measurement::{Facets, Inference, Measurement, Photographed};
use crate::estimate::noise::{Noise, NoiseSource};
use crate::estimate::prior::Prior;
use crate::estimate::unknowns::SceneModel;
use crate::estimate::verdict::refuse_unexplained;
use crate::forward::FacetValues;
use crate::geometry::{FacetGrid, Fold, Light};
use crate::image::{
    CornersBy, FacetMeasurement, FoldSeen, Framing, LensEstimate, Making, MeasuredPanels, Photograph, Point,
    REFINED_WITHIN_PX, Refinement, measure_panels, open_sides, refine,
};
use crate::kernel::mesh::{TOLERANCE, respond};
use crate::scene::{
    FoldSetting, MarkedPanels, PhotographedFold, Picture, other_cameras, other_lights, stated, stated_fold,
};
use crate::spectrum::{ASSUMED_LIGHT, WavelengthGrid, candidate_lights};
use crate::stream::{self, Optics};

/// Least distance of a pixel from a panel's sides, px.
const MARGIN_PX: f64 = 0.0;

/// A photographed fold, and what is known of it.
#[derive(Clone, Debug)]
pub struct Setup<'a> {
    /// The fold and its facets.
    pub fold: Fold,
    /// Direction of the sun, and diffuse-to-direct ratio.
    pub light: Light,
    /// Corners of each panel, px of the upright picture from its top left corner: crease end 0, crease end 1,
    /// outer end 1, outer end 0; they are refined to the nearby edges.
    pub corners: [[Point; 4]; 2],
    /// Wavelengths of the spectrum.
    pub wavelengths: WavelengthGrid,
    /// Built-in name or file of the camera; if none, the one named in the photograph, or a stand-in for it.
    pub camera: Option<&'a str>,
    /// Built-in name or file of the illuminant, or a SPEC such as `sun:40deg`; if none, the sun at the
    /// photograph's place and time if recorded, else assumed daylight or, with a flash, a lamp or at night,
    /// an inferred light.
    pub illuminant: Option<&'a str>,
    /// Value of a perfect white diffuser facing the sun, in its strongest channel, if known.
    pub exposure: Option<f64>,
    /// What is behind the sheet.
    pub backing: Backing,
}

impl Setup<'_> {
    /// A fold of square panels open by `angle_deg`, degrees, with 10 x 10 facets each, the sun in its plane
    /// of symmetry, and everything else unknown; the spectrum from 400 to 700 nm by 5.
    ///
    /// # Errors
    /// [`Error::Usage`] if there is no such fold.
    pub fn new(angle_deg: f64, corners: [[Point; 4]; 2]) -> Result<Self> {
        let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
        Ok(Self {
            fold,
            light: Light::new(&fold, 0.0, 0.0, 0.0)?,
            corners,
            wavelengths: WavelengthGrid::uniform(400.0, 700.0, 5.0)?,
            camera: None,
            illuminant: None,
            exposure: None,
            backing: Backing::Unknown,
        })
    }

    /// The fold, its light, and the camera that took the photograph.
    fn setting(&self, photograph: &Photograph) -> Result<FoldSetting> {
        let info = photograph.info();
        let camera = match self.camera {
            Some(named) => Camera::named(named),
            None => camera_of(info)?,
        };
        let sun = || match light_of(&info.camera.taken) {
            LightTaken::Sun(spec, _) => Some(spec),
            LightTaken::Daylight(_) | LightTaken::OtherThanDaylight(_) => None,
        };
        let light = self.illuminant.map(str::to_owned).or_else(sun);
        let illuminant = stream::specs().illuminant(light.as_deref().unwrap_or(ASSUMED_LIGHT))?;
        let sensitivities = camera.sensitivities(|spec| stream::specs().camera(spec))?;
        let mut optics = Optics::new(self.wavelengths.clone(), &sensitivities, &[illuminant], None)?;
        optics.camera.stands_in = camera.stands_in;
        Ok(FoldSetting {
            fold: self.fold,
            angle_sd_deg: None,
            light: self.light,
            sky: None,
            is_lit_otherwise: false,
            response: respond(&self.fold, TOLERANCE)?.0,
            optics: Some(optics),
            is_daylight_assumed: light.is_none(),
            backing: self.backing,
            card: None,
            tolerance: Some(TOLERANCE),
        })
    }

    /// Candidates for a light that was not stated and that the camera noted not to be daylight; empty
    /// otherwise.
    fn lights(&self, photograph: &Photograph, optics: &Optics) -> Result<Vec<Candidate>> {
        match (self.illuminant, light_of(&photograph.info().camera.taken)) {
            (None, LightTaken::OtherThanDaylight(_)) => {
                Candidate::all(candidate_lights()?, &self.wavelengths, &optics.camera.sensitivities)
            }
            _ => Ok(Vec::new()),
        }
    }
}

/// Measures the spectrum of a folded sheet in a photograph, as `vkernel`, `vextract` and `vestimate` do by
/// default.
///
/// # Arguments
/// - `photograph`: linear light, opened from a file ([`Photograph::open`]) or [in
///   memory](Photograph::from_light).
/// - `setup`: positions of the panels, and what is known of fold, light and camera.
///
/// # Returns
/// For every wavelength the 45°:0° reflectance factor, from 0 to 1, with its standard deviation; the
/// exposure; effects that distinguish the photograph from that of an ideal fold; and the verdict. See
/// [`Measurement`].
///
/// # Errors
/// [`Error::Usage`] if neither the photograph nor `setup` names a camera, or corners are not those of the
/// fold's panels; [`Error::Corners`] if they lie outside the picture; [`Error::Spectrum`] if camera or light
/// are unknown; [`Error::Numeric`] if the picture has other channels than the camera, or is a grey one saved
/// as RGB; [`Error::Field`] if no facet is usable, or the facets are nothing like those of a fold.
///
/// # Example
/// ```
/// use vfold::estimate::verdict::Level;
/// use vfold::image::{Photograph, Point, ReadOptions};
/// use vfold::measure::{Setup, sheet};
///
/// let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
/// let photograph = Photograph::open(file.as_ref(), &ReadOptions::default())?;
/// let panel0 =
///     [(332.1, 462.5), (345.3, 77.1), (121.9, 11.9), (103.9, 442.2)].map(|(x, y)| Point::new(x, y));
/// let panel1 =
///     [(332.1, 462.5), (345.3, 77.1), (484.9, 16.7), (472.0, 453.4)].map(|(x, y)| Point::new(x, y));
/// let known = Setup {
///     camera: Some("canon-5d-mark-ii"),
///     illuminant: Some("D65"),
///     ..Setup::new(50.0, [panel0, panel1])?
/// };
///
/// let measured = sheet(&photograph, &known)?;
/// assert_eq!(measured.verdict.level, Level::Good);
/// let (reflectance, sd) = (&measured.estimate.reflectance, measured.estimate.reflectance_sd().unwrap());
/// let at = measured.wavelengths_nm.iter().position(|nm| *nm == 600.0).unwrap();
/// assert!((reflectance[at] - 0.279).abs() < 2.0 * sd[at]); // the magenta patch of a ColorChecker
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn sheet(photograph: &Photograph, setup: &Setup) -> Result<Measurement> {
    let fold = setup.setting(photograph)?;
    if let Some(problem) = photograph.unlike_camera(fold.optics()?.camera.channels.len()) {
        return Err(Error::Numeric(problem));
    }
    let panels: BTreeMap<_, _> = fold.fold.panels().into_iter().enumerate().collect();
    let marked: BTreeMap<_, _> = setup.corners.into_iter().enumerate().collect();
    let panels = MarkedPanels::new(&panels, &marked)?;
    let Refinement { panels: refined, lens, .. } =
        refine(photograph, &panels.marked, &LensEstimate::UNKNOWN, REFINED_WITHIN_PX)?;
    let corners = <[[Point; 4]; 2]>::try_from(refined).unwrap_or(setup.corners);
    let panels = panels.grids(lens.lens, corners)?;
    let MeasuredPanels { facets, processing, .. } = measure_panels(photograph, &panels, MARGIN_PX)?;
    let rgb = values(&facets, |facet| facet.mean.clone())?;
    let noise = Noise {
        source: NoiseSource::OfFacets(values(&facets, |facet| facet.standard_error.clone())?),
        model_error: Noise::model_error(true),
    };
    let model = fold.model()?;
    let sd = noise.deviations(&model, &rgb)?;
    let (rgb, shadows) = fold.out_of_shadows(&rgb, &sd);
    let measured = &Measured { rgb: &rgb, sd: &sd };
    let picture = Picture {
        measured,
        framing: Some(Framing {
            panels: corners.map(Some),
            size: [photograph.width(), photograph.height()].map(|px| px as f64),
            margin_px: MARGIN_PX,
        }),
        exposure: setup.exposure,
        by_chart: false,
        white_per_klx: photograph.info().white_per_klx(),
        by_paper: None,
    };
    let seen = FoldSeen {
        size: [photograph.width(), photograph.height()],
        corners_by: CornersBy::Hand,
        lens,
        focal_35mm: photograph.info().camera.focal_35mm,
        depths: None,
    };
    let other_fold = seen.other_than(&corners, &stated_fold(&fold.fold, None));
    let taken = Photographed {
        making: Making::of(photograph.info(), processing, open_sides(photograph, &panels), other_fold),
        chart_residual: None,
        shadows,
        parts: Some(PhotographedFold::of(&fold).parts(&picture)?),
    };
    let lights = setup.lights(photograph, fold.optics()?)?;
    let stated = stated(fold.optics()?, fold.is_daylight_assumed);
    let wavelengths_nm = setup.wavelengths.wavelengths_nm();
    let inference = Inference {
        model: SceneModel::known(model),
        wavelengths_nm: wavelengths_nm.to_vec(),
        start: None,
        is_auto: true,
        stated: if lights.is_empty() { stated } else { stated.but_light() },
        lights,
        other_lights: other_lights(fold.optics()?, fold.is_daylight_assumed).map(Arc::new),
        other_cameras: other_cameras(fold.optics()?),
        shown: None,
        panel: Some(fold.fold.facets()),
    };
    let exposure = setup.exposure.map_or(Exposure::Free, Exposure::Known);
    let data = inference.data(measured, exposure, true)?;
    let facets = Facets { measured, exposure, photograph: Some(&taken) };
    let measurement = inference.measure(&facets, &data, &Prior::built_in(wavelengths_nm)?)?;
    refuse_unexplained(&measurement.estimate, || Ok(1.0))?;
    Ok(measurement)
}

/// A property of the facets' measurements as facet values.
fn values(
    facets: &[FacetMeasurement],
    pick: fn(&FacetMeasurement) -> Option<Vec<f64>>,
) -> Result<FacetValues> {
    FacetValues::of_rows(&facets.iter().map(pick).collect::<Vec<_>>())
        .ok_or_else(|| Error::Numeric("facets have different numbers of channels".to_owned()))
}

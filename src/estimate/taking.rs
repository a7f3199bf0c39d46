//! The stated light and camera, and doubts that arise from how a photograph was taken.

use std::fmt;

use super::verdict::{Doubt, Level};
use crate::image::{Making, Processing, camera_name};
use crate::spectrum::is_other_camera;
use crate::spectrum::library::{What, is_built_in};

/// The stated light and camera.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stated {
    /// Names of the lights; empty if none was stated.
    pub lights: Vec<String>,
    /// True if daylight was assumed, because no light was stated.
    pub is_daylight_assumed: bool,
    /// Name of the camera.
    pub camera: String,
    /// The camera that took the picture, if its sensitivities were not measured and others stand in for them.
    pub stands_in_for: Option<String>,
    /// True if the sensitivities are predicted from its colour matrix rather than those of another camera.
    pub is_predicted: bool,
    /// True if all channels have the same peak, as when they are scaled one by one.
    pub has_one_peak: bool,
}

impl Stated {
    /// The same for an inferred light.
    #[must_use]
    pub fn but_light(self) -> Self {
        Self { lights: Vec::new(), is_daylight_assumed: false, ..self }
    }
}

impl fmt::Display for Stated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scaled =
            if self.has_one_peak { " (whose channels are each scaled to the same peak)" } else { "" };
        if self.is_daylight_assumed {
            f.write_str("the light, which was assumed to be daylight, or ")?;
        } else if !self.lights.is_empty() {
            write!(f, "the light {} or ", self.lights.join(", "))?;
        }
        write!(f, "the camera {}{scaled}", self.camera)
    }
}

/// Root mean square of the residuals of a chart's patches, relative to what the stated light and camera
/// give, above which one of these is wrong: more than charts of `train` leave in any daylight stated for
/// theirs, through cameras that differ from the measured ones as units do (`benches/stated.sh`).
const CHART_RESIDUAL: f64 = 0.08;

/// Doubts that arise from how the photograph was taken; `chart_residual` is the root mean square of the
/// residuals of a chart's patches, if there is a chart.
#[must_use]
pub fn doubts_of_taking(stated: &Stated, making: &Making, chart_residual: Option<f64>) -> Vec<Doubt> {
    let all = [
        unlike_chart(chart_residual),
        developed(making),
        processed(making),
        black(making),
        open_sides(making),
        other_fold(making),
        scaled(stated),
        stand_in(stated),
        another_camera(stated, making),
    ];
    all.into_iter().flatten().collect()
}

fn developed(making: &Making) -> Option<Doubt> {
    making.is_developed.then(|| Doubt {
        level: Level::Wrong,
        because: "this picture was developed for the eye, \
                  and neither white balance nor colour matrix was undone"
            .to_owned(),
        remedy:
            "use the RAW file, or give vextract --undo, or --transfer if its numbers are the camera's own"
                .to_owned(),
    })
}

fn processed(making: &Making) -> Option<Doubt> {
    let because = |processing| match processing {
        Processing::Curve => "noise falls as brightness rises: a tone curve such as sRGB's was applied",
        Processing::Matrix => {
            "noise in the channels is anticorrelated: a colour matrix mixed them, \
             as programs that develop RAW files do"
        }
        Processing::CurveOfFlatField => {
            "noise in the picture given with --white falls as brightness rises: \
             a tone curve such as sRGB's was applied to it"
        }
    };
    making.processing.map(|processing| Doubt {
        level: Level::Wrong,
        because: because(processing).to_owned(),
        remedy: "use the RAW file, or a linear TIFF in the camera's own colours".to_owned(),
    })
}

/// A chart that is not as the stated light and camera show it.
fn unlike_chart(residual: Option<f64>) -> Option<Doubt> {
    residual.filter(|residual| *residual > CHART_RESIDUAL).map(|residual| {
        let percent = 100.0 * residual;
        Doubt::new(
            format!("the patches of the chart are {percent:.0} % off what light and camera would give"),
            "check the light, the camera and which chart it is",
        )
    })
}

fn black(making: &Making) -> Option<Doubt> {
    making.unsubtracted_black.map(|part| {
        let percent = 100.0 * part;
        Doubt::new(
            format!(
                "the darkest pixels are {percent:.2} % of white in every channel: \
                 black was probably not subtracted"
            ),
            "give vextract --black-level auto, or the camera's black level",
        )
    })
}

fn open_sides(making: &Making) -> Option<Doubt> {
    let sides = making.open_sides.join(" or ");
    (!sides.is_empty()).then(|| {
        Doubt::new(
            format!(
                "no edge of the sheet lies along {sides}: it extends beyond the corners, \
                 or does not reach them"
            ),
            "mark the corners of whole panels, and check them with vextract --overlay",
        )
    })
}

/// Corners that do not belong to the stated fold.
fn other_fold(making: &Making) -> Option<Doubt> {
    making.other_fold.map(|other| {
        Doubt::new(
            format!("the corners are not those of the stated fold, but {other}"),
            "measure sheet and angle again, check the corners with vextract --overlay, \
             or give the output of vextract --find to vkernel --regions",
        )
    })
}

/// Sensitivities scaled one by one have lost the ratios of the channels. For built-in cameras published like
/// that (docs/spectra.md) the verdict says so without doubting: the paper, and samples simulated with them,
/// take them as they are.
fn scaled(Stated { camera, has_one_peak, .. }: &Stated) -> Option<Doubt> {
    (*has_one_peak && !is_built_in(What::Cameras, camera)).then(|| {
        Doubt::new(
            format!(
                "all channels of the camera {camera} have the same peak: scaled one by one, \
                 they have lost their ratios"
            ),
            "give sensitivities on one scale, or derive them from a photograph \
             of a colour chart (vextract --save-camera)",
        )
    })
}

fn stand_in(stated: &Stated) -> Option<Doubt> {
    let instead = if stated.is_predicted {
        "they are predicted from its colour matrix"
    } else {
        "those of another camera stand in"
    };
    stated.stands_in_for.as_ref().map(|unmeasured| {
        Doubt::new(
            format!("the sensitivities of {unmeasured} have not been measured: {instead}"),
            "derive them from a photograph of a colour chart (vextract --save-camera)",
        )
    })
}

/// EXIF data that name another camera than the stated one.
fn another_camera(stated: &Stated, making: &Making) -> Option<Doubt> {
    let (make, model) = &making.taken_by;
    let is_other = stated.stands_in_for.is_none() && is_other_camera(&stated.camera, make, model);
    is_other.then(|| {
        Doubt::new(
            format!("EXIF says that {} took the picture, not {}", camera_name(make, model), stated.camera),
            "give the camera that took it (vextract --camera)",
        )
    })
}

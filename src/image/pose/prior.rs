//! The priors on a fold and a camera.

use std::f64::consts::SQRT_2;

use super::view::{ANGLE, K1, LN_DEPTH, LN_DEPTH_RATIO, LN_FOCAL};

/// Prior mean and standard deviation of an unknown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Expected {
    /// Its index among the unknowns.
    pub unknown: usize,
    pub mean: f64,
    pub sd: f64,
}

/// Number of unknowns with a prior.
pub(super) const EXPECTED: usize = 5;

/// A hypothesis on how a fold was made and photographed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hypothesis {
    /// Its prior probability.
    pub share: f64,
    pub expected: [Expected; EXPECTED],
    pub form: Form,
}

/// The form of both panels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Form {
    /// Their depths relative to their width.
    Usual([f64; 2]),
    /// Any other.
    Other,
}

/// Diagonal of a film frame, mm, to which equivalent focal lengths refer (CIPA DCG-001).
pub(super) const FILM_DIAGONAL_MM: f64 = 43.27;
/// Equivalent focal length of an unknown camera, mm: two in three are between 25 mm and 120 mm.
pub(super) const FOCAL_MM: f64 = 55.0;
const LN_FOCAL_SD: f64 = 0.8;
/// Error of a focal length stated in the file: it is rounded to mm, and lenses are focused at close range.
const LN_STATED_FOCAL_SD: f64 = 0.05;
/// Fraction of pictures cropped after the focal length was recorded.
const CROPPED_SHARE: f64 = 0.1;
/// Error of a panel's depth: sheets are cut and folded by hand.
const LN_DEPTH_SD: f64 = 0.005;
/// Depth over width of panels of unknown form: two in three are between a half and two.
const LN_ANY_DEPTH_SD: f64 = 0.7;

/// Mean and standard deviation of an unstated angle, radians: any.
const ANY_ANGLE: (f64, f64) = (0.8, 10.0);
/// Those of an angle other than the stated one, radians: most folds are open by 20° to 80°.
const OTHER_ANGLE: (f64, f64) = (0.85, 0.4);
/// Fraction of folds that are as stated; of the others half have another angle, half other panels.
const AS_STATED: f64 = 0.9;

/// Depth over width of usual panels, and their prior probabilities: mostly squares, then halves of A and
/// Letter sheets divided either way, whole ones of sheets twice as large, and the same folded the other way.
const FORMS: [(f64, f64); 11] = [
    (1.0, 0.75),
    (1.0 / SQRT_2, 0.02),
    (0.5 / SQRT_2, 0.02),
    (5.5 / 8.5, 0.02),
    (4.25 / 11.0, 0.02),
    (8.5 / 11.0, 0.02),
    (SQRT_2, 0.01),
    (2.0 * SQRT_2, 0.01),
    (8.5 / 5.5, 0.01),
    (11.0 / 4.25, 0.01),
    (11.0 / 8.5, 0.01),
];

/// Knowledge of a fold and its camera in addition to the corners.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct KnownBefore {
    /// Standard deviation of the lens's k1 from that which is corrected.
    pub k1_sd: f64,
    /// The focal length stated in the file, in the unit of the picture.
    pub focal: Option<f64>,
    /// The focal length of [`FOCAL_MM`], in the unit of the picture.
    pub usual_focal: f64,
    /// Depths of both panels over their width.
    pub depths: Option<[f64; 2]>,
}

/// All hypotheses on how the fold was made and photographed.
pub(super) fn hypotheses(known_before: &KnownBefore) -> Vec<Hypothesis> {
    forms(known_before.depths)
        .into_iter()
        .flat_map(|form| with_focals(known_before, form, ANY_ANGLE))
        .collect()
}

/// The fold as stated, with mean and standard deviation of its angle, radians.
pub(super) fn as_stated(known_before: &KnownBefore, depths: [f64; 2], angle: (f64, f64)) -> Vec<Hypothesis> {
    with_focals(known_before, (AS_STATED, Form::Usual(depths)), angle)
}

/// The alternatives: another angle, or another form of the panels.
pub(super) fn other_than_stated(
    known_before: &KnownBefore,
    depths: [f64; 2],
    angle: (f64, f64),
) -> Vec<Hypothesis> {
    let share = 0.5 * (1.0 - AS_STATED);
    let other_angle = with_focals(known_before, (share, Form::Usual(depths)), OTHER_ANGLE);
    let is_other = |(_, form): &(f64, Form)| *form != Form::Usual(depths);
    let others = forms(None).into_iter().filter(is_other);
    let other_form =
        others.flat_map(|(of_form, form)| with_focals(known_before, (share * of_form, form), angle));
    other_angle.into_iter().chain(other_form).collect()
}

/// A form of the panels and its probability, with every focal length.
fn with_focals(known_before: &KnownBefore, (share, form): (f64, Form), angle: (f64, f64)) -> Vec<Hypothesis> {
    let k1 = Expected { unknown: K1, mean: 0.0, sd: known_before.k1_sd };
    let angle = Expected { unknown: ANGLE, mean: angle.0, sd: angle.1 };
    let [depth, ratio] = of_form(form);
    let hypothesis = |(of_focal, focal): (f64, Expected)| Hypothesis {
        share: share * of_focal,
        expected: [focal, k1, depth, ratio, angle],
        form,
    };
    focals(known_before).into_iter().map(hypothesis).collect()
}

/// Possible forms of the panels, with their probabilities.
fn forms(known_before: Option<[f64; 2]>) -> Vec<(f64, Form)> {
    if let Some(depths) = known_before {
        return vec![(1.0, Form::Usual(depths))];
    }
    let usual = FORMS.map(|(depth, share)| (share, Form::Usual([depth; 2])));
    let others = 1.0 - FORMS.iter().map(|(_, share)| share).sum::<f64>();
    usual.into_iter().chain([(others, Form::Other)]).collect()
}

/// Prior on the depths for this form.
fn of_form(form: Form) -> [Expected; 2] {
    let (mean, sd, ratio) = match form {
        Form::Usual([depth0, depth1]) => (depth0.ln(), LN_DEPTH_SD, (depth1 / depth0).ln()),
        Form::Other => (0.0, LN_ANY_DEPTH_SD, 0.0),
    };
    [
        Expected { unknown: LN_DEPTH, mean, sd },
        Expected { unknown: LN_DEPTH_RATIO, mean: ratio, sd: LN_DEPTH_SD },
    ]
}

/// Possible focal lengths of the camera, with their probabilities.
fn focals(known_before: &KnownBefore) -> Vec<(f64, Expected)> {
    let expected = |focal: f64, sd: f64| Expected { unknown: LN_FOCAL, mean: focal.ln(), sd };
    let usual = expected(known_before.usual_focal, LN_FOCAL_SD);
    match known_before.focal {
        Some(focal) => {
            vec![(1.0 - CROPPED_SHARE, expected(focal, LN_STATED_FOCAL_SD)), (CROPPED_SHARE, usual)]
        }
        None => vec![(1.0, usual)],
    }
}

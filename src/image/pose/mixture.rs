//! The most probable form of the panels among several explanations of the same corners, and the uncertainty
//! of the angle over all of them.

use super::fit::Fitted;
use super::prior::Form;
use super::view::{ANGLE, LN_DEPTH, LN_DEPTH_RATIO};

/// Fits whose angles, radians, and logarithms of depths differ by less than this are identical.
const SAME: f64 = 1e-4;
/// Fraction of the total weight over which deviations are averaged.
const PROBABLE: f64 = 0.95;

/// Corners explained by a fold of some form.
#[derive(Debug, Clone, Copy)]
pub(super) struct Explanation {
    pub form: Form,
    pub fitted: Fitted,
}

/// The average over several explanations.
pub(super) struct Mean {
    /// The angle for the most probable form, radians.
    pub angle: f64,
    /// Its standard deviation.
    pub sd: f64,
    /// Depths of panels of that form relative to their width.
    pub depths: [f64; 2],
}

/// Averages explanations by their evidence; none if there are none.
pub(super) fn mean(explanations: Vec<Explanation>) -> Option<Mean> {
    let explanations = distinct(explanations);
    let most = explanations.iter().map(|one| one.fitted.ln_evidence).fold(f64::NEG_INFINITY, f64::max);
    let weight = |one: &Explanation| (one.fitted.ln_evidence - most).exp();
    let of_form = |form: Form| explanations.iter().filter(move |one| one.form == form);
    let weight_of = |form: Form| of_form(form).map(weight).sum::<f64>();
    let forms = explanations.iter().map(|one| one.form);
    let form = forms.max_by(|a, b| weight_of(*a).total_cmp(&weight_of(*b)))?;
    let mean = |of: fn(&Fitted) -> f64| {
        of_form(form).map(|one| weight(one) * of(&one.fitted)).sum::<f64>() / weight_of(form)
    };
    let angle = mean(|fitted| fitted.unknowns[ANGLE]);
    let weighed =
        explanations.iter().map(|one| (weight(one), one.fitted.unknowns[ANGLE], one.fitted.angle_sd));
    let depths = match form {
        Form::Usual(depths) => depths,
        Form::Other => {
            [mean(|fitted| fitted.unknowns[LN_DEPTH] + fitted.unknowns[LN_DEPTH_RATIO] / 2.0).exp(); 2]
        }
    };
    Some(Mean { angle, sd: deviation(angle, weighed.collect()), depths })
}

/// Root mean square deviation from an angle, over the nearest explanations that make up [`PROBABLE`] of the
/// weight: weights, angles and their standard deviations.
///
/// A distant form with little weight, which a user who trusts the angle would dismiss as a blunder, would
/// increase it several times.
fn deviation(angle: f64, mut weighed: Vec<(f64, f64, f64)>) -> f64 {
    weighed.sort_by(|a, b| (a.1 - angle).abs().total_cmp(&(b.1 - angle).abs()));
    let enough = PROBABLE * weighed.iter().map(|(weight, _, _)| weight).sum::<f64>();
    let (mut total, mut squares) = (0.0, 0.0);
    for (weight, other, sd) in weighed {
        if total >= enough {
            break;
        }
        total += weight;
        squares += weight * (sd * sd + (other - angle).powi(2));
    }
    (squares / total).sqrt()
}

/// The explanations without duplicates.
pub(super) fn distinct(explanations: Vec<Explanation>) -> Vec<Explanation> {
    let mut kept: Vec<Explanation> = Vec::new();
    for one in explanations {
        let is_same = |other: &Explanation| {
            let apart = one.fitted.unknowns - other.fitted.unknowns;
            one.form == other.form
                && (one.fitted.ln_evidence - other.fitted.ln_evidence).abs() < SAME
                && [ANGLE, LN_DEPTH].iter().all(|number| apart[*number].abs() < SAME)
        };
        if !kept.iter().any(is_same) {
            kept.push(one);
        }
    }
    kept
}

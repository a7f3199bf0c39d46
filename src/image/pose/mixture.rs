//! Of several explanations of the same corners, the form of the panels that is most probable, and how
//! uncertain the angle is in all.

use super::fit::Fitted;
use super::prior::Form;
use super::view::{ANGLE, LN_DEPTH, LN_DEPTH_RATIO};

/// Fits whose angles, radians, and logarithms of depths differ by less than this are one.
const SAME: f64 = 1e-4;
/// Share of all that is likely within which deviations count.
const PROBABLE: f64 = 0.95;

/// Corners explained by a fold of some form.
#[derive(Debug, Clone, Copy)]
pub(super) struct Explanation {
    pub form: Form,
    pub fitted: Fitted,
}

/// What several explanations say together.
pub(super) struct Mean {
    /// The angle of folds of the most probable form, radians.
    pub angle: f64,
    /// Its standard deviation.
    pub sd: f64,
    /// Depths of panels of that form, over their width.
    pub depths: [f64; 2],
}

/// Weighs explanations by their evidence; none if there is no explanation.
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

/// Root mean square deviation from an angle of the nearest that make up [`PROBABLE`] of all: weights, angles
/// and their standard deviations.
///
/// A far form with little weight, which whoever believes the angle takes for a blunder, would widen it
/// manifold.
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

/// Each explanation once.
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

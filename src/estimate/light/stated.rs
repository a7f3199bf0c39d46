//! Whether another light is more probable than the one that was stated.
//!
//! In another light the facets are those of another spectrum. How much more probable the facets are then is
//! known before anything is known of who stated the light: the ratio of evidence. What people state is right
//! in nineteen cases of twenty (docs/model.md), and nothing is known of what they take for it otherwise, so
//! that every other light is weighed by itself: one in which facets are more than nineteen times as probable
//! is more probable than the one that was stated.

use std::fmt;
use std::sync::OnceLock;

use super::Candidate;
use crate::camera::CameraResponse;
use crate::estimate::data::FacetData;
use crate::estimate::facets::{Facets, Second};
use crate::estimate::fluorescence_search::Fluorescing;
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};
use crate::estimate::verdict::Doubt;
use crate::spectrum::{WavelengthGrid, candidate_lights};

/// Logarithm of the ratio of evidence that makes up for a statement: nineteen times, as one statement in
/// twenty is mistaken, rounded.
pub(super) const LN_ODDS: f64 = 3.0;
/// A light under which facets are at least as probable as that is not asked about, in standard deviations of
/// how improbable facets of known sheets are: what is as usual as that needs no other light to explain it.
const USUAL: f64 = 0.5;
/// Lights are searched if models that are linear say that facets may become so much more probable in them,
/// and are weighed by classes of spectra if they are ahead by so much under all spectra as one, so many of
/// them at most: what classes add differs from light to light by less than the rest of
/// [`LN_ODDS`].
pub(super) const LN_AHEAD: f64 = 1.0;
const DISTINCT_ODDS: usize = 3;
/// One of so many lights is tried first, as neighbours are alike.
const STEP: usize = 6;
/// More times than that are not counted.
const MOST_TIMES: f64 = 1e6;

/// Facets in the light that was stated, under all spectra as one.
pub type StatedScene = Sorted<(), Second>;

/// Lights that may be the true one instead, made when they are first asked for.
#[derive(Debug)]
pub struct Others {
    grid: WavelengthGrid,
    sensitivities: Vec<Vec<f64>>,
    lights: OnceLock<Vec<Candidate>>,
}

impl Others {
    /// Those before a camera of these sensitivities, `[channel][waveband]`.
    #[must_use]
    pub fn before(grid: &WavelengthGrid, sensitivities: &[Vec<f64>]) -> Self {
        Self { grid: grid.clone(), sensitivities: sensitivities.to_vec(), lights: OnceLock::new() }
    }

    /// Whether these are the same lights before the same camera.
    #[must_use]
    pub fn are_those_of(&self, other: &Self) -> bool {
        self.grid == other.grid && self.sensitivities == other.sensitivities
    }

    /// None on wavelengths that built-in lights do not cover.
    pub fn lights(&self) -> &[Candidate] {
        self.lights.get_or_init(|| {
            let all =
                candidate_lights().and_then(|all| Candidate::all(&all, &self.grid, &self.sensitivities));
            all.unwrap_or_default()
        })
    }
}

/// A light that is more probable than the one that was stated.
#[derive(Clone, Debug, PartialEq)]
pub struct RivalLight {
    /// What it is called.
    pub name: String,
    /// Logarithm of how many times as probable the facets are in it.
    pub ln_odds: f64,
}

impl RivalLight {
    /// The one of most evidence among `lights`, if that is ahead of the stated one's by enough.
    pub(super) fn of(
        lights: impl Iterator<Item = (String, f64)>,
        ln_stated: f64,
        ln_enough: f64,
    ) -> Option<Self> {
        let ahead = lights.map(|(name, ln_evidence)| Self { name, ln_odds: ln_evidence - ln_stated });
        let most = ahead.max_by(|a, b| a.ln_odds.total_cmp(&b.ln_odds));
        most.filter(|most| most.ln_odds > ln_enough)
    }

    /// What it says against an estimate in light that was `stated`.
    #[must_use]
    pub fn doubt(&self, stated: &str) -> Doubt {
        Doubt::new(
            format!("{self} as the {stated} you gave"),
            "check the light, or have it found (--illuminant unknown)",
        )
    }
}

impl fmt::Display for RivalLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let times = self.ln_odds.exp();
        if times > MOST_TIMES {
            return write!(f, "{} is more than a million times as probable", self.name);
        }
        // two digits: the evidence is an approximation
        let unit = 10_f64.powf(times.log10().floor() - 1.0).max(1.0);
        write!(f, "{} is {:.0} times as probable", self.name, (times / unit).round() * unit)
    }
}

/// The light in which facets are much more probable than in the one that was `stated`, in which the sheet may
/// fluoresce, if there is any among `others`.
pub fn rival(
    data: &FacetData,
    (stated, fluorescing): (&StatedScene, &[Fluorescing]),
    others: &Others,
    prior: &Prior,
) -> Option<RivalLight> {
    if stated.solution.surprise(1.0) < USUAL {
        return None;
    }
    let facets = Facets { data, gaussian: prior.broad() };
    let (reflectance, (_, unknowns)) =
        (facets.reflectance_at(&stated.solution.w), facets.split(&stated.solution.w));
    let search = Search::new(data, prior);
    let score_test = search.score_test(stated)?;
    let least =
        fluorescing.iter().map(|(_, one)| one.ln_evidence).fold(stated.ln_evidence, f64::max) + LN_AHEAD;
    let ahead = |light: &Candidate| {
        let lit = data.in_light(&light.camera);
        let alike = seen_alike(&reflectance, &data.scene().facets().sources().first()?.camera, light);
        let start = Facets { data: &lit, gaussian: prior.broad() }.set_out_from(&alike);
        let mut in_light = Search::new(&lit, prior);
        // of lights far off the stated one the way there says little, of lights near by the way from what is
        // seen alike
        let change =
            &stated.solution.at.residuals - lit.residuals(&reflectance, unknowns.as_slice()).residuals;
        let is_hopeful = score_test.ln_gain_along(&change) > LN_AHEAD
            || in_light.ln_gain_from((), &start, stated)? > LN_AHEAD;
        if !is_hopeful {
            return None;
        }
        let one = in_light.sort(((), 0.0), Some(start), least)?;
        (one.ln_evidence > least).then_some((lit, one))
    };
    let ahead = coarse_to_fine(others.lights(), ahead, |(_, one)| one.ln_evidence);
    if ahead.is_empty() {
        return None;
    }
    let by_classes = ahead.iter().filter_map(|(light, (lit, one))| {
        Some((light.name.clone(), Search::new(lit, prior).ln_evidence_by_classes(one)?))
    });
    let by_bands = fluorescing
        .iter()
        .filter_map(|(emitting, one)| Search::new(emitting, prior).ln_evidence_by_classes(one));
    let ln_stated = by_bands.fold(search.ln_evidence_by_classes(stated)?, |sum, own| {
        sum.max(own) + (-(sum - own).abs()).exp().ln_1p()
    });
    RivalLight::of(by_classes, ln_stated, LN_ODDS)
}

/// The reflectance that sends to the camera in another light what this one does: where to set out from.
fn seen_alike(reflectance: &[f64], camera: &CameraResponse, light: &Candidate) -> Vec<f64> {
    let power = |camera: &CameraResponse, band: usize| {
        (0..camera.channels())
            .map(|channel| camera.channel(channel)[band])
            .sum::<f64>()
            .max(f64::MIN_POSITIVE)
    };
    let ratio = |(band, r): (usize, &f64)| r * power(camera, band) / power(&light.camera, band);
    let alike: Vec<f64> = reflectance.iter().enumerate().map(ratio).collect();
    let brightest = |all: &[f64]| all.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let scale = brightest(reflectance) / brightest(&alike);
    alike.into_iter().map(|r| scale * r).collect()
}

/// Those of most evidence among the lights that are `ahead`: one of [`STEP`] is tried, then the neighbours of
/// the best.
pub(super) fn coarse_to_fine<'l, L, T>(
    lights: &'l [L],
    mut ahead: impl FnMut(&'l L) -> Option<T>,
    ln_evidence: impl Fn(&T) -> f64,
) -> Vec<(&'l L, T)> {
    let mut all = Vec::new();
    for at in (STEP / 2..lights.len()).step_by(STEP) {
        all.extend(ahead(&lights[at]).map(|one| (at, one)));
    }
    let order = |(_, a): &(usize, T), (_, b): &(usize, T)| ln_evidence(b).total_cmp(&ln_evidence(a));
    if let Some((best, _)) = all.iter().min_by(|a, b| order(a, b)) {
        let best = *best;
        for at in (best.saturating_sub(STEP - 1)..lights.len().min(best + STEP)).filter(|at| *at != best) {
            all.extend(ahead(&lights[at]).map(|one| (at, one)));
        }
    }
    all.sort_by(order);
    all.truncate(DISTINCT_ODDS);
    all.into_iter().map(|(at, one)| (&lights[at], one)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odds_are_said_to_two_digits() {
        let text = |ln_odds: f64| RivalLight { name: "A".to_owned(), ln_odds }.to_string();
        assert_eq!(text(412_f64.ln()), "A is 410 times as probable");
        assert_eq!(text(23.4_f64.ln()), "A is 23 times as probable");
        assert_eq!(text(30.0), "A is more than a million times as probable");
    }

    #[test]
    fn a_light_must_make_up_for_the_statement() {
        let of = |ln_evidence| {
            RivalLight::of([("A".to_owned(), ln_evidence), ("B".to_owned(), -9.0)].into_iter(), 5.0, LN_ODDS)
        };
        assert_eq!(of(7.9), None);
        assert_eq!(of(8.1).map(|one| one.name), Some("A".to_owned()));
    }
}

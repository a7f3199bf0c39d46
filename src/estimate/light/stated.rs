//! Tests whether another light is more probable than the stated one.
//!
//! In another light the facets belong to another spectrum. The ratio of evidence says how much more probable
//! that makes them, whoever stated the light. Statements are right in nineteen cases of twenty
//! (docs/model.md), and it is unknown which lights are mistaken for which. Every other light is therefore
//! weighed by itself: if it makes the facets more than nineteen times as probable, it is more probable than
//! the stated one.

use std::sync::OnceLock;

use super::Candidate;
use crate::camera::CameraResponse;
use crate::estimate::data::FacetData;
use crate::estimate::facets::Facets;
use crate::estimate::photograph::priors::Priors;
use crate::estimate::prior::Prior;
use crate::estimate::rival::{LN_AHEAD, Rival};
use crate::estimate::search::Search;
use crate::estimate::searched::Lit;
use crate::solve::forecast::{ScoreTest, foreseen_cost};
use crate::spectrum::{WavelengthGrid, candidate_lights};

/// A stated light is not questioned if facets, with the noise at which hypotheses are sorted, are no more
/// improbable in it than this, in standard deviations over known sheets: what is that usual needs no other
/// light to explain it.
const USUAL: f64 = 0.5;
/// Lights are weighed by classes of spectra if they are ahead by [`LN_AHEAD`] under all spectra as one, up to
/// this number.
const DISTINCT_ODDS: usize = 3;
/// First one light in this many is tried, as neighbours are similar.
const STEP: usize = 6;

/// Lights that may be the true one instead, computed on first use.
#[derive(Debug)]
pub struct Others {
    grid: WavelengthGrid,
    sensitivities: Vec<Vec<f64>>,
    lights: OnceLock<Vec<Candidate>>,
}

impl Others {
    /// Alternatives for a camera with these sensitivities, `[channel][waveband]`.
    #[must_use]
    pub fn before(grid: &WavelengthGrid, sensitivities: &[Vec<f64>]) -> Self {
        Self { grid: grid.clone(), sensitivities: sensitivities.to_vec(), lights: OnceLock::new() }
    }

    /// Empty if the built-in lights do not cover the wavelengths.
    pub fn lights(&self) -> &[Candidate] {
        self.lights.get_or_init(|| {
            let all = candidate_lights().and_then(|all| Candidate::all(all, &self.grid, &self.sensitivities));
            all.unwrap_or_default()
        })
    }
}

/// The light among `others`, if any, in which facets are much more probable than in the one that was
/// `stated`, in which the sheet may fluoresce.
pub fn rival(
    data: &FacetData,
    (Lit { sorted: stated, .. }, fluorescing): (&Lit, &[Lit]),
    others: &Others,
    prior: &Prior,
) -> Option<Rival> {
    let search = Search::new(data, prior);
    if stated.solution.surprise(search.tempering()) < USUAL {
        return None;
    }
    let facets = Facets { data, gaussian: prior.broad() };
    let (reflectance, (_, unknowns)) =
        (facets.reflectance_at(&stated.solution.w), facets.split(&stated.solution.w));
    let score_test = ScoreTest::at(&stated.solution, search.tempering())?;
    let least =
        fluorescing.iter().map(|one| one.sorted.ln_evidence).fold(stated.ln_evidence, f64::max) + LN_AHEAD;
    let ahead = |light: &Candidate| {
        let lit = data.in_light(&light.camera);
        let alike = seen_alike(&reflectance, &data.scene().facets().sources().first()?.camera, light);
        let facets = Facets { data: &lit, gaussian: prior.broad() };
        let start = facets.set_out_from(&alike);
        let mut in_light = Search::new(&lit, prior);
        let tempering = in_light.tempering();
        let ln_gain =
            || Some(0.5 * (stated.solution.cost(tempering) - foreseen_cost(&facets, &start, tempering)?));
        // the first test serves for lights far from the stated one, the second, from a reflectance that looks
        // alike, for near ones
        let change =
            &stated.solution.at.residuals - lit.residuals(&reflectance, unknowns.as_slice()).residuals;
        let is_hopeful = score_test.ln_gain_by(0.0, &change) > LN_AHEAD || ln_gain()? > LN_AHEAD;
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
        .filter_map(|Lit { data, sorted, .. }| Search::new(data, prior).ln_evidence_by_classes(sorted));
    let ln_stated = by_bands.fold(search.ln_evidence_by_classes(stated)?, |sum, own| {
        sum.max(own) + (-(sum - own).abs()).exp().ln_1p()
    });
    Rival::of(by_classes, ln_stated, Priors::USUAL.ln_odds_of_statement())
}

/// The reflectance that looks the same to the camera in another light: a starting point.
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

/// The lights of most evidence among those `ahead`: one in [`STEP`] is tried, then the neighbours of the
/// best.
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

//! Tests whether a sheet fluoresces. A linear model predicts which bands are possible, so that no searches
//! are made for sheets without any sign of them.

use std::iter;

use nalgebra::{DMatrix, DVector};

use super::data::FacetData;
use super::doubt::EXPLAINED;
use super::emission::{Emission, Origin, SIZES};
use super::facets::{Facets, Second};
use super::fluorescence::Fluorescence;
use super::prior::Prior;
use super::search::{Search, Sorted};
use crate::solve::forecast::ScoreTest;

/// A band is searched if linear models predict that the sheet has it with at least these log odds: less
/// changes nothing.
const LN_ODDS_LEAST: f64 = -2.0;
/// Bands whose log evidence under all spectra is this far below the best are dropped.
pub const LN_EVIDENCE_HOPELESS: f64 = -12.0;
/// Distance of the facets from a sheet without emission, in standard deviations beyond chance, above which
/// the model linearised there does not predict other sheets.
const SURPRISE: f64 = 5.0;
/// Facets are precise if their noise is this many times smaller than that at which classes are distinguished:
/// for such facets emission is considered only if a sheet without it does not explain them.
pub const PRECISE: f64 = 10.0;
/// Probability above which a sheet is reported to fluoresce, together with it: that of a brightener in a
/// white sheet beforehand. Below it, the facets rather speak against one.
const REPORTED: f64 = 0.35;

/// True if a sheet with these logits may have a band, predicted from the changes of the residuals with each
/// of its [sizes](Emission::sizes).
pub fn is_hopeful(
    test: &ScoreTest,
    changes: &[(f64, DVector<f64>)],
    emission: &Emission,
    logit: &DVector<f64>,
) -> bool {
    test.ln_gain_among(changes) + emission.ln_share(logit) > LN_ODDS_LEAST
}

/// The standard normal number of the size that is nearest to a mode without emission, given the residuals
/// there and their changes: the usual size is far from the mode of a sheet that hardly emits.
pub fn nearest_size(residuals: &DVector<f64>, changes: &[(f64, DVector<f64>)], tempering: f64) -> f64 {
    let off = |((_, number), (_, change)): &((f64, f64), &(f64, DVector<f64>))| {
        (residuals - change).norm_squared() / (tempering * tempering) + number * number
    };
    let nearest = iter::zip(SIZES, changes).min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map_or(0.0, |((_, number), _)| number)
}

/// Indices of the emissions, the first of which is none, that a sheet may have, each with the number of its
/// [nearest size](nearest_size); `plain` is its mode under all spectra without emission.
pub fn possible<H>(
    data: &FacetData,
    emissions: &[Emission],
    plain: &Sorted<H, Second>,
    prior: &Prior,
) -> Vec<(usize, f64)> {
    let tempering = Search::new(data, prior).tempering();
    let [_, bands @ ..] = emissions else { return Vec::new() };
    let Some(test) = ScoreTest::at(&plain.solution, tempering) else { return Vec::new() };
    let facets = Facets { data, gaussian: prior.broad() };
    let (logit, unknowns) = facets.split(&plain.solution.w);
    let reflectance = facets.reflectance_at(&plain.solution.w);
    let changes = data.changes_with(bands, (&logit, &reflectance), unknowns.as_slice());
    let is_possible = |(emission, changes): (&Emission, &Vec<_>)| {
        // a free exposure absorbs light from behind
        let is_absorbed = emission.origin() == Some(Origin::Behind) && data.fits_exposure();
        let may_be = || is_unexplained(plain, tempering) || is_hopeful(&test, changes, emission, &logit);
        emission.is_excited() && !is_absorbed && may_be()
    };
    let possible = iter::zip(bands, &changes).enumerate().filter(|(_, one)| is_possible(*one));
    let residuals = &plain.solution.at.residuals;
    possible.map(|(n, (_, changes))| (n + 1, nearest_size(residuals, changes, tempering))).collect()
}

/// True if the facets are so far from a sheet without emission that it is no start for others.
pub fn is_unexplained<H>(plain: &Sorted<H, Second>, tempering: f64) -> bool {
    plain.solution.surprise(tempering) > SURPRISE
}

/// True if a sheet with emission explains the facets at the noise at which hypotheses are sorted.
pub fn explains<H>(data: &FacetData, sorted: &Sorted<H, Second>, tempering: f64) -> bool {
    data.rms(&sorted.solution.at.residuals) < EXPLAINED * tempering
}

/// The emission inferred for a sheet; `None` if there is hardly a reason to expect any.
///
/// # Arguments
/// - `shares`: the cause of each alternative's emission, and its probability;
/// - `values`, `spread`: those of the mean of the alternatives, with reflectances first; `first`: index of
///   the emission, as a fraction of white, among them;
/// - `nothing`: the emission model of a sheet without emission, in the light of the scene.
pub fn found(
    shares: impl Iterator<Item = (Option<Origin>, f64)>,
    (values, spread): (&[f64], Option<&DMatrix<f64>>),
    nothing: &Emission,
    first: usize,
) -> Option<Fluorescence> {
    let (mut by_ultraviolet, mut by_light, mut from_behind) = (0.0, 0.0, 0.0);
    for (origin, share) in shares {
        match origin {
            Some(Origin::Ultraviolet) => by_ultraviolet += share,
            Some(Origin::Visible) => by_light += share,
            Some(Origin::Behind) => from_behind += share,
            None => {}
        }
    }
    let (probability, origin) = match by_ultraviolet + by_light {
        fluorescence if fluorescence < from_behind => (from_behind, Origin::Behind),
        fluorescence if by_ultraviolet > by_light => (fluorescence, Origin::Ultraviolet),
        fluorescence => (fluorescence, Origin::Visible),
    };
    if probability < REPORTED {
        return None;
    }
    let wavelengths_nm = nothing.wavelengths_nm();
    let count = wavelengths_nm.len();
    let sent = &values[first..first + count];
    let peak = nothing.peak(sent);
    let sd = |of: &dyn Fn(&DMatrix<f64>) -> f64| spread.map_or(f64::INFINITY, of);
    let sd_of_total = |band: usize| sd(&|all| (all.column(band) + all.column(first + band)).norm());
    Some(Fluorescence {
        // probabilities may add up to slightly more than 1 by rounding
        probability: probability.min(1.0),
        origin,
        peak_nm: wavelengths_nm[peak],
        size: sent[peak],
        size_sd: sd(&|all| all.column(first + peak).norm()),
        total_radiance_factor: (0..count).map(|band| values[band] + sent[band]).collect(),
        total_radiance_factor_sd: (0..count).map(sd_of_total).collect(),
    })
}

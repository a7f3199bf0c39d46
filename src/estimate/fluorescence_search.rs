//! Whether a sheet fluoresces: which bands it may have is foreseen by a linear model, so that sheets that
//! facets say nothing of take no searches.

use nalgebra::{DMatrix, DVector};

use super::data::FacetData;
use super::doubt::EXPLAINED;
use super::emission::{Emission, Origin};
use super::facets::{Facets, Second};
use super::fluorescence::Fluorescence;
use super::prior::Prior;
use super::search::{Search, Sorted};
use crate::solve::forecast::ScoreTest;

/// A band is searched if so much of the evidence may be its own, as a logarithm, at so many times its usual
/// size at least: less changes nothing.
const LN_EVIDENCE_LEAST: f64 = -1.5;
const LEAST_SIZE: f64 = 0.25;
/// Bands so far behind the best under all spectra, as the logarithm of a share of its evidence, are out of
/// the question.
const LN_EVIDENCE_HOPELESS: f64 = -12.0;
/// Where facets are so many standard deviations further from a sheet that sends out nothing than chance has
/// it, the model linear about that says nothing of others.
const SURPRISE: f64 = 5.0;
/// Probability from which on a sheet is said to fluoresce.
const PROBABLE: f64 = 0.5;

/// Whether a sheet of these logits may have a band, as far as a linear model foresees from how residuals
/// change with it.
pub fn is_hopeful(
    test: &ScoreTest,
    change: &DVector<f64>,
    emission: &Emission,
    logit: &DVector<f64>,
) -> bool {
    test.ln_gain_by(LEAST_SIZE, change) + emission.ln_share(logit) > LN_EVIDENCE_LEAST
}

/// Facets as data of a sheet that fluoresces, and their maximum under all spectra.
pub type Fluorescing<'a> = (FacetData<'a>, Sorted<(), Second>);

/// The facets with each of the bands that the sheet may have and that explain them, `plain` being their
/// maximum without; hardly ever is there one.
pub fn may_be<'a>(data: &FacetData<'a>, plain: &Sorted<(), Second>, prior: &Prior) -> Vec<Fluorescing<'a>> {
    let [_, bands @ ..] = data.scene().emissions() else { return Vec::new() };
    let of_plain = Search::new(data, prior);
    let Some(test) = of_plain.score_test(plain) else { return Vec::new() };
    let facets = Facets { data, gaussian: prior.broad() };
    let (logit, unknowns) = facets.split(&plain.solution.w);
    let reflectance = facets.reflectance_at(&plain.solution.w);
    let changes = data.changes_with(bands, &reflectance, unknowns.as_slice());
    let is_unexplained = of_plain.surprise(plain) > SURPRISE;
    let mut best = plain.ln_evidence;
    let mut all = Vec::new();
    for (emission, change) in bands.iter().zip(changes) {
        // an exposure that is free takes up what comes from behind
        if emission.origin() == Some(Origin::Behind) && data.fits_exposure() {
            continue;
        }
        if !is_unexplained && !is_hopeful(&test, &change, emission, &logit) {
            continue;
        }
        let Some(emitting) = data.emitting(emission) else { continue };
        let mut search = Search::new(&emitting, prior);
        let numbers = plain.solution.w.len() + emission.unknowns();
        // where nothing explains the facets leads no further
        let start = (!is_unexplained).then(|| plain.solution.w.clone().resize_vertically(numbers, 0.0));
        if let Some(sorted) = search.sort(((), 0.0), start, best + LN_EVIDENCE_HOPELESS)
            && emitting.rms(&sorted.solution.at.residuals) < EXPLAINED * search.tempering()
        {
            best = best.max(sorted.ln_evidence);
            all.push((emitting, sorted));
        }
    }
    all.retain(|(_, sorted)| sorted.ln_evidence >= best + LN_EVIDENCE_HOPELESS);
    all
}

/// What a sheet is found to send out.
///
/// # Arguments
/// - `shares`: what excites each thing that may be so, and how probable that is;
/// - `values`, `spread`: those of a mean of these, reflectances first; `first`: where among them stands what
///   is sent out as a fraction of white;
/// - `nothing`: the emission of a sheet that sends out nothing, in the light of the scene.
///
/// None if it probably sends out nothing.
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
    if probability < PROBABLE {
        return None;
    }
    let wavelengths_nm = nothing.wavelengths_nm();
    let count = wavelengths_nm.len();
    let sent = &values[first..first + count];
    let peak = nothing.peak(sent);
    let sd = |of: &dyn Fn(&DMatrix<f64>) -> f64| spread.map_or(f64::INFINITY, of);
    let sd_of_total = |band: usize| sd(&|all| (all.column(band) + all.column(first + band)).norm());
    Some(Fluorescence {
        // shares may add up to a rounding more than 1
        probability: probability.min(1.0),
        origin,
        peak_nm: wavelengths_nm[peak],
        size: sent[peak],
        size_sd: sd(&|all| all.column(first + peak).norm()),
        total_radiance_factor: (0..count).map(|band| values[band] + sent[band]).collect(),
        total_radiance_factor_sd: (0..count).map(sd_of_total).collect(),
    })
}

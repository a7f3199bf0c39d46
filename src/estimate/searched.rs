//! Facets under several alternatives, searched together: the mean of all modes as an estimate.

use super::alternatives::Alternatives;
use super::data::FacetData;
use super::emission::Emission;
use super::facets::{Facets, Second};
use super::fluorescence::Fluorescence;
use super::fluorescence_search;
use super::linear::Start;
use super::mixture::Mixture;
use super::photograph::Finding;
use super::prior::Prior;
use super::search::{Search, Sorted};
use super::unknowns::{EXPOSURE, SUPPORTED};
use super::{Estimate, Fitted};
use crate::solve::posterior::{Iteration, Model};

/// An exposure, which has no prior, is supported by the facets if its standard deviation is below this share
/// of its value.
const EXPOSURE_SUPPORTED: f64 = 0.5;

/// Iterations by run.
pub type Trace = Vec<Vec<Iteration>>;

/// The mean of all modes under some alternatives.
pub struct Searched<'a> {
    pub mixture: Mixture<usize, Second>,
    /// Index of the light of each alternative.
    pub lights: Vec<usize>,
    /// As given, and with the same indices.
    alternatives: Alternatives<'a, 'a>,
    /// Probability that another camera of the stated model saw the facets.
    seen_by_another: f64,
}

/// Facets in a light, of a sheet with or without emission, and their mode under all spectra.
pub struct Lit<'a> {
    /// Index of the light.
    pub light: usize,
    pub data: FacetData<'a>,
    pub sorted: Sorted<(), Second>,
}

impl Lit<'_> {
    /// True if the sheet emits light.
    pub fn emits(&self) -> bool {
        self.data.emission().is_some_and(|emission| emission.origin().is_some())
    }
}

impl<'a> Searched<'a> {
    /// Searches alternatives, those without emission first, and adds to their `trace`; `None` if there are
    /// none, or facets are not finite.
    pub fn among(all: Vec<Lit<'a>>, prior: &Prior, trace: &mut Trace) -> Option<Self> {
        if all.is_empty() {
            return None;
        }
        let lights = all.iter().map(|one| one.light).collect();
        let all = all.into_iter().enumerate();
        let (alternatives, mut sorted): (Vec<_>, Vec<_>) =
            all.map(|(n, Lit { data, sorted, .. })| (data, sorted.for_hypothesis(n))).unzip();
        sorted.sort_by(Sorted::order);
        let alternatives = Alternatives::of(alternatives.into_iter().map(|data: FacetData<'a>| move || data));
        let mut search = Search::new(&alternatives, prior);
        let mixture = search.mixture(&sorted)?;
        trace.append(&mut search.trace);
        Some(Self { mixture, lights, alternatives, seen_by_another: 0.0 })
    }

    /// The facets of a sheet without emission.
    pub fn plain(&self) -> &FacetData<'a> {
        self.alternatives.get(0)
    }

    /// The mean of these modes and those of the facets of a sheet without emission if another camera saw
    /// them, unless that is `None`, weighted by evidence.
    pub fn or_seen_by_another(self, other: Option<Self>) -> Self {
        let Some(Self { mixture: other, .. }) = other else { return self };
        let ln_evidence = other.ln_evidence;
        let mixture = self.mixture.and(other);
        Self { seen_by_another: (ln_evidence - mixture.ln_evidence).exp(), mixture, ..self }
    }

    /// Converts to an estimate, with the errors of another mixture, `off`; `data` are those of any
    /// alternative.
    pub fn estimate(&self, data: &FacetData, off: &Mixture<usize, Second>, trace: Trace) -> Estimate {
        let found = &self.mixture;
        let (bands, unknowns) = (data.scene().facets().bands(), data.scene().unknowns());
        let sd = |column: usize| off.spread.as_ref().map_or(f64::INFINITY, |all| all.column(column).norm());
        let w = &off.best.start.w;
        let first = off.best.start.gaussian.basis().ncols();
        let of_unknowns = unknowns.iter().enumerate().map(|(n, expected)| {
            let (sd, prior_sd) = (sd(bands + n), expected.at(w[first + n]).1.abs());
            Fitted {
                unknown: expected.unknown,
                value: found.values[bands + n],
                sd,
                supported: sd < SUPPORTED * prior_sd,
            }
        });
        let last = bands + unknowns.len();
        let exposure = found.values[last];
        let of_exposure = data.fits_exposure().then(|| Fitted {
            unknown: &EXPOSURE,
            value: exposure,
            sd: sd(last),
            supported: sd(last) < EXPOSURE_SUPPORTED * exposure,
        });
        // weights of a mean may add up to slightly more than 1 by rounding
        let reflectance = found.values[..bands].iter().map(|r| r.min(1.0)).collect();
        let Start { hypothesis, gaussian, w, .. } = &found.best.start;
        let facets = Facets { data: self.alternatives.get(*hypothesis), gaussian };
        let left = (found.best.rms, data.unexplained(&facets.evaluate(w).residuals));
        Estimate {
            fitted: of_exposure.into_iter().chain(of_unknowns).collect(),
            spread: off.spread.as_ref().map(|all| all.columns(0, bands).into_owned()),
            findings: (self.seen_by_another > 0.5).then(Finding::of_another_camera).into_iter().collect(),
            fluorescence: self.fluorescence(last + 1),
            surprise: found.best.surprise,
            ..Estimate::searched(reflectance, exposure, left, (trace, found.best.termination))
        }
    }

    /// The emission of the sheet, given the index of its first value.
    fn fluorescence(&self, first: usize) -> Option<Fluorescence> {
        let emission = |alternative: usize| self.alternatives.get(alternative).emission();
        let Mixture { values, spread, shares, .. } = &self.mixture;
        let shares = shares
            .iter()
            .map(|(alternative, share)| (emission(*alternative).and_then(Emission::origin), *share));
        fluorescence_search::found(shares, (values, spread.as_ref()), emission(0)?, first)
    }
}

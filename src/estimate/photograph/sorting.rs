//! Hypotheses on photographs in order of their evidence under all spectra as one.
//!
//! Similar hypotheses have similar modes, so that most are started from the result of another. Series of them
//! that do not depend on each other are searched side by side.

use nalgebra::DVector;
use rayon::prelude::*;

use super::conditions::StatedScene;
use super::day::Day;
use super::family::Photographs;
use super::hypotheses::{Hypothesis, hypotheses_without_bounces};
use super::imperfection::Imperfection;
use super::sheet_models::SheetModel;
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};
use crate::estimate::searched::Trace;

/// Log evidence relative to the best above which hypotheses count, and above which ideal folds are weighed
/// again against real sheets.
pub const LN_EVIDENCE_NEAR: f64 = -5.0;
/// Hypotheses whose log evidence is further below the best are hopeless, and their searches are abandoned.
pub const LN_EVIDENCE_HOPELESS: f64 = -10.0;
/// If the best sheet model of a clear day is this far behind on a dull day, the other models have no chance.
const LN_EVIDENCE_FAR: f64 = -8.0;

/// A hypothesis with its mode under all spectra as one.
pub type Tried = Sorted<Hypothesis, ()>;

/// Hypotheses to be searched one after the other.
struct Series {
    hypotheses: Vec<Hypothesis>,
    /// The search of the series ends at one whose log evidence is this far below the best.
    ln_far: f64,
}

impl Series {
    fn of(hypotheses: impl IntoIterator<Item = Hypothesis>) -> Self {
        Self { hypotheses: hypotheses.into_iter().collect(), ln_far: f64::NEG_INFINITY }
    }

    /// Sheet models on a dull day, the best of a clear day first: if it is far behind, so are the others.
    fn on(day: Day, by_weight: &[SheetModel]) -> Self {
        let hypotheses =
            by_weight.iter().map(|kind| Hypothesis { day, ..Hypothesis::usual(*kind) }).collect();
        Self { hypotheses, ln_far: LN_EVIDENCE_FAR }
    }

    /// Its hypotheses as far as they were searched, each started from the most similar one before, also among
    /// those of `earlier` series, or from `start` if there is none.
    fn sorted(
        self,
        search: &mut Search<Photographs>,
        stated: &StatedScene,
        (start, earlier): (&DVector<f64>, &[Tried]),
    ) -> Vec<Tried> {
        let mut found: Vec<Tried> = Vec::new();
        for hypothesis in self.hypotheses {
            let before = || earlier.iter().chain(&found);
            // a spectrum found without bounces is no start for a fold
            let nearest = before().filter(|one| one.hypothesis.has_bounces()).min_by(|a, b| {
                let [of_a, of_b] = [a, b].map(|one| one.hypothesis.differences(&hypothesis));
                of_a.cmp(&of_b).then(a.order(b))
            });
            let start = nearest.map_or(start, |one| &one.solution.w).clone();
            // real sheets may yet gain by a smaller model error: ideal folds are no measure for them
            let is_ideal = |of: &Hypothesis| of.imperfection.is_ideal();
            let rivals = before().filter(|one| is_ideal(&hypothesis) || !is_ideal(&one.hypothesis));
            let ln_best = rivals.map(Tried::ln_weight).fold(f64::NEG_INFINITY, f64::max);
            let one = (hypothesis, hypothesis.ln_share(stated));
            let one = search.sort(one, Some(start), ln_best + LN_EVIDENCE_HOPELESS);
            let is_far = one.as_ref().is_none_or(|one| one.ln_weight() < ln_best + self.ln_far);
            found.extend(one);
            if is_far && self.ln_far.is_finite() {
                break;
            }
        }
        found
    }
}

/// Usual folds, the `ideal` ones, dull days and sheets without bounces in order of evidence under all
/// spectra, with the trace of their searches: in this order, the first from `start`.
pub fn sorted(
    photographs: &Photographs,
    prior: &Prior,
    (ideal, start): (Vec<Hypothesis>, DVector<f64>),
    dull_days: &[Day],
) -> Option<(Vec<Tried>, Trace)> {
    let stated = &photographs.0.first()?.parts.stated;
    let (mut all, mut trace) = (Vec::new(), Trace::new());
    let mut add = |side_by_side: Vec<Series>, all: &mut Vec<Tried>| {
        let side_by_side = side_by_side.into_par_iter().map(|series| {
            let mut search = Search::new(photographs, prior);
            (series.sorted(&mut search, stated, (&start, all)), search.trace)
        });
        for (found, more) in side_by_side.collect::<Vec<_>>() {
            all.extend(found);
            trace.extend(more);
        }
    };
    let [first, others @ ..] = SheetModel::ALL.map(Hypothesis::usual);
    add(vec![Series::of([first])], &mut all);
    add(vec![Series::of(others), Series::of(ideal)], &mut all);
    let mut by_weight: Vec<&Tried> =
        all.iter().filter(|one| !one.hypothesis.imperfection.is_ideal()).collect();
    by_weight.sort_by(|a, b| a.order(b));
    let by_weight: Vec<SheetModel> = by_weight.into_iter().map(|one| one.hypothesis.kind).collect();
    let mut days = dull_days.iter().map(|day| Series::on(*day, &by_weight));
    // dull days resemble each other more than a clear one
    let first = days.by_ref().take(1);
    add(first.chain([Series::of(hypotheses_without_bounces())]).collect(), &mut all);
    add(days.collect(), &mut all);
    let mut search = Search::new(photographs, prior);
    weigh_against_ideal(&mut search, &mut all);
    trace.extend(search.trace);
    all.sort_by(Tried::order);
    Some((all, trace))
}

/// Weighs real sheets against ideal folds of some evidence, with the size of the model error that has most
/// evidence: for a picture taken with care the usual size does not distinguish the two. The estimates of real
/// sheets keep the usual size, as residuals show only what the unknowns do not absorb.
fn weigh_against_ideal(search: &mut Search<Photographs>, all: &mut [Tried]) {
    let ln_most = |is_ideal: bool| {
        let of = all.iter().filter(|one| one.hypothesis.imperfection.is_ideal() == is_ideal);
        of.map(Tried::ln_weight).fold(f64::NEG_INFINITY, f64::max)
    };
    if ln_most(true) < ln_most(false) + LN_EVIDENCE_NEAR {
        return;
    }
    let ln_hopeless = ln_most(true).max(ln_most(false)) + LN_EVIDENCE_HOPELESS;
    for has_bounces in [true, false] {
        let is_weighed = |one: &Tried| {
            !one.hypothesis.imperfection.is_ideal() && one.hypothesis.has_bounces() == has_bounces
        };
        let real = all.iter().filter(|one| is_weighed(one));
        let Some(real) = real.min_by(|a, b| a.order(b)) else { continue };
        // an error that is a sixteenth as large makes one datum at most sixteen times as probable
        let data = real.solution.at.residuals.len() as f64;
        let is_hopeful = |imperfection: &Imperfection| {
            real.ln_weight() - data * imperfection.discrepancy().ln() > ln_hopeless
        };
        let less = [Imperfection::Careful, Imperfection::Simulated].into_iter().filter(is_hopeful);
        let less = less.filter_map(|imperfection| {
            let hypothesis = Hypothesis { imperfection, ..real.hypothesis };
            search.sort((hypothesis, real.ln_share), Some(real.solution.w.clone()), ln_hopeless)
        });
        let more = less.map(|one| one.ln_evidence - real.ln_evidence).fold(0.0, f64::max);
        all.iter_mut().filter(|one| is_weighed(one)).for_each(|one| one.ln_share += more);
    }
}

//! Facets of an ideal fold in each of several lights, in order of evidence.

use nalgebra::DVector;

use super::Candidate;
use crate::estimate::alternatives::Alternatives;
use crate::estimate::facets::Second;
use crate::estimate::family::Family;
use crate::estimate::prior::Prior;
use crate::estimate::search::{Search, Sorted};
use crate::estimate::searched::{Lit, Trace};

/// Lights whose log evidence under all spectra is this far below the best are dropped: knowing the class of
/// spectra rarely changes as much.
const LN_EVIDENCE_HOPELESS: f64 = -6.0;
/// The same before the lights next to one have been tried: one of those may have far more evidence.
const LN_EVIDENCE_BETWEEN: f64 = -20.0;
/// Maximum number of lights under which classes of spectra are distinguished.
const DISTINCT_ODDS: usize = 48;

/// Facets in each of these lights, in order of evidence under all spectra, each started from the result of
/// its neighbour, without lights that are hopeless beside one of log evidence `best`; and the trace.
///
/// # Arguments
/// - `lights`: all lights, or none for the stated one alone; `tried`: indices of those that are tried;
/// - `family`: the facets in each;
/// - `start`: where the first search starts, if not at the mean.
pub fn lights_in_order<'a>(
    (lights, tried): (&[Candidate], &[usize]),
    family: &Alternatives<'_, 'a>,
    prior: &Prior,
    (start, best): (Option<DVector<f64>>, f64),
) -> (Vec<Lit<'a>>, Trace) {
    let found = (0..lights.len().max(1)).map(|_| None).collect();
    let mut all = Series { lights, search: Search::new(family, prior), found, start, best };
    let is_between = |light: usize| lights.get(light).is_some_and(|light| light.is_between);
    let apart: Vec<usize> = tried.iter().copied().filter(|light| !is_between(*light)).collect();
    apart.iter().for_each(|light| all.sort(*light, LN_EVIDENCE_BETWEEN));
    let ln: Vec<f64> = apart.iter().map(|light| all.ln_weight(*light)).collect();
    for (n, ends) in apart.windows(2).enumerate() {
        let &[first, next] = ends else { continue };
        let mut between = first + 1..next;
        let are_alike = !between.is_empty() && between.all(is_between);
        if are_alike && are_distinguished(&ln, n, all.best) {
            all.refine(first, next);
        }
    }
    let Series { search: Search { trace, .. }, found, .. } = all;
    let mut found: Vec<_> = found.into_iter().flatten().collect();
    found.sort_by(Sorted::order);
    let most = found.first().map_or(best, |first| first.ln_weight().max(best));
    found.retain(|one| one.ln_weight() >= most + LN_EVIDENCE_HOPELESS);
    found.truncate(DISTINCT_ODDS);
    let of = |sorted: Sorted<usize, Second>| {
        let light = sorted.hypothesis;
        Lit { light, data: family.get(light).clone(), sorted: sorted.for_hypothesis(()) }
    };
    (found.into_iter().map(of).collect(), trace)
}

/// Lights in a row, and their modes as far as they were searched.
struct Series<'r, F: Family<Hypothesis = usize>> {
    /// Empty for the stated light alone.
    lights: &'r [Candidate],
    search: Search<'r, F>,
    found: Vec<Option<Sorted<usize, F::Second>>>,
    /// Where the next search starts.
    start: Option<DVector<f64>>,
    /// The most evidence so far.
    best: f64,
}

impl<F: Family<Hypothesis = usize>> Series<'_, F> {
    fn ln_weight(&self, light: usize) -> f64 {
        self.found[light].as_ref().map_or(f64::NEG_INFINITY, Sorted::ln_weight)
    }

    /// Searches a light, unless its evidence is this far below the best.
    fn sort(&mut self, light: usize, ln_hopeless: f64) {
        let share = (light, self.lights.get(light).map_or(0.0, |light| light.ln_share));
        if let Some(one) = self.search.sort(share, self.start.clone(), self.best + ln_hopeless) {
            self.best = self.best.max(one.ln_weight());
            self.start = Some(one.solution.w.clone());
            self.found[light] = Some(one);
        }
    }

    /// Searches the lights between two, from the more probable one on; the first shares its probability with
    /// them.
    fn refine(&mut self, first: usize, next: usize) {
        let is_up = self.ln_weight(first) >= self.ln_weight(next);
        let nearest = if is_up { first } else { next };
        self.start = self.found[nearest].as_ref().map(|one| one.solution.w.clone());
        let ln_sharing = ((next - first) as f64).ln();
        if let Some(one) = &mut self.found[first] {
            one.ln_share -= ln_sharing;
        }
        for n in 1..next - first {
            self.sort(if is_up { first + n } else { next - n }, LN_EVIDENCE_HOPELESS - ln_sharing);
        }
    }
}

/// True if lights between the one at `n` and the next may be among the most probable, and differ from both:
/// log evidence `ln` bends by more than one per step, as it does where its width is less than a step.
fn are_distinguished(ln: &[f64], n: usize, best: f64) -> bool {
    let at = |n: usize| ln.get(n).copied().unwrap_or(f64::NEG_INFINITY);
    let before = |n: usize| n.checked_sub(1).map_or(f64::NEG_INFINITY, at);
    let is_peak = |n: usize| at(n) >= before(n) && at(n) >= at(n + 1);
    let bend = |n: usize| 2.0 * at(n) - before(n) - at(n + 1);
    let most = at(n).max(at(n + 1));
    let is_bent = [n, n + 1].into_iter().any(|n| at(n).is_finite() && bend(n) > 1.0);
    let is_near = most >= best + LN_EVIDENCE_HOPELESS;
    is_bent && (is_near || (most >= best + LN_EVIDENCE_BETWEEN && (is_peak(n) || is_peak(n + 1))))
}

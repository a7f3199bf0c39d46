//! Which candidates are worth a search.

/// Most candidates that are searched, and the least evidence for one of them, as the logarithm of its share
/// of the first's; and where data do not tell classes apart.
const TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -3.0;
const UNSEPARATED_TRIED: usize = 24;
const UNSEPARATED_LN_EVIDENCE_LEAST: f64 = -5.0;
/// Spectra of a class are one if their root mean square difference is less.
pub const APART: f64 = 0.005;

/// Those of most evidence, of which the first has most; more of them if data are not `telling`.
pub fn of_most_evidence<T>(found: &[T], ln_evidence: impl Fn(&T) -> f64, is_telling: bool) -> &[T] {
    let (most, ln_least) = if is_telling {
        (TRIED, LN_EVIDENCE_LEAST)
    } else {
        (UNSEPARATED_TRIED, UNSEPARATED_LN_EVIDENCE_LEAST)
    };
    let least = found.first().map_or(0.0, |best| ln_evidence(best) + ln_least);
    let enough = found.partition_point(|one| ln_evidence(one) >= least);
    &found[..enough.min(most)]
}

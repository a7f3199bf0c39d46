//! Selects the candidates that are worth a search.

/// Maximum number of candidates searched, and their least log evidence relative to the first; then the same
/// where data do not distinguish classes.
const TRIED: usize = 3;
const LN_EVIDENCE_LEAST: f64 = -3.0;
const UNSEPARATED_TRIED: usize = 24;
const UNSEPARATED_LN_EVIDENCE_LEAST: f64 = -5.0;
/// Spectra of a class count as one if their root mean square difference is less.
pub const APART: f64 = 0.005;

/// The candidates of most evidence from a list sorted by it; more of them if data are not `telling`.
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

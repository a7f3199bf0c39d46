//! Deviations of a photograph from the ideal.

use crate::estimate::unknowns::Unknown;

/// A deviation of a photograph from the ideal. An estimate of a real sheet allows for it, but a photograph
/// without it reveals more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The unknown that deviates; `None` for corners and the kind of day.
    pub unknown: Option<&'static Unknown>,
    /// What is wrong.
    pub what: String,
    /// What to do.
    pub remedy: &'static str,
    /// True if it exceeds the errors of users and the differences of sheets: then usually something else is
    /// wrong.
    pub is_unusual: bool,
}

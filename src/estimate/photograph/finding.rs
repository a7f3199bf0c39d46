//! Deviations of a photograph from the ideal.

/// A deviation of a photograph from the ideal. The estimate allows for it, but a photograph without it
/// reveals more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is wrong.
    pub what: String,
    /// What to do.
    pub remedy: &'static str,
    /// True if it exceeds the errors of users and the differences of sheets: then usually something else is
    /// wrong.
    pub is_unusual: bool,
}

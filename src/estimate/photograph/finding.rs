//! What is not ideal about a photograph.

/// Something that is not ideal about a photograph. The estimate allows for it; a photograph without it tells
/// more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: &'static str,
    /// Whether it is by more than people err and sheets differ: where facets say so, something else is wrong
    /// as a rule.
    pub is_unusual: bool,
}

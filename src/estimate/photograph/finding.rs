//! Deviations of a photograph from the ideal.

use crate::estimate::unknowns::Unknown;

/// A deviation of a photograph from the ideal. An estimate of a real sheet allows for it, but a photograph
/// without it reveals more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The unknown that deviates; `None` for corners, the kind of day and the camera.
    pub unknown: Option<&'static Unknown>,
    /// What is wrong.
    pub what: String,
    /// What to do.
    pub remedy: &'static str,
    /// True if it exceeds the errors of users and the differences of sheets: then usually something else is
    /// wrong.
    pub is_unusual: bool,
}

impl Finding {
    /// Another camera of the stated model probably saw the facets.
    #[must_use]
    pub fn of_another_camera() -> Self {
        Self {
            unknown: None,
            what: "the camera's sensitivities are probably not quite those stated".to_owned(),
            remedy: "derive them from a photograph of a colour chart (vextract --save-camera)",
            is_unusual: false,
        }
    }
}

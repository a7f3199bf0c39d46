//! Reasons to doubt an estimate.

/// Reduced chi below which facets are explained.
pub const EXPLAINED: f64 = 2.0;

/// Trustworthiness of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// No reason for doubt: the error bars hold if light and camera are as stated.
    Good,
    /// There is a reason for doubt: errors may exceed the error bars.
    Doubtful,
    /// The facets do not belong to the scene: the estimate is meaningless.
    Wrong,
}

impl Level {
    /// Name used in records and messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Wrong => "wrong",
        }
    }
}

/// A reason to doubt an estimate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// Its severity.
    pub level: Level,
    /// The reason.
    pub because: String,
    /// What to do.
    pub remedy: String,
}

impl Doubt {
    /// A doubt of level [`Level::Doubtful`].
    #[must_use]
    pub fn new(because: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { level: Level::Doubtful, because: because.into(), remedy: remedy.into() }
    }
}

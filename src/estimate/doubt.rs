//! What speaks against an estimate.

/// Reduced chi up to which facets are explained.
pub const EXPLAINED: f64 = 2.0;

/// How far an estimate can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Nothing speaks against it: its error bars hold, if light and camera are as stated.
    Good,
    /// Something speaks against it: it may be further off than its error bars.
    Doubtful,
    /// The facets are not those of the scene: it means nothing.
    Wrong,
}

impl Level {
    /// As records and messages have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Wrong => "wrong",
        }
    }
}

/// Something that speaks against an estimate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// How much.
    pub level: Level,
    /// What it is.
    pub because: String,
    /// What to do.
    pub remedy: String,
}

impl Doubt {
    /// One for which an estimate is [`Level::Doubtful`].
    #[must_use]
    pub fn new(because: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { level: Level::Doubtful, because: because.into(), remedy: remedy.into() }
    }
}

//! What is scored, and how it looks in a table.

use clap::ValueEnum;

/// A kind of score.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Metric {
    /// Root mean square error.
    Rmse,
    /// Colour difference under each illuminant.
    Ciede2000,
    /// What the paper calls Pearson distance.
    Pd,
    /// Goodness of fit coefficient.
    Gfc,
    /// Spectral angle.
    Angle,
    /// From the first illuminant to each other one.
    Metamerism,
}

impl Metric {
    /// What the score is called in records; colour differences under other illuminants than the first get its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rmse => "rmse",
            Self::Ciede2000 => "ciede2000",
            Self::Pd => "pd",
            Self::Gfc => "gfc",
            Self::Angle => "angle_deg",
            Self::Metamerism => "metamerism",
        }
    }
}

/// How many columns, at least, and decimals a score has.
pub fn width_and_decimals(name: &str) -> (usize, usize) {
    match name {
        "rmse" => (8, 4),
        "pd" => (10, 5),
        "gfc" => (8, 5),
        _ => (10, 3),
    }
}

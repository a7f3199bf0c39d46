//! A patch of a chart in a photograph.

/// A patch with its expected values.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The reference's name.
    pub name: String,
    /// Mean light per channel in the photograph.
    pub measured: Vec<f64>,
    /// Standard error of the mean per channel.
    pub standard_error: Vec<f64>,
    /// Value of the scene's camera at exposure 1, above 0.
    pub expected: Vec<f64>,
}

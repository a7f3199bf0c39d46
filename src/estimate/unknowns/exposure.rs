//! How bright the picture is.

use super::{Flag, Role, Scale, Unknown};

/// Value of a perfect white diffuser facing the sun, in its strongest channel.
pub static EXPOSURE: Unknown = Unknown {
    name: "exposure",
    about: "Exposure: value of a perfect white diffuser that faces the sun, in its strongest channel",
    unit: None,
    flag: &Flag { value: "exposure", help: "Value of white facing the sun, as --exposure free" },
    range: 0.0..=f64::INFINITY,
    scale: Scale::Linear,
    role: Role::Exposure,
};

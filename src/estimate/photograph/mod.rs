//! Photographs of real sheets: every effect that an ideal fold lacks is estimated together with the spectrum,
//! as an unknown with a prior.
//!
//! A sheet reflects more at some angles than at others, its crease is round and its panels bow, the sky and
//! the ground shine into the fold, the sun is warmer than it was said to be, the lens darkens the corners.
//! Each of these is an unknown with a prior that says how well people know it
//! ([`unknowns::TABLE`](super::unknowns::TABLE)); what is left is an error that is smooth over a panel and
//! alike in the channels ([`error`]). [`parts`] holds what the facets are made of, [`model`] puts it
//! together, [`sheet_models`] are the kinds of sheets that a prior of measured materials knows, and
//! [`search`] finds the most probable spectrum under all of them.

pub mod chebyshev;
pub mod conditions;
pub mod corners;
pub mod day;
pub mod error;
mod family;
pub mod finding;
mod findings;
pub mod hypotheses;
pub mod imperfection;
mod joint;
mod known;
mod lens;
mod lighting;
pub mod model;
mod number;
pub mod parts;
mod prediction;
pub mod priors;
pub mod search;
pub mod sheet_models;
pub mod sheets;
mod sums;
mod unmodelled;
mod whitened;

pub use conditions::{Conditions, ShownDaylight, StatedScene};
pub(super) use family::Photographs;
pub use finding::Finding;
pub(super) use known::{KnownReflectance, KnownSeen, shown_daylight};
pub use parts::Parts;
pub use search::{SheetEstimate, estimate, estimate_usual};
pub use unmodelled::Unmodelled;

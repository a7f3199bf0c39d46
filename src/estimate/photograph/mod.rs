//! Photographs of real sheets: every effect that an ideal fold lacks is estimated together with the spectrum,
//! as an unknown with a prior.
//!
//! A sheet reflects more at some angles than at others, its crease is round and its panels bow, sky and
//! ground shine into the fold, the sun is warmer than stated, the lens darkens the corners. Each effect is an
//! unknown with a prior that reflects how well it is usually known
//! ([`unknowns::TABLE`](super::unknowns::TABLE)); the remainder is an error that is smooth over a panel and
//! similar in all channels ([`error`]). [`parts`] holds the ingredients of the facets, [`model`] combines
//! them, [`sheet_models`] are the models known from measured materials, and [`search`] finds the most
//! probable spectrum under all of them.

pub mod chebyshev;
pub mod conditions;
pub mod corners;
pub mod day;
pub mod error;
pub mod eye;
mod family;
pub mod finding;
mod findings;
mod fold_changes;
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
mod sorting;
mod unmodelled;
mod whitened;

pub use conditions::{Conditions, ShownDaylight, StatedScene};
pub(super) use family::Photographs;
pub use finding::Finding;
pub(super) use known::{KnownReflectance, KnownSeen, shown_daylight};
pub use parts::Parts;
pub use search::{SheetEstimate, Weighed, estimate, estimate_usual, weigh};
pub use unmodelled::Unmodelled;

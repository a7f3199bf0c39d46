//! The mean light of facets and patches, and how certain it is.

mod facets;
mod measurement;
mod outliers;
mod patches;
mod plane_fit;
mod shared_noise;
mod tally;

pub use facets::measure;
pub use measurement::{FacetMeasurement, PixelRun};
pub use patches::{corner_orders, measure_patches};
pub use shared_noise::pixels_sharing_noise;

//! The mean light of facets and patches, and how certain it is.

mod facets;
mod making;
mod measurement;
mod mixed_channels;
mod noise_growth;
mod open_sides;
mod outliers;
mod panels;
mod patches;
mod plane_fit;
mod processing;
mod rounding;
mod shared_noise;
mod tally;

pub use facets::measure;
pub use making::Making;
pub use measurement::{FacetMeasurement, PixelRun};
pub use open_sides::open_sides;
pub use panels::{MeasuredPanels, measure_panels};
pub use patches::{corner_orders, measure_patches};
pub use processing::Processing;
pub use shared_noise::pixels_sharing_noise;

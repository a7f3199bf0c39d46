//! From facet RGB to the spectrum: the posterior mean over classes of known spectra ([`map`]), for
//! photographs together with the unknowns of sheet, light and camera ([`photograph`]). The paper's own
//! estimator and its rivals are in [`paper`](crate::paper).

mod alternatives;
mod built_in;
mod camera_errors;
mod channels;
pub mod classes;
mod compress;
pub mod data;
mod doubt;
pub mod emission;
mod estimated;
mod exposure;
mod facets;
mod family;
pub mod fluorescence;
mod fluorescence_search;
pub mod gaussian;
pub mod light;
mod linear;
pub mod map;
pub mod measured;
pub mod measurement;
mod mixture;
pub mod noise;
mod normal;
pub mod other_camera;
pub mod photograph;
pub mod prior;
pub mod rival;
mod search;
mod searched;
pub mod shading;
pub mod shadow;
mod smooth_errors;
mod starts;
pub mod taking;
pub mod unknowns;
pub mod verdict;

pub use estimated::Estimate;
pub use exposure::Exposure;
pub use family::TELLING_CHANNELS;
pub use unknowns::Fitted;
pub use verdict::WRONG_CHI;

//! From a picture file to the mean colour of every facet of a folded sheet.
//!
//! [`Photograph`] reads a file and gives linear light, [`Homography`] says where on a panel a pixel lies,
//! [`measure`] averages the light over each facet, [`measure_patches`] over those of a chart; [`refine`] finds where exactly the panels
//! are, and [`write_overlay`] shows it. [`write_linear`] and [`write_srgb_png`] go the other way.
//! Nothing here knows about reflectance, cameras or the command line.
//!
//! Image coordinates are continuous: origin at the top left corner of the upright picture, x to the right, y down;
//! pixel (i, j) covers [i, i+1) x [j, j+1). Panel coordinates run from 0 to 1: u along the crease, v outwards from it.

mod corners;
mod decode;
mod development;
mod distortion;
mod edge;
mod exif;
mod facets;
mod flat_field;
mod grid;
mod homography;
mod info;
mod interleaved;
mod measurement;
mod mosaic;
mod open;
mod orientation;
mod outliers;
mod overlay;
mod patches;
mod photograph;
mod pixel;
mod pixel_area;
mod pixels;
mod plane_fit;
mod point;
mod pose;
mod preview;
#[cfg_attr(not(feature = "raw"), path = "no_raw.rs")]
mod raw;
mod refine;
mod scale;
#[cfg(feature = "raw")]
mod sensor;
mod shared_noise;
mod sites;
mod tally;
mod thumbnail;
#[cfg(feature = "raw")]
mod tiff_directories;
mod transfer;
mod write;

pub use corners::{CHART_CORNERS, PANEL_CORNERS, WHITE_CORNERS, check_inside, parse_corners};
pub use development::Development;
pub use distortion::Lens;
pub use exif::CameraNotes;
pub use facets::measure;
pub use flat_field::FlatField;
pub use grid::Grid;
pub use homography::Homography;
pub use info::{PhotographInfo, SensorInfo};
pub use measurement::{FacetMeasurement, PixelRun};
pub use mosaic::Mosaic;
pub use orientation::Orientation;
pub use overlay::write_overlay;
pub use patches::{corner_orders, measure_patches};
pub use photograph::Photograph;
pub use pixel::Pixel;
pub use point::Point;
pub use pose::camera_position;
pub use preview::write_preview;
pub use refine::{Marked, Refinement, refine};
pub use scale::ReadOptions;
pub use shared_noise::pixels_sharing_noise;
pub use thumbnail::{Thumbnail, thumbnail};
pub use transfer::{Transfer, srgb_to_linear};
pub use write::{png_bytes, write_linear, write_srgb_png};

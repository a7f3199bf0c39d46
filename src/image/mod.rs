//! From a picture file to the mean colour of every facet of a folded sheet.
//!
//! [`Photograph`] reads a file into linear light, [`Homography`] maps between panel and picture, [`measure`]
//! averages the light over each facet, [`measure_patches`] over a chart's patches; [`find_fold`] locates the
//! panels of a fold, [`find_chart`] a chart, [`FoldSeen`] determines the angle between panels, [`refine`]
//! their exact corners, and [`write_overlay`] shows them. [`write_linear`] and [`write_srgb_png`] write
//! pictures. Nothing here depends on reflectances, camera sensitivities or the command line.
//!
//! Image coordinates are continuous: origin at the top left corner of the upright picture, x to the right, y
//! down; pixel (i, j) covers [i, i+1) x [j, j+1). Panel coordinates run from 0 to 1: u along the crease, v
//! outwards from it.
//!
//! Each module uses only those to its right:
//!
//! ```text
//! drawing -> measuring -> placing
//! finding -> edges -> placing
//! pose -> placing
//! drawing, measuring, finding, edges, reading -> photograph -> numbers
//! ```

mod drawing;
mod edges;
mod finding;
mod measuring;
mod numbers;
mod photograph;
mod placing;
mod pose;
mod reading;

pub use drawing::{
    Balance, Thumbnail, White, is_for_the_eye, png_bytes, thumbnail, write_linear, write_overlay,
    write_preview, write_srgb_png,
};
pub use edges::{Marked, REFINED_WITHIN_PX, Refinement, refine};
pub use finding::{
    DetectedChart, DetectedFold, Detections, NoFold, WeighedFold, find_all, find_chart, find_fold,
    find_fold_and_chart, find_fold_around, weighed_chart, weighed_folds,
};
pub use measuring::{
    FacetMeasurement, Making, MeasuredPanels, PixelRun, Processing, corner_orders, measure, measure_panels,
    measure_patches, open_sides, pixels_sharing_noise,
};
pub use numbers::{Development, ReadOptions, Transfer, srgb_to_linear};
pub use photograph::{
    CameraNotes, FileStamp, FlatField, Mosaic, Orientation, OtherLight, Photograph, PhotographInfo, Pixel,
    SensorInfo, Taken, camera_name,
};
pub use placing::{
    CHART_CORNERS, CameraPose, Framing, Grid, Homography, Lens, LensEstimate, PANEL_CORNERS, Point,
    WHITE_CORNERS, camera_pose, camera_position, check_inside, parse_corners, parse_point,
};
pub use pose::{CornersBy, FoldAngle, FoldSeen, OtherFold, StatedFold};
pub use reading::PictureFile;

//! The middles of a chart's patches.

use super::facets::measure;
use super::measurement::FacetMeasurement;
use crate::Result;
use crate::image::photograph::Photograph;
use crate::image::placing::{CHART_CORNERS, Grid, Homography, Lens, Point, check_inside};

/// Measured fraction of a patch's width and height, clear of frames, blur and inaccurate corners.
const MIDDLE: f64 = 0.5;

/// Measures the middle of every patch of a chart: the mean over half its width and half its height.
///
/// # Arguments
/// - `region`: name of what the corners bound, for errors.
/// - `corners`: outer corners of the block of patches, by the order of [`CHART_CORNERS`]; px.
/// - `lens`: distortion of the picture.
/// - `rows`, `cols`: patches, evenly spaced.
///
/// # Returns
/// Patches row by row from the first.
///
/// # Errors
/// [`Error::Corners`](crate::Error::Corners) unless the corners form a convex quadrilateral in the picture.
///
/// # Example
/// ```
/// use vfold::image::{Lens, Photograph, Point, ReadOptions, measure_patches, write_linear};
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("chart.exr");
/// let two: Vec<f64> = (0..300).map(|k| if k / 3 % 10 < 5 { 0.25 } else { 0.5 }).collect(); // 10 x 10 px
/// write_linear(&path, 10, 10, &two)?;
/// let corners = [(0., 0.), (10., 0.), (10., 10.), (0., 10.)].map(|(x, y)| Point::new(x, y));
/// let photograph = Photograph::open(&path, &ReadOptions::default())?;
/// let patches = measure_patches(&photograph, "chart", corners, Lens::STRAIGHT, [1, 2])?;
/// assert_eq!(patches[1].mean, Some(vec![0.5; 3]));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn measure_patches(
    photograph: &Photograph,
    region: &str,
    corners: [Point; 4],
    lens: Lens,
    [rows, cols]: [usize; 2],
) -> Result<Vec<FacetMeasurement>> {
    check_inside(region, &corners, &CHART_CORNERS, photograph.width(), photograph.height())?;
    let chart = Homography::through(lens, corners)?;
    let middle =
        |k: usize, count: usize| [-MIDDLE, MIDDLE].map(|side| (k as f64 + 0.5 + side / 2.0) / count as f64);
    let patch = |k: usize| chart.rectangle(middle(k % cols, cols), middle(k / cols, rows));
    let middles = (0..rows * cols).map(|k| Ok(Grid::even(Homography::through(lens, patch(k))?, [1, 1])));
    measure(photograph, &middles.collect::<Result<Vec<_>>>()?, 0.0)
}

/// The eight orders in which four corners can be read around a chart, the original one first.
#[must_use]
pub fn corner_orders([a, b, c, d]: [Point; 4]) -> [[Point; 4]; 8] {
    let turned = |[a, b, c, d]: [Point; 4]| [[a, b, c, d], [b, c, d, a], [c, d, a, b], [d, a, b, c]];
    let ([p, q, r, s], [t, u, v, w]) = (turned([a, b, c, d]), turned([a, d, c, b]));
    [p, q, r, s, t, u, v, w]
}

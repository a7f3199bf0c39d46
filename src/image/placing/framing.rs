//! Positions of the panels of a fold in a photograph.

use super::point::Point;

/// Positions of the panels of a fold in a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct Framing {
    /// Four corners of each panel in the order of [`PANEL_CORNERS`](crate::image::PANEL_CORNERS), px of the
    /// upright picture; none for an unmarked panel.
    pub panels: [Option<[Point; 4]>; 2],
    /// Width and height of the picture, px.
    pub size: [f64; 2],
    /// Least distance of a pixel that was read from a panel's sides, px.
    pub margin_px: f64,
}

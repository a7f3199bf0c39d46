//! Where the panels of a fold are in a photograph.

use super::point::Point;

/// Where the panels of a fold are in a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct Framing {
    /// Four corners of each panel in the order of [`PANEL_CORNERS`](crate::image::PANEL_CORNERS), px of the
    /// upright picture; none where a panel is not marked.
    pub panels: [Option<[Point; 4]>; 2],
    /// Width and height of the picture, px.
    pub size: [f64; 2],
}

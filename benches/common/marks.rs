//! Marks of points, told apart by shape as well as by colour.

use plotters::prelude::*;

/// The shape of a point.
#[derive(Clone, Copy)]
pub enum Mark {
    Disc,
    Ring,
    Triangle,
    Cross,
}

/// One point.
pub fn element<'b, C: Clone + 'static>(
    at: C,
    mark: Mark,
    colour: RGBColor,
) -> DynElement<'static, SVGBackend<'b>, C> {
    match mark {
        Mark::Disc => Circle::new(at, 5, colour.filled()).into_dyn(),
        Mark::Ring => Circle::new(at, 4, colour.stroke_width(2)).into_dyn(),
        Mark::Triangle => TriangleMarker::new(at, 5, colour.filled()).into_dyn(),
        Mark::Cross => Cross::new(at, 4, colour.stroke_width(2)).into_dyn(),
    }
}

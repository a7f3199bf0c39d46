//! Draws lines of `series,x,y` from standard input: `paper-plot OUT.svg TITLE X Y [--log-x]`.
//!
//! The axis of y begins at 0; series keep the order in which they come, and points are joined in theirs.

use std::error::Error;
use std::io::stdin;
use std::ops::Range;

use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;
use vfold::plot::{COLOURS, load_font};

const SIZE: (u32, u32) = (640, 400);
/// Room above the highest point, for the names of the lines.
const HEADROOM: f64 = 1.4;

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// A line's name and points.
struct Series {
    name: String,
    points: Vec<(f64, f64)>,
}

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, title, x, y, rest @ ..] = arguments.as_slice() else {
        return Err("usage: paper-plot OUT.svg TITLE X Y [--log-x]".into());
    };
    let all = read()?;
    let points = || all.iter().flat_map(|series| series.points.iter().copied());
    let low = points().fold(f64::INFINITY, |low, (x, _)| low.min(x));
    let high = points().fold(f64::NEG_INFINITY, |high, (x, _)| high.max(x));
    let top = HEADROOM * points().fold(0.0, |top, (_, y)| f64::max(top, y));
    if rest.is_empty() {
        draw(out, [title, x, y], low..high, 0.0..top, &all)
    } else {
        draw(out, [title, x, y], (low..high).log_scale(), 0.0..top, &all)
    }
}

fn read() -> Outcome<Vec<Series>> {
    let mut all: Vec<Series> = Vec::new();
    for line in stdin().lines() {
        let line = line?;
        let [name, x, y] = line.split(',').collect::<Vec<_>>()[..] else {
            return Err(format!("'{line}' is not series,x,y").into());
        };
        let point = (x.parse()?, y.parse()?);
        match all.iter_mut().find(|series| series.name == name) {
            Some(series) => series.points.push(point),
            None => all.push(Series { name: name.to_owned(), points: vec![point] }),
        }
    }
    if all.is_empty() { Err("no points to draw".into()) } else { Ok(all) }
}

fn draw<X>(out: &str, texts: [&str; 3], x: X, y: Range<f64>, all: &[Series]) -> Outcome
where
    X: AsRangedCoord<Value = f64>,
    X::CoordDescType: ValueFormatter<f64>,
{
    load_font();
    let root = SVGBackend::new(out, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .caption(texts[0], ("sans-serif", 17))
        .margin(12)
        .margin_right(26)
        .x_label_area_size(42)
        .y_label_area_size(56)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc(texts[1])
        .y_desc(texts[2])
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()?;
    for (Series { name, points }, colour) in all.iter().zip(COLOURS.iter().cycle()) {
        let style = colour.stroke_width(2);
        chart
            .draw_series(LineSeries::new(points.iter().copied(), style).point_size(3))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.85))
        .label_font(("sans-serif", 13))
        .draw()?;
    root.present()?;
    Ok(())
}

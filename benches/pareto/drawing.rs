//! Error against time, both in powers of ten: a panel a problem, the front as a line, settings beside their
//! points.

use std::fs;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use vfold::plot::{COLOURS, load_font};

use crate::common::{machine, results};
use crate::marks::{Mark, element};
use crate::point::{HEAD, Point, front};

/// Size of a panel.
const SIZE: (u32, u32) = (620, 460);
/// What others made: what they take is beside the front, not on it.
const PEERS: [&str; 4] = ["pyviewfactor", "NumPy", "SciPy", "colour-science"];
/// Marks of our own series, in the colours of all drawings; peers are black.
const OURS: [Mark; 3] = [Mark::Disc, Mark::Ring, Mark::Triangle];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// What the axes of a drawing say.
struct Axes {
    x: &'static str,
    y: &'static str,
    /// What the lines join: the points of each series, or those on the front.
    joins: Joins,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Joins {
    Series,
    Front,
}

/// Reads the rows of a stage on standard input: its table and its drawing.
pub fn draw(stage: &str) {
    let (points, notes) = Point::read();
    fs::write(results(&format!("pareto_{stage}.csv")), table(&points, &notes)).unwrap();
    let y = match stage {
        "kernel" => "largest error of a form factor",
        "response" => "largest relative error of a facet",
        "estimate" => "mean RMSE of reflectance",
        _ => "mean RMSE of reflectance, the scene's error included",
    };
    let axes = Axes { x: "processor time, ms", y, joins: Joins::Front };
    grid(&format!("pareto_{stage}.svg"), &axes, &points);
}

/// The drawing of growth: facets in the place of time.
pub fn growth(points: &[Point]) {
    let axes = Axes { x: "facets along a side of a panel", y: "ms, or count", joins: Joins::Series };
    grid("growth.svg", &axes, points);
}

fn table(points: &[Point], notes: &[String]) -> String {
    let mut lines = vec![format!("# {}", machine())];
    lines.extend_from_slice(notes);
    lines.push(format!("{HEAD},front"));
    for (_, points) in grouped(points, |point| &point.panel) {
        let front: Vec<String> = front_of_ours(&points).iter().map(ToString::to_string).collect();
        let row = |point: &Point| point.to_string();
        let mark = |row: &String| if front.contains(row) { "yes" } else { "" };
        lines.extend(points.into_iter().map(row).map(|row| format!("{row},{}", mark(&row))));
    }
    lines.join("\n") + "\n"
}

fn is_peer(series: &str) -> bool {
    PEERS.iter().any(|peer| series.starts_with(peer))
}

fn front_of_ours<'a>(points: &[&'a Point]) -> Vec<&'a Point> {
    front(points.iter().copied().filter(|point| !is_peer(&point.series)))
}

/// Points by a name, in the order in which names come first.
fn grouped<'a>(
    points: impl IntoIterator<Item = &'a Point>,
    name: impl Fn(&'a Point) -> &'a str,
) -> Vec<(&'a str, Vec<&'a Point>)> {
    let mut groups: Vec<(&str, Vec<&Point>)> = Vec::new();
    for point in points {
        match groups.iter_mut().find(|(of, _)| *of == name(point)) {
            Some((_, group)) => group.push(point),
            None => groups.push((name(point), vec![point])),
        }
    }
    groups
}

fn grid(file: &str, axes: &Axes, points: &[Point]) {
    let panels = grouped(points, |point| &point.panel);
    let columns = if panels.len() == 3 { 3 } else { panels.len().min(2) };
    let rows = panels.len().div_ceil(columns);
    let size = (SIZE.0 * columns as u32, SIZE.1 * rows as u32);
    load_font();
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&WHITE).unwrap();
        let names: Vec<&str> = grouped(points, |point| &point.series)
            .into_iter()
            .map(|(name, _)| name)
            .filter(|name| !is_peer(name))
            .collect();
        for (area, (title, points)) in root.split_evenly((rows, columns)).iter().zip(&panels) {
            panel(area, axes, title, points, &names);
        }
        root.present().unwrap();
    }
    fs::write(results(file), svg).unwrap();
}

/// A series looks alike in all panels: its place among all `names` of ours says how.
fn panel(area: &Area, axes: &Axes, title: &str, points: &[&Point], names: &[&str]) {
    let mut chart = frame(area, axes, title, points);
    if axes.joins == Joins::Front {
        let line = front_of_ours(points).into_iter().map(|point| (point.ms, point.error));
        chart.draw_series(LineSeries::new(line, BLACK.mix(0.45).stroke_width(2))).unwrap();
    }
    for (name, points) in grouped(points.iter().copied(), |point| &point.series) {
        let (colour, mark) = match names.iter().position(|ours| *ours == name) {
            Some(n) => (COLOURS[n % COLOURS.len()], OURS[n % OURS.len()]),
            None => (BLACK, Mark::Cross),
        };
        if axes.joins == Joins::Series {
            let line = points.iter().map(|point| (point.ms, point.error));
            chart.draw_series(LineSeries::new(line, colour.mix(0.5))).unwrap();
        }
        series(&mut chart, name, &points, colour, mark);
    }
    let position = match axes.joins {
        Joins::Series => SeriesLabelPosition::UpperLeft,
        Joins::Front => SeriesLabelPosition::LowerLeft,
    };
    chart
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.8))
        .label_font(("sans-serif", 13))
        .draw()
        .unwrap();
}

/// Axes wide enough for the points, and the legend below those that fall.
fn frame<'a, 'b>(area: &Area<'b>, axes: &Axes, title: &str, points: &[&Point]) -> Chart<'a, 'b> {
    let names = grouped(points.iter().copied(), |point| &point.series).len();
    let legend = 0.05 * (2.0 + names as f64);
    let below = if axes.joins == Joins::Front { 1.1 * legend / (1.0 - legend) } else { 0.1 };
    let x_range = around(points.iter().map(|point| point.ms), [0.1, 0.1]);
    let y_range = around(points.iter().map(|point| point.error), [below, 0.1]);
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 17))
        .margin(10)
        .x_label_area_size(42)
        .y_label_area_size(70)
        .build_cartesian_2d(x_range.log_scale(), y_range.log_scale())
        .unwrap();
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(axes.x)
        .y_desc(axes.y)
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()
        .unwrap();
    chart
}

/// The range of some numbers, wider on both sides by so many times itself, in powers of ten.
fn around(values: impl Iterator<Item = f64> + Clone, [below, above]: [f64; 2]) -> Range<f64> {
    let low = values.clone().fold(f64::INFINITY, f64::min).ln();
    let high = values.fold(0.0, f64::max).ln();
    let span = (high - low).max(1.0);
    (low - below * span).exp()..(high + above * span).exp()
}

/// A label of an axis; none for those that would stand too close together.
fn number(value: &f64) -> String {
    let digit = (value / 10_f64.powf(value.log10().floor())).round() as u32;
    match value {
        _ if !matches!(digit, 1 | 2 | 3 | 5 | 10) => String::new(),
        0.001..=1000.0 => format!("{}", (value * 1e4).round() / 1e4),
        _ => format!("{value:.0e}"),
    }
}

/// Marks of a series, its settings beside them, and its name in the legend.
fn series<'a, 'b: 'a>(
    chart: &mut Chart<'a, 'b>,
    name: &str,
    points: &[&Point],
    colour: RGBColor,
    mark: Mark,
) {
    let marks = points.iter().map(|point| element((point.ms, point.error), mark, colour));
    let legend = move |(x, y)| element((x + 8, y), mark, colour);
    chart.draw_series(marks).unwrap().label(name).legend(legend);
    // Beside the point where there is room, and above and below it by turns.
    let [left, right] = [chart.x_range().start, chart.x_range().end].map(f64::ln);
    let label = |(n, point): (usize, &&Point)| {
        let at_right = (point.ms.ln() - left) / (right - left) > 0.75;
        let (side, dx) = if at_right { (HPos::Right, -6) } else { (HPos::Left, 6) };
        let (height, dy) = if n % 2 == 0 { (VPos::Bottom, -3) } else { (VPos::Top, 4) };
        let style = ("sans-serif", 12).into_font().color(&colour).pos(Pos::new(side, height));
        EmptyElement::at((point.ms, point.error)) + Text::new(point.setting.clone(), (dx, dy), style)
    };
    chart.draw_series(points.iter().enumerate().map(label)).unwrap();
}

//! Error against time, both in powers of ten: a panel a problem, the front as a line, settings beside their points.

use std::fs;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::common::{machine, results};
use crate::marks::{Mark, element};
use crate::point::{HEAD, Point, front};

/// Size of a panel.
const SIZE: (u32, u32) = (620, 460);
/// What others made: what they take is beside the front, not on it.
const PEERS: [&str; 4] = ["pyviewfactor", "NumPy", "SciPy", "colour-science"];
/// Okabe and Ito's colours, which colour-blind readers tell apart; peers are black.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(120, 120, 120),
];
const OURS: [Mark; 3] = [Mark::Disc, Mark::Ring, Mark::Triangle];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// What the axes of a drawing say.
struct Axes {
    x: &'static str,
    y: &'static str,
    labels: SeriesLabelPosition,
}

/// Reads the rows of a stage on standard input: its table and its drawing.
pub fn draw(stage: &str) {
    let (points, notes) = Point::read();
    let y = match stage {
        "kernel" => "largest error of a form factor",
        "response" => "largest relative error of a facet, r up to 0.99 (mesh) or 1",
        "estimate" => "mean RMSE of reflectance",
        _ => "mean RMSE of reflectance, model error included",
    };
    let mut table = format!("# {}\n{}\n{HEAD},front\n", machine(), notes.join("\n")).replace("\n\n", "\n");
    for panel in panels(&points) {
        let front: Vec<String> =
            front(panel.1.iter().copied().filter(|p| !is_peer(p))).iter().map(ToString::to_string).collect();
        for point in &panel.1 {
            let row = point.to_string();
            let mark = if front.contains(&row) { "yes" } else { "" };
            table += &format!("{row},{mark}\n");
        }
    }
    fs::write(results(&format!("pareto_{stage}.csv")), table).unwrap();
    let axes = Axes { x: "processor time, ms", y, labels: SeriesLabelPosition::LowerLeft };
    grid(&format!("pareto_{stage}.svg"), &axes, &points, true);
}

/// The drawing of growth: facets in the place of time.
pub fn growth(points: &[Point]) {
    let axes = Axes {
        x: "facets along a side of a panel",
        y: "ms, or count",
        labels: SeriesLabelPosition::UpperLeft,
    };
    grid("growth.svg", &axes, points, false);
}

fn is_peer(point: &Point) -> bool {
    PEERS.iter().any(|peer| point.series.starts_with(peer))
}

/// Points by panel, in the order in which panels come first.
fn panels(points: &[Point]) -> Vec<(&str, Vec<&Point>)> {
    let mut panels: Vec<(&str, Vec<&Point>)> = Vec::new();
    for point in points {
        match panels.iter_mut().find(|(panel, _)| *panel == point.panel) {
            Some((_, of_panel)) => of_panel.push(point),
            None => panels.push((&point.panel, vec![point])),
        }
    }
    panels
}

fn grid(name: &str, axes: &Axes, points: &[Point], with_front: bool) {
    let panels = panels(points);
    let columns = panels.len().min(if panels.len() == 3 { 3 } else { 2 });
    let rows = panels.len().div_ceil(columns);
    let size = (SIZE.0 * columns as u32, SIZE.1 * rows as u32);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&WHITE).unwrap();
        for (area, (title, points)) in root.split_evenly((rows, columns)).iter().zip(&panels) {
            panel(area, axes, title, points, with_front);
        }
        root.present().unwrap();
    }
    fs::write(results(name), svg).unwrap();
}

fn panel(area: &Area, axes: &Axes, title: &str, points: &[&Point], with_front: bool) {
    let (x_range, y_range) =
        (around(points.iter().map(|p| p.ms), 0.3), around(points.iter().map(|p| p.error), 0.8));
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
    if with_front {
        let ours = points.iter().copied().filter(|point| !is_peer(point));
        let line = front(ours).into_iter().map(|point| (point.ms, point.error));
        chart.draw_series(LineSeries::new(line, BLACK.mix(0.45).stroke_width(2))).unwrap();
    }
    let mut names: Vec<&str> = Vec::new();
    for point in points {
        if !names.contains(&point.series.as_str()) {
            names.push(&point.series);
        }
    }
    let (peers, ours): (Vec<_>, Vec<_>) =
        names.into_iter().partition(|name| PEERS.iter().any(|peer| name.starts_with(peer)));
    for (n, name) in ours.iter().enumerate() {
        series(&mut chart, points, name, COLOURS[n % COLOURS.len()], OURS[n % OURS.len()], !with_front);
    }
    for name in peers {
        series(&mut chart, points, name, BLACK, Mark::Cross, false);
    }
    chart
        .configure_series_labels()
        .position(axes.labels.clone())
        .background_style(WHITE.mix(0.8))
        .label_font(("sans-serif", 13))
        .draw()
        .unwrap();
}

/// The range of some numbers, wider by so many powers of ten on both sides.
fn around(values: impl Iterator<Item = f64> + Clone, powers: f64) -> Range<f64> {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(0.0, f64::max);
    low / 10_f64.powf(powers)..high * 10_f64.powf(powers)
}

fn number(value: &f64) -> String {
    if (0.01..=1000.0).contains(value) {
        format!("{}", (value * 1e4).round() / 1e4)
    } else {
        format!("{value:.0e}")
    }
}

fn series<'a, 'b: 'a>(
    chart: &mut Chart<'a, 'b>,
    points: &[&Point],
    name: &str,
    colour: RGBColor,
    mark: Mark,
    joined: bool,
) {
    let own: Vec<&Point> = points.iter().copied().filter(|point| point.series == name).collect();
    if joined {
        let line = own.iter().map(|point| (point.ms, point.error));
        chart.draw_series(LineSeries::new(line, colour.mix(0.5))).unwrap();
    }
    let marks = own.iter().map(|point| element((point.ms, point.error), mark, colour));
    let legend = move |(x, y)| element((x + 8, y), mark, colour);
    chart.draw_series(marks).unwrap().label(name).legend(legend);
    // Beside the point where there is room.
    let [left, right] = [chart.x_range().start, chart.x_range().end].map(f64::ln);
    let label = |point: &&Point| {
        let at_right = (point.ms.ln() - left) / (right - left) > 0.75;
        let (side, dx) = if at_right { (HPos::Right, -6) } else { (HPos::Left, 6) };
        let style = ("sans-serif", 12).into_font().color(&colour).pos(Pos::new(side, VPos::Bottom));
        EmptyElement::at((point.ms, point.error)) + Text::new(point.setting.clone(), (dx, -3), style)
    };
    chart.draw_series(own.iter().map(label)).unwrap();
}

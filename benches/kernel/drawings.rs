//! Error against time, both in powers of ten, one panel an angle or a number of facets.

use std::fs;

use plotters::coord::Shift;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use vfold::plot::load_font;

use crate::common::results;
use crate::marks::{Mark, element};
use crate::steps::Steps;
use crate::table::Row;
use crate::{ANGLES_DEG, FACETS};

const SIZE: (u32, u32) = (1140, 700);

/// A method's colour, one of Okabe and Ito's, and its mark: told apart by colour-blind readers.
const STYLES: [(&str, RGBColor, Mark); 7] = [
    ("exact", RGBColor(0, 114, 178), Mark::Disc),
    ("midpoint", RGBColor(0, 0, 0), Mark::Cross),
    ("monte-carlo area", RGBColor(213, 94, 0), Mark::Triangle),
    ("monte-carlo cosine", RGBColor(230, 159, 0), Mark::Ring),
    ("patches", RGBColor(204, 121, 167), Mark::Triangle),
    ("auto", RGBColor(0, 158, 115), Mark::Ring),
    ("pyviewfactor", RGBColor(86, 180, 233), Mark::Cross),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// One method's name and its points.
struct Series {
    name: String,
    colour: RGBColor,
    mark: Mark,
    points: Vec<(f64, f64)>,
}

/// What all panels of a drawing share.
struct Axes {
    x: &'static str,
    y: &'static str,
    x_range: std::ops::Range<f64>,
    y_range: std::ops::Range<f64>,
}

/// Draws all rows.
pub fn draw(rows: &[Row], steps: &[Steps]) {
    let entry = |row: &Row| (row.kernel_ms, row.entry_error);
    let radiance = |row: &Row| (row.total_ms, row.radiance_errors[1]);
    let panels = FACETS.map(|n| {
        let of_panel = |row: &&Row| row.n == n && row.angle_deg.total_cmp(&45.0).is_eq();
        (format!("45°, {n}x{n} facets"), by_method(rows.iter().filter(of_panel), entry))
    });
    let axes = Axes {
        x: "time of the form factors, ms",
        y: "largest error of a form factor",
        x_range: 1e-3..1e4,
        y_range: 1e-17..10.0,
    };
    grid("entry_error.svg", &axes, &panels);
    let panels = ANGLES_DEG.map(|angle_deg| {
        let of_panel = |row: &&Row| row.n == 10 && row.angle_deg.total_cmp(&angle_deg).is_eq();
        (format!("{angle_deg}°, 10x10 facets"), by_method(rows.iter().filter(of_panel), radiance))
    });
    let axes = Axes {
        x: "time of form factors and bounces, ms",
        y: "largest error of a facet's radiance, r = 0.9",
        x_range: 1e-2..1e5,
        y_range: 1e-13..10.0,
    };
    grid("radiance_error.svg", &axes, &panels);
    let panels = [10, 64].map(|n| (format!("{n}x{n} facets"), by_angle(steps, n)));
    let axes = Axes {
        x: "Lanczos steps",
        y: "largest error of a facet's radiance, r = 0.99",
        x_range: 1.0..1000.0,
        y_range: 1e-17..10.0,
    };
    grid("response.svg", &axes, &panels);
}

fn by_method<'a>(
    rows: impl Iterator<Item = &'a Row> + Clone,
    of: impl Fn(&Row) -> (f64, f64),
) -> Vec<Series> {
    let series = |(name, colour, mark): (&str, RGBColor, Mark)| {
        let points = rows.clone().filter(|row| row.method == name).map(&of);
        let points = points.filter(drawable).collect();
        Series { name: name.to_owned(), colour, mark, points }
    };
    STYLES.into_iter().map(series).filter(|series| !series.points.is_empty()).collect()
}

/// Not a number, and no error at all, have no place on logarithmic axes.
fn drawable((x, y): &(f64, f64)) -> bool {
    *x > 0.0 && *y > 0.0
}

fn by_angle(steps: &[Steps], n: usize) -> Vec<Series> {
    let series = |(angle_deg, (_, colour, mark)): (f64, (&str, RGBColor, Mark))| {
        let own = steps.iter().filter(|row| row.n == n && row.angle_deg.total_cmp(&angle_deg).is_eq());
        let points = own.map(|row| (row.steps as f64, row.radiance_errors[2])).filter(drawable).collect();
        Series { name: format!("{angle_deg}°"), colour, mark, points }
    };
    ANGLES_DEG.into_iter().zip(STYLES).map(series).collect()
}

fn grid(name: &str, axes: &Axes, panels: &[(String, Vec<Series>)]) {
    load_font();
    let mut svg = String::new();
    {
        let columns = if panels.len() > 4 { 3 } else { 2 };
        let rows = panels.len().div_ceil(columns);
        let height = if rows == 1 { SIZE.1 / 2 + 60 } else { SIZE.1 };
        let root = SVGBackend::with_string(&mut svg, (SIZE.0, height)).into_drawing_area();
        root.fill(&WHITE).unwrap();
        for (area, (title, series)) in root.split_evenly((rows, columns)).iter().zip(panels) {
            panel(area, axes, title, series);
        }
        root.present().unwrap();
    }
    fs::write(results(name), svg).unwrap();
}

fn panel(area: &Area, axes: &Axes, title: &str, all: &[Series]) {
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 16))
        .margin(8)
        .x_label_area_size(38)
        .y_label_area_size(58)
        .build_cartesian_2d(axes.x_range.clone().log_scale(), axes.y_range.clone().log_scale())
        .unwrap();
    let power = |value: &f64| format!("{value:.0e}");
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc(axes.x)
        .y_desc(axes.y)
        .x_label_formatter(&power)
        .y_label_formatter(&power)
        .label_style(("sans-serif", 12))
        .axis_desc_style(("sans-serif", 13))
        .draw()
        .unwrap();
    for series in all {
        plot(&mut chart, series);
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.85))
        .label_font(("sans-serif", 12))
        .draw()
        .unwrap();
}

fn plot<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, Series { name, colour, mark, points }: &Series) {
    let (colour, mark) = (*colour, *mark);
    chart.draw_series(LineSeries::new(points.iter().copied(), colour.mix(0.5))).unwrap();
    let marks = points.iter().map(|point| element(*point, mark, colour));
    chart.draw_series(marks).unwrap().label(name).legend(move |(x, y)| element((x + 8, y), mark, colour));
}

//! Histograms of scores.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::figure::{COLOURS, Drawn, FONT};
use super::text::{SMALL, number};

/// Approximate number of bins.
const BINS: f64 = 16.0;
/// Least value, in widths of the range, at which the axis does not begin at zero.
const FAR_FROM_ZERO: f64 = 2.0;

/// Counts of values in bins of equal width.
#[derive(Debug, PartialEq)]
pub(super) struct Histogram {
    start: f64,
    width: f64,
    counts: Vec<usize>,
}

impl Histogram {
    /// Of one or more finite values, in bins of 1, 2 or 5 times a power of ten.
    pub fn of(values: &[f64]) -> Self {
        let (low, high) =
            values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        let low = if low >= 0.0 && low < FAR_FROM_ZERO * (high - low) { 0.0 } else { low };
        let width = nice((high - low) / BINS).max(f64::EPSILON * high.abs()).max(f64::MIN_POSITIVE);
        let start = (low / width).floor() * width;
        let bin = |value: f64| ((value - start) / width).max(0.0) as usize;
        let mut counts = vec![0; bin(high) + 1];
        values.iter().for_each(|value| counts[bin(*value)] += 1);
        Self { start, width, counts }
    }

    fn edge(&self, bin: usize) -> f64 {
        self.start + bin as f64 * self.width
    }

    /// Draws it with a line at `mark`.
    pub fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, title: &str, mark: f64) -> Drawn<B> {
        let highest = self.counts.iter().copied().max().unwrap_or(1) as f64;
        let mut chart = ChartBuilder::on(area)
            .margin(8)
            .margin_right(14)
            .x_label_area_size(40)
            .y_label_area_size(36)
            .build_cartesian_2d(self.start..self.edge(self.counts.len()), 0.0..1.1 * highest)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .disable_x_mesh()
            .x_labels(4)
            .y_labels(4)
            .x_label_formatter(&|value| number(*value))
            .y_label_formatter(&|value| format!("{value:.0}"))
            .x_desc(title)
            .label_style((FONT, SMALL))
            .axis_desc_style((FONT, 13))
            .draw()?;
        let bars = self.counts.iter().enumerate().filter(|(_, count)| **count > 0).map(|(bin, count)| {
            let corners = [(self.edge(bin), 0.0), (self.edge(bin + 1), *count as f64)];
            let mut bar = Rectangle::new(corners, COLOURS[0].mix(0.75).filled());
            bar.set_margin(0, 0, 1, 0);
            bar
        });
        chart.draw_series(bars)?;
        let line = DashedLineSeries::new([(mark, 0.0), (mark, 1.1 * highest)], 5, 3, BLACK.stroke_width(1));
        chart.draw_series(line).map(drop)
    }
}

/// 1, 2 or 5 times a power of ten, not below `width`.
fn nice(width: f64) -> f64 {
    if width <= 0.0 {
        return 0.0;
    }
    let power = 10_f64.powf(width.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|step| step * power).find(|step| *step >= width).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// NumPy: `np.histogram([.001, .0039, .0041, .0299], np.arange(0, .031, .002))`.
    #[test]
    fn values_are_counted_where_numpy_counts_them() {
        let found = Histogram::of(&[0.001, 0.0039, 0.0041, 0.0299]);
        assert!((found.width - 0.002).abs() < 1e-15);
        assert_eq!(found.counts, [1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]);
    }

    #[test]
    fn one_value_has_a_bin() {
        for value in [0.0, 0.3, 1e-12, 40.0] {
            let found = Histogram::of(&[value, value]);
            assert_eq!(found.counts.iter().sum::<usize>(), 2, "{found:?}");
            assert!(found.counts.len() < 40, "{found:?}");
        }
    }
}

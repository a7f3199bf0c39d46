//! Estimated spectra with their error bands, and the true ones.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::figure::{COLOURS, Drawn, FONT, Figure};

/// Most curves in one drawing: more would be indistinguishable.
pub const CURVES_MAX: usize = COLOURS.len();
const SIZE: (u32, u32) = (760, 438);

/// One estimated spectrum.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance per wavelength.
    pub reflectance: Vec<f64>,
    /// Standard deviation of each, drawn as a band of two on either side.
    pub reflectance_sd: Option<Vec<f64>>,
    /// Total radiance factor per wavelength of a fluorescent sheet, drawn thin: the emission is the
    /// difference.
    pub total: Option<Vec<f64>>,
    /// True wavelengths and reflectances, drawn dashed.
    pub truth: Option<(Vec<f64>, Vec<f64>)>,
    /// The light, if it was inferred with the spectrum.
    pub light: Option<LightCurve>,
}

/// An inferred light.
#[derive(Clone, Debug)]
pub struct LightCurve {
    /// Its name and probability.
    pub name: String,
    /// Relative power, one number per wavelength of the spectrum.
    pub power: Vec<f64>,
}

/// The light is drawn up to this fraction of the chart's height, with its name.
const LIGHT_HEIGHT: f64 = 0.9;
const LIGHT: RGBColor = RGBColor(150, 150, 150);

/// Curves over wavelength, at least one, in the order of [`COLOURS`]; swatches below name them.
pub(super) struct Spectra<'a>(pub Vec<&'a Curve>);

impl Figure for Spectra<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let curves = || self.0.iter().copied();
        let mut chart = ChartBuilder::on(area)
            .margin(14)
            .margin_right(24)
            .x_label_area_size(50)
            .y_label_area_size(56)
            .build_cartesian_2d(ends(curves()), 0.0..top(curves()))?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_label_formatter(&|nm| format!("{nm:.0}"))
            .x_desc("wavelength, nm")
            .y_desc("reflectance")
            .label_style((FONT, 14))
            .axis_desc_style((FONT, 15))
            .draw()?;
        for (curve, colour) in curves().zip(COLOURS.into_iter().cycle()) {
            // with several sheets, each truth has its sheet's colour
            let truth = if self.0.len() == 1 { BLACK.stroke_width(2) } else { colour.stroke_width(1) };
            draw_curve(&mut chart, curve, colour, truth)?;
        }
        if let [Curve { wavelengths_nm, light: Some(light), .. }] = self.0.as_slice() {
            draw_light(&mut chart, wavelengths_nm, light, top(curves()))?;
        }
        Ok(())
    }
}

/// Reflectance over wavelength.
type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// One spectrum with its band, and the dashed true one.
pub(super) fn draw_curve<B: DrawingBackend>(
    chart: &mut Chart<B>,
    curve: &Curve,
    colour: RGBColor,
    truth: ShapeStyle,
) -> Drawn<B> {
    if let Some(band) = band(curve) {
        chart.draw_series(std::iter::once(Polygon::new(band, colour.mix(0.22))))?;
    }
    if let Some((wavelengths_nm, reflectance)) = &curve.truth {
        let line: Vec<_> = points(wavelengths_nm, reflectance.iter().copied()).collect();
        chart.draw_series(DashedLineSeries::new(line, 6, 4, truth))?;
    }
    if let Some(total) = &curve.total {
        let line = points(&curve.wavelengths_nm, total.iter().copied());
        chart.draw_series(LineSeries::new(line, colour.stroke_width(1)))?;
    }
    let line = points(&curve.wavelengths_nm, curve.reflectance.iter().copied());
    chart.draw_series(LineSeries::new(line, colour.stroke_width(2)))?;
    Ok(())
}

/// The light below a single spectrum, in arbitrary units.
fn draw_light<B: DrawingBackend>(
    chart: &mut Chart<B>,
    wavelengths_nm: &[f64],
    LightCurve { name, power }: &LightCurve,
    top: f64,
) -> Drawn<B> {
    let scale = LIGHT_HEIGHT * top / power.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let line = points(wavelengths_nm, power.iter().map(|power| scale * power));
    chart.draw_series(LineSeries::new(line, LIGHT.stroke_width(1)))?;
    if let Some(first_nm) = wavelengths_nm.first() {
        let words = format!("  grey: the estimated light, most probably {name}, in arbitrary units");
        let style = (FONT, 13).into_font().color(&LIGHT);
        chart.draw_series(std::iter::once(Text::new(words, (*first_nm, top), style)))?;
    }
    Ok(())
}

/// First and last wavelength of all curves, nm.
pub(super) fn ends<'a>(curves: impl Iterator<Item = &'a Curve>) -> Range<f64> {
    let all = curves.flat_map(|curve| curve.wavelengths_nm.iter().copied());
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), nm| (a.min(nm), b.max(nm)));
    low..high
}

/// Upper end of the reflectance axis: 1, or more for a fluorescent sheet.
pub(super) fn top<'a>(curves: impl Iterator<Item = &'a Curve>) -> f64 {
    let highest = curves.map(highest).fold(0.0, f64::max);
    (1.08 * highest).min(highest.max(1.0))
}

/// Outline of two standard deviations on either side of a curve.
fn band(curve: &Curve) -> Option<Vec<(f64, f64)>> {
    let outline = |edge: Vec<f64>| points(&curve.wavelengths_nm, edge.into_iter()).collect::<Vec<_>>();
    let [low, high] = curve.edges()?.map(outline);
    Some(high.into_iter().chain(low.into_iter().rev()).collect())
}

impl Curve {
    /// Lower and upper edge of its band: two standard deviations on either side.
    pub(super) fn edges(&self) -> Option<[Vec<f64>; 2]> {
        let sd = self.reflectance_sd.as_ref()?;
        let edge = |side: f64| {
            self.reflectance.iter().zip(sd).map(|(r, sd)| (r + side * sd).clamp(0.0, 1.0)).collect()
        };
        Some([-2.0, 2.0].map(edge))
    }
}

/// The highest point of a curve, its band and its truth.
pub(super) fn highest(curve: &Curve) -> f64 {
    let own = curve.edges().map_or_else(|| curve.reflectance.clone(), |[_, high]| high);
    let truth = curve.truth.iter().flat_map(|(_, reflectance)| reflectance.iter().copied());
    let total = curve.total.iter().flatten().copied();
    own.into_iter().chain(truth).chain(total).fold(0.05, f64::max)
}

fn points<'a>(
    wavelengths_nm: &'a [f64],
    reflectance: impl Iterator<Item = f64> + 'a,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    wavelengths_nm.iter().copied().zip(reflectance)
}

//! The colours of an estimate, as numbers and swatches.

use super::View;
use super::html::Html;
use super::words::{digits, with_sd};
use crate::colorimetry::{Colorimeter, Colour, Observer};
use crate::error::Result;
use crate::stream::{EstimateRecord, Scene};

/// Appearance of the sheet under the page's illuminant; none if its colours cannot be computed, as with a few
/// wavelengths.
pub(super) fn section(estimate: &EstimateRecord, scene: &Scene, view: &View) -> Result<Option<Html>> {
    let grid = scene.grid()?;
    let meter = Colorimeter::new(&grid, view.illuminant, view.observer).ok();
    let Some(meter) = meter.filter(|_| estimate.wavelengths_nm == grid.wavelengths_nm()) else {
        return Ok(None);
    };
    let colour = meter.colour(&estimate.reflectance);
    let sd = estimate.error_bars().map(|errors| meter.colour_sd(&estimate.reflectance, errors));
    let [r, g, b] = bytes(&colour);
    let row = |space: &str, pick: fn(&Colour) -> [f64; 3]| {
        let value = |n: usize| {
            let (value, sd) = (pick(&colour)[n], sd.as_ref().map(|sd| pick(sd)[n]));
            sd.map_or_else(|| digits(value, 0.0), |sd| with_sd(value, sd))
        };
        std::iter::once(space.to_owned()).chain([0, 1, 2].map(value)).map(Html::from).collect::<Vec<_>>()
    };
    let rows = [
        row("CIE XYZ, Y of white 100", |colour| colour.xyz),
        row("CIELAB", |colour| colour.lab),
        row("sRGB, 0 to 1", |colour| colour.srgb),
    ];
    let bars = if sd.is_some() { ", with standard deviations (upper bounds)" } else { "" };
    let (light, observer) = (view.illuminant.name(), observer(view.observer));
    let caption = format!("Colour under {light}, {observer} observer{bars}");
    let numbers = Html::table(&caption, &["colour space", "X, L*, R", "Y, a*, G", "Z, b*, B"], rows);
    let style = format!("background: rgb({r}, {g}, {b})");
    let swatch = Html::element(
        "span",
        &[("class", "swatch"), ("style", &style), ("role", "img"), ("aria-label", "swatch")],
        "",
    );
    let hex = Html::element("figcaption", &[], format!("#{r:02x}{g:02x}{b:02x}"));
    let seen = Html::element("figure", &[], vec![swatch, hex]);
    Ok(Some(Html::element("div", &[("class", "colour")], vec![seen, numbers])))
}

/// The observer in words.
pub(super) fn observer(observer: Observer) -> &'static str {
    match observer {
        Observer::Cie1931_2deg => "2°",
        Observer::Cie1964_10deg => "10°",
    }
}

fn bytes(colour: &Colour) -> [u8; 3] {
    colour.srgb.map(|value| (255.0 * value).round() as u8)
}

//! Colour scales that colour-blind readers can distinguish.

use plotters::prelude::RGBColor;

/// Blue, white, brown, equally dark on both sides: from two diverging schemes of C. Brewer, *The Cartographic
/// Journal* 40 (2003), p. 27.
const DIVERGING: [RGBColor; 5] = [
    RGBColor(5, 48, 97),
    RGBColor(67, 147, 195),
    RGBColor(247, 247, 247),
    RGBColor(224, 130, 20),
    RGBColor(127, 59, 8),
];
/// Cividis: J. Nuñez, C. Anderton, R. Renslow, *PLOS ONE* 13 (2018), e0199239.
const SEQUENTIAL: [RGBColor; 5] = [
    RGBColor(0, 34, 78),
    RGBColor(66, 78, 108),
    RGBColor(125, 124, 120),
    RGBColor(188, 174, 108),
    RGBColor(254, 232, 56),
];
/// Facets without a number, in a colour of neither scale.
pub(super) const UNKNOWN: RGBColor = RGBColor(150, 150, 150);

/// Values that differ by less, relative to the largest, are equal.
const ROUNDING: f64 = 1e-6;

/// Numbers from `low` to `high` as colours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    colours: &'static [RGBColor; 5],
    pub low: f64,
    pub high: f64,
}

impl Scale {
    /// Symmetrical around zero and wide enough for all `values`, at least to `least`.
    pub fn around_zero(values: impl Iterator<Item = f64>, least: f64) -> Self {
        let limit = values.fold(least, |limit, value| limit.max(value.abs()));
        Self { colours: &DIVERGING, low: -limit, high: limit }
    }

    /// From the least to the largest of `values`; a single value if they are equal up to rounding.
    pub fn over(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let low = if high - low > ROUNDING * high.abs() { low } else { high };
        Self { colours: &SEQUENTIAL, low, high }
    }

    /// Whether it has a single value.
    pub fn is_one(&self) -> bool {
        self.high <= self.low
    }

    /// The colour of a value, clamped to the ends.
    pub fn colour(&self, value: f64) -> RGBColor {
        let share = (value - self.low) / (self.high - self.low);
        let place = if self.is_one() { 0.5 } else { share.clamp(0.0, 1.0) };
        let steps = (self.colours.len() - 1) as f64;
        let step = (place * steps).min(steps - 1.0) as usize;
        let share = place * steps - step as f64;
        let (RGBColor(r, g, b), RGBColor(s, h, c)) = (self.colours[step], self.colours[step + 1]);
        let mix = |a: u8, b: u8| (f64::from(a) * (1.0 - share) + f64::from(b) * share).round() as u8;
        RGBColor(mix(r, s), mix(g, h), mix(b, c))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle_have_their_colours() {
        let scale = Scale::around_zero([2.0, -5.0].into_iter(), 3.0);
        assert_eq!((scale.low, scale.high), (-5.0, 5.0));
        assert_eq!([-9.0, 0.0, 5.0].map(|value| scale.colour(value)), [0, 2, 4].map(|n| DIVERGING[n]));
        assert_eq!(Scale::over([7.0, 7.0 + 1e-9].into_iter()).colour(7.0), SEQUENTIAL[2]);
    }
}

//! Functions of reflectance used as terms of the facet model, as fractions and as series over bounces.

const SHEET: Series = Series { first: 0, step: 1 };
/// `r/(1 − rg)`.
pub const EVEN: Family = Family { offset: 0.0, a: [1.0, 0.0, 0.0], b: [1.0, 0.0], bounces: SHEET };
/// `r/(1 + rg)`.
pub const ODD: Family = Family { offset: 0.0, a: [1.0, 0.0, 0.0], b: [-1.0, 0.0], bounces: SHEET };

/// 1, for light from parts of known reflectance that never met the sheet: its bounces are not counted.
pub const WITH_KNOWN: Family = Family { offset: 1.0, a: [0.0, 0.0, 0.0], b: [0.0, 0.0], bounces: SHEET };

/// `r/d`, `rcg/d` and `c/d` with `d = 1 − rcg²`, for a fold with a card of reflectance `c`.
pub fn families_with_card(c: f64) -> [Family; 3] {
    let family = |offset, a, first| Family { offset, a, b: [0.0, c], bounces: Series { first, step: 2 } };
    // The last is c/d = c + c²g²·r/d.
    [family(0.0, [1.0, 0.0, 0.0], 0), family(0.0, [0.0, c, 0.0], 1), family(c, [0.0, 0.0, c * c], 2)]
}

/// `offset + a·r/(1 − b·r)`, where a and b are polynomials in the pole g: `a₀ + a₁g + a₂g²` and `b₁g + b₂g²`.
///
/// The offset is direct light; the fraction is a geometric series.
#[derive(Clone, Copy)]
pub struct Family {
    offset: f64,
    a: [f64; 3],
    b: [f64; 2],
    bounces: Series,
}

/// Term n of a series is the light of bounce `first + step·n`.
#[derive(Clone, Copy)]
pub struct Series {
    first: u32,
    step: u32,
}

impl Family {
    /// The polynomials a and b at pole `g`.
    #[inline]
    fn coefficients(&self, g: f64) -> (f64, f64) {
        (self.a[0] + g * (self.a[1] + g * self.a[2]), g * (self.b[0] + g * self.b[1]))
    }

    /// Value at reflectance `r` for pole `g`.
    #[inline]
    pub fn value(&self, r: f64, g: f64) -> f64 {
        let (a, b) = self.coefficients(g);
        self.offset + a * r / (1.0 - b * r)
    }

    /// Amplification by bounces of light that leaves the sheet: the value without its offset, divided by `r`.
    #[inline]
    pub fn gain(&self, r: f64, g: f64) -> f64 {
        let (a, b) = self.coefficients(g);
        a / (1.0 - b * r)
    }

    /// The part of the value due to more than `bounces` bounces.
    pub fn value_after(&self, bounces: u32, r: f64, g: f64) -> f64 {
        r * self.gain_after(bounces, r, g)
    }

    /// The part of the gain due to more than `bounces` bounces.
    pub fn gain_after(&self, bounces: u32, r: f64, g: f64) -> f64 {
        let Series { first, step } = self.bounces;
        let counted = bounces.saturating_add(step).saturating_sub(first) / step;
        let (a, b) = self.coefficients(g);
        a * (b * r).powf(f64::from(counted)) / (1.0 - b * r)
    }

    /// Value, first and second derivative at reflectance `r` for pole `g`.
    #[inline]
    pub fn at(&self, r: f64, g: f64) -> [f64; 3] {
        let (a, b) = self.coefficients(g);
        let rest = 1.0 / (1.0 - b * r);
        let slope = a * rest * rest;
        [self.offset + a * r * rest, slope, 2.0 * b * slope * rest]
    }
}

//! Terms of the facet model for emitted light.

use nalgebra::DMatrix;

/// Effect of bounced exciting light on each term: the factor `1/(1 − gq)` for a pole g and a sheet that
/// reflects the share q of the exciting light.
#[derive(Clone, Debug, PartialEq)]
pub struct ExcitingBounces {
    /// One factor per term.
    pub factors: Vec<f64>,
    /// Their first and second derivatives by the standard normal number of q, relative to the factor.
    pub slopes: Vec<f64>,
    pub bends: Vec<f64>,
}

impl ExcitingBounces {
    /// From the `poles` of the terms, and q with its derivatives by the number.
    pub fn new(poles: &[f64], [q, slope, bend]: [f64; 3]) -> Self {
        let factors: Vec<f64> = poles.iter().map(|pole| (1.0 - pole * q).recip()).collect();
        let relative: Vec<f64> = poles.iter().zip(&factors).map(|(pole, factor)| pole * factor).collect();
        Self {
            slopes: relative.iter().map(|g| g * slope).collect(),
            bends: relative.iter().map(|g| 2.0 * (g * slope).powi(2) + g * bend).collect(),
            factors,
        }
    }
}

/// `rᵖ(1 + gt)/(1 − gq)` for a term t with pole g and reflectance r: emission proportional to the power p of
/// the reflectance, of a sheet that reflects the share q of the exciting light. Waveband by term, with
/// derivatives by reflectance.
pub struct Made {
    pub terms: DMatrix<f64>,
    pub slopes: DMatrix<f64>,
    pub curvatures: DMatrix<f64>,
}

impl Made {
    /// From terms with `poles`, and their derivatives.
    pub fn of(
        reflectance: &[f64],
        terms: [&DMatrix<f64>; 3],
        poles: &[f64],
        (power, exciting): (i32, &ExcitingBounces),
    ) -> Self {
        let p = f64::from(power);
        let of_r = |r: f64| match power {
            0 => [1.0, 0.0, 0.0],
            _ => [r.powi(power), p * r.powi(power - 1), p * (p - 1.0) * r.powi(power - 2)],
        };
        let of_r: Vec<_> = reflectance.iter().map(|r| of_r(*r)).collect();
        let mut made = terms.map(Clone::clone);
        for (term, (pole, factor)) in poles.iter().zip(&exciting.factors).enumerate() {
            for (n, of_r) in of_r.iter().enumerate() {
                let [value, slope, bend] = of_r.map(|of_r| factor * of_r);
                let [t, by, twice] = terms.map(|of| pole * of[(n, term)]);
                made[0][(n, term)] = value * (1.0 + t);
                made[1][(n, term)] = slope * (1.0 + t) + value * by;
                made[2][(n, term)] = bend * (1.0 + t) + 2.0 * slope * by + value * twice;
            }
        }
        let [terms, slopes, curvatures] = made;
        Self { terms, slopes, curvatures }
    }
}

/// [`Made::terms`] alone.
pub fn made(
    reflectance: &[f64],
    terms: &DMatrix<f64>,
    poles: &[f64],
    (power, factors): (i32, &[f64]),
) -> DMatrix<f64> {
    let powers: Vec<f64> = reflectance.iter().map(|r| r.powi(power)).collect();
    let mut made = terms.clone();
    let columns = made.as_mut_slice().chunks_exact_mut(powers.len().max(1));
    for (column, (pole, factor)) in columns.zip(poles.iter().zip(factors)) {
        for (t, of_r) in column.iter_mut().zip(&powers) {
            *t = factor * of_r * (1.0 + pole * *t);
        }
    }
    made
}

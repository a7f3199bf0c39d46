//! Terms of the facet model for emitted light.

use nalgebra::DMatrix;

/// `rᵖ(1 + gt)` for a term t with pole g and reflectance r: emission proportional to the power p of the
/// reflectance. Waveband by term, with derivatives by reflectance.
pub struct Made {
    pub terms: DMatrix<f64>,
    pub slopes: DMatrix<f64>,
    pub curvatures: DMatrix<f64>,
}

impl Made {
    /// From terms with `poles`, and their derivatives.
    pub fn of(reflectance: &[f64], terms: [&DMatrix<f64>; 3], poles: &[f64], power: i32) -> Self {
        let p = f64::from(power);
        let of_r = |r: f64| match power {
            0 => [1.0, 0.0, 0.0],
            _ => [r.powi(power), p * r.powi(power - 1), p * (p - 1.0) * r.powi(power - 2)],
        };
        let mut made = terms.map(Clone::clone);
        for (term, pole) in poles.iter().enumerate() {
            for (n, r) in reflectance.iter().enumerate() {
                let [value, slope, bend] = of_r(*r);
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
pub fn made(reflectance: &[f64], terms: &DMatrix<f64>, poles: &[f64], power: i32) -> DMatrix<f64> {
    let mut made = terms.clone();
    for (mut column, pole) in made.column_iter_mut().zip(poles) {
        for (t, r) in column.iter_mut().zip(reflectance) {
            *t = r.powi(power) * (1.0 + pole * *t);
        }
    }
    made
}

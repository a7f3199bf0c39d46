//! How finely light that is reflected twice and more is followed.

/// Numbers of points, directions and patches of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Points away from the crease and along it, at which light that is reflected twice is integrated over directions.
    pub(super) points: [usize; 2],
    /// Directions at each point, across the crease and along it.
    pub(super) directions: [usize; 2],
    /// Where rows of patches begin and end, as shares of the panel's depth: among them light is reflected three times and more.
    pub(super) edges: &'static [f64],
    /// Patches along the crease: it is across them that light near the crease varies most in direction.
    pub(super) columns: usize,
}

impl Resolution {
    /// To simulate pictures: facets agree with rendered ones within half a percent.
    pub const FINE: Self =
        Self { points: [8, 6], directions: [8, 10], edges: &[0.0, 0.1, 0.3, 0.6, 1.0], columns: 8 };
    /// To compare kinds of sheets with a photograph, of which no kind explains the facets to a percent: two thirds of the time, and no further
    /// off light that is followed more finely still than [`Self::FINE`] is. Fewer patches would be: sheets that mirror at grazing angles need them.
    pub const COARSE: Self = Self { points: [6, 4], directions: [6, 8], ..Self::FINE };
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use nalgebra::{Point3, Vector3};

    use super::*;
    use crate::geometry::{FacetGrid, Fold};
    use crate::sheet::{Family, measured};
    use crate::transport::departures;

    /// Facets of families within 0.5 % and 0.8 % of their brightness (rms), of a measured sheet within 3 %, in the mean of three folds.
    #[test]
    fn coarse_light_is_near_to_fine_light() {
        let finest = Resolution {
            points: [10, 8],
            directions: [12, 14],
            edges: &[0.0, 0.05, 0.15, 0.3, 0.5, 0.75, 1.0],
            columns: 10,
        };
        let family = |gloss, roughness| Family { gloss, roughness, body_roughness_deg: 12.0, fuzz: 0.0 };
        let shapes = [family(0.3, 0.3).into(), family(1.0, 0.42).into(), measured().unwrap()[9].clone()];
        let albedos = [0.1, 0.4, 0.8];
        let scenes =
            [(48.0, 0.0, [1.0, 1.1, 8.4]), (40.0, 0.15, [-0.8, 0.5, 6.0]), (62.0, -0.2, [0.2, -1.5, 5.0])];
        let count = (60 * albedos.len() * scenes.len()) as f64;
        let mut squares = [[0.0; 3]; 2];
        for (angle_deg, tilt, eye) in scenes {
            let fold = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: 10, cols: 3 }).unwrap();
            let (sun, eye) = (Vector3::new(tilt, 0.05, 1.0), Point3::from(eye));
            let at = |resolution: &Resolution| departures(&fold, &sun, &eye, &shapes, &albedos, resolution);
            let truth = at(&finest);
            for (squares, resolution) in squares.iter_mut().zip([Resolution::FINE, Resolution::COARSE]) {
                for ((shape, facet, albedo), found) in at(&resolution).indexed_iter() {
                    let brightness = 0.05 + 0.5 * albedos[albedo];
                    let off: f64 = (found - truth[[shape, facet, albedo]]) / brightness;
                    squares[shape] += off.powi(2) / count;
                }
            }
        }
        for (squares, name) in squares.iter().zip(["fine", "coarse"]) {
            let rms = squares.map(f64::sqrt);
            for (rms, bound) in rms.into_iter().zip([0.005, 0.008, 0.03]) {
                assert!(rms < bound, "{name}: facets off by {rms} of their brightness");
            }
        }
    }
}

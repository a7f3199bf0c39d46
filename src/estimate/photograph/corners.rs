//! Changes of the facets if a corner of a panel is not where it was marked.

use nalgebra::{DMatrix, DVector};

use super::finding::Finding;
use super::parts::Place;

/// Changes of the values of all facets, ordered by channel and then facet, for each corner displaced by one
/// panel depth: the two ends of the crease, then the two outer corners of either panel.
///
/// A displaced corner shifts nearby facets in proportion to their proximity; the resulting change follows
/// from the next facets inwards and outwards. Shifts along the crease, where light varies little, are
/// omitted.
///
/// # Arguments
/// - `places`: positions of the facets; `values`: facet by channel.
#[must_use]
pub fn shifts(places: &[Place], values: &DMatrix<f64>) -> Vec<DVector<f64>> {
    let slopes = slopes(places, values);
    let width = width(places);
    let column = |share: &dyn Fn(&Place) -> f64| {
        DVector::from_fn(slopes.len(), |n, _| share(&places[n % places.len()]) * slopes[n])
    };
    let ends: [fn(f64) -> f64; 2] = [|along| 1.0 - along, |along| along];
    let mut all = Vec::new();
    for end in ends {
        let near = |place: &Place| end(place.along / width);
        // a crease displaced into one panel is displaced out of the other
        let into = |place: &Place| if place.panel == 0 { -1.0 } else { 1.0 };
        all.push(column(&|place| (1.0 - place.depth) * near(place) * into(place)));
        for panel in [0, 1] {
            let of_panel = move |place: &Place| if place.panel == panel { place.depth } else { 0.0 };
            all.push(column(&|place| of_panel(place) * near(place)));
        }
    }
    all
}

/// Length of the crease, in panel depths: facets begin and end at equal distances from its ends.
#[must_use]
pub fn width(places: &[Place]) -> f64 {
    let along = || places.iter().map(|place| place.along);
    along().fold(0.0, f64::max) + along().fold(f64::INFINITY, f64::min)
}

/// Smallest displacement of a corner that is reported, in panel depths.
const LEAST: f64 = 0.015;

/// Corners that, according to the residuals of the facets, are not where they are marked.
///
/// # Arguments
/// - `shifts`: from [`shifts`], whitened like `residuals`; `sd`: prior standard deviation of a corner's
///   displacement, in panel depths.
#[must_use]
pub fn findings(shifts: &[DVector<f64>], residuals: &DVector<f64>, sd: f64) -> Vec<Finding> {
    const NAMES: [&str; 3] =
        ["of the crease", "of the outer side of panel 0", "of the outer side of panel 1"];
    let found = |(n, shift): (usize, &DVector<f64>)| {
        let off = (sd * sd * shift.dot(residuals)).abs();
        // residuals contain the effect of corners among everything that the model lacks: this part remains
        // open
        let open = (1.0 - sd * sd * shift.norm_squared()).max(0.0);
        (off > LEAST && off > 2.0 * sd * open.sqrt()).then(|| Finding {
            unknown: None,
            what: format!(
                "end {} {} is about {:.1} % of a panel's depth from where it is marked",
                n / NAMES.len(),
                NAMES[n % NAMES.len()],
                100.0 * off
            ),
            remedy: "check it with vextract --overlay and mark it again; --refine searches for edges",
            is_unusual: off > 3.0 * sd,
        })
    };
    shifts.iter().enumerate().filter_map(found).collect()
}

/// Change of each facet's values per panel depth outwards, from the next facets on either side in its column.
fn slopes(places: &[Place], values: &DMatrix<f64>) -> DMatrix<f64> {
    let mut slopes = DMatrix::zeros(values.nrows(), values.ncols());
    for (n, place) in places.iter().enumerate() {
        let column = places.iter().enumerate().filter(|(_, other)| {
            other.panel == place.panel && (other.along - place.along).abs() < SAME_COLUMN
        });
        let next = |outwards: f64| {
            let further =
                column.clone().filter(move |(_, other)| outwards * (other.depth - place.depth) > 1e-9);
            further.min_by(|a, b| (a.1.depth - place.depth).abs().total_cmp(&(b.1.depth - place.depth).abs()))
        };
        let (inner, outer) = (next(-1.0).map_or(n, |(m, _)| m), next(1.0).map_or(n, |(m, _)| m));
        let apart = places[outer].depth - places[inner].depth;
        if apart > 0.0 {
            slopes.set_row(n, &((values.row(outer) - values.row(inner)) / apart));
        }
    }
    slopes
}

/// Maximum distance along the crease between facets of a column, in panel depths: some of their pixels may be
/// missing.
const SAME_COLUMN: f64 = 0.12;

#[cfg(test)]
mod tests {
    use super::*;

    /// A value that rises evenly with depth: where the crease is marked too far into panel 1, panel 1 is read
    /// too deep near it.
    #[test]
    fn a_shifted_corner_reads_what_is_beside() {
        let place = |n: usize| Place {
            panel: n / 30,
            depth: (n % 30 / 3) as f64 / 10.0 + 0.05,
            along: (n % 3) as f64 / 3.0 + 1.0 / 6.0,
            off_centre: 0.0,
        };
        let places: Vec<Place> = (0..60).map(place).collect();
        let values = DMatrix::from_fn(60, 2, |n, c| (1.0 + c as f64) * (1.0 + 2.0 * places[n].depth));
        let all = shifts(&places, &values);
        assert_eq!(all.len(), 6);
        for (n, place) in places.iter().enumerate() {
            let into = if place.panel == 0 { -1.0 } else { 1.0 };
            for c in 0..2 {
                let crease = into * (1.0 - place.depth) * (1.0 - place.along) * 2.0 * (1.0 + c as f64);
                assert!((all[0][60 * c + n] - crease).abs() < 1e-9);
                let outer = if place.panel == 1 { place.depth * place.along } else { 0.0 };
                assert!((all[5][60 * c + n] - outer * 2.0 * (1.0 + c as f64)).abs() < 1e-9);
            }
        }
    }
}

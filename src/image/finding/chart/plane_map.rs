//! How a plane is seen in perspective, from pairs of places on it and in the picture.

use nalgebra::{Matrix3, SMatrix, SVector, SymmetricEigen, Vector3};

use super::super::outline::Place;

/// Entries of a projective map, one of which is its scale.
const NUMBERS: usize = 9;
/// Fewest places that determine it.
const FEWEST: usize = 4;

/// Position in the picture of a place on the plane.
pub(super) fn seen(map: &Matrix3<f64>, place: Place) -> Place {
    let seen = map * place.push(1.0);
    Place::new(seen.x / seen.z, seen.y / seen.z)
}

/// The projective map from places on a plane to their positions in the picture, by least squares.
///
/// Source: R. Hartley, A. Zisserman, *Multiple View Geometry* (2004), algorithm 4.2.
pub(super) fn projective(pairs: &[(Place, Place)]) -> Option<Matrix3<f64>> {
    if pairs.len() < FEWEST {
        return None;
    }
    let of_plane = normalising(pairs.iter().map(|(place, _)| *place));
    let of_picture = normalising(pairs.iter().map(|(_, seen)| *seen));
    let mut normal = SMatrix::<f64, NUMBERS, NUMBERS>::zeros();
    for (place, at) in pairs {
        let (q, p) = (seen(&of_plane, *place), seen(&of_picture, *at));
        let (x, y) = (q.x, q.y);
        let rows = [
            [x, y, 1.0, 0.0, 0.0, 0.0, -p.x * x, -p.x * y, -p.x],
            [0.0, 0.0, 0.0, x, y, 1.0, -p.y * x, -p.y * y, -p.y],
        ];
        for row in rows.map(SVector::from) {
            normal += row * row.transpose();
        }
    }
    let eigen = SymmetricEigen::new(normal);
    let (least, _) = eigen.eigenvalues.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    let map = Matrix3::from_row_slice(eigen.eigenvectors.column(least).as_slice());
    let map = of_picture.try_inverse()? * map * of_plane;
    map.iter().all(|number| number.is_finite()).then_some(map)
}

/// The affine map from places to the picture; through three pairs exactly.
pub(super) fn affine(pairs: &[(Place, Place)]) -> Option<Matrix3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Matrix3::zeros());
    for (place, seen) in pairs {
        let place = place.push(1.0);
        normal += place * place.transpose();
        right += place * seen.push(1.0).transpose();
    }
    Some(normal.try_inverse()? * right).map(|map| map.transpose())
}

/// Moves places to the origin and scales them to a mean distance of 1 from it.
fn normalising(places: impl Iterator<Item = Place> + Clone) -> Matrix3<f64> {
    let count = places.clone().count() as f64;
    let middle = places.clone().sum::<Place>() / count;
    let size = (places.map(|place| (place - middle).norm()).sum::<f64>() / count).max(f64::MIN_POSITIVE);
    Matrix3::from_diagonal(&Vector3::new(1.0 / size, 1.0 / size, 1.0)) * Matrix3::new_translation(&-middle)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;

    #[test]
    fn maps_are_found_again() {
        let places: Vec<Place> = (0..12).map(|k| Place::new(f64::from(k % 4), f64::from(k / 4))).collect();
        let pairs =
            |map: &Matrix3<f64>| places.iter().map(|place| (*place, seen(map, *place))).collect::<Vec<_>>();
        let map = Matrix3::new(40.0, -9.0, 300.0, 7.0, 35.0, 200.0, 0.02, -0.03, 1.0);
        let found = projective(&pairs(&map)).unwrap();
        assert!((found / found[(2, 2)] - map).norm() < 1e-6, "{found}");
        let map = Matrix3::new(40.0, -9.0, 300.0, 7.0, 35.0, 200.0, 0.0, 0.0, 1.0);
        assert!((affine(&pairs(&map)).unwrap() - map).norm() < 1e-6);
        assert_eq!(projective(&pairs(&map)[..3]), None);
    }
}

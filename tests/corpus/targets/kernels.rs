//! Arrays made elsewhere.

use vfold::scene::ExternalKernel;
use vfold::stream::{read_rows, read_square, write_matrix};

use super::{assert_finite, taken, with_file};

pub fn npy(bytes: &[u8]) {
    with_file("a.npy", bytes, |path| {
        taken(read_rows(path, 3));
        if let Some(matrix) = taken(read_square(path)) {
            with_file("b.npy", &[], |copy| {
                let row = |i| matrix.row(i).iter().copied().collect();
                write_matrix(copy, matrix.nrows(), matrix.ncols(), row).unwrap();
                let again = read_square(copy).unwrap();
                let bits = |m: &nalgebra::DMatrix<f64>| m.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&again), bits(&matrix));
            });
        }
        let Some(kernel) = taken(ExternalKernel::read(path, None, None)) else { return };
        let Some(scene) = taken(kernel.scene()) else { return };
        for response in scene.responses().unwrap() {
            let light: Vec<_> =
                (0..response.facets()).map(|facet| response.irradiance(facet, 0.99)).collect();
            assert_finite("irradiance", &light);
        }
    });
}

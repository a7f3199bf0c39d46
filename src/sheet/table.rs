//! Reflection of measured sheets, tabulated over the directions.
//!
//! Fits of measured materials (A. Sztrajman et al., "Neural BRDF representation and importance sampling",
//! Computer Graphics Forum 2021; the measurements: J. Dupuy, W. Jakob, SIGGRAPH Asia 2018, and J. Nielsen et
//! al., SIGGRAPH Asia 2015), sampled by `share/make-shapes.py`.

use std::sync::Arc;

use pulp::Arch;

use super::angles::AngleList;
use super::place::{ANGLES, AZIMUTHS, PARTS, Place};

/// Body and surface of one material.
#[derive(Clone, Debug)]
pub(super) struct Table(Arc<[f32]>);

impl Table {
    /// Completes, by reciprocity, a table in which the angle of exit never exceeds that of incidence.
    pub(super) fn of_half(half: &[f32]) -> Self {
        let row = PARTS * AZIMUTHS;
        let mut table = vec![0.0; ANGLES * ANGLES * row];
        let pairs = (0..ANGLES).flat_map(|a| (0..=a).map(move |b| (a, b)));
        for ((a, b), values) in pairs.zip(half.chunks_exact(row)) {
            for start in [(a * ANGLES + b) * row, (b * ANGLES + a) * row] {
                table[start..start + row].copy_from_slice(values);
            }
        }
        Self(table.into())
    }

    /// Body and surface at the place of each of many pairs of directions.
    pub(super) fn at_each(&self, angles: &AngleList) -> [Vec<f64>; 2] {
        let mut reflections = [0, 1].map(|_| vec![0.0; angles.len()]);
        let [body, surface] = &mut reflections;
        Arch::new().dispatch(|| {
            for ((body, surface), place) in body.iter_mut().zip(surface).zip(&angles.places) {
                [*body, *surface] = self.at(place);
            }
        });
        reflections
    }

    /// Body and surface at a place.
    #[inline(always)]
    pub(super) fn at(&self, place: &Place) -> [f64; 2] {
        let Place { first, corners, azimuth } = *place;
        let cells = self.0[first as usize..].first_chunk::<CELL>();
        // of one azimuth, then of the next
        let mut sums = [0.0_f32; 2 * PARTS];
        for (start, weight) in CORNERS.into_iter().zip(corners) {
            if let Some(values) = cells.and_then(|cells| cells[start..].first_chunk::<{ 2 * PARTS }>()) {
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        let [body, surface, next_body, next_surface] = sums;
        [body + azimuth * (next_body - body), surface + azimuth * (next_surface - surface)].map(f64::from)
    }
}

/// Where the values at the corners of a cell start, relative to its first: the angles of incidence and exit
/// are those of the cell or the next ones.
const CORNERS: [usize; 4] = {
    let [light, eye] = [PARTS * AZIMUTHS * ANGLES, PARTS * AZIMUTHS];
    [0, eye, light, light + eye]
};
/// Numbers from the first of a cell to its last.
const CELL: usize = CORNERS[3] + 2 * PARTS;

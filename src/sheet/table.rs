//! Reflection of measured sheets, tabulated over the directions.
//!
//! Fits of measured materials (A. Sztrajman et al., "Neural BRDF representation and importance sampling",
//! Computer Graphics Forum 2021; the measurements: J. Dupuy, W. Jakob, SIGGRAPH Asia 2018, and J. Nielsen et
//! al., SIGGRAPH Asia 2015), sampled by `share/make-shapes.py`.

use std::sync::Arc;

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
        let (body, surface) = angles.places.iter().map(|place| self.at(place).into()).unzip();
        [body, surface]
    }

    /// Body and surface at a place.
    pub(super) fn at(&self, place: &Place) -> [f64; 2] {
        const STEPS: [usize; 2] = [PARTS * AZIMUTHS * ANGLES, PARTS * AZIMUTHS];
        let Place { first, into: [a, b, c] } = *place;
        // of one azimuth, then of the next
        let mut sums = [0.0_f32; 2 * PARTS];
        let corners =
            [(0, 0, (1.0 - a) * (1.0 - b)), (0, 1, (1.0 - a) * b), (1, 0, a * (1.0 - b)), (1, 1, a * b)];
        for (light, eye, weight) in corners {
            let start = first as usize + light * STEPS[0] + eye * STEPS[1];
            if let Some(values) = self.0[start..].first_chunk::<{ 2 * PARTS }>() {
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        let [body, surface, next_body, next_surface] = sums;
        [body + c * (next_body - body), surface + c * (next_surface - surface)].map(f64::from)
    }
}

//! Functions on a panel: polynomials in both directions on every cell of a grid of strips.
//!
//! A cell has the polynomials `P_m(s)·P_b(x)` up to a total degree. The products of two high degrees, half of
//! all, contribute least to smooth light.

use super::strips::Strips;

/// Strips across a panel and along the first half of its crease, with equal numbers of polynomials in both
/// directions.
///
/// Functions are ordered by strip across, degree across, degree along and strip along, the last varying
/// fastest.
#[derive(Clone, Debug)]
pub(super) struct Space {
    pub(super) across: Strips,
    pub(super) along: Strips,
}

impl Space {
    /// The same strips with `more` additional degrees.
    pub(super) fn with_more_degrees(&self, more: usize) -> Self {
        let [across, along] = [&self.across, &self.along]
            .map(|strips| Strips { ends: strips.ends.clone(), order: strips.order + more });
        Self { across, along }
    }

    /// Number of functions.
    pub(super) fn len(&self) -> usize {
        self.across.ends.len() * self.of_strip()
    }

    /// Number of functions on a strip across the panel.
    pub(super) fn of_strip(&self) -> usize {
        self.first(self.order())
    }

    /// Number of polynomials in either direction.
    pub(super) fn order(&self) -> usize {
        self.across.order
    }

    /// Number of degrees along the crease of the functions of degree `m` across it.
    pub(super) fn degrees(&self, m: usize) -> usize {
        self.order() - m
    }

    /// Index, within a strip, of the first function of degree `m` across the crease.
    pub(super) fn first(&self, m: usize) -> usize {
        self.along.ends.len() * (0..m).map(|m| self.degrees(m)).sum::<usize>()
    }

    /// Coordinates of the constant function 1.
    pub(super) fn uniform(&self) -> Vec<f64> {
        let mut one = vec![0.0; self.len()];
        for (of_strip, across) in one.chunks_exact_mut(self.of_strip()).zip(&self.across.ends) {
            for (coordinate, along) in of_strip.iter_mut().zip(&self.along.ends) {
                *coordinate = ((across[1] - across[0]) * (along[1] - along[0])).sqrt();
            }
        }
        one
    }
}

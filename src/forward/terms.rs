//! The terms of the facet model, functions of reflectance at a pole, and the wavebands where they are not
//! zero.

use nalgebra::DMatrix;
use pulp::Arch;

use super::families::{EVEN, Family, ODD, WITH_KNOWN, families_with_card};

/// A card of known reflectance in the place of one panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Its panel, 0 or 1; the other one is the sheet.
    pub panel: usize,
    /// Reflectance per waveband.
    pub reflectance: Vec<f64>,
}

/// The functions whose linear combinations are the facets' radiances.
#[derive(Clone, Debug)]
pub enum Terms {
    /// A surface of one reflectance: `r/(1 − rg)`, followed by `r/(1 + rg)` if a fold is lit unevenly
    /// (`odd`).
    One { poles: Vec<f64>, odd: bool },
    /// A fold of a sheet and a card of reflectance c: `r/d`, `rcg/d`, `c/d` with `d = 1 − rcg²`.
    Card { poles: Vec<f64>, card: Card },
    /// A surface with parts of known reflectance has different poles in every waveband: 1, then `r/(1 − rg)`,
    /// in that waveband alone.
    WithKnown(Vec<Vec<f64>>),
}

/// Terms of the same family, each with its own pole, starting at row `first`.
pub struct Block<'a> {
    pub first: usize,
    pub family: Family,
    pub poles: &'a [f64],
}

impl Terms {
    /// Number of terms.
    pub fn count(&self) -> usize {
        match self {
            Self::One { poles, odd } => poles.len() * (1 + usize::from(*odd)),
            Self::Card { poles, .. } => 3 * poles.len(),
            Self::WithKnown(bands) => bands.iter().map(|poles| 1 + poles.len()).sum(),
        }
    }

    /// Poles of the terms of a surface of one reflectance, negated where they are subtracted; `None` for
    /// other surfaces.
    pub fn signed_poles(&self) -> Option<Vec<f64>> {
        let Self::One { poles, odd } = self else { return None };
        let subtracted = poles.iter().filter(|_| *odd).map(|pole| -pole);
        Some(poles.iter().copied().chain(subtracted).collect())
    }

    /// True if no light returns to the surface and no part of it is known.
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::One { poles, .. } if poles.iter().all(|pole| pole.abs() <= 0.0))
    }

    /// Index of the first term of a waveband.
    pub fn first(&self, band: usize) -> usize {
        match self {
            Self::WithKnown(bands) => bands[..band].iter().map(|poles| 1 + poles.len()).sum(),
            _ => 0,
        }
    }

    /// The terms that are not zero in a waveband.
    fn blocks(&self, band: usize) -> impl Iterator<Item = Block<'_>> {
        let blocks = match self {
            Self::One { poles, odd } => {
                [Some(Block::nth(0, EVEN, poles)), odd.then(|| Block::nth(1, ODD, poles)), None]
            }
            Self::Card { poles, card } => {
                let families = families_with_card(card.reflectance[band]);
                std::array::from_fn(|n| Some(Block::nth(n, families[n], poles)))
            }
            Self::WithKnown(bands) => {
                let first = self.first(band);
                let known = Block { first, family: WITH_KNOWN, poles: &[0.0] };
                [Some(known), Some(Block { first: first + 1, family: EVEN, poles: &bands[band] }), None]
            }
        };
        blocks.into_iter().flatten()
    }

    /// Evaluates `of` for every family and pole in each of `bands`, at the `reflectance` in each: waveband by
    /// term.
    pub fn in_bands<const N: usize>(
        &self,
        bands: &[usize],
        reflectance: &[f64],
        of: impl Fn(&Family, f64, f64) -> [f64; N],
    ) -> [DMatrix<f64>; N] {
        let mut all = [(); N].map(|()| DMatrix::zeros(bands.len(), self.count()));
        Arch::new().dispatch(
            #[inline(always)]
            || self.fill(bands, reflectance, of, &mut all),
        );
        all
    }

    #[inline(always)]
    fn fill<const N: usize>(
        &self,
        bands: &[usize],
        reflectance: &[f64],
        of: impl Fn(&Family, f64, f64) -> [f64; N],
        all: &mut [DMatrix<f64>; N],
    ) {
        // Wavebands with the same families and poles form one run, which the compiler can vectorise.
        let run = if matches!(self, Self::One { .. }) { bands.len().max(1) } else { 1 };
        for (n, (bands, reflectance)) in bands.chunks(run).zip(reflectance.chunks(run)).enumerate() {
            for Block { first, family, poles } in self.blocks(bands[0]) {
                for (term, g) in poles.iter().enumerate() {
                    let mut columns = all.each_mut().map(|matrix| {
                        &mut matrix.column_mut(first + term).data.into_slice_mut()[n * run..][..bands.len()]
                    });
                    for (row, r) in reflectance.iter().enumerate() {
                        let values = of(&family, *r, *g);
                        columns.iter_mut().zip(values).for_each(|(column, value)| column[row] = value);
                    }
                }
            }
        }
    }
}

impl<'a> Block<'a> {
    /// The `n`th of several blocks with the same poles.
    fn nth(n: usize, family: Family, poles: &'a [f64]) -> Self {
        Self { first: n * poles.len(), family, poles }
    }
}

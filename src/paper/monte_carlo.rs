//! Form factors by Monte Carlo, as in the paper's estimate of its kernel, and by rays in place of pairs of
//! points.
//!
//! Pairs of points distributed uniformly over two facets have an infinite variance if the facets meet: with ρ
//! the distance to their common point, the squared kernel of eq. (2) grows as ρ⁻⁴ and the area elements leave
//! ∫ ρ⁻² dρ. The mean still converges, but more slowly than the standard error from the same samples
//! suggests. Rays that leave a facet under the cosine law are simply counted where they land: the variance is
//! that of a proportion.

use ndarray::parallel::prelude::*;
use ndarray::{Array4, ArrayViewMut2, Axis};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::fold_kernel::{FoldKernel, row_ranges};
use super::midpoint::PointKernel;
use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};
use crate::kernel::mesh::Samples;

/// Samples that justify another thread: fewer are finished before it has started.
const SAMPLES_A_THREAD: usize = 20_000;

/// Definition of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// A pair of points, distributed uniformly over both facets, for each distinct entry, as in the paper.
    Area,
    /// A ray that leaves a facet under the cosine law, for each row of facets.
    Cosine,
}

impl Sampling {
    /// Its name for `vkernel --sampling`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Cosine => "cosine",
        }
    }
}

/// A seeded estimate of the form factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MonteCarlo {
    sampling: Sampling,
    samples: u32,
    seed: u64,
}

impl MonteCarlo {
    /// An estimate from `samples` samples; the same `seed` gives identical results on every machine and with
    /// any number of threads.
    ///
    /// # Errors
    /// Fewer than two samples, whose variance is undefined.
    pub fn new(sampling: Sampling, samples: u32, seed: u64) -> Result<Self> {
        if samples < 2 {
            let problem = format!("{samples} is too few for a standard error");
            return Err(Error::usage("--samples", problem, "give 2 to 4294967295"));
        }
        Ok(Self { sampling, samples, seed })
    }

    /// Definition of a sample.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// The samples of the estimate.
    #[must_use]
    pub fn samples(&self) -> Samples {
        Samples { sampling: self.sampling.name(), count: self.samples, seed: self.seed }
    }

    /// The form factors of `fold`, and the largest standard error of one, from the scatter of the samples.
    ///
    /// # Source
    /// Deeb et al., section 5A; Malley's method for rays (Pharr et al., *Physically Based Rendering*, 4th
    /// ed., appendix A.5.3).
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::paper::monte_carlo::{MonteCarlo, Sampling};
    /// let fold = Fold::new(90.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let (kernel, sd) = MonteCarlo::new(Sampling::Cosine, 10_000, 1)?.form_factors(&fold);
    /// assert!((kernel.form_factor(0, 0, 0, 0) - 0.20004).abs() < 5.0 * sd); // Howell, configuration C-14
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn form_factors(&self, fold: &Fold) -> (FoldKernel, f64) {
        let (kernel, sds) = match self.sampling {
            Sampling::Area => self.by_points(fold),
            Sampling::Cosine => self.by_rays(fold),
        };
        (kernel, sds.into_iter().fold(0.0, f64::max))
    }

    /// An independent random number generator for each part of the work.
    fn generator(&self, part: usize) -> ChaCha8Rng {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(part as u64);
        generator
    }

    /// Pairs of points for every pair of rows and every shift; the largest standard error of each pair of
    /// rows.
    fn by_points(&self, fold: &Fold) -> (FoldKernel, Vec<f64>) {
        let (points, [rows0, rows1]) = (PointKernel::new(fold), row_ranges(fold));
        let FacetGrid { rows, cols } = fold.facets();
        let pairs_a_thread = SAMPLES_A_THREAD.div_ceil(cols * self.samples as usize);
        FoldKernel::from_exchange(fold, pairs_a_thread, |i, j, shifts| {
            let mut generator = self.generator(i * rows + j);
            let (s, t) = (&rows0[i], &rows1[j]);
            let (height_s, height_t) = (s.end - s.start, t.end - t.start);
            let mut largest: f64 = 0.0;
            for (k, value) in shifts.iter_mut().enumerate() {
                let (mean, sd) = self.mean(|| {
                    let z = k as f64 + unit(&mut generator) - unit(&mut generator);
                    let s = s.start + height_s * unit(&mut generator);
                    let t = t.start + height_t * unit(&mut generator);
                    points.at(s, t, z)
                });
                *value = height_s * height_t * mean;
                largest = largest.max(height_s.max(height_t) * sd);
            }
            largest
        })
    }

    /// Mean of samples and its standard error.
    fn mean(&self, mut sample: impl FnMut() -> f64) -> (f64, f64) {
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..self.samples {
            let value = sample();
            sum += value;
            squares += value * value;
        }
        let count = f64::from(self.samples);
        let mean = sum / count;
        (mean, ((squares / count - mean * mean).max(0.0) / (count - 1.0)).sqrt())
    }

    /// Rays from every row; those between two rows count in both directions, weighted for minimum variance.
    fn by_rays(&self, fold: &Fold) -> (FoldKernel, Vec<f64>) {
        let (hits, rows) = (self.hits(fold), row_ranges(fold));
        let (count, last_panel) = (f64::from(self.samples), hits.len_of(Axis(0)) - 1);
        FoldKernel::from_exchange(fold, SAMPLES_A_THREAD.div_ceil(fold.facets().cols), |i, j, shifts| {
            let [height0, height1] = [&rows[0][i], &rows[1][j]].map(|row| row.end - row.start);
            // a row of a symmetric fold and its mirror image share their rays
            let same = if last_panel == 0 && i == j { 2.0 } else { 1.0 };
            let mut largest: f64 = 0.0;
            for (k, value) in shifts.iter_mut().enumerate() {
                let sides = if k == 0 { 1.0 } else { 2.0 };
                let scale = height0 * height1 / ((height0 + height1) * sides * count);
                let [there, back] = [hits[[0, i, j, k]], hits[[last_panel, j, i, k]]].map(f64::from);
                *value = scale * (there + back);
                let variance = same * (there * (1.0 - there / count) + back * (1.0 - back / count));
                largest = largest.max(scale * variance.sqrt() / height0.min(height1));
            }
            largest
        })
    }

    /// Counts of the rays from each row of panel 0, and of panel 1 unless the panels are alike: by panel,
    /// row, row hit and shift.
    fn hits(&self, fold: &Fold) -> Array4<u32> {
        let panels = if fold.is_symmetric() { 1 } else { 2 };
        let (ranges, FacetGrid { rows, cols }) = (row_ranges(fold), fold.facets());
        let (sin, cos) = fold.angle_rad().sin_cos();
        let shoot = |panel: usize, row: usize, mut hits: ArrayViewMut2<u32>| {
            let (from, onto) = (&ranges[panel][row], &ranges[1 - panel]);
            let mut generator = self.generator(panel * rows + row);
            for _ in 0..self.samples {
                let s = from.start + (from.end - from.start) * unit(&mut generator);
                let x = unit(&mut generator);
                let [along, away, up] = cosine_direction(&mut generator);
                // the ray reaches the other panel's plane after `reach·sinθ`, unless it leads away from it
                let reach = s / (up * cos - away * sin);
                let t = reach * up;
                // positive and negative shifts are equivalent, and so are x and 1 − x
                let shift = x + reach * sin * along.abs();
                if (reach > 0.0) & (t < onto[rows - 1].end) & (shift < cols as f64) {
                    let row = onto.partition_point(|row| row.end <= t);
                    hits[[row, shift as usize]] += 1;
                }
            }
        };
        let mut hits = Array4::zeros((panels, rows, rows, cols));
        for (panel, mut from_panel) in hits.outer_iter_mut().enumerate() {
            let from_rows = from_panel.outer_iter_mut().into_par_iter().enumerate();
            from_rows
                .with_min_len(SAMPLES_A_THREAD.div_ceil(self.samples as usize))
                .for_each(|(row, hits)| shoot(panel, row, hits));
        }
        hits
    }
}

/// A number uniformly distributed over (0, 1), in steps of 2⁻³²: much finer than any number of samples
/// resolves.
#[inline]
fn unit(generator: &mut ChaCha8Rng) -> f64 {
    (f64::from(generator.next_u32()) + 0.5) * 2.0_f64.powi(-32)
}

/// A direction under the cosine law: along the crease, away from it in the panel, up from the panel.
#[inline]
fn cosine_direction(generator: &mut ChaCha8Rng) -> [f64; 3] {
    loop {
        let [along, away] = [(); 2].map(|()| 2.0 * unit(generator) - 1.0);
        let up2 = 1.0 - along * along - away * away;
        if up2 > 0.0 {
            return [along, away, up2.sqrt()];
        }
    }
}

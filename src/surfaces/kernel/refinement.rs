//! The bounces on any surface, on patches that are refined until the facet means are accurate.

use super::SurfaceKernel;
use super::direct::DirectLight;
use super::patches::{Division, Patch, patches, patches_by};
use crate::error::{Error, Result};
use crate::geometry::LightSource;
use crate::kernel::mesh::{Accuracy, KernelSource, Mesh};
use crate::surfaces::shape::{FACETS_MAX, Shape};
use crate::surfaces::{Exchange, SurfaceResponse};

/// Cells along a side in successively finer meshes.
const LADDER: [usize; 6] = [1, 2, 4, 8, 16, 32];
/// Factor of the number of cells along a side of a facet in which a shadow ends.
const SHADOW: usize = 2;
/// A shadow ends in a facet if direct light on its patches differs by more than this, relative to the
/// brightest.
const UNEVEN: f64 = 0.01;
/// Most cells along a side that can be requested: for a single facet they make the largest number of patches.
const CELLS_MAX: usize = 316;
/// Most patches of the first mesh, and of others except one expected to reach the tolerance.
const FIRST_MAX: usize = 8000;
const PATCHES_MAX: usize = 40_000;
/// Most pairs of patches that may partly hide each other, which dominate the time: half a minute or so.
const HIDDEN_MAX: f64 = 2e6;
/// Ratio of successive differences between meshes. With cells halved it should be a quarter; on coarse
/// meshes, and where a shadow ends, it may be as small once and larger the next time.
const FALL: f64 = 0.45;
/// The ratio assumed after only two meshes, and if the difference did not decrease.
const FIRST_FALL: f64 = 0.6;
const LEAST_FALL: f64 = 0.75;
/// Reflectances at which two meshes are compared.
const PROBES: [f64; 2] = [0.5, 0.9];
/// Facets darker than this fraction of the mean are compared relative to it instead of to themselves.
const DARK: f64 = 0.1;

/// The solution of the bounces for every source.
pub struct Solved {
    /// Poles and residues per source.
    pub responses: Vec<SurfaceResponse>,
    /// Their accuracy.
    pub accuracy: Accuracy,
    /// The form factors between the patches of the last mesh.
    pub kernel: SurfaceKernel,
    /// Largest standard error of sampled direct light, 0 if none is sampled.
    pub direct_error: f64,
}

/// Solves the bounces on `shape` under each of `sources` for every reflectance, on `mesh`.
///
/// [`Mesh::Auto`] refines facets until the expected error of every facet mean is at most `tolerance`,
/// relative to itself or, in the dark, to a tenth of the mean, at reflectances up to 0.9; it stops earlier,
/// as the accuracy shows, at 40 000 patches or two million pairs of partly hidden patches.
///
/// # Errors
/// As [`SurfaceKernel::new`] and [`SurfaceResponse::solve`]; [`Error::Usage`] for a mesh of rows and columns,
/// which shapes do not have.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold, LightSource};
/// use vfold::surfaces::Accordion;
/// use vfold::kernel::mesh::Mesh;
/// use vfold::surfaces::kernel::refinement::solve;
/// let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 2, cols: 2 })?;
/// let v = Accordion { valley, creases: 1, ridge_deg: 60.0, bow_deg: 0.0 }.shape()?;
/// let sun = LightSource::directional([0.0, 0.0, 1.0], 1.0)?;
/// let solved = solve(&v, &[sun], Mesh::Auto, 0.02)?;
/// assert!(solved.accuracy.facet_mean_error.unwrap() <= 0.02);
/// assert!(solved.responses[0].irradiance(0, 0.9) > 1.4 * solved.responses[0].irradiance(0, 0.0));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn solve(shape: &Shape, sources: &[LightSource], mesh: Mesh, tolerance: f64) -> Result<Solved> {
    let scene = Scene { shape, sources, tolerance };
    match mesh {
        Mesh::Auto => scene.refined(),
        Mesh::Facets => scene.on(&patches(shape, Division::NONE)),
        Mesh::Cells(cells) => scene.on(&patches(shape, Division { cells, graded: false })),
        Mesh::Patches(_) => Err(Error::usage(
            "--mesh",
            "a shape has no rows and columns",
            "give auto, facets, or one number: cells along each side of a facet",
        )),
    }
}

/// The patches of the mesh on which [`solve`] ended with this many `unknowns`; none if there is no such mesh.
#[must_use]
pub fn patches_again(shape: &Shape, sources: &[LightSource], unknowns: usize) -> Option<Vec<Patch>> {
    let scene = Scene { shape, sources, tolerance: 0.0 };
    let even = (1..=CELLS_MAX).map(|cells| patches(shape, Division { cells, graded: false }));
    let once = std::iter::once_with(|| patches(shape, Division::NONE));
    let uneven = scene.uneven();
    let ladder = LADDER.iter().map(|cells| scene.divided(*cells, &uneven));
    let mut meshes = once.chain(ladder).chain(even.take_while(|patches| patches.len() <= unknowns));
    meshes.find(|patches| patches.len() == unknowns)
}

struct Scene<'a> {
    shape: &'a Shape,
    sources: &'a [LightSource],
    tolerance: f64,
}

impl Scene<'_> {
    fn refined(&self) -> Result<Solved> {
        let uneven = self.uneven();
        let first = self.divided(LADDER[0], &uneven);
        if first.len() > FIRST_MAX {
            return self.on(&patches(self.shape, Division::NONE));
        }
        let (mut solved, mut before) = (self.on(&first)?, None);
        for cells in &LADDER[1..] {
            let patches = self.divided(*cells, &uneven);
            let growth = patches.len() as f64 / solved.accuracy.unknowns as f64;
            let hidden = solved.kernel.census().hidden as f64 * growth.powi(2);
            let reaches =
                solved.accuracy.facet_mean_error.is_some_and(|error| FALL * error <= self.tolerance);
            let patches_max = if reaches { FACETS_MAX } else { PATCHES_MAX };
            if patches.len() > patches_max || hidden > HIDDEN_MAX {
                break;
            }
            let finer = match self.on(&patches) {
                Ok(finer) => finer,
                // if this does not fit into memory, the last solution remains
                Err(Error::Memory { .. } | Error::FullExchange { .. }) => break,
                Err(error) => return Err(error),
            };
            let last = difference(&solved.responses, &finer.responses);
            let error = left(before, last);
            (solved, before) = (finer, Some(last));
            solved.accuracy.facet_mean_error = Some(error);
            if error <= self.tolerance {
                break;
            }
        }
        Ok(solved)
    }

    /// Patches, finer where shadows end.
    fn divided(&self, cells: usize, uneven: &[bool]) -> Vec<Patch> {
        let cells = |facet: usize| if uneven[facet] { SHADOW * cells } else { cells };
        patches_by(self.shape, |facet| Division { cells: cells(facet), graded: true })
    }

    /// Facets in which a shadow ends: parts of them receive different light from a source other than the sky.
    fn uneven(&self) -> Vec<bool> {
        let patches = patches(self.shape, Division { cells: 2, graded: false });
        let mut uneven = vec![false; self.shape.len()];
        for source in self.sources.iter().filter(|source| !source.is_sky()) {
            let light = DirectLight::of_lamp(source, self.shape, &patches);
            let lit: Vec<(usize, f64)> = patches.iter().map(|patch| patch.facet).zip(light).collect();
            for facet in lit.chunk_by(|a, b| a.0 == b.0) {
                let (low, high) = facet.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), (_, light)| {
                    (low.min(*light), high.max(*light))
                });
                uneven[facet[0].0] |= high - low > UNEVEN * high;
            }
        }
        uneven
    }

    /// The solution on these patches.
    fn on(&self, patches: &[Patch]) -> Result<Solved> {
        let kernel = SurfaceKernel::new(self.shape, patches, self.tolerance)?;
        let (mut responses, mut residual, mut direct_error) = (Vec::new(), 0.0_f64, 0.0_f64);
        for source in self.sources {
            let direct = DirectLight::of(source, self.shape, patches, &kernel);
            let (response, left) = SurfaceResponse::solve(&kernel, &direct.irradiance, 0.1 * self.tolerance)?;
            responses.push(response);
            (residual, direct_error) = (residual.max(left), direct_error.max(direct.standard_error));
        }
        let source =
            KernelSource { method: "exact", samples: None, entry_sd: None, entries: kernel.entries() };
        let (unknowns, kernel_source) = (kernel.unknowns(), Some(source));
        let accuracy = Accuracy { unknowns, facet_mean_error: None, residual, kernel: kernel_source };
        Ok(Solved { responses, accuracy, kernel, direct_error })
    }
}

/// Total change by all finer meshes, extrapolated from the `last` difference between two meshes and the one
/// `before` it.
fn left(before: Option<f64>, last: f64) -> f64 {
    let fall = before.map_or(FIRST_FALL, |before| (last / before).clamp(FALL, LEAST_FALL));
    last * fall / (1.0 - fall)
}

/// Largest difference of a facet's irradiance between two meshes, over sources and [`PROBES`].
fn difference(coarse: &[SurfaceResponse], fine: &[SurfaceResponse]) -> f64 {
    let mut largest = 0.0_f64;
    for ((coarse, fine), r) in coarse.iter().zip(fine).flat_map(|pair| PROBES.map(|r| (pair, r))) {
        let [before, after] = [coarse, fine].map(|response| {
            (0..response.facets()).map(|facet| response.irradiance(facet, r)).collect::<Vec<_>>()
        });
        let dark = DARK * after.iter().sum::<f64>() / after.len() as f64;
        let changes =
            before.iter().zip(&after).map(|(before, after)| (before - after).abs() / after.max(dark));
        largest = changes.fold(largest, f64::max);
    }
    largest
}

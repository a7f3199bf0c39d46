//! Exchange of light between the parts of a bent sheet, and the light that its facets gather.

use nalgebra::{DMatrix, Vector2, Vector3};
use ndarray::Array2;

use crate::error::{Error, Result};
use crate::geometry::Fold;
use crate::kernel::quadrature::Rule;
use crate::solve::dense::cholesky;

use super::columns::Columns;
use super::section::{self, Strip};
use super::seen::{self, Sample};
use super::view::SeenStrip;
use super::{BentFold, Symmetry};

/// Number of columns of a strip.
const COLUMNS: usize = 5;
/// Columns in one half, including the middle one: light and sheet are symmetric about the middle of the
/// crease.
const HALF: usize = COLUMNS.div_ceil(2);
/// Gauss points across a strip and along a column.
const POINTS: [usize; 2] = [3, 2];

/// A point of the sheet's cross-section that represents part of a row of facets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Its weight in the row's value.
    pub share: f64,
    /// Coordinates across the crease and out of the opening.
    pub place: Vector2<f64>,
    /// Unit normal there.
    pub normal: Vector2<f64>,
}

/// Light that reaches a point of the sheet from a patch of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Incoming<'a> {
    /// The point.
    pub at: &'a Seen,
    /// Unit vector towards the patch.
    pub towards: Vector3<f64>,
    /// Unit normal of the patch.
    pub normal: Vector2<f64>,
    /// Form factor from the point to the patch.
    pub form_factor: f64,
}

/// How a picture shows a fold.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The direction from which it is seen, in the coordinates of [`Fold::panels`].
    pub towards: Vector3<f64>,
    /// Fraction of each panel next to the crease that is not read, because pixels there show both panels.
    pub unread: [f64; 2],
}

impl From<Vector3<f64>> for View {
    /// From this direction, read up to the crease.
    fn from(towards: Vector3<f64>) -> Self {
        Self { towards, unread: [0.0; 2] }
    }
}

/// Form factors among the parts of a bent sheet and to its facets, independent of light and albedo.
pub struct BentExchange {
    /// Panels and facets, of which the angle is not used.
    fold: Fold,
    /// Angle between the panels' chords, degrees.
    angle_deg: f64,
    strips: Vec<Strip>,
    /// Area of each patch (strip, then column of one half) together with its mirror image.
    areas: Vec<f64>,
    /// For light of each [`Symmetry`] area times form factor, patch by patch: symmetric.
    exchange: [DMatrix<f64>; 2],
    /// For light of each [`Symmetry`] the form factor from each facet of one half (panel, row, column) to
    /// each patch.
    gather: [DMatrix<f64>; 2],
    /// The points of the sheet visible in each row of facets of both panels.
    rows: Vec<Vec<Seen>>,
}

impl BentExchange {
    /// The exchange of `bent` with the panels and facets of `fold`, seen from far away.
    ///
    /// The viewpoint decides what the facets show of a rounded crease: they divide the quadrilateral between
    /// an outer side and the line where the panels would meet without rounding. Coordinates are those of
    /// [`Fold::panels`].
    #[must_use]
    pub fn new(bent: &BentFold, fold: &Fold, view: impl Into<View>) -> Self {
        let View { towards, unread } = view.into();
        let panels = section::strips(bent, fold);
        let towards = Vector2::new(towards.x, towards.z);
        let edges = fold.spacing().edges(fold.facets().rows);
        let samples = [0, 1].map(|panel| seen::samples(&panels, panel, (&edges, unread[panel]), towards));
        let strips = panels.concat();
        let rows = rows(&strips, &samples, fold.facets().rows);
        let numbered: Vec<(usize, Sample)> = (0..2)
            .flat_map(|panel: usize| samples[panel].iter().map(move |sample| (panel, *sample)))
            .collect();
        Self {
            areas: strips
                .iter()
                .flat_map(|strip| (0..HALF).map(|c| strip.depth() * column_width(c, fold)))
                .collect(),
            exchange: exchange(&strips, fold),
            gather: gather(&strips, &numbered, fold),
            rows,
            strips,
            fold: *fold,
            angle_deg: bent.angle_deg,
        }
    }

    /// Radiance of the facets in parallel light from the direction `sun`, as [`BentFold::facet_radiance`].
    ///
    /// # Errors
    /// [`Error::Numeric`] if light does not leave the fold.
    pub fn facet_radiance(&self, sun: Vector3<f64>, albedos: &[f64]) -> Result<Array2<f64>> {
        let sun = Vector2::new(sun.x, sun.z);
        self.radiance_in(|_, normal| normal.dot(&sun).max(0.0), albedos)
    }

    /// The same for a lamp in that direction, at `distance` from the `middle` of the sheet (across the crease
    /// and out of it), where it is as bright as that sun. Light does not vary along the crease; it is that at
    /// the middle.
    ///
    /// # Errors
    /// As [`BentExchange::facet_radiance`].
    pub fn radiance_by_lamp(
        &self,
        towards: Vector3<f64>,
        (middle, distance): (Vector2<f64>, f64),
        albedos: &[f64],
    ) -> Result<Array2<f64>> {
        let along = distance * towards.y;
        let lamp = middle + distance * Vector2::new(towards.x, towards.z);
        let lit = |place: &Vector2<f64>, normal: &Vector2<f64>| {
            let way = lamp - place;
            let reach = way.norm_squared() + along * along;
            normal.dot(&way).max(0.0) * distance * distance / reach.powf(1.5)
        };
        self.radiance_in(lit, albedos)
    }

    /// Radiance of the facets if direct light on the sheet depends on position and normal.
    fn radiance_in(
        &self,
        lit: impl Fn(&Vector2<f64>, &Vector2<f64>) -> f64,
        albedos: &[f64],
    ) -> Result<Array2<f64>> {
        let patches = self.strips.iter().flat_map(|strip| [lit(&strip.at(0.5), &strip.normal); HALF]);
        let power =
            DMatrix::from_iterator(self.areas.len(), 1, patches.zip(&self.areas).map(|(e, area)| e * area));
        let direct: Vec<f64> = self
            .rows
            .iter()
            .map(|row| row.iter().map(|seen| seen.share * lit(&seen.place, &seen.normal)).sum())
            .collect();
        let cols = self.fold.facets().cols;
        let half = cols.div_ceil(2);
        let mut radiance = Array2::zeros((self.rows.len() * cols, albedos.len()));
        for (node, albedo) in albedos.iter().enumerate() {
            let gathered = self.gathered(Symmetry::Even, &power, *albedo)?;
            for (row, direct) in direct.iter().enumerate() {
                for col in 0..cols {
                    let facet = row * half + col.min(cols - 1 - col);
                    radiance[(row * cols + col, node)] = albedo * (direct + gathered[facet]);
                }
            }
        }
        Ok(radiance)
    }

    /// The fold whose panels and facets it has; its angle is not used.
    pub(crate) fn fold(&self) -> &Fold {
        &self.fold
    }

    /// Angle between the panels' chords, degrees.
    pub(crate) fn angle_deg(&self) -> f64 {
        self.angle_deg
    }

    /// The middle line of each strip and its normal, across the crease and out of the fold.
    pub(crate) fn middles(&self) -> impl Iterator<Item = [Vector2<f64>; 2]> + '_ {
        self.strips.iter().map(|strip| [strip.at(0.5), strip.normal])
    }

    /// Positions along the crease of the middles of a strip's patches in one half.
    pub(crate) fn columns(&self) -> [f64; HALF] {
        std::array::from_fn(|c| ((c as f64 + 0.5) / COLUMNS as f64 - 0.5) * self.fold.width())
    }

    /// The points of the sheet visible in each row of facets of both panels.
    pub(crate) fn rows(&self) -> &[Vec<Seen>] {
        &self.rows
    }

    /// Light of the sheet that reaches the points of a row in the middle of the crease, patch by patch.
    pub(crate) fn incoming(&self, row: usize) -> Vec<Incoming<'_>> {
        let edge = |n: usize| (n as f64 / COLUMNS as f64 - 0.5) * self.fold.width();
        let mut all = Vec::new();
        for at in &self.rows[row] {
            for strip in &self.strips {
                let Some(seen) = SeenStrip::new(at.place, at.normal, strip) else { continue };
                let up_to = |y: f64| y.signum() * seen.up_to(y.abs());
                let way = strip.at(0.5) - at.place;
                all.extend((0..COLUMNS).map(|column| {
                    let [low, high] = [edge(column), edge(column + 1)];
                    Incoming {
                        at,
                        towards: Vector3::new(way.x, 0.5 * (low + high), way.y).normalize(),
                        normal: strip.normal,
                        form_factor: up_to(high) - up_to(low),
                    }
                }));
            }
        }
        all
    }

    /// Number of patches in one half.
    pub(crate) fn patches(&self) -> usize {
        self.areas.len()
    }

    /// Irradiance of the facets of one half (panel, row, column) by the sheet, given the external irradiances
    /// of the patches, strip by strip: a column per light.
    pub(crate) fn bounced(
        &self,
        symmetry: Symmetry,
        irradiances: &DMatrix<f64>,
        albedo: f64,
    ) -> Result<DMatrix<f64>> {
        let power = DMatrix::from_fn(irradiances.nrows(), irradiances.ncols(), |patch, light| {
            irradiances[(patch, light)] * self.areas[patch]
        });
        self.gathered(symmetry, &power, albedo)
    }

    /// The same, given the external light that every patch receives, times its area.
    fn gathered(&self, symmetry: Symmetry, power: &DMatrix<f64>, albedo: f64) -> Result<DMatrix<f64>> {
        let mut system = -&self.exchange[symmetry as usize];
        for (n, area) in self.areas.iter().enumerate() {
            system[(n, n)] += area / albedo;
        }
        let left = cholesky(system).map(|factors| factors.solve(power));
        let left =
            left.ok_or_else(|| Error::Numeric(format!("no light escapes a bent sheet of albedo {albedo}")))?;
        Ok(&self.gather[symmetry as usize] * left)
    }
}

/// Width of a column together with its mirror image.
fn column_width(column: usize, fold: &Fold) -> f64 {
    let alike = if 2 * column + 1 == COLUMNS { 1.0 } else { 2.0 };
    alike * fold.width() / COLUMNS as f64
}

/// Area times form factor of all pairs of patches, computed from the shallower of two strips.
fn exchange(strips: &[Strip], fold: &Fold) -> [DMatrix<f64>; 2] {
    let [across, along] = POINTS.map(Rule::gauss_legendre);
    let width = fold.width() / COLUMNS as f64;
    let column = |c: usize| along.on(0.0, width).map(move |(y, _)| c as f64 * width - 0.5 * fold.width() + y);
    let places: Vec<f64> = (0..HALF).flat_map(column).collect();
    let columns = Columns::seen_from(&places, COLUMNS, fold.width());
    let mut exchange = [0, 1].map(|_| DMatrix::zeros(strips.len() * HALF, strips.len() * HALF));
    let mut shares = [0, 1].map(|_| vec![0.0; places.len() * HALF]);
    for (i, one) in strips.iter().enumerate() {
        for (j, other) in strips.iter().enumerate().skip(i + 1) {
            let ((i, from), (j, to)) =
                if one.depth() <= other.depth() { ((i, one), (j, other)) } else { ((j, other), (i, one)) };
            shares.iter_mut().for_each(|shares| shares.fill(0.0));
            for (share, weight) in across.on(0.0, 1.0) {
                if let Some(seen) = SeenStrip::new(from.at(share), from.normal, to) {
                    columns.add_shares(&seen, weight, &mut shares);
                }
            }
            for (exchange, shares) in exchange.iter_mut().zip(&shares) {
                for (place, shares) in shares.chunks_exact(HALF).enumerate() {
                    let (c, weight) = (place / POINTS[1], 0.5 * along.weights[place % POINTS[1]]);
                    for (d, share) in shares.iter().enumerate() {
                        let flux = weight * share * from.depth() * column_width(c, fold);
                        exchange[(i * HALF + c, j * HALF + d)] += flux;
                        exchange[(j * HALF + d, i * HALF + c)] += flux;
                    }
                }
            }
        }
    }
    exchange
}

/// Form factor from each facet of one half to each patch; samples come with their panels.
fn gather(strips: &[Strip], samples: &[(usize, Sample)], fold: &Fold) -> [DMatrix<f64>; 2] {
    let (rows, cols) = (fold.facets().rows, fold.facets().cols);
    let half = cols.div_ceil(2);
    let places: Vec<f64> = (0..half).map(|c| ((c as f64 + 0.5) / cols as f64 - 0.5) * fold.width()).collect();
    let columns = Columns::seen_from(&places, COLUMNS, fold.width());
    let mut gather = [0, 1].map(|_| DMatrix::zeros(2 * rows * half, strips.len() * HALF));
    let mut shares = [0, 1].map(|_| vec![0.0; half * HALF]);
    for (panel, sample) in samples {
        let from = &strips[sample.strip];
        for (j, to) in strips.iter().enumerate() {
            let Some(seen) = SeenStrip::new(from.at(sample.share), from.normal, to) else { continue };
            shares.iter_mut().for_each(|shares| shares.fill(0.0));
            columns.add_shares(&seen, sample.weight, &mut shares);
            for (gather, shares) in gather.iter_mut().zip(&shares) {
                for (n, share) in shares.iter().enumerate() {
                    gather[((panel * rows + sample.row) * half + n / HALF, j * HALF + n % HALF)] += share;
                }
            }
        }
    }
    gather
}

/// The points visible in the rows of both panels.
fn rows(strips: &[Strip], samples: &[Vec<Sample>; 2], rows: usize) -> Vec<Vec<Seen>> {
    let mut shown = vec![Vec::new(); 2 * rows];
    for (p, samples) in samples.iter().enumerate() {
        for Sample { row, weight, strip, share } in samples {
            let strip = &strips[*strip];
            let seen = Seen { share: *weight, place: strip.at(*share), normal: strip.bent_at(*share) };
            shown[p * rows + row].push(seen);
        }
    }
    shown
}

//! The pixels along a piece of a side, and how well an edge at each of several distances explains them.
//!
//! The model is two planes of light with the edge between them, mixed by area in the pixels that the edge
//! crosses: a sheet may be as bright as the table, but of another colour. A change that smooth light explains
//! as well is no edge. Nor may the edge be the end of a sheet's shadow: up to its edge the sheet must
//! continue as it is further inwards.

use nalgebra::{SVector, Vector2, Vector3};

use super::fit::{COEFFICIENTS, Fit, Sums};

/// Distances at which an edge is tried.
pub(super) const PLACES: usize = 25;
/// Extra spread of an edge by the lens to either side, px, in addition to that of a pixel.
const BLURS_PX: [f64; BLURS] = [0.0, 2.0, 4.0, 9.0];
pub(super) const BLURS: usize = 4;
/// Clearance between the sheet pixels examined and an edge, for each blur, px, in addition to
/// [`CLEARANCE_PX`].
const CLEAR_PX: [f64; BLURS] = [0.0, 0.0, 3.0, 6.75];
/// Residuals below this fraction of the light count as zero.
const EXACT: f64 = 1e-3;
/// Largest variation of a sheet's light up to its edge, relative to that further inwards.
const UNEVEN: f64 = 2.0;
/// Pixels nearer to an edge than this may see beyond it, px.
const CLEARANCE_PX: f64 = 2.0;

/// The pixels of a piece of a side.
pub(super) struct Piece {
    /// Its position along the side, from 0 to 1.
    pub place: f64,
    /// Distance from the side, px, and light, sorted by distance.
    pixels: Vec<(f64, Vector3<f64>)>,
    /// Sums over the first k of them, for k from none to all.
    sums: Vec<Sums>,
    /// Independent channels: the three of a grey picture count as one.
    channels: usize,
}

/// Distance of a tried place from the side.
pub(super) fn offset(place: usize, reach_px: f64) -> f64 {
    reach_px * (2.0 * place as f64 / (PLACES - 1) as f64 - 1.0)
}

impl Piece {
    /// Some pixels, each with its distance from the side and its light.
    pub fn new(place: f64, mut pixels: Vec<(f64, Vector3<f64>)>) -> Self {
        let is_grey = pixels.iter().all(|(_, light)| light.max() <= light.min());
        pixels.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut sums = vec![Sums::default()];
        for (distance, light) in &pixels {
            sums.push(sums[sums.len() - 1].with(*distance, light));
        }
        Self { place, pixels, sums, channels: if is_grey { 1 } else { 3 } }
    }

    /// Gain in log likelihood of an edge at each place over none; pixels are at most `width_px` from the
    /// side.
    pub fn gains(&self, across: &Vector2<f64>, blur: usize, reach_px: f64, width_px: f64) -> [f64; PLACES] {
        let (count, exact) = (self.pixels.len() as f64, self.exact());
        let smooth = self.smooth_residual(width_px);
        let blur_px = BLURS_PX[blur];
        let gain = |place| {
            let edge = self.edge_residual(offset(place, reach_px), across, blur_px)?;
            let spare = count - COEFFICIENTS as f64 - 1.0;
            Some(0.5 * spare * self.sum_of_ln(smooth? + exact, edge + exact))
        };
        std::array::from_fn(|place| gain(place).filter(|gain| gain.is_finite()).unwrap_or(0.0))
    }

    /// Loss in log likelihood of the light inside an edge at each place, compared with a sheet that continues
    /// up to there.
    pub fn breaks(&self, inwards: f64, reach_px: f64, blur: usize) -> [f64; PLACES] {
        let within = |least: f64| {
            let sums = self.sums_beyond(least, inwards);
            Some((sums.residual()? / sums.count + self.exact() / sums.count, sums.count))
        };
        let Some((further, _)) = within(reach_px) else { return [0.0; PLACES] };
        let usual = further * UNEVEN * UNEVEN;
        std::array::from_fn(|place| {
            within(inwards * offset(place, reach_px) + CLEARANCE_PX + CLEAR_PX[blur])
                .map_or(0.0, |(variance, count)| 0.5 * count * self.sum_of_ln(variance.sup(&usual), usual))
        })
    }

    /// Sums over the pixels whose distance times `inwards`, 1 or -1, exceeds `least`.
    fn sums_beyond(&self, least: f64, inwards: f64) -> Sums {
        if inwards > 0.0 {
            let first = self.pixels.partition_point(|(distance, _)| *distance <= least);
            self.sums[self.pixels.len()].without(&self.sums[first])
        } else {
            self.sums[self.pixels.partition_point(|(distance, _)| -distance > least)]
        }
    }

    /// Residual of a cubic polynomial across the piece.
    fn smooth_residual(&self, width_px: f64) -> Option<Vector3<f64>> {
        let mut fit = Fit::default();
        for (distance, light) in &self.pixels {
            let d = distance / width_px;
            fit.add(&SVector::from([1.0, d, d * d, d * d * d]), light);
        }
        self.left_by(fit)
    }

    /// Residual of two planes of light that meet at this distance from the side. Pixels that the edge does
    /// not cross enter through precomputed sums.
    fn edge_residual(&self, edge_px: f64, across: &Vector2<f64>, blur_px: f64) -> Option<Vector3<f64>> {
        let reach = edge_reach(across, blur_px);
        let first = self.pixels.partition_point(|(distance, _)| distance - edge_px <= -reach);
        let end = self.pixels.partition_point(|(distance, _)| distance - edge_px < reach);
        let mut fit = Fit::of_sides(
            &self.sums[first].seen_from(edge_px),
            &self.sums[self.pixels.len()].without(&self.sums[end]).seen_from(edge_px),
        );
        fit.add_mixed(self.pixels[first..end].iter().map(|(distance, light)| {
            let z = distance - edge_px;
            (z, share_beyond(z, across, blur_px), light)
        }));
        self.left_by(fit)
    }

    /// Sum of squared residuals of a fit in each channel; none if the fit is not unique or pixels are too
    /// few.
    fn left_by(&self, fit: Fit) -> Option<Vector3<f64>> {
        let explained = fit.normal.cholesky()?.solve(&fit.right).component_mul(&fit.right).row_sum_tr();
        let squares = self.sums[self.pixels.len()].light_squares;
        (self.pixels.len() > 2 * COEFFICIENTS).then_some((squares - explained).sup(&Vector3::zeros()))
    }

    /// Sums of squares that count as zero.
    fn exact(&self) -> Vector3<f64> {
        let brightest = self.pixels.iter().fold(Vector3::zeros(), |most, (_, light)| light.abs().sup(&most));
        brightest.map(|light: f64| self.pixels.len() as f64 * (EXACT * light).powi(2))
    }

    /// Sum over the channels of the logarithms of ratios.
    fn sum_of_ln(&self, over: Vector3<f64>, under: Vector3<f64>) -> f64 {
        over.component_div(&under).iter().take(self.channels).map(|ratio| ratio.ln()).sum()
    }
}

/// Extents across a line with this unit normal of a pixel widened by `blur_px`, the longer first.
fn spread(normal: &Vector2<f64>, blur_px: f64) -> [f64; 2] {
    [normal.amax() + blur_px, normal.amin().max(1e-3) + blur_px]
}

/// The distance from a line beyond which a pixel does not see across it.
fn edge_reach(normal: &Vector2<f64>, blur_px: f64) -> f64 {
    spread(normal, blur_px).iter().sum::<f64>() / 2.0
}

/// Fraction of a pixel, widened by the blur of `blur_px`, that lies beyond a line with this unit normal when
/// its centre is `z` beyond it.
fn share_beyond(z: f64, normal: &Vector2<f64>, blur_px: f64) -> f64 {
    let [wide, narrow] = spread(normal, blur_px);
    let ramp = |x: f64| x.max(0.0).powi(2) / 2.0;
    let (outer, inner) = ((wide + narrow) / 2.0, (wide - narrow) / 2.0);
    match z {
        z if z <= -outer => 0.0,
        z if z >= outer => 1.0,
        z => (ramp(z + outer) - ramp(z + inner) - ramp(z - inner)) / (wide * narrow),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against the mean over 400 x 400 points of the pixel.
        #[test]
        fn the_share_of_a_pixel_is_its_area(z in -1.0..1.0, angle in 0.0..6.3) {
            let normal = Vector2::new(f64::cos(angle), f64::sin(angle));
            let place = |k: usize| (k as f64 + 0.5) / 400.0 - 0.5;
            let beyond = |k: &usize| z + normal.x * place(k % 400) + normal.y * place(k / 400) > 0.0;
            let share = (0..160_000).filter(beyond).count() as f64 / 160_000.0;
            prop_assert!((share_beyond(z, &normal, 0.0) - share).abs() < 3e-3, "{share}");
        }
    }
}

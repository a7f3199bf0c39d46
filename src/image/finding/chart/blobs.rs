//! Blobs of uniform light, among which are the patches of a chart.

use super::super::outline::Place;
use super::super::plane::Plane;

/// Limits of the change of light per pixel inside a blob, in square roots of light, where noise is uniform.
/// Dark patches on black need the lowest, noise the highest.
const EVEN: [f32; 4] = [0.012, 0.025, 0.05, 0.09];
/// Smallest patch, px, and largest as a fraction of the picture.
const LEAST_PX: usize = 16;
const LARGEST_PART: f64 = 1.0 / 40.0;
/// Limits of a blob's area over twelve times the root of the determinant of its pixels' covariance: 1 for a
/// parallelogram, slightly more with rounded corners, less with holes and bays.
const FILLED: [f64; 2] = [0.72, 1.12];
/// Largest ratio of a patch's length to its width.
const SLIMMEST: f64 = 6.0;
/// Blobs whose centres are nearer than this, in sides of the larger one, are duplicates.
const SAME: f64 = 0.35;
/// Most blobs kept per picture, the largest.
const MOST: usize = 500;

/// A blob of uniform light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blob {
    pub centre: Place,
    /// Side of a square of the same area, px.
    pub side_px: f64,
    /// Its longer side, px.
    pub long_px: f64,
}

/// The blobs of a picture with these changes of light from pixel to pixel.
pub(super) fn blobs(changes: &Plane) -> Vec<Blob> {
    let mut all: Vec<Blob> = EVEN.iter().flat_map(|even| below(changes, *even)).collect();
    all.sort_by(|a, b| b.side_px.total_cmp(&a.side_px));
    let mut kept: Vec<Blob> = Vec::new();
    for blob in all {
        let is_new = |other: &Blob| (other.centre - blob.centre).norm() > SAME * other.side_px;
        if kept.len() < MOST && kept.iter().all(is_new) {
            kept.push(blob);
        }
    }
    kept
}

/// Connected pixels below a bound.
fn below(changes: &Plane, bound: f32) -> Vec<Blob> {
    let (width, count) = (changes.width, changes.values.len());
    let mut free: Vec<bool> = changes.values.iter().map(|change| *change < bound).collect();
    let mut blobs = Vec::new();
    let mut waiting = Vec::new();
    for first in 0..count {
        if !std::mem::take(&mut free[first]) {
            continue;
        }
        let mut sums = Sums::default();
        waiting.push(first);
        while let Some(k) = waiting.pop() {
            let x = k % width;
            sums.add(x as f64 + 0.5, (k / width) as f64 + 0.5);
            let neighbours = [
                (x > 0).then(|| k - 1),
                (x + 1 < width).then_some(k + 1),
                k.checked_sub(width),
                Some(k + width).filter(|k| *k < count),
            ];
            for k in neighbours.into_iter().flatten() {
                if std::mem::take(&mut free[k]) {
                    waiting.push(k);
                }
            }
        }
        blobs.extend(sums.blob(count));
    }
    blobs
}

/// Sums over the pixels of a blob.
#[derive(Default)]
struct Sums {
    pixels: usize,
    place: Place,
    squares: [f64; 3],
}

impl Sums {
    fn add(&mut self, x: f64, y: f64) {
        self.pixels += 1;
        self.place += Place::new(x, y);
        self.squares = [self.squares[0] + x * x, self.squares[1] + y * y, self.squares[2] + x * y];
    }

    /// The blob, if it can be a patch in a picture of this many pixels.
    fn blob(&self, of_picture: usize) -> Option<Blob> {
        let pixels = self.pixels as f64;
        if self.pixels < LEAST_PX || pixels > LARGEST_PART * of_picture as f64 {
            return None;
        }
        let centre = self.place / pixels;
        let [xx, yy, xy] = self.squares.map(|sum| sum / pixels);
        // a pixel is a square, whose own variance is 1/12
        let (xx, yy) = (xx - centre.x * centre.x + 1.0 / 12.0, yy - centre.y * centre.y + 1.0 / 12.0);
        let xy = xy - centre.x * centre.y;
        let (mean, half) = ((xx + yy) / 2.0, ((xx - yy) / 2.0).hypot(xy));
        let determinant = mean * mean - half * half;
        let filled = pixels / (12.0 * determinant.max(0.0).sqrt());
        let is_slim = mean + half > SLIMMEST * SLIMMEST * (mean - half);
        (!is_slim && (FILLED[0]..FILLED[1]).contains(&filled)).then(|| Blob {
            centre,
            side_px: pixels.sqrt(),
            long_px: (12.0 * (mean + half)).sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture that is uniform inside a shape and nowhere else.
    fn found(inside: impl Fn(f64, f64) -> bool) -> Vec<Blob> {
        let is_even = |k: usize| inside((k % 200) as f64 + 0.5, (k / 200) as f64 + 0.5);
        let values = (0..200 * 150).map(|k| if is_even(k) { 0.0 } else { 1.0 }).collect();
        blobs(&Plane { width: 200, values })
    }

    #[test]
    fn a_leaning_parallelogram_is_a_blob_at_its_centre() {
        let [blob] = found(|x, y| (y - 60.0).abs() < 10.0 && (x - 90.0 - 0.5 * (y - 60.0)).abs() < 12.0)[..]
        else {
            panic!("one blob")
        };
        assert!((blob.centre - Place::new(90.0, 60.0)).norm() < 0.3, "{blob:?}");
        assert!((blob.side_px - 480_f64.sqrt()).abs() < 1.0, "{blob:?}");
    }

    #[test]
    fn what_is_bent_slim_or_large_is_none() {
        assert!(
            found(|x, y| (40.0..80.0).contains(&x) && (40.0..80.0).contains(&y) && (x < 50.0 || y < 50.0))
                .is_empty()
        );
        assert!(found(|x, y| (40.0..90.0).contains(&x) && (40.0..46.0).contains(&y)).is_empty());
        assert!(found(|x, y| (40.0..90.0).contains(&x) && (40.0..90.0).contains(&y)).is_empty());
    }
}

//! A photograph of a fold: the light on its panels, seen by a pinhole camera.

use std::path::Path;

use nalgebra::{DMatrix, Point3, Vector3};

use crate::colorimetry::encode_srgb;
use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};
use crate::image::{Homography, Point, write_linear, write_srgb_png};

/// Cells of a panel, away from the crease and along it, on which the light is computed.
const CELLS: FacetGrid = FacetGrid { rows: 160, cols: 96 };
/// Samples of a pixel in each direction: its value is the mean over its area.
const SUBPIXELS: usize = 4;
/// The camera stands this many times the fold's size away.
const DISTANCE: f64 = 7.0;
/// Share of the picture that the fold fills.
const FILL: f64 = 0.84;

/// Where a camera stands and where it sees the panels.
#[derive(Clone, Debug)]
pub struct View {
    width: usize,
    height: usize,
    panels: [Homography; 2],
}

impl View {
    /// A view into the fold from a little off its bisecting plane, the crease upright, panel 0 on the left.
    ///
    /// # Errors
    /// [`Error::Usage`] for a picture without pixels or of more than 2²⁸, or a fold too narrow to look into.
    ///
    /// # Example
    /// ```
    /// use vfold::forward::render::View;
    /// use vfold::geometry::{FacetGrid, Fold};
    /// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
    /// let [panel0, panel1] = View::of(&fold, 640, 480)?.corners();
    /// assert_eq!(panel0[0], panel1[0]); // both panels begin at one end of the crease
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn of(fold: &Fold, width: usize, height: usize) -> Result<Self> {
        if width == 0 || height == 0 || width.saturating_mul(height) > 1 << 28 {
            return Err(Error::usage(
                "--render-size",
                format!("{width}x{height} is no picture"),
                "give 640x480 or so",
            ));
        }
        let world = panel_corners(fold);
        let pinhole = Pinhole::facing(fold, &world);
        let flat = world.map(|corners| corners.map(|corner| pinhole.project(corner)));
        let placed = centred(flat, width as f64, height as f64);
        let [panel0, panel1] = placed.map(Homography::from_unit_square);
        Ok(Self { width, height, panels: [panel0?, panel1?] })
    }

    /// Corners of both panels in the picture: crease end 0, crease end 1, outer end 1, outer end 0.
    #[must_use]
    pub fn corners(&self) -> [[Point; 4]; 2] {
        self.panels.each_ref().map(|panel| panel.corners().to_owned())
    }

    /// Cells of a panel whose light a picture needs.
    #[must_use]
    pub fn grid(&self) -> FacetGrid {
        CELLS
    }
}

/// Linear camera RGB, row by row from the top.
#[derive(Clone, Debug)]
pub struct Picture {
    width: usize,
    height: usize,
    rgb: Vec<f64>,
}

impl Picture {
    /// Takes a picture of the light on the cells of both panels (cell by channel, as [`View::grid`] orders them), before
    /// a black background; every pixel is the mean over its area.
    #[must_use]
    pub fn take(view: &View, light: &DMatrix<f64>) -> Self {
        let mut rgb = vec![0.0; view.width * view.height * 3];
        for (n, pixel) in rgb.chunks_exact_mut(3).enumerate() {
            let (x, y) = ((n % view.width) as f64, (n / view.width) as f64);
            for sub in 0..SUBPIXELS * SUBPIXELS {
                let offset = |k: usize| (k as f64 + 0.5) / SUBPIXELS as f64;
                let at = Point { x: x + offset(sub % SUBPIXELS), y: y + offset(sub / SUBPIXELS) };
                add_light(view, light, at, pixel);
            }
            pixel.iter_mut().for_each(|value| *value /= (SUBPIXELS * SUBPIXELS) as f64);
        }
        Self { width: view.width, height: view.height, rgb }
    }

    /// The pixels' values, three a pixel.
    pub fn pixels_mut(&mut self) -> &mut [f64] {
        &mut self.rgb
    }

    /// Writes the picture as it is, linear: OpenEXR or 16-bit TIFF.
    ///
    /// # Errors
    /// As [`write_linear`].
    pub fn save(&self, path: &Path) -> Result<()> {
        write_linear(path, self.width, self.height, &self.rgb)
    }

    /// Writes linear sRGB for a screen: 8-bit PNG, the brightest pixel white.
    ///
    /// # Errors
    /// As [`write_srgb_png`].
    pub fn save_for_screen(&self, path: &Path) -> Result<()> {
        let brightest = self.rgb.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let encoded: Vec<f64> = self.rgb.iter().map(|value| encode_srgb(value / brightest)).collect();
        write_srgb_png(path, self.width, self.height, &encoded)
    }
}

/// Adds what a point of the picture shows, of up to three channels.
fn add_light(view: &View, light: &DMatrix<f64>, at: Point, pixel: &mut [f64]) {
    for (panel, homography) in view.panels.iter().enumerate() {
        let (u, v) = homography.to_panel(at);
        if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) {
            for (channel, value) in pixel.iter_mut().enumerate().take(light.ncols()) {
                *value += interpolate(light, panel, channel, u, v);
            }
            return;
        }
    }
}

/// Bilinear between the centres of the cells.
fn interpolate(light: &DMatrix<f64>, panel: usize, channel: usize, u: f64, v: f64) -> f64 {
    let along = |position: f64, cells: usize| {
        let position = (position * cells as f64 - 0.5).clamp(0.0, (cells - 1) as f64);
        let first = (position as usize).min(cells - 2);
        (first, position - first as f64)
    };
    let ((col, right), (row, out)) = (along(u, CELLS.cols), along(v, CELLS.rows));
    let cell = |row: usize, col: usize| light[((panel * CELLS.rows + row) * CELLS.cols + col, channel)];
    let across = |row: usize| (1.0 - right) * cell(row, col) + right * cell(row, col + 1);
    (1.0 - out) * across(row) + out * across(row + 1)
}

/// Corners of both panels in space: the crease along y, the bisecting plane x = 0, the opening towards +z.
fn panel_corners(fold: &Fold) -> [[Point3<f64>; 4]; 2] {
    let half = fold.angle_rad() / 2.0;
    let (half_width, depths) = (fold.width() / 2.0, fold.depths());
    [(-1.0, depths[0]), (1.0, depths[1])].map(|(side, depth)| {
        let outer = |y: f64| Point3::new(side * depth * half.sin(), y, depth * half.cos());
        [
            Point3::new(0.0, -half_width, 0.0),
            Point3::new(0.0, half_width, 0.0),
            outer(half_width),
            outer(-half_width),
        ]
    })
}

/// A camera without lens errors.
struct Pinhole {
    position: Point3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
    forward: Vector3<f64>,
}

impl Pinhole {
    /// Looks at the middle of the fold from within its opening, so that neither panel hides the other.
    fn facing(fold: &Fold, world: &[[Point3<f64>; 4]; 2]) -> Self {
        let aside = (fold.angle_rad() / 6.0).min(0.1);
        let direction = Vector3::new(aside.sin(), -0.12, aside.cos()).normalize();
        let middle = Point3::new(0.0, 0.0, world[0][2].z / 2.0);
        let position =
            middle + DISTANCE * fold.width().hypot(fold.depths()[0].max(fold.depths()[1])) * direction;
        let forward = -direction;
        // Upright, but rolled by two degrees: no pixel row runs along an edge.
        let right = forward.cross(&Vector3::new(0.035, 1.0, 0.0)).normalize();
        Self { position, right, up: right.cross(&forward), forward }
    }

    fn project(&self, point: Point3<f64>) -> Point {
        let from = point - self.position;
        let depth = from.dot(&self.forward);
        Point { x: from.dot(&self.right) / depth, y: -from.dot(&self.up) / depth }
    }
}

/// Scales and moves the panels' corners so that they fill the picture.
fn centred(panels: [[Point; 4]; 2], width: f64, height: f64) -> [[Point; 4]; 2] {
    let range = |pick: fn(&Point) -> f64| {
        let values = panels.iter().flatten().map(pick);
        values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    };
    let ((left, right), (top, bottom)) = (range(|p| p.x), range(|p| p.y));
    let scale = FILL * (width / (right - left)).min(height / (bottom - top));
    let place =
        |value: f64, low: f64, high: f64, size: f64| 0.5 * size + scale * (value - 0.5 * (low + high));
    panels.map(|corners| {
        corners.map(|p| Point { x: place(p.x, left, right, width), y: place(p.y, top, bottom, height) })
    })
}

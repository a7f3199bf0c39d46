//! The angle of a fold from its six corners in a photograph.
//!
//! Six corners are twelve numbers. Position and orientation of the fold take six, the angle is the seventh;
//! the focal length, the lens distortion and the form of the panels are fitted with it, under a
//! [prior](prior) on each. Panels may have one of several usual forms: each is tried, and weighted by how
//! well it explains the corners.
//!
//! The camera is a pinhole behind a lens as in [`Lens`], with its axis through the middle of the picture: a
//! picture cropped on one side biases the result slightly.

mod agreement;
mod fit;
mod mixture;
mod outline;
mod prior;
mod view;

pub use agreement::{OtherFold, StatedFold};

use rayon::prelude::*;

use super::placing::{LensEstimate, Point};
use fit::Sighting;
use mixture::{Explanation, Mean, mean};
use outline::Outline;
use prior::{FILM_DIAGONAL_MM, FOCAL_MM, Hypothesis, KnownBefore, hypotheses};

/// The angle between the panels of a fold, determined from its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldAngle {
    /// Degrees, from 0 to 180.
    pub angle_deg: f64,
    /// Its standard deviation, degrees.
    pub angle_sd_deg: f64,
    /// Depth of panels 0 and 1, away from the crease, relative to their width along it.
    pub depths: [f64; 2],
}

/// Origin of the corners, which determines their accuracy relative to a panel's side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CornersBy {
    /// [`find_fold`](crate::image::find_fold) found them.
    Finding,
    /// A person marked them.
    Hand,
}

/// Knowledge of a fold and the camera in addition to the corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldSeen {
    /// Width and height of the picture, px.
    pub size: [usize; 2],
    /// Origin of the corners.
    pub corners_by: CornersBy,
    /// The lens, as known.
    pub lens: LensEstimate,
    /// Focal length of equal angle of view on film of 36 x 24 mm, mm, if the camera recorded it.
    pub focal_35mm: Option<f64>,
    /// Depths of both panels relative to their width, if stated.
    pub depths: Option<[f64; 2]>,
}

/// Standard deviation of a detected corner, relative to a panel's side.
const DETECTED: f64 = 0.002;
/// The same for a corner marked by a person.
const MARKED: f64 = 0.008;

impl FoldSeen {
    /// The angle of the fold whose panels have these corners.
    ///
    /// # Arguments
    /// - `panels`: corners of panels 0 and 1, px, in the order of
    ///   [`PANEL_CORNERS`](crate::image::PANEL_CORNERS); if they differ in an end of the crease, the midpoint
    ///   is used.
    ///
    /// # Returns
    /// None if no fold that opens towards the camera has such corners.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::image::{CornersBy, FoldSeen, LensEstimate, Point};
    /// let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// // from (0.5, 1, 6) along -z, the focal length 900 px
    /// let see = |x: f64, y: f64, z: f64| {
    ///     Point::new(320.0 + 900.0 * (x - 0.5) / (6.0 - z), 240.0 - 900.0 * (y - 1.0) / (6.0 - z))
    /// };
    /// let panels = fold.panels().map(|panel| panel.corners.map(|p| see(p.x, p.y, p.z)));
    /// let seen = FoldSeen {
    ///     size: [640, 480],
    ///     corners_by: CornersBy::Finding,
    ///     lens: LensEstimate::UNKNOWN,
    ///     focal_35mm: None,
    ///     depths: Some([1.0; 2]),
    /// };
    /// let found = seen.angle(&panels).unwrap();
    /// assert!((found.angle_deg - 50.0).abs() < 0.1 && found.angle_sd_deg < 2.0);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn angle(&self, panels: &[[Point; 4]; 2]) -> Option<FoldAngle> {
        let outline = self.outline(panels)?;
        let explained = self.explained(&outline, hypotheses(&self.known_before(&outline)));
        let Mean { angle, sd, depths } = mean(explained)?;
        Some(FoldAngle {
            angle_deg: angle.to_degrees(),
            angle_sd_deg: sd.to_degrees(),
            depths: outline.in_order(depths),
        })
    }

    fn outline(&self, panels: &[[Point; 4]; 2]) -> Option<Outline> {
        Outline::of(panels, &self.lens.lens, self.size.map(|px| px as f64), self.unit_px())
    }

    fn known_before(&self, outline: &Outline) -> KnownBefore {
        let diagonal = (self.size[0] as f64).hypot(self.size[1] as f64) / self.unit_px();
        KnownBefore {
            k1_sd: self.lens.k1_sd,
            focal: self.focal_35mm.map(|focal_mm| focal_mm / FILM_DIAGONAL_MM * diagonal),
            usual_focal: FOCAL_MM / FILM_DIAGONAL_MM * diagonal,
            depths: self.depths.map(|depths| outline.in_order(depths)),
        }
    }

    /// All explanations of the corners under some hypotheses.
    fn explained(&self, outline: &Outline, hypotheses: Vec<Hypothesis>) -> Vec<Explanation> {
        let corner = match self.corners_by {
            CornersBy::Finding => DETECTED,
            CornersBy::Hand => MARKED,
        };
        let sighting = Sighting { corners: outline.corners, sd: corner * outline.side };
        let explained = hypotheses.par_iter().flat_map_iter(|hypothesis| {
            let fitted = sighting.fit(hypothesis).into_iter();
            fitted.map(|fitted| Explanation { form: hypothesis.form, fitted })
        });
        explained.collect()
    }

    /// Half the picture's shorter side, px.
    fn unit_px(&self) -> f64 {
        self.size[0].min(self.size[1]) as f64 / 2.0
    }
}

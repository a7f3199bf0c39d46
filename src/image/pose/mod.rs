//! The angle of a fold from its six corners in a photograph.
//!
//! Six corners are twelve numbers. Where the fold is and how it is turned takes six, the angle is the
//! seventh; the focal length, the lens' distortion and the panels' form are known more or less, and what is
//! not is found along with the angle, each as far as it was [known](prior) before. Panels may be of several
//! usual forms: each is tried, and weighed by how well it explains the corners.
//!
//! The camera is a pinhole behind a lens as [`Lens`] has it, its axis through the middle of the picture: a
//! picture cut on one side is seen a little askew.

mod agreement;
mod fit;
mod mixture;
mod outline;
mod prior;
mod view;

pub use agreement::{OtherFold, StatedFold};

use super::placing::{Lens, Point};
use fit::Sighting;
use mixture::{Explanation, Mean, mean};
use outline::Outline;
use prior::{FILM_DIAGONAL_MM, FOCAL_MM, Hypothesis, KnownBefore, hypotheses};

/// The angle between the panels of a fold as its corners tell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldAngle {
    /// Degrees, from 0 to 180.
    pub angle_deg: f64,
    /// Its standard deviation, degrees.
    pub angle_sd_deg: f64,
    /// Depth of panels 0 and 1, away from the crease, over their width along it.
    pub depths: [f64; 2],
}

/// Whose corners they are, by how far they are off, as a part of a panel's side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CornersBy {
    /// [`find_fold`](crate::image::find_fold) found them.
    Finding,
    /// Somebody marked them.
    Hand,
}

/// What is known of a fold and the camera beside the corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldSeen {
    /// Width and height of the picture, px.
    pub size: [usize; 2],
    /// Who says where the corners are.
    pub corners_by: CornersBy,
    /// The lens, if it was stated.
    pub lens: Option<Lens>,
    /// Focal length that shows as much on film of 36 x 24 mm, mm, if the camera wrote it.
    pub focal_35mm: Option<f64>,
    /// Depths of both panels over their width, if they were stated.
    pub depths: Option<[f64; 2]>,
}

/// Standard deviation of a corner that was found, as a part of a panel's side.
const DETECTED: f64 = 0.002;
/// The same of one that somebody marked.
const MARKED: f64 = 0.008;

impl FoldSeen {
    /// The angle of the fold whose panels have these corners.
    ///
    /// # Arguments
    /// - `panels`: corners of panels 0 and 1, px, in the order of
    ///   [`PANEL_CORNERS`](crate::image::PANEL_CORNERS); where they differ in an end of the crease, that is
    ///   in the middle.
    ///
    /// # Returns
    /// None if no fold that is open to the camera looks so.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::image::{CornersBy, FoldSeen, Point};
    /// let fold = Fold::new(50.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?;
    /// // from (0.5, 1, 6) along -z, the focal length 900 px
    /// let see = |x: f64, y: f64, z: f64| {
    ///     Point::new(320.0 + 900.0 * (x - 0.5) / (6.0 - z), 240.0 - 900.0 * (y - 1.0) / (6.0 - z))
    /// };
    /// let panels = fold.panels().map(|panel| panel.corners.map(|p| see(p.x, p.y, p.z)));
    /// let seen = FoldSeen {
    ///     size: [640, 480],
    ///     corners_by: CornersBy::Finding,
    ///     lens: None,
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
        Outline::of(panels, self.lens, self.size.map(|px| px as f64), self.unit_px())
    }

    fn known_before(&self, outline: &Outline) -> KnownBefore {
        let diagonal = (self.size[0] as f64).hypot(self.size[1] as f64) / self.unit_px();
        KnownBefore {
            is_lens_known: self.lens.is_some(),
            focal: self.focal_35mm.map(|focal_mm| focal_mm / FILM_DIAGONAL_MM * diagonal),
            usual_focal: FOCAL_MM / FILM_DIAGONAL_MM * diagonal,
            depths: self.depths.map(|depths| outline.in_order(depths)),
        }
    }

    /// All that explains the corners under some hypotheses.
    fn explained(&self, outline: &Outline, hypotheses: Vec<Hypothesis>) -> Vec<Explanation> {
        let corner = match self.corners_by {
            CornersBy::Finding => DETECTED,
            CornersBy::Hand => MARKED,
        };
        let sighting = Sighting { corners: outline.corners, sd: corner * outline.side };
        let explained = hypotheses.iter().flat_map(|hypothesis| {
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

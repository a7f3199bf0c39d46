//! Checks whether corners agree with the stated fold: its angle, and the form of its panels.

use std::fmt;

use super::mixture::{Explanation, Mean, distinct, mean};
use super::prior::{as_stated, other_than_stated};
use super::{FoldAngle, FoldSeen};
use crate::image::placing::Point;

/// A fold as stated by the user.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedFold {
    /// Angle between the panels, degrees.
    pub angle_deg: f64,
    /// Its standard deviation, degrees.
    pub angle_sd_deg: f64,
    /// Depths of both panels over their width.
    pub depths: [f64; 2],
}

/// A fold that agrees better with the corners than the stated one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherFold {
    /// The most probable fold other than the stated one.
    pub fold: FoldAngle,
    /// Whether its panels differ from the stated ones, rather than its angle.
    pub has_other_panels: bool,
}

impl fmt::Display for OtherFold {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FoldAngle { angle_deg, angle_sd_deg, depths: [depth0, depth1] } = self.fold;
        if !self.has_other_panels {
            return write!(f, "those of a fold with an angle of {angle_deg:.0} ± {angle_sd_deg:.0}°");
        }
        write!(f, "those of panels {depth0:.2}")?;
        if (depth1 / depth0).ln().abs() > SAME_FORM {
            write!(f, " and {depth1:.2}")?;
        }
        write!(f, " times as deep as wide")
    }
}

/// The stated fold is rejected below this probability.
const LEAST: f64 = 0.05;
/// If the corners are this near to those of the stated fold, as a sum of squares in standard deviations, no
/// others are tried: even an exact explanation by them would not be as probable.
const NEAR: f64 = 6.0;
/// Depths whose logarithms differ by less than this have the same form.
const SAME_FORM: f64 = 1e-6;

impl FoldSeen {
    /// The fold that agrees better with these corners than the stated one, if the stated one is rejected.
    ///
    /// # Arguments
    /// - `panels`: as for [`FoldSeen::angle`].
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::image::{CornersBy, FoldSeen, LensEstimate, Point, StatedFold};
    /// let see = |x: f64, y: f64, z: f64| {
    ///     Point::new(320.0 + 900.0 * (x - 0.5) / (6.0 - z), 240.0 - 900.0 * (y - 1.0) / (6.0 - z))
    /// };
    /// let fold = Fold::new(45.0, 1.0, 2.0, FacetGrid { rows: 1, cols: 1 })?;
    /// let panels = fold.panels().map(|panel| panel.corners.map(|p| see(p.x, p.y, p.z)));
    /// let seen = FoldSeen {
    ///     size: [640, 480],
    ///     corners_by: CornersBy::Hand,
    ///     lens: LensEstimate::UNKNOWN,
    ///     focal_35mm: None,
    ///     depths: None,
    /// };
    /// let stated = StatedFold { angle_deg: 45.0, angle_sd_deg: 1.2, depths: [2.0; 2] };
    /// assert_eq!(seen.other_than(&panels, &stated), None);
    /// assert!(seen.other_than(&panels, &StatedFold { depths: [1.0; 2], ..stated }).is_some());
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn other_than(&self, panels: &[[Point; 4]; 2], stated: &StatedFold) -> Option<OtherFold> {
        let outline = self.outline(panels)?;
        let (known_before, depths) = (self.known_before(&outline), outline.in_order(stated.depths));
        let angle = (stated.angle_deg.to_radians(), stated.angle_sd_deg.to_radians());
        let stated = self.explained(&outline, as_stated(&known_before, depths, angle));
        if stated.iter().any(|one| one.fitted.squares < NEAR) {
            return None;
        }
        let others = self.explained(&outline, other_than_stated(&known_before, depths, angle));
        let [stated, others] = [stated, others].map(distinct);
        let all = || stated.iter().chain(&others).map(|one| one.fitted);
        let reduced_chi = all().map(|fitted| fitted.reduced_chi()).fold(f64::INFINITY, f64::min);
        let most = all().map(|fitted| fitted.ln_evidence_at(reduced_chi)).fold(f64::NEG_INFINITY, f64::max);
        let weight = |all: &[Explanation]| {
            all.iter().map(|one| (one.fitted.ln_evidence_at(reduced_chi) - most).exp()).sum::<f64>()
        };
        if weight(&stated) >= LEAST * (weight(&stated) + weight(&others)) {
            return None;
        }
        let Mean { angle, sd, depths: found } = mean(others)?;
        let fold = FoldAngle {
            angle_deg: angle.to_degrees(),
            angle_sd_deg: sd.to_degrees(),
            depths: outline.in_order(found),
        };
        let has_other_panels =
            found.iter().zip(depths).any(|(found, stated)| (found / stated).ln().abs() > SAME_FORM);
        Some(OtherFold { fold, has_other_panels })
    }
}

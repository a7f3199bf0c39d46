//! The angle of the fold in a set of regions, and the form of its panels.

use super::Regions;
use crate::image::{CornersBy, FoldAngle, FoldSeen, LensEstimate};

/// Why corners do not determine the angle of a fold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoAngle {
    /// There are fewer than six.
    #[error("panel{0} has no corners, so the angle is unknown")]
    NoCorners(usize),
    /// The middle of the picture is unknown.
    #[error("the picture's 'width' and 'height' are missing, without which the corners do not fix the angle")]
    NoSize,
    /// No fold that opens towards the camera has these corners.
    #[error("no fold that is open to the camera has these corners")]
    NoFold,
}

impl Regions {
    /// The angle derived from the corners, ignoring a stated one, for panels of these depths relative to
    /// their width, if known.
    ///
    /// # Errors
    /// [`NoAngle`] if they do not determine it.
    pub fn angle_by_corners(&self, depths: Option<[f64; 2]>) -> Result<FoldAngle, NoAngle> {
        let corners = |number| self.panels.get(&number).copied().ok_or(NoAngle::NoCorners(number));
        let panels = [corners(0)?, corners(1)?];
        let corners_by = if self.confidence.is_some() { CornersBy::Finding } else { CornersBy::Hand };
        let size = self.size.ok_or(NoAngle::NoSize)?;
        let seen = FoldSeen { size, corners_by, lens: LensEstimate::UNKNOWN, focal_35mm: None, depths };
        seen.angle(&panels).ok_or(NoAngle::NoFold)
    }
}

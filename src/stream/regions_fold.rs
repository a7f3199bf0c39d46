//! The fold that regions show: how far it is open, and the form of its panels.

use super::Regions;
use crate::image::{CornersBy, FoldAngle, FoldSeen};

/// Why corners do not tell the angle of a fold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoAngle {
    /// There are not six.
    #[error("there are no corners of panel{0}, so that the angle is unknown")]
    NoCorners(usize),
    /// Where the middle of the picture is is unknown.
    #[error("the picture's 'width' and 'height' are missing, without which corners do not fix the angle")]
    NoSize,
    /// No fold that is open to the camera looks so.
    #[error("no fold that is open to the camera has these corners")]
    NoFold,
}

impl Regions {
    /// The angle that the corners tell, whatever is stated beside them, of panels of these depths over their
    /// width, if that is known.
    ///
    /// # Errors
    /// [`NoAngle`], if they do not tell it.
    pub fn angle_by_corners(&self, depths: Option<[f64; 2]>) -> Result<FoldAngle, NoAngle> {
        let corners = |number| self.panels.get(&number).copied().ok_or(NoAngle::NoCorners(number));
        let panels = [corners(0)?, corners(1)?];
        let corners_by = if self.confidence.is_some() { CornersBy::Finding } else { CornersBy::Hand };
        let size = self.size.ok_or(NoAngle::NoSize)?;
        let seen = FoldSeen { size, corners_by, lens: None, focal_35mm: None, depths };
        seen.angle(&panels).ok_or(NoAngle::NoFold)
    }
}

//! The scene's panels that are marked in a photograph.

use std::collections::BTreeMap;

use crate::error::{Error, Result};
use crate::estimate::photograph::priors::Priors;
use crate::geometry::{Fold, Panel, joints};
use crate::image::{
    FacetMeasurement, Grid, Homography, Lens, Marked, PANEL_CORNERS, Point, StatedFold, camera_position,
};
use crate::surfaces::Sight;

/// A fold as it was stated, to be compared with corners; the standard deviation of its angle, degrees, is
/// that of one that somebody measured unless it is known.
#[must_use]
pub fn stated_fold(fold: &Fold, angle_sd_deg: Option<f64>) -> StatedFold {
    StatedFold {
        angle_deg: fold.angle_deg(),
        angle_sd_deg: angle_sd_deg.unwrap_or(Priors::USUAL.angle_sd_deg),
        depths: fold.depths().map(|depth| depth / fold.width()),
    }
}

/// Panels as the scene has them and as they were marked.
pub struct MarkedPanels<'a> {
    panels: Vec<&'a Panel>,
    /// As they were marked, in the order of their numbers.
    pub marked: Vec<Marked>,
}

impl<'a> MarkedPanels<'a> {
    /// The panels of a scene whose corners are `marked`, by the panels' numbers.
    ///
    /// # Errors
    /// [`Error::Usage`] if no panel is marked, one that the scene does not have, or two in the same place.
    pub fn new(scene: &'a BTreeMap<usize, Panel>, marked: &BTreeMap<usize, [Point; 4]>) -> Result<Self> {
        if marked.is_empty() {
            let problem = "there is no panel in it, such as 'panel0'";
            return Err(Error::usage("--regions", problem, "add it or give --panel0"));
        }
        let of_scene = |number: &usize| scene.get(number).ok_or_else(|| unknown(*number, scene));
        let panels: Vec<&Panel> = marked.keys().map(of_scene).collect::<Result<_>>()?;
        let joints = joints(panels.iter().copied());
        let marked = marked.iter().zip(joints);
        let marked: Vec<_> = marked
            .map(|((panel, corners), joints)| Marked { panel: *panel, corners: *corners, joints })
            .collect();
        meet(&marked)?;
        apart(&marked)?;
        Ok(Self { panels, marked })
    }

    /// The facets between `corners` of the panels, seen through `lens`.
    ///
    /// # Errors
    /// As [`Homography::through`].
    pub fn grids(&self, lens: Lens, corners: impl IntoIterator<Item = [Point; 4]>) -> Result<Vec<Grid>> {
        let grid = |((panel, marked), corners): ((&&Panel, &Marked), _)| {
            let outline = Homography::through(lens, corners)?;
            Ok(Grid::of_panel(marked.panel, outline, &panel.row_edges, &panel.col_edges))
        };
        self.panels.iter().zip(&self.marked).zip(corners).map(grid).collect()
    }

    /// Whether each facet of the panels is hidden, row by row, by what stands before it: seen from where the
    /// camera stood for the panels to lie as the `grids`. Panels of one plane do not tell where that was, and
    /// hide nothing.
    #[must_use]
    pub fn hidden(&self, sight: &Sight, grids: &[Grid], lens: Lens) -> Vec<bool> {
        let corners = |(panel, grid): (&&Panel, &Grid)| {
            let seen = grid.outline.corners().map(|corner| lens.undistort(corner));
            panel.corners.into_iter().zip(seen).collect::<Vec<_>>()
        };
        let seen: Vec<_> = self.panels.iter().zip(grids).flat_map(corners).collect();
        let eye = camera_position(&seen);
        let hidden = |panel: &&Panel, v: &[f64], u: &[f64]| {
            eye.is_some_and(|eye| !sight.sees_all(&eye, panel, [[u[0], u[1]], [v[0], v[1]]]))
        };
        let rows = self.panels.iter().flat_map(|panel| panel.row_edges.windows(2).map(move |v| (panel, v)));
        rows.flat_map(|(panel, v)| panel.col_edges.windows(2).map(move |u| hidden(panel, v, u))).collect()
    }

    /// The measured facets where the scene has them among its `count`; those of other panels are not seen.
    #[must_use]
    pub fn in_scene(&self, measured: Vec<FacetMeasurement>, count: usize) -> Vec<FacetMeasurement> {
        let mut facets = vec![FacetMeasurement::unseen(); count];
        let places = self.panels.iter().flat_map(|panel| panel.facets.clone());
        places.zip(measured).for_each(|(place, measured)| facets[place] = measured);
        facets
    }
}

fn unknown(number: usize, scene: &BTreeMap<usize, Panel>) -> Error {
    let known: Vec<_> = scene.keys().map(usize::to_string).collect();
    let problem = format!("the scene has no flat panel {number} of rows and columns");
    Error::usage("--panel", problem, format!("its panels are {}", known.join(", ")))
}

/// Part of a panel's longest side by which marks of one corner may differ.
const SAME_CORNER: f64 = 0.05;

/// Checks that panels which share a corner of the sheet have it marked in one place.
fn meet(marked: &[Marked]) -> Result<()> {
    for (n, b) in marked.iter().enumerate() {
        let longest = (0..4).map(|k| distance(b.corners[k], b.corners[(k + 1) % 4])).fold(0.0, f64::max);
        for a in &marked[..n] {
            for (k, joint) in b.joints.iter().enumerate() {
                let Some(l) = a.joints.iter().position(|other| other == joint) else { continue };
                let (of_a, of_b) = (a.corners[l], b.corners[k]);
                if distance(of_a, of_b) > SAME_CORNER * longest {
                    let problem = format!(
                        "{} of panel {} is at {},{} and {} of panel {} at {},{}: \
                         they are one point of the sheet",
                        PANEL_CORNERS[l], a.panel, of_a.x, of_a.y, PANEL_CORNERS[k], b.panel, of_b.x, of_b.y
                    );
                    let remedy = format!("mark all panels from the same end: {}", PANEL_CORNERS.join(", "));
                    return Err(Error::usage("--panel", problem, remedy));
                }
            }
        }
    }
    Ok(())
}

fn distance(a: Point, b: Point) -> f64 {
    (a.x - b.x).hypot(a.y - b.y)
}

/// Checks that no two panels are marked in one place.
fn apart(marked: &[Marked]) -> Result<()> {
    let outlines = marked.iter().map(|panel| Homography::from_unit_square(panel.corners));
    let outlines: Vec<_> = outlines.collect::<Result<_>>()?;
    let holds = |a: &Homography, b: &Homography| {
        let (u, v) = a.to_panel(b.to_image(0.5, 0.5));
        (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
    };
    for (n, b) in outlines.iter().enumerate() {
        if let Some(m) = outlines[..n].iter().position(|a| holds(a, b) && holds(b, a)) {
            let problem = format!("panels {} and {} lie over each other", marked[m].panel, marked[n].panel);
            return Err(Error::usage("--panel", problem, "panels meet at a crease and nowhere else"));
        }
    }
    Ok(())
}

//! The panels of a scene that are marked in a photograph.

use std::collections::BTreeMap;

use crate::error::{Error, Result};
use crate::estimate::photograph::priors::Priors;
use crate::estimate::unknowns::{Expectation, Normal, Scale};
use crate::geometry::{Fold, Panel, joints};
use crate::image::{
    FacetMeasurement, Grid, Homography, Lens, Marked, PANEL_CORNERS, Point, StatedFold, camera_position,
};
use crate::surfaces::Sight;

/// The stated fold, for comparison with marked corners. The standard deviation of its angle, degrees,
/// defaults to that of usual measurements, blunders among them.
#[must_use]
pub fn stated_fold(fold: &Fold, angle_sd_deg: Option<f64>) -> StatedFold {
    let usual = || {
        let Priors { angle_sd_deg: sd, stated_tail, .. } = Priors::USUAL;
        Expectation::from(Normal { mean: 0.0, sd }).with_tail(stated_tail).spread(Scale::Linear, 0.0, 1.0)
    };
    StatedFold {
        angle_deg: fold.angle_deg(),
        angle_sd_deg: angle_sd_deg.unwrap_or_else(usual),
        depths: fold.depths().map(|depth| depth / fold.width()),
    }
}

/// Panels as in the scene and as marked.
pub struct MarkedPanels<'a> {
    panels: Vec<&'a Panel>,
    /// The marks, in the order of panel numbers.
    pub marked: Vec<Marked>,
}

impl<'a> MarkedPanels<'a> {
    /// The panels of a scene with corners `marked`, by panel number.
    ///
    /// # Errors
    /// [`Error::Usage`] if no panel is marked, if one is not in the scene, or if two are in the same place.
    pub fn new(scene: &'a BTreeMap<usize, Panel>, marked: &BTreeMap<usize, [Point; 4]>) -> Result<Self> {
        if marked.is_empty() {
            let problem = "it has no panel, such as 'panel0'";
            return Err(Error::usage("--regions", problem, "add one, or give --panel0"));
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

    /// For each facet of the panels, row by row, true if something hides it from the camera, whose position
    /// follows from the `grids`. Panels of a single plane do not determine that position, and nothing counts
    /// as hidden.
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

    /// Places the measured facets among the `count` facets of the scene; those of other panels are unseen.
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

/// Tolerance for marks of the same corner, relative to a panel's longest side.
const SAME_CORNER: f64 = 0.05;

/// Checks that corners of the sheet shared by several panels are marked in one place.
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
            let problem = format!("panels {} and {} overlap", marked[m].panel, marked[n].panel);
            return Err(Error::usage("--panel", problem, "mark panels that meet only at a crease"));
        }
    }
    Ok(())
}

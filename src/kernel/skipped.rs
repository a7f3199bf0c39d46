//! Counts the work that a scene's symmetries and light make unnecessary.

use crate::geometry::{Fold, Light};
use crate::kernel::mesh::Accuracy;

/// Work that was skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// What was not computed, in the plural.
    pub what: &'static str,
    /// Their number.
    pub count: usize,
    /// Why they are not needed.
    pub why: &'static str,
}

/// The work skipped in solving interreflections on `fold`, given the `accuracy` of the solution and the
/// number of `poles` left of its unknowns. Entries with a count of zero are omitted.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold, Light};
/// use vfold::kernel::mesh::Mesh;
/// use vfold::kernel::skipped::skipped;
/// use vfold::paper::{Method, respond};
/// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// let (response, accuracy) = respond(Method::Exact, &fold, Mesh::Facets, 1e-5)?;
/// let light = Light::new(&fold, 0.0, 0.0, 0.0)?;
/// let skipped = skipped(&fold, &light, &accuracy, response.poles().len());
/// // Of 2 · 100 · 100 form factors between the panels, 550 are distinct.
/// assert!(skipped.iter().any(|skip| skip.what == "equal form factors" && skip.count == 19_450));
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn skipped(fold: &Fold, light: &Light, accuracy: &Accuracy, poles: usize) -> Vec<Skipped> {
    let panel = match accuracy.kernel {
        Some(_) => accuracy.unknowns,
        None => fold.facets().len(),
    };
    let [sun0, sun1] = light.panel_irradiance();
    let further_lights = usize::from(sun0.total_cmp(&sun1).is_ne()) + usize::from(light.sky() > 0.0);
    let skip = |what, count, why| Skipped { what, count, why };
    let mut list = vec![
        skip("visibility tests", panel * panel, "nothing stands between two panels of a fold"),
        skip("form factors of a panel with itself", 2 * panel * panel, "a plane does not see itself"),
    ];
    list.push(match accuracy.kernel {
        Some(source) => skip(
            "equal form factors",
            2 * panel * panel - source.entries,
            "shift along the crease, mirror image and reciprocity leave few that differ",
        ),
        None => {
            skip("form factors of facets", 2 * panel * panel, "the bounces are solved on undivided panels")
        }
    });
    let modes_why = "the light does not excite them, or they stay below the tolerance";
    list.push(skip("modes", accuracy.unknowns.saturating_sub(poles), modes_why));
    if accuracy.kernel.is_none() {
        let why = "each half of the crease is the other's mirror image";
        list.push(skip("unknowns of the crease's other half", accuracy.unknowns, why));
    }
    if fold.is_symmetric() {
        let why = "each panel is the other's mirror image";
        list.push(skip("unknowns of the other panel", accuracy.unknowns, why));
    }
    let why = "tilted sun and sky are found from the poles of even light";
    list.push(skip("solutions for further lights", further_lights, why));
    list.retain(|skip| skip.count > 0);
    list
}

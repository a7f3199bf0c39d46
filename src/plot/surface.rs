//! Direct light and row sums of the kernel for every facet.

use std::path::Path;

use super::figure::{Above, save};
use super::maps::{FacetMap, Maps};
use super::scale::Scale;
use crate::error::Result;
use crate::geometry::Panel;

/// Light of the facets of a scene.
#[derive(Clone, Debug)]
pub struct FacetLight {
    /// Positions of the facets, by the panels' numbers.
    pub panels: Vec<(usize, Panel)>,
    /// Fraction of its light that each facet sends to others: row sums of the kernel, 0..1.
    pub row_sums: Vec<f64>,
    /// Direct irradiance, relative to a plane facing the sun.
    pub irradiance: Vec<f64>,
}

impl FacetLight {
    fn maps(&self, title: &str, values: &[f64], unit: &'static str) -> Maps<'_> {
        let on_panels = self.panels.iter().flat_map(|(_, panel)| panel.facets.clone());
        Maps {
            title: title.to_owned(),
            panels: &self.panels,
            maps: vec![FacetMap { title: String::new(), values: values.iter().copied().map(Some).collect() }],
            scale: Scale::over(on_panels.filter_map(|facet| values.get(facet)).copied()),
            unit,
        }
    }
}

/// Draws both as maps, SVG or PNG.
///
/// # Errors
/// [`crate::Error::File`] if it cannot be written.
pub fn draw(path: &Path, light: &FacetLight) -> Result<()> {
    let handed = light.maps("light exchanged between facets", &light.row_sums, "row sums of the kernel");
    let direct = light.maps("direct light", &light.irradiance, "irradiance, facing the sun = 1");
    save(path, &Above(handed, Some(direct)))
}

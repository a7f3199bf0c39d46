//! Facets that were measured: which of them can be used.

use crate::error::{Error, Result};
use crate::forward::FacetModel;

/// A picture with less light in all its facets is dark: squares of such numbers are zero.
const DARKEST: f64 = 1e-100;

/// Facet RGB, and how far each may be off: facet by channel, none for a facet that was not measured.
pub struct Measured<'a> {
    /// Values.
    pub rgb: &'a [Option<Vec<f64>>],
    /// Standard deviations, positive.
    pub sd: &'a [Option<Vec<f64>>],
}

/// Whether there are values of as many facets as the scene has, in as many channels where a facet was measured.
///
/// # Errors
/// [`Error::Field`] under that name if not.
pub fn check_shape(name: &str, values: &[Option<Vec<f64>>], [facets, channels]: [usize; 2]) -> Result<()> {
    if values.len() != facets {
        return Err(Error::field(name, format!("{} facets, but the scene has {facets}", values.len())));
    }
    match values.iter().flatten().find(|row| row.len() != channels) {
        None => Ok(()),
        Some(odd) => Err(Error::field(
            name,
            format!("{} channels, but the scene has {channels}: its camera's in every picture", odd.len()),
        )),
    }
}

/// Facets with a value in every channel; checks the shapes on the way.
pub fn usable_facets(model: &FacetModel, measured: &Measured) -> Result<Vec<usize>> {
    let (facets, channels) = (model.sources()[0].facets.nrows(), model.sources()[0].camera.channels());
    check_shape("facet_rgb", measured.rgb, [facets, channels])?;
    check_shape("facet_sd", measured.sd, [facets, channels])?;
    let usable: Vec<usize> =
        (0..facets).filter(|f| measured.rgb[*f].is_some() && measured.sd[*f].is_some()).collect();
    if usable.is_empty() {
        return Err(Error::field("facet_rgb", "no facet was measured; check corners and clipping"));
    }
    if usable.iter().filter_map(|f| measured.rgb[*f].as_ref()).flatten().sum::<f64>() <= DARKEST {
        return Err(Error::field("facet_rgb", "no light in any facet; check exposure and black level"));
    }
    Ok(usable)
}

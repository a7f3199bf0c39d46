//! Measured facets, and which of them can be used.

use crate::error::{Error, Result, counted};
use crate::forward::{FacetModel, FacetValues};

/// A picture with no more light than this in all facets is dark: squares of such numbers underflow.
const DARKEST: f64 = 1e-100;

/// Facet RGB with standard deviations.
pub struct Measured<'a> {
    /// Values.
    pub rgb: &'a FacetValues,
    /// Standard deviations, positive.
    pub sd: &'a FacetValues,
}

/// Checks that there are values for as many facets as the scene has, with its number of channels if any facet
/// was measured.
///
/// # Errors
/// [`Error::Field`] with this `name` if not.
pub fn check_shape(name: &str, values: &FacetValues, [facets, channels]: [usize; 2]) -> Result<()> {
    if values.len() != facets {
        let problem = format!("{}, but the scene has {facets}", counted(values.len(), "facet"));
        return Err(Error::field(name, problem));
    }
    let other = values.channels();
    if other != channels && values.facets().any(|facet| facet.is_some()) {
        let other = counted(other, "channel");
        let problem = format!("{other}, but the scene has {channels}: its camera's in every picture");
        return Err(Error::field(name, problem));
    }
    Ok(())
}

/// Facets with a value in every channel, after checking the shapes.
pub fn usable_facets(model: &FacetModel, measured: &Measured) -> Result<Vec<usize>> {
    let (facets, channels) = (model.sources()[0].facets.nrows(), model.sources()[0].camera.channels());
    check_shape("facet_rgb", measured.rgb, [facets, channels])?;
    check_shape("facet_sd", measured.sd, [facets, channels])?;
    let usable: Vec<usize> =
        (0..facets).filter(|f| measured.rgb.facet(*f).is_some() && measured.sd.facet(*f).is_some()).collect();
    if usable.is_empty() {
        return Err(Error::field("facet_rgb", "no facet was measured; check corners and clipping"));
    }
    if usable.iter().filter_map(|f| measured.rgb.facet(*f)).map(|facet| facet.sum()).sum::<f64>() <= DARKEST {
        return Err(Error::field("facet_rgb", "no light in any facet; check exposure and black level"));
    }
    Ok(usable)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_have_the_channels_of_the_scene_or_none_was_measured() {
        let check = |rows: &[Option<Vec<f64>>]| {
            check_shape("facet_rgb", &FacetValues::of_rows(rows).unwrap(), [2, 3])
        };
        assert!(check(&[Some(vec![0.1; 3]), None]).is_ok() && check(&[None, None]).is_ok());
        for rows in [vec![Some(vec![]), None], vec![Some(vec![0.1; 4]), None], vec![None]] {
            assert!(check(&rows).is_err(), "{rows:?}");
        }
    }
}

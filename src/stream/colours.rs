//! Values of facets in a sample: `[facet][channel]` for one picture, `[picture][facet][channel]` for several,
//! each under its own light.

use std::ops::RangeInclusive;

use schemars::JsonSchema;
use serde::Serialize;

use super::Sample;
use super::fields::{LARGEST, finite};
use crate::error::{Error, Result, counted};
use crate::forward::FacetValues;

/// Facet by channel; none for a facet that was not measured.
pub(super) type Rows = Vec<Option<Vec<f64>>>;

/// One value per channel, in the order of the camera's channels; null for a facet that was not measured.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum ColoursRecord {
    /// Of one picture: `[facet][channel]`.
    Picture(Rows),
    /// Of several: `[picture][facet][channel]`.
    Pictures(Vec<Rows>),
}

impl Sample {
    /// Sets the facets' values in `pictures` pictures and, where known, their standard deviations.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_facets(&mut self, rgb: &FacetValues, sd: Option<&FacetValues>, pictures: usize) -> Result<()> {
        for (name, facets) in std::iter::once(("facet_rgb", rgb)).chain(sd.map(|sd| ("facet_sd", sd))) {
            let rows = facets.rows();
            finite(name, rows.iter().flatten().flatten())?;
            let record = match pictures {
                1 => ColoursRecord::Picture(rows),
                _ => ColoursRecord::Pictures(by_picture(&rows, pictures)),
            };
            self.fields.set(name, record)?;
        }
        Ok(())
    }

    /// The facets' values; a facet counts as measured if all pictures contain it.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing.
    pub fn facet_rgb(&self) -> Result<FacetValues> {
        let rgb = self.colours("facet_rgb", -LARGEST..=LARGEST)?;
        rgb.ok_or_else(|| Error::field("facet_rgb", "missing; make it with vforward or vextract"))
    }

    /// The facets' standard deviations, if known.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn facet_sd(&self) -> Result<Option<FacetValues>> {
        self.colours("facet_sd", 0.0..=LARGEST)
    }

    /// A field, with pictures side by side.
    fn colours(&self, name: &str, range: RangeInclusive<f64>) -> Result<Option<FacetValues>> {
        let facets: Option<Rows> = match self.fields.get(name) {
            Ok(facets) => facets,
            Err(_) => Some(side_by_side(name, &self.pictures(name)?)?),
        };
        let Some(facets) = facets else { return Ok(None) };
        within(name, &facets, range)?;
        values(name, &facets).map(Some)
    }

    fn pictures(&self, name: &str) -> Result<Vec<Rows>> {
        let needs = "needs lists of numbers, one per facet, or a list of such lists, one per picture";
        self.fields.require(name, "").map_err(|_| Error::field(name, needs))
    }
}

/// A field's rows as values of facets.
pub(super) fn values(name: &str, rows: &Rows) -> Result<FacetValues> {
    let problem = "facets have different numbers of channels; each needs one number per channel";
    FacetValues::of_rows(rows).ok_or_else(|| Error::field(name, problem))
}

fn side_by_side(name: &str, pictures: &[Rows]) -> Result<Rows> {
    let facets = pictures[0].len();
    if let Some(other) = pictures.iter().find(|picture| picture.len() != facets) {
        let problem = format!("{} in one picture, {facets} in another", counted(other.len(), "facet"));
        return Err(Error::field(name, problem));
    }
    let in_all = |facet: usize| {
        let values: Option<Vec<_>> = pictures.iter().map(|picture| picture[facet].clone()).collect();
        values.map(|values| values.concat())
    };
    Ok((0..facets).map(in_all).collect())
}

fn by_picture(facets: &Rows, pictures: usize) -> Vec<Rows> {
    let part = |values: &Vec<f64>, picture: usize| {
        let channels = values.len() / pictures;
        values[picture * channels..(picture + 1) * channels].to_vec()
    };
    let picture = |n| facets.iter().map(|facet| facet.as_ref().map(|values| part(values, n))).collect();
    (0..pictures).map(picture).collect()
}

fn within(name: &str, facets: &Rows, range: RangeInclusive<f64>) -> Result<()> {
    match facets.iter().flatten().flatten().find(|value| !range.contains(*value)) {
        Some(value) => Err(Error::field(name, format!("{value:e} cannot be the value of a facet"))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn facets_of_several_pictures_stand_beside_each_other() {
        let mut sample = Sample::new("fold", "sheet").unwrap();
        let rgb = FacetValues::of_rows(&[Some(vec![0.1, 0.2, 0.3, 0.4]), None]).unwrap();
        sample.set_facets(&rgb, None, 2).unwrap();
        assert_eq!(sample.fields.text("facet_rgb"), Some("[[[0.1,0.2],null],[[0.3,0.4],null]]"));
        assert_eq!(sample.facet_rgb().unwrap(), rgb);
    }

    #[test]
    fn a_facet_counts_if_all_pictures_have_it() {
        let mut sample = Sample::new("fold", "sheet").unwrap();
        sample.fields.set("facet_rgb", json!([[[0.1], [0.2]], [[0.3], null]])).unwrap();
        assert_eq!(sample.facet_rgb().unwrap().rows(), [Some(vec![0.1, 0.3]), None]);
    }
}

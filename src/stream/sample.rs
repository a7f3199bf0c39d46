//! The sample record: one sheet's facet RGB, and what the tools make of it.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::fields::{Fields, finite};
use crate::error::{Error, Result};
use crate::forward::bounces::Truncation;
use crate::plot::spectra::Curve;
use crate::score::{Metrics, Summary};

/// Largest value of a facet that is read: sums and squares of such numbers stay finite.
const LARGEST: f64 = 1e30;

/// Facet by channel, those of several pictures one after the other; none for a facet that was not measured in all of them.
pub type Colours = Vec<Option<Vec<f64>>>;

/// A sample record.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its fields, those that the tools do not know included.
    pub fields: Fields,
}

/// A true or estimated reflectance, on its own wavelengths.
#[derive(Clone, Debug, Serialize, Deserialize, PartialEq)]
pub struct ReflectanceRecord {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Reflectance a wavelength.
    pub reflectance: Vec<f64>,
}

impl Sample {
    /// An empty sample of a scene.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn new(scene: &str, id: &str) -> Result<Self> {
        let mut fields = Fields::of_kind("sample");
        fields.set("scene", scene)?;
        fields.set("id", id)?;
        Ok(Self { fields })
    }

    /// The sample's name.
    ///
    /// # Errors
    /// [`Error::Field`] if it has none.
    pub fn id(&self) -> Result<String> {
        self.fields.require("id", "vforward and vextract name their samples")
    }

    /// Sets the facets' values in a number of `pictures` and, where known, their standard deviations.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_facets(&mut self, rgb: &Colours, sd: Option<&Colours>, pictures: usize) -> Result<()> {
        for (name, facets) in std::iter::once(("facet_rgb", rgb)).chain(sd.map(|sd| ("facet_sd", sd))) {
            finite(name, facets.iter().flatten().flatten())?;
            match pictures {
                1 => self.fields.set(name, facets)?,
                _ => self.fields.set(name, by_picture(facets, pictures))?,
            }
        }
        Ok(())
    }

    /// The facets' values.
    ///
    /// # Errors
    /// [`Error::Field`] if they are missing.
    pub fn facet_rgb(&self) -> Result<Colours> {
        let rgb = self.colours("facet_rgb", -LARGEST..=LARGEST)?;
        rgb.ok_or_else(|| Error::field("facet_rgb", "missing; make it with vforward or vextract"))
    }

    /// The facets' standard deviations, if known.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn facet_sd(&self) -> Result<Option<Colours>> {
        self.colours("facet_sd", 0.0..=LARGEST)
    }

    /// A field that is `[facet][channel]` for one picture, `[picture][facet][channel]` for several.
    fn colours(&self, name: &str, range: RangeInclusive<f64>) -> Result<Option<Colours>> {
        let several = self.fields.0.get(name).is_some_and(is_by_picture);
        let facets = if several {
            Some(beside_each_other(self.fields.require(name, "make it with vforward or vextract")?)?)
        } else {
            self.fields.get(name)?
        };
        facets.as_ref().map_or(Ok(()), |facets| within(name, facets, range))?;
        Ok(facets)
    }

    /// Says how many bounces of light the facets' values are made of.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_bounces(&mut self, truncation: &Truncation) -> Result<()> {
        let Truncation { count, missing } = truncation;
        finite("bounces.missing", [missing])?;
        self.fields.set("bounces", json!({ "count": count, "missing": missing }))
    }

    /// Sets the true spectrum.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_truth(&mut self, truth: &ReflectanceRecord) -> Result<()> {
        finite("truth", truth.reflectance.iter().chain(&truth.wavelengths_nm))?;
        self.fields.set("truth", truth)
    }

    /// The estimate as a curve to draw; none if there is none.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn curve(&self) -> Result<Option<Curve>> {
        let Some(estimate) = self.estimated()? else { return Ok(None) };
        Ok(Some(Curve {
            name: self.id()?,
            wavelengths_nm: estimate.wavelengths_nm,
            reflectance: estimate.reflectance,
            reflectance_sd: self.estimated_sd()?,
            truth: self.truth()?.map(|truth| (truth.wavelengths_nm, truth.reflectance)),
        }))
    }

    /// The true spectrum, if the sample carries it.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a spectrum.
    pub fn truth(&self) -> Result<Option<ReflectanceRecord>> {
        self.fields.get("truth")
    }

    /// Marks the sample as failed.
    ///
    /// # Errors
    /// As [`Fields::set`].
    pub fn set_error(&mut self, error: &Error) -> Result<()> {
        self.fields.set("error", error.to_string())
    }

    /// What went wrong with this sample in an earlier tool, if anything did.
    ///
    /// # Errors
    /// [`Error::Field`] if `error` is not text.
    pub fn error(&self) -> Result<Option<String>> {
        self.fields.get("error")
    }

    /// The exposure at which the facets were computed or calibrated, if it is known.
    ///
    /// # Errors
    /// [`Error::Field`] if it is not a number above 0.
    pub fn exposure(&self) -> Result<Option<f64>> {
        match self.fields.get("exposure")? {
            Some(exposure) if !(exposure > 0.0 && exposure <= LARGEST) => Err(Error::field(
                "exposure",
                format!("{exposure} gives no picture; it needs a number above 0"),
            )),
            exposure => Ok(exposure),
        }
    }

    /// Whether the facets come from a photograph.
    ///
    /// # Errors
    /// [`Error::Field`] if `image` is not an object.
    pub fn is_photograph(&self) -> Result<bool> {
        Ok(self.fields.get::<serde::de::IgnoredAny>("image")?.is_some())
    }

    /// Adds scores.
    ///
    /// # Errors
    /// [`Error::Field`] if a number is not finite.
    pub fn set_metrics(&mut self, metrics: &Metrics) -> Result<()> {
        finite("metrics", [&metrics.rmse, &metrics.ciede2000, &metrics.pd])?;
        self.fields
            .set("metrics", json!({ "rmse": metrics.rmse, "ciede2000": metrics.ciede2000, "pd": metrics.pd }))
    }

    /// The sample's scores, if it has any.
    ///
    /// # Errors
    /// [`Error::Field`] if they are not numbers.
    pub fn metrics(&self) -> Result<Option<Metrics>> {
        #[derive(Deserialize)]
        struct MetricsRecord {
            rmse: f64,
            ciede2000: f64,
            pd: f64,
        }
        let record: Option<MetricsRecord> = self.fields.get("metrics")?;
        Ok(record.map(|MetricsRecord { rmse, ciede2000, pd }| Metrics { rmse, ciede2000, pd }))
    }
}

/// The record that ends a scored stream: how many samples, and the mean, median and worst of each score.
///
/// # Errors
/// As [`Fields::set`].
pub fn summary(summary: &Summary) -> Result<Fields> {
    let mut fields = Fields::of_kind("summary");
    fields.set("samples", summary.samples())?;
    fields.set("scored", summary.scored())?;
    if let Some(statistics) = summary.statistics() {
        for (name, pick) in [
            ("rmse", (|m: &Metrics| m.rmse) as fn(&Metrics) -> f64),
            ("ciede2000", |m| m.ciede2000),
            ("pd", |m| m.pd),
        ] {
            let [mean, median, worst] = statistics.each_ref().map(pick);
            fields.set(name, json!({ "mean": mean, "median": median, "worst": worst }))?;
        }
    }
    Ok(fields)
}

/// Whether there are three levels of lists, not two.
fn is_by_picture(facets: &Value) -> bool {
    let rows = facets.as_array().into_iter().flatten().filter_map(Value::as_array);
    rows.flatten().any(Value::is_array)
}

fn beside_each_other(pictures: Vec<Colours>) -> Result<Colours> {
    let facets = pictures[0].len();
    if let Some(other) = pictures.iter().find(|picture| picture.len() != facets) {
        let problem = format!("{} facets in one picture, {facets} in another", other.len());
        return Err(Error::field("facet_rgb", problem));
    }
    let in_all = |facet: usize| {
        let values: Option<Vec<_>> = pictures.iter().map(|picture| picture[facet].clone()).collect();
        values.map(|values| values.concat())
    };
    Ok((0..facets).map(in_all).collect())
}

fn by_picture(facets: &Colours, pictures: usize) -> Vec<Colours> {
    let part = |values: &Vec<f64>, picture: usize| {
        let channels = values.len() / pictures;
        values[picture * channels..(picture + 1) * channels].to_vec()
    };
    let picture = |n| facets.iter().map(|facet| facet.as_ref().map(|values| part(values, n))).collect();
    (0..pictures).map(picture).collect()
}

fn within(name: &str, facets: &Colours, range: RangeInclusive<f64>) -> Result<()> {
    match facets.iter().flatten().flatten().find(|value| !range.contains(*value)) {
        Some(value) => Err(Error::field(name, format!("{value:e} cannot be the value of a facet"))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_of_several_pictures_stand_beside_each_other() {
        let mut sample = Sample::new("fold", "sheet").unwrap();
        let rgb: Colours = vec![Some(vec![0.1, 0.2, 0.3, 0.4]), None];
        sample.set_facets(&rgb, None, 2).unwrap();
        assert_eq!(sample.fields.0["facet_rgb"], json!([[[0.1, 0.2], null], [[0.3, 0.4], null]]));
        assert_eq!(sample.facet_rgb().unwrap(), rgb);
    }

    #[test]
    fn a_facet_counts_if_all_pictures_have_it() {
        let mut sample = Sample::new("fold", "sheet").unwrap();
        sample.fields.set("facet_rgb", json!([[[0.1], [0.2]], [[0.3], null]])).unwrap();
        assert_eq!(sample.facet_rgb().unwrap(), [Some(vec![0.1, 0.3]), None]);
    }
}

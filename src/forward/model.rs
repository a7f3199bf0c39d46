//! Facet RGB of a surface as a linear combination of a few functions of its reflectance.
//!
//! Every facet's radiance is a sum over the poles of the response. The poles and their functions of
//! reflectance are common to all facets: eqs. (33) to (35) with the poles in place of all eigenvalues. The
//! spectrum is therefore integrated once per pole and channel rather than per facet and channel, and only
//! over wavebands that a sensor sees.

use nalgebra::{DMatrix, DVector};

use super::families::Family;
use super::lighting::seen_bands;
use super::terms::Terms;
use crate::camera::CameraResponse;

/// Facet RGB of a surface under known light, for any reflectance of the surface or of its unknown part.
#[derive(Clone, Debug)]
pub struct FacetModel {
    terms: Terms,
    sources: Vec<Source>,
    seen_bands: Vec<usize>,
}

/// One light: the weight of each term in every facet, and the camera's response.
#[derive(Clone, Debug)]
pub struct Source {
    /// Facet by term.
    pub facets: DMatrix<f64>,
    /// The camera's response to this light.
    pub camera: CameraResponse,
}

impl FacetModel {
    /// A model with these `terms` and at least one source, which holds their weights in the facets.
    pub(crate) fn of(terms: Terms, sources: Vec<Source>) -> Self {
        let seen_bands = seen_bands(sources.iter().map(|source| &source.camera));
        Self { terms, sources, seen_bands }
    }

    /// Number of terms: functions of reflectance that all facets combine.
    #[must_use]
    pub fn terms(&self) -> usize {
        self.terms.count()
    }

    /// Number of wavebands.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.sources[0].camera.bands()
    }

    /// The lights, each with the weights of the terms.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The same model with every source scaled by its amount.
    ///
    /// # Panics
    /// If the number of amounts differs from the number of sources.
    #[must_use]
    pub fn in_amounts(&self, amounts: &[f64]) -> Self {
        assert_eq!(amounts.len(), self.sources.len(), "one amount per source");
        let mut scaled = self.clone();
        scaled.sources.iter_mut().zip(amounts).for_each(|(source, amount)| source.facets *= *amount);
        scaled
    }

    /// The same model with this response to light in place of that of every source.
    #[must_use]
    pub fn in_light(&self, camera: &CameraResponse) -> Self {
        let source = |source: &Source| Source { facets: source.facets.clone(), camera: camera.clone() };
        Self::of(self.terms.clone(), self.sources.iter().map(source).collect())
    }

    /// The terms for a spectrum: waveband by term. They contain no `1/r`, as black is a valid reflectance.
    #[must_use]
    pub fn terms_of(&self, reflectance: &[f64]) -> DMatrix<f64> {
        let [terms] = self.in_all_bands(reflectance, |family, r, g| [family.value(r, g)]);
        terms
    }

    /// The terms with their first and second derivatives by reflectance.
    #[must_use]
    pub fn derivatives_of(&self, reflectance: &[f64]) -> [DMatrix<f64>; 3] {
        self.in_all_bands(reflectance, Family::at)
    }

    /// Signed poles, one per term. Bounces multiply light emitted by the surface by `1 + pt`, where
    /// `t = r/(1 − rp)` is the term of reflected light at the pole p. `None` if parts of the surface are
    /// known.
    #[must_use]
    pub fn signed_poles(&self) -> Option<Vec<f64>> {
        self.terms.signed_poles()
    }

    /// RGB of every facet at exposure 1: facet by channel. Facets of a fold are ordered by panel, row,
    /// column.
    ///
    /// # Source
    /// Deeb et al., eq. (24), for the uniform sheet eq. (33).
    #[must_use]
    pub fn facet_rgb(&self, reflectance: &[f64]) -> DMatrix<f64> {
        self.rgb_of(reflectance, None, Family::value)
    }

    /// The part of [`FacetModel::facet_rgb`] due to light reflected from panel to panel more than `bounces`
    /// times.
    ///
    /// # Source
    /// Deeb et al., eqs. (5) to (7) and (11) to (14): light after b bounces is a mode's share times its pole
    /// to the power b, so that the sum over b > `bounces` has a closed form.
    #[must_use]
    pub fn facet_rgb_after(&self, bounces: u32, reflectance: &[f64]) -> DMatrix<f64> {
        self.rgb_of(reflectance, None, |family, r, g| family.value_after(bounces, r, g))
    }

    /// The linear map from reflectance to the mean RGB of `facets`, channel by waveband, if light does not
    /// bounce. `None` for a concave sheet, whose RGB is not linear in its reflectance, or if parts are known.
    #[must_use]
    pub fn without_bounces(&self, facets: &[usize]) -> Option<DMatrix<f64>> {
        if !self.terms.is_flat() {
            return None;
        }
        let of_source = |source: &Source| {
            let light = facets.iter().map(|facet| source.facets.row(*facet).sum()).sum::<f64>();
            let share = light / facets.len().max(1) as f64;
            DMatrix::from_fn(source.camera.channels(), self.bands(), |c, band| {
                share * source.camera.channel(c)[band]
            })
        };
        Some(self.sources.iter().map(of_source).sum())
    }

    fn in_all_bands<const N: usize>(
        &self,
        reflectance: &[f64],
        of: impl Fn(&Family, f64, f64) -> [f64; N],
    ) -> [DMatrix<f64>; N] {
        self.terms.in_bands(&(0..reflectance.len()).collect::<Vec<_>>(), reflectance, of)
    }

    /// True if the surface consists of one unknown sheet alone.
    pub(super) fn is_of_one_sheet(&self) -> bool {
        self.terms.signed_poles().is_some()
    }

    /// RGB of every facet of one sheet. `sent` gives the light leaving a mode per waveband, relative to the
    /// light, for the index of a source and the mode's pole.
    pub(super) fn rgb_of_modes(&self, sent: impl Fn(usize, f64) -> Vec<f64>) -> DMatrix<f64> {
        let poles = self.terms.signed_poles().unwrap_or_default();
        let of_source = |(n, Source { facets, camera }): (usize, &Source)| {
            let weights =
                DMatrix::from_fn(self.bands(), camera.channels(), |band, c| camera.channel(c)[band]);
            let mut rgb = DMatrix::zeros(facets.nrows(), camera.channels());
            for (column, pole) in facets.column_iter().zip(&poles) {
                // the response to one source has no part in the modes of another
                if column.iter().any(|residue| *residue != 0.0) {
                    rgb += column * (weights.tr_mul(&DVector::from(sent(n, *pole)))).transpose();
                }
            }
            rgb
        };
        self.sources.iter().enumerate().map(of_source).sum()
    }

    /// RGB of every facet. `of` evaluates a family at a reflectance and a pole; `amounts`, if given, multiply
    /// the result, one per waveband.
    pub(super) fn rgb_of(
        &self,
        reflectance: &[f64],
        amounts: Option<&[f64]>,
        of: impl Fn(&Family, f64, f64) -> f64,
    ) -> DMatrix<f64> {
        let bands = &self.seen_bands;
        let reflectance: Vec<f64> = bands.iter().map(|band| reflectance[*band]).collect();
        let [terms] = self.terms.in_bands(bands, &reflectance, |family, r, g| [of(family, r, g)]);
        let of_source = |source: &Source| {
            let camera = &source.camera;
            let amount = |band: usize| amounts.map_or(1.0, |amounts| amounts[band]);
            let weights = DMatrix::from_fn(bands.len(), camera.channels(), |n, c| {
                camera.channel(c)[bands[n]] * amount(bands[n])
            });
            &source.facets * terms.tr_mul(&weights)
        };
        self.sources.iter().map(of_source).sum()
    }
}

//! Facet RGB of a fold as a linear combination of a few functions of reflectance.
//!
//! Every facet's radiance is a sum over the poles of the response; the poles and what the reflectance makes of them are
//! common to all facets: eqs. (33) to (35) with the poles in place of all eigenvalues. So the spectrum is integrated
//! once a pole and channel, not once a facet and channel, and only over wavebands that a sensor sees.

use nalgebra::DMatrix;

use super::families::{EVEN, Families, Family, ODD, beside_card};
use crate::camera::CameraResponse;
use crate::geometry::Light;
use crate::response::{ModeLight, Modes, Response};

/// The lights of a scene as the camera responds to them.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// Where the sun stands and how much sky there is.
    pub light: Light,
    /// Response of the camera to the sun.
    pub sun: CameraResponse,
    /// Response to the sky, scaled to 1 in the sun's reference channel; needed only where the light has a sky.
    pub sky: CameraResponse,
}

impl Lighting {
    /// The lights of the scene: the sun, and the sky if there is one, each with the camera's response to it.
    pub fn sources(&self) -> impl Iterator<Item = (ModeLight, &CameraResponse)> + Clone {
        let sun = (ModeLight::Sun(self.light.panel_irradiance()), &self.sun);
        let sky = (ModeLight::Sky(self.light.sky()), &self.sky);
        std::iter::once(sun).chain((self.light.sky() > 0.0).then_some(sky))
    }

    /// RGB at exposure 1 of a flat sheet of this `reflectance`, a number a waveband, outside the fold: the sun meets it at an angle
    /// of cosine `cos`, nothing hides the sky.
    ///
    /// # Example
    /// ```
    /// use vfold::camera::CameraResponse;
    /// use vfold::forward::Lighting;
    /// use vfold::geometry::{FacetGrid, Fold, Light};
    /// let light = Light::new(&Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 1, cols: 1 })?, 0.0, 0.0, 0.2)?;
    /// let camera = CameraResponse::from_weights(vec![vec![0.75, 0.25]]);
    /// let lighting = Lighting { light, sun: camera.clone(), sky: camera };
    /// assert_eq!(lighting.flat_rgb(0.8, &[1.0, 1.0]), [1.0]); // 0.8 from the sun, 0.2 from the sky
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn flat_rgb(&self, cos: f64, reflectance: &[f64]) -> Vec<f64> {
        let seen = |camera: &CameraResponse, channel| -> f64 {
            camera.channel(channel).iter().zip(reflectance).map(|(weight, r)| weight * r).sum()
        };
        (0..self.sun.channels())
            .map(|channel| cos * seen(&self.sun, channel) + self.light.sky() * seen(&self.sky, channel))
            .collect()
    }

    /// The wavebands in which at least one channel sees one of the lights.
    #[must_use]
    pub fn seen_bands(&self) -> Vec<usize> {
        seen_bands(self.sources().map(|(_, camera)| camera))
    }
}

fn seen_bands<'a>(cameras: impl Iterator<Item = &'a CameraResponse> + Clone) -> Vec<usize> {
    let bands = cameras.clone().next().map_or(0, CameraResponse::bands);
    (0..bands).filter(|band| cameras.clone().any(|camera| camera.sees(*band))).collect()
}

/// A light on a fold of known response, and how the camera sees it.
pub struct Lit<'a> {
    /// Which of the responses.
    pub response: usize,
    /// The light.
    pub light: ModeLight,
    /// The camera's response to it.
    pub camera: &'a CameraResponse,
}

/// A card of known reflectance in the place of one panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Its panel, 0 or 1; the other is the sheet.
    pub panel: usize,
    /// Reflectance a waveband.
    pub reflectance: Vec<f64>,
}

/// Facet RGB of a fold under known light, for any reflectance of its panels.
#[derive(Clone, Debug)]
pub struct FacetModel {
    poles: Vec<f64>,
    panels: Panels,
    sources: Vec<Source>,
    seen_bands: Vec<usize>,
}

/// Whether both panels are of one sheet.
#[derive(Clone, Debug)]
enum Panels {
    /// One sheet, lit unevenly (odd modes excited) or evenly.
    One { odd: bool },
    /// The sheet beside a card.
    Card(Card),
}

/// One light: how much of each term every facet takes, and how the camera sees it.
#[derive(Clone, Debug)]
pub struct Source {
    /// Facet by term.
    pub facets: DMatrix<f64>,
    /// The camera's response to this light.
    pub camera: CameraResponse,
}

impl FacetModel {
    /// A fold of one sheet.
    #[must_use]
    pub fn one_sheet(response: &Response, lighting: &Lighting) -> Self {
        Self::under(response, lighting, None)
    }

    /// A fold whose `panel` (0 or 1) is a card of known `reflectance` on the scene's wavelengths, the other one the sheet.
    #[must_use]
    pub fn with_card(response: &Response, lighting: &Lighting, panel: usize, reflectance: Vec<f64>) -> Self {
        Self::under(response, lighting, Some(Card { panel, reflectance }))
    }

    fn under(response: &Response, lighting: &Lighting, card: Option<Card>) -> Self {
        let lights: Vec<Lit> =
            lighting.sources().map(|(light, camera)| Lit { response: 0, light, camera }).collect();
        Self::new(std::slice::from_ref(response), &lights, card)
    }

    /// A fold of one sheet, or of a sheet and a card, with a source for each of `lights`. Several `responses`, of as many
    /// facets each, are the fold at several angles.
    #[must_use]
    pub fn new(responses: &[Response], lights: &[Lit], card: Option<Card>) -> Self {
        let poles = responses.iter().flat_map(Response::poles).collect();
        let odd = responses.iter().any(|response| matches!(response.modes(), Modes::Separate(_)))
            || lights.iter().any(|lit| lit.light.is_uneven());
        let panels = card.map_or(Panels::One { odd }, Panels::Card);
        let seen_bands = seen_bands(lights.iter().map(|lit| lit.camera));
        let mut model = Self { poles, panels, sources: Vec::new(), seen_bands };
        for lit in lights {
            let first = responses[..lit.response].iter().map(|response| response.poles().len()).sum();
            model.add_source(&responses[lit.response], first, lit);
        }
        model
    }

    /// Adds a light on a fold whose poles begin at `first`.
    fn add_source(&mut self, response: &Response, first: usize, lit: &Lit) {
        let count = response.facets();
        let mut facets = DMatrix::zeros(2 * count, self.terms());
        let poles = self.poles.len();
        for facet in 0..2 * count {
            let panel = facet / count;
            for (k, mode) in (first..).zip(response.excitations(panel, facet % count, lit.light)) {
                match &self.panels {
                    Panels::One { odd } => {
                        facets[(facet, k)] = 0.5 * (mode.own + mode.other);
                        if *odd {
                            facets[(facet, poles + k)] = 0.5 * (mode.own - mode.other);
                        }
                    }
                    Panels::Card(card) => {
                        let own = if panel == card.panel { 2 } else { 0 };
                        facets[(facet, own * poles + k)] = mode.own;
                        facets[(facet, poles + k)] = mode.other;
                    }
                }
            }
        }
        self.sources.push(Source { facets, camera: lit.camera.clone() });
    }

    /// Number of terms: functions of reflectance that all facets combine.
    #[must_use]
    pub fn terms(&self) -> usize {
        self.poles.len()
            * match self.panels {
                Panels::One { odd: false } => 1,
                Panels::One { odd: true } => 2,
                Panels::Card(_) => 3,
            }
    }

    /// Number of wavebands.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.sources[0].camera.bands()
    }

    /// The lights, each with what facets take of the terms.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The terms for a spectrum: term by waveband.
    ///
    /// One sheet: `r/(1 − rg)`, then `r/(1 + rg)` where panels are lit unevenly. With a card c: `r/d`, `rcg/d`, `c/d`,
    /// `d = 1 − rcg²`. Never `1/r`: black is a legal reflectance.
    #[must_use]
    pub fn terms_of(&self, reflectance: &[f64]) -> DMatrix<f64> {
        self.terms_in(0..reflectance.len(), reflectance, Family::value)
    }

    /// The terms with their first and second derivatives by reflectance.
    #[must_use]
    pub fn derivatives_of(&self, reflectance: &[f64]) -> [DMatrix<f64>; 3] {
        let mut all = [(); 3].map(|()| DMatrix::zeros(self.terms(), reflectance.len()));
        let poles = self.poles.len();
        for (band, r) in reflectance.iter().enumerate() {
            for (n, family) in self.families(band).iter().enumerate() {
                let rows = band * self.terms() + n * poles;
                let [values, slopes, curvatures] =
                    all.each_mut().map(|matrix| &mut matrix.as_mut_slice()[rows..rows + poles]);
                let targets = values.iter_mut().zip(slopes).zip(curvatures);
                for (((value, slope), curvature), g) in targets.zip(&self.poles) {
                    [*value, *slope, *curvature] = family.at(*r, *g);
                }
            }
        }
        all
    }

    /// What `of` makes of every family, pole and waveband of `bands`: term by waveband.
    fn terms_in(
        &self,
        bands: impl ExactSizeIterator<Item = usize>,
        reflectance: &[f64],
        of: impl Fn(&Family, f64, f64) -> f64,
    ) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.terms(), bands.len());
        for (mut column, band) in all.column_iter_mut().zip(bands) {
            let families = self.families(band);
            let targets = column.as_mut_slice().chunks_exact_mut(self.poles.len().max(1));
            for (target, family) in targets.zip(families.iter()) {
                for (value, g) in target.iter_mut().zip(&self.poles) {
                    *value = of(family, reflectance[band], *g);
                }
            }
        }
        all
    }

    /// The families of terms in a waveband.
    fn families(&self, band: usize) -> Families {
        match &self.panels {
            Panels::One { odd } => Families { all: [EVEN, ODD, ODD], count: 1 + usize::from(*odd) },
            Panels::Card(card) => beside_card(card.reflectance[band]),
        }
    }

    /// RGB of every facet at exposure 1: facet by channel, facet order panel, row, column.
    ///
    /// # Source
    /// Deeb et al., eq. (24), for the uniform sheet eq. (33).
    #[must_use]
    pub fn facet_rgb(&self, reflectance: &[f64]) -> DMatrix<f64> {
        self.rgb_of(reflectance, Family::value)
    }

    /// What light adds to [`FacetModel::facet_rgb`] that has been reflected from panel to panel more than `bounces` times.
    ///
    /// # Source
    /// Deeb et al., eqs. (5) to (7) and (11) to (14): light after b bounces is a mode's share times its pole to the b, so
    /// that the sum over b > `bounces` has a closed form.
    #[must_use]
    pub fn facet_rgb_after(&self, bounces: u32, reflectance: &[f64]) -> DMatrix<f64> {
        self.rgb_of(reflectance, |family, r, g| family.value_after(bounces, r, g))
    }

    /// What the mean of `facets` takes of each waveband of the reflectance, where light does not bounce: channel by waveband.
    /// None for a folded sheet, whose RGB is no linear function of reflectance, or beside a card.
    #[must_use]
    pub fn without_bounces(&self, facets: &[usize]) -> Option<DMatrix<f64>> {
        if matches!(self.panels, Panels::Card(_)) || self.poles.iter().any(|pole| pole.abs() > 0.0) {
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

    /// RGB of every facet, `of` being what a family makes of reflectance and pole.
    fn rgb_of(&self, reflectance: &[f64], of: impl Fn(&Family, f64, f64) -> f64) -> DMatrix<f64> {
        let bands = &self.seen_bands;
        let terms = self.terms_in(bands.iter().copied(), reflectance, of);
        let of_source = |source: &Source| {
            let camera = &source.camera;
            let weights =
                DMatrix::from_fn(bands.len(), camera.channels(), |n, c| camera.channel(c)[bands[n]]);
            &source.facets * (&terms * weights)
        };
        self.sources.iter().map(of_source).sum()
    }
}

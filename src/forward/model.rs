//! Facet RGB of a fold as a linear combination of a few functions of reflectance.
//!
//! Every facet's radiance is a sum over the poles of the response; the poles and what the reflectance makes of them are
//! common to all facets: eqs. (33) to (35) with the poles in place of all eigenvalues. So the spectrum is integrated
//! once a pole and channel, not once a facet and channel.

use nalgebra::DMatrix;

use crate::camera::CameraResponse;
use crate::geometry::Light;
use crate::response::Response;

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

/// Facet RGB of a fold under known light, for any reflectance of its panels.
#[derive(Clone, Debug)]
pub struct FacetModel {
    poles: Vec<f64>,
    panels: Panels,
    sources: Vec<Source>,
}

/// Whether both panels are of one sheet.
#[derive(Clone, Debug)]
enum Panels {
    /// One sheet, lit unevenly (odd modes excited) or evenly.
    One { odd: bool },
    /// Panel 0 is the sheet, panel 1 a card of known reflectance a waveband.
    Card(Vec<f64>),
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
        let [e0, e1] = lighting.light.panel_irradiance();
        Self::new(response, lighting, Panels::One { odd: (e0 - e1).abs() > 0.0 })
    }

    /// A fold of a sheet (panel 0) and a card (panel 1) whose reflectance is known on the scene's wavelengths.
    #[must_use]
    pub fn with_card(response: &Response, lighting: &Lighting, card: Vec<f64>) -> Self {
        Self::new(response, lighting, Panels::Card(card))
    }

    fn new(response: &Response, lighting: &Lighting, panels: Panels) -> Self {
        let sky = lighting.light.sky();
        let mut model = Self { poles: response.poles().to_vec(), panels, sources: Vec::new() };
        let sun = lighting.light.panel_irradiance();
        model.add_source(response, &lighting.sun, |_| sun);
        if sky > 0.0 {
            // A panel sees the sky that the other one does not hide: 1 − F·1, in the modes of F.
            model.add_source(response, &lighting.sky, |pole| [sky * (1.0 - pole); 2]);
        }
        model
    }

    fn add_source(
        &mut self,
        response: &Response,
        camera: &CameraResponse,
        on_mode: impl Fn(f64) -> [f64; 2],
    ) {
        let count = response.facets();
        let mut facets = DMatrix::zeros(2 * count, self.terms());
        let poles = self.poles.len();
        for facet in 0..2 * count {
            let (panel, residues) = (facet / count, response.facet_residues(facet % count));
            for (k, (residue, pole)) in residues.iter().zip(&self.poles).enumerate() {
                let light = on_mode(*pole);
                let (own, other) = (light[panel], light[1 - panel]);
                match self.panels {
                    Panels::One { odd } => {
                        facets[(facet, k)] = residue * 0.5 * (own + other);
                        if odd {
                            facets[(facet, poles + k)] = residue * 0.5 * (own - other);
                        }
                    }
                    Panels::Card(_) => {
                        facets[(facet, 2 * panel * poles + k)] = residue * own;
                        facets[(facet, poles + k)] = residue * other;
                    }
                }
            }
        }
        self.sources.push(Source { facets, camera: camera.clone() });
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
        self.sources[0].camera.channel(0).len()
    }

    /// The lights, each with what facets take of the terms.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The terms at reflectance `r` in waveband `band`, each with its first and second derivative by `r`.
    ///
    /// One sheet: `r/(1 − rg)`, then `r/(1 + rg)` where panels are lit unevenly. With a card c: `r/d`, `rcg/d`, `c/d`,
    /// `d = 1 − rcg²`. Never `1/r`: black is a legal reflectance.
    pub fn terms_at(&self, r: f64, band: usize) -> impl Iterator<Item = [f64; 3]> + '_ {
        let families: &[Family] = match &self.panels {
            Panels::One { odd: false } => &[|r, _, g| rational(r, 1.0, g)],
            Panels::One { odd: true } => &[|r, _, g| rational(r, 1.0, g), |r, _, g| rational(r, 1.0, -g)],
            Panels::Card(_) => &[
                |r, c, g| rational(r, 1.0, c * g * g),
                |r, c, g| rational(r, c * g, c * g * g),
                // c/d = c + c²g²·r/d
                |r, c, g| {
                    let [value, slope, curvature] = rational(r, c * c * g * g, c * g * g);
                    [c + value, slope, curvature]
                },
            ],
        };
        let card = match &self.panels {
            Panels::Card(card) => card[band],
            Panels::One { .. } => 0.0,
        };
        families.iter().flat_map(move |family| self.poles.iter().map(move |g| family(r, card, *g)))
    }

    /// RGB of every facet at exposure 1: facet by channel, facet order panel, row, column.
    ///
    /// # Source
    /// Deeb et al., eq. (24), for the uniform sheet eq. (33).
    #[must_use]
    pub fn facet_rgb(&self, reflectance: &[f64]) -> DMatrix<f64> {
        let channels = self.sources[0].camera.channels();
        let mut moments = vec![DMatrix::zeros(self.terms(), channels); self.sources.len()];
        for (band, r) in reflectance.iter().enumerate() {
            for (term, [value, ..]) in self.terms_at(*r, band).enumerate() {
                for (source, moments) in self.sources.iter().zip(&mut moments) {
                    for channel in 0..channels {
                        moments[(term, channel)] += source.camera.channel(channel)[band] * value;
                    }
                }
            }
        }
        self.sources.iter().zip(&moments).map(|(source, moments)| &source.facets * moments).sum()
    }
}

/// A term as a function of reflectance, of the card's reflectance and of a pole.
type Family = fn(f64, f64, f64) -> [f64; 3];

/// `a·r/(1 − b·r)` with its first and second derivative by r.
fn rational(r: f64, a: f64, b: f64) -> [f64; 3] {
    let rest = 1.0 / (1.0 - b * r);
    let slope = a * rest * rest;
    [a * r * rest, slope, 2.0 * b * slope * rest]
}

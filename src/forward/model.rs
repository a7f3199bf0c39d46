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

    /// Values and derivatives of the terms at reflectance `r` in waveband `band`.
    ///
    /// One sheet: `r/(1 − rg)`, then `r/(1 + rg)` where panels are lit unevenly. With a card c: `r/d`, `rcg/d`, `c/d`,
    /// `d = 1 − rcg²`. Never `1/r`: black is a legal reflectance.
    pub fn terms_at(&self, r: f64, band: usize, values: &mut [f64], slopes: &mut [f64]) {
        let count = self.poles.len();
        for (k, g) in self.poles.iter().enumerate() {
            let mut put = |n: usize, value: f64, slope: f64| {
                (values[n * count + k], slopes[n * count + k]) = (value, slope)
            };
            match &self.panels {
                Panels::One { odd } => {
                    let (even_rest, odd_rest) = (1.0 / (1.0 - r * g), 1.0 / (1.0 + r * g));
                    put(0, r * even_rest, even_rest * even_rest);
                    if *odd {
                        put(1, r * odd_rest, odd_rest * odd_rest);
                    }
                }
                Panels::Card(card) => {
                    let c = card[band];
                    let rest = 1.0 / (1.0 - r * c * g * g);
                    put(0, r * rest, rest * rest);
                    put(1, r * c * g * rest, c * g * rest * rest);
                    put(2, c * rest, c * c * g * g * rest * rest);
                }
            }
        }
    }

    /// RGB of every facet at exposure 1: facet by channel, facet order panel, row, column.
    ///
    /// # Source
    /// Deeb et al., eq. (24), for the uniform sheet eq. (33).
    #[must_use]
    pub fn facet_rgb(&self, reflectance: &[f64]) -> DMatrix<f64> {
        let terms = self.terms();
        let (mut values, mut slopes) = (vec![0.0; terms], vec![0.0; terms]);
        let channels = self.sources[0].camera.channels();
        let mut moments = vec![DMatrix::zeros(terms, channels); self.sources.len()];
        for (band, r) in reflectance.iter().enumerate() {
            self.terms_at(*r, band, &mut values, &mut slopes);
            for (source, moments) in self.sources.iter().zip(&mut moments) {
                for channel in 0..channels {
                    let weight = source.camera.channel(channel)[band];
                    moments.column_mut(channel).iter_mut().zip(&values).for_each(|(m, v)| *m += weight * v);
                }
            }
        }
        self.sources.iter().zip(&moments).map(|(source, moments)| &source.facets * moments).sum()
    }
}

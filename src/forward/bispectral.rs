//! A sheet described by a Donaldson matrix, which light excites again at every bounce.

use nalgebra::{DMatrix, DVector};

use super::model::FacetModel;
use crate::error::{Error, Result};
use crate::spectrum::{Bispectral, Outside, Spectrum, WavelengthGrid};

/// A surface made of one matte sheet that is excited by all light falling on it.
///
/// One kernel serves all wavelengths. Within a mode of pole g the wavebands exchange light as patches do: b =
/// (I − gD)⁻¹ D s for the light s and the Donaldson matrix D.
#[derive(Clone, Debug)]
pub struct BispectralSheet<'a> {
    model: &'a FacetModel,
    sheet: &'a Bispectral,
    lights: &'a [BispectralLight],
}

/// The power of a light in the wavebands of a scene and in the bands that excite a sheet, in the same unit.
#[derive(Clone, Debug, PartialEq)]
pub struct BispectralLight {
    in_scene: Vec<f64>,
    in_bands: DVector<f64>,
}

impl BispectralLight {
    /// Samples `light`; excitation bands that it does not cover count as dark.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if it does not cover `grid`, or has no power in a waveband in which the sheet
    /// fluoresces: emission is expressed relative to white in the same light.
    pub fn new(light: &Spectrum, grid: &WavelengthGrid, sheet: &Bispectral) -> Result<Self> {
        let in_scene = light.on(grid, Outside::Refuse)?;
        let in_bands: DVector<f64> = light.on(&sheet.excitation, Outside::Zero)?.into();
        let emitted = &sheet.fluorescence * &in_bands;
        let mut bands = in_scene.iter().zip(&emitted);
        if let Some(dark) = bands.position(|(power, emitted)| *power <= 0.0 && *emitted > 0.0) {
            return Err(Error::Spectrum {
                name: light.name().to_owned(),
                problem: format!(
                    "it has no power at {} nm, where the sheet fluoresces",
                    grid.wavelengths_nm()[dark]
                ),
                remedy: "choose other wavelengths or another light: emission is a fraction \
                         of white's light"
                    .to_owned(),
            });
        }
        Ok(Self { in_scene, in_bands })
    }

    fn is_dark(&self) -> bool {
        self.in_scene.iter().chain(&self.in_bands).all(|power| power.abs() < f64::MIN_POSITIVE)
    }
}

impl<'a> BispectralSheet<'a> {
    /// The sheet of a model, with a light for each of its sources.
    ///
    /// # Errors
    /// [`Error::Field`] if a part of the surface has a known reflectance, as that does not cover the
    /// ultraviolet.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::camera::CameraResponse;
    /// use vfold::forward::{BispectralLight, BispectralSheet, FacetModel};
    /// use vfold::surfaces::{DenseExchange, SurfaceResponse};
    /// use vfold::spectrum::{Donaldson, Spectrum, WavelengthGrid};
    /// // Two like patches hand half of their light to each other, both are lit: a pole of 0.5.
    /// let exchange = DenseExchange::new(&dmatrix![0.0, 0.5; 0.5, 0.0], &[1.0, 1.0], vec![0, 1]);
    /// let (response, _) = SurfaceResponse::solve(&exchange, &[1.0, 1.0], 1e-12)?;
    /// let model = FacetModel::of_surface(&[(response, CameraResponse::from_weights(vec![vec![0.0, 1.0]]))]);
    /// let grid = WavelengthGrid::new(vec![400.0, 450.0])?;
    /// let sheet =
    ///     Donaldson::new("cloth", grid.clone(), grid.clone(), &dmatrix![0.5, 0.0; 0.1, 0.8])?.on(&grid)?;
    /// let light = BispectralLight::new(&Spectrum::flat("E", 1.0), &grid, &sheet)?;
    /// let rgb = BispectralSheet::new(&model, &sheet, &[light])?.facet_rgb();
    /// let first = 0.5 / (1.0 - 0.25);
    /// assert!((rgb[0] - (0.8 + 0.1 * (1.0 + 0.5 * first)) / (1.0 - 0.4)).abs() < 1e-12);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    ///
    /// # Panics
    /// If the number of lights differs from the number of sources.
    pub fn new(model: &'a FacetModel, sheet: &'a Bispectral, lights: &'a [BispectralLight]) -> Result<Self> {
        assert_eq!(lights.len(), model.sources().len(), "one light per source");
        if model.is_of_one_sheet() {
            return Ok(Self { model, sheet, lights });
        }
        let problem = "fluorescence is not computed beside parts of known reflectance; \
                       fold the sheet alone";
        Err(Error::field("fluorescence", problem))
    }

    /// Total radiance factor of the flat sheet in the first light, one number from 0 per waveband.
    #[must_use]
    pub fn total_radiance_factor(&self) -> Vec<f64> {
        self.lights.first().map_or_else(Vec::new, |light| self.sent(light, 0.0))
    }

    /// RGB of every facet at exposure 1, as [`FacetModel::facet_rgb`].
    #[must_use]
    pub fn facet_rgb(&self) -> DMatrix<f64> {
        self.model.rgb_of_modes(|source, g| self.sent(&self.lights[source], g))
    }

    /// The part of it that has bounced more than `bounces` times, as [`FacetModel::facet_rgb_after`].
    #[must_use]
    pub fn facet_rgb_after(&self, bounces: u32) -> DMatrix<f64> {
        self.model.rgb_of_modes(|source, g| self.sent_after(bounces, &self.lights[source], g))
    }

    /// Light leaving a mode of pole `g` per waveband, relative to the light.
    fn sent(&self, light: &BispectralLight, g: f64) -> Vec<f64> {
        self.sent_of(light, light, g)
    }

    /// The part of it that has bounced more than `bounces` times.
    fn sent_after(&self, bounces: u32, light: &BispectralLight, g: f64) -> Vec<f64> {
        let mut falling = light.clone();
        for _ in 0..=bounces {
            falling = self.next_bounce(&falling, g);
            if falling.is_dark() {
                break;
            }
        }
        self.sent_of(&falling, light, g)
    }

    /// Light leaving a mode of pole `g`, all bounces included, when `falling` arrives, relative to `light`.
    fn sent_of(&self, falling: &BispectralLight, light: &BispectralLight, g: f64) -> Vec<f64> {
        let bands = falling.in_bands.len();
        let exchange = DMatrix::identity(bands, bands) - g * &self.sheet.between_bands;
        // Poles and reflectances are below 1, and emission never excites itself: a solution exists.
        let in_all = exchange.lu().solve(&falling.in_bands).unwrap_or_else(|| falling.in_bands.clone());
        let emitted = &self.sheet.fluorescence * in_all;
        let bands =
            self.sheet.reflectance.iter().zip(&emitted).zip(falling.in_scene.iter().zip(&light.in_scene));
        let part = |((r, emitted), (falling, light)): ((&f64, &f64), (&f64, &f64))| {
            let in_light = |power: f64| if *light > 0.0 { power / light } else { 0.0 };
            (r * in_light(*falling) + in_light(*emitted)) / (1.0 - r * g)
        };
        bands.map(part).collect()
    }

    /// Light arriving at a mode of pole `g` one bounce after `light` arrives.
    fn next_bounce(&self, light: &BispectralLight, g: f64) -> BispectralLight {
        let emitted = &self.sheet.fluorescence * &light.in_bands;
        let reflected = self.sheet.reflectance.iter().zip(&light.in_scene).map(|(r, power)| r * power);
        BispectralLight {
            in_scene: reflected.zip(&emitted).map(|(reflected, emitted)| g * (reflected + emitted)).collect(),
            in_bands: g * &self.sheet.between_bands * &light.in_bands,
        }
    }
}

//! vfold measures the spectral reflectance of a matte sheet with an ordinary camera.
//!
//! Fold the sheet into a V and photograph it in the sun: light that has been reflected n times in the fold
//! carries the n-th power of the reflectance, so the colour gradient along the panels holds far more than
//! three numbers. The five tools in `src/bin` are thin; everything they do is here. A single call,
//! [`measure::sheet`], leads from a photograph to a spectrum.
//!
//! The method is that of R. Deeb, D. Muselet, M. Hébert, A. Trémeau, "Spectral reflectance estimation from
//! one RGB image using self-interreflections in a concave object", *Applied Optics* 57 (2018), p. 4918. Where
//! to find its equations:
//!
//! | equation | what it says | here |
//! |---|---|---|
//! | eq. (1), eq. (4) | light between surfaces as integrals | [`kernel::continuum`] |
//! | eq. (2) | geometrical kernel of two points | [`paper::form_factors`], averaged over facets |
//! | eq. (2) | the same as printed, at facet centres | [`paper::midpoint::form_factors`] |
//! | eq. (2) | the same on any surface, hidden parts left out | [`surfaces::kernel::SurfaceKernel`] |
//! | eqs. (5) to (7) and (11) to (14) | light bounce by bounce | [`paper::bounces`], [`forward::FacetModel::facet_rgb_after`] |
//! | eq. (10) | kernel matrix of the facets | [`paper::FoldKernel::matrix_row`] |
//! | eq. (16) | radiance after all bounces | [`response::Response::solve`], [`surfaces::SurfaceResponse::solve`] |
//! | eq. (17), eq. (18) | camera response | [`camera::CameraResponse`] |
//! | eq. (15), eq. (24) | facet RGB, one reflectance per facet | [`paper::nonuniform`] |
//! | eq. (24) | the same, one reflectance per panel | [`forward::FacetModel::facet_rgb`] |
//! | eq. (24) | the same, known parts of a surface next to an unknown one | [`surfaces::ReducedExchange::with_known`] |
//! | eqs. (26) to (28) | one reflectance: modes of the kernel | [`response::Response`] |
//! | eqs. (33) to (35) | RGB as modes times functions of r | [`forward::model`] |
//! | eq. (36) | the estimate as a bounded minimum | [`paper::smooth`]; [`estimate::map`] with a better prior |
//! | - | the rivals of section 5C, on flat sheets | [`paper::park`], [`paper::khan`] |
//! | eq. (37), eq. (38) | RMSE, "Pearson distance" | [`score`] |
//!
//! Two modules can be skipped on a first reading: [`paper`], the method as published and its rivals, and
//! [`surfaces`], shapes other than folds. Dependencies point downwards only; the tools in `src/bin` are above
//! all others, [`error`] is below:
//!
//! ```text
//! report               -> scene, stream, estimate, score, plot, image, colorimetry, spectrum, files, markup
//! cli                  -> scene, stream, spectrum, progress, files, message, room
//! measure              -> scene, stream, estimate, forward, kernel, geometry, camera, spectrum, image
//! scene                -> stream, surfaces, estimate, forward, transport, sheet, kernel, response, image
//! scene                -> geometry, camera, colorimetry, spectrum, plot
//! stream               -> paper, surfaces, estimate, forward, kernel, response, solve, geometry, spectrum
//! stream               -> image, calibrate, score, plot, colorimetry, progress, parallel, files, room
//! paper                -> surfaces, estimate, forward, kernel, response, solve, geometry, camera, room
//! estimate             -> forward, sheet, kernel, response, solve, geometry, camera, spectrum, image
//! surfaces             -> forward, kernel, response, solve, geometry, camera, image
//! forward              -> response, geometry, camera, image, colorimetry, spectrum
//! transport            -> sheet, kernel, geometry
//! sheet                -> kernel
//! kernel               -> response, solve, geometry, room
//! response             -> solve
//! plot                 -> image, geometry, files, markup, message
//! image                -> geometry, colorimetry, files, room
//! score, camera        -> colorimetry
//! camera               -> solve
//! camera, colorimetry  -> spectrum
//! spectrum             -> files, markup, message
//! progress, markup     -> message
//! ```
//!
//! The chart's polynomials (section 5D) are in [`calibrate`], which knows only patches. Only [`stream`] knows
//! JSON, including that of spectra; [`spectrum::formats`] knows other files of spectra, [`image`] alone knows
//! pixels, and [`solve`] knows bounds and priors but no optics.

pub mod calibrate;
pub mod camera;
pub mod cli;
pub mod colorimetry;
pub mod error;
pub mod estimate;
pub mod files;
pub mod forward;
pub mod geometry;
pub mod image;
pub mod kernel;
pub mod markup;
pub mod measure;
pub mod message;
pub mod paper;
pub mod parallel;
pub mod plot;
pub mod progress;
pub mod report;
pub mod response;
pub mod room;
pub mod scene;
pub mod score;
pub mod sheet;
pub mod solve;
pub mod spectrum;
pub mod stream;
pub mod surfaces;
pub mod transport;

pub use error::{Error, Result};

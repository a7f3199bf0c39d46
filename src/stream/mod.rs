//! The stream between the tools: NDJSON records, and NPY arrays beside them.
//!
//! This is the only place that knows JSON. A record keeps every field it came with; the tools read the fields they know
//! through typed views and add their own.

mod calibration;
mod colours;
mod development;
mod drawn;
mod estimate;
mod fields;
mod geometry;
mod given_kernel;
mod history;
mod json_file;
mod light;
mod materials;
mod model;
mod npy;
mod npy_reader;
mod optics;
mod outline;
mod panels;
mod photograph;
mod pipe;
mod plan;
mod rawtoaces;
mod reader;
mod regions;
mod regions_file;
mod residuals;
mod response;
mod resume;
mod sample;
mod saves;
mod scene;
mod shape_file;
mod surface;
mod unknowns;
mod writer;

pub use calibration::CalibrationRecord;
pub use colours::Colours;
pub use development::read_development;
pub use fields::{Fields, finite};
pub use given_kernel::GivenKernel;
pub use history::HistoryLine;
pub use materials::Material;
pub use model::ReferencePanel;
pub use npy::{ArrayStack, write_matrix};
pub use npy_reader::{read_matrix, read_rows, read_square};
pub use optics::{CameraRecord, Optics, SpectrumRecord};
pub use photograph::ImageRecord;
pub use pipe::{Transform, pipe};
pub use plan::{ExpectedError, plan};
pub use rawtoaces::{camera, illuminant, reflectances};
pub use reader::{Reader, Record};
pub use regions::{Corners, Regions};
pub use regions_file::RegionsFile;
pub use resume::Kept;
pub use sample::{ReflectanceRecord, Sample, summary};
pub use saves::Saves;
pub use scene::{Scene, SkippedRecord};
pub use shape_file::read_shape;
pub use surface::Surface;
pub use writer::Output;

//! Pictures out: simulated photographs, previews, overlays, thumbnails.

mod overlay;
mod preview;
mod thumbnail;
mod write;

pub use overlay::write_overlay;
pub use preview::write_preview;
pub use thumbnail::{Thumbnail, thumbnail};
pub use write::{png_bytes, write_linear, write_srgb_png};

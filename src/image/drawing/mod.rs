//! Pictures out: simulated photographs, previews, overlays, thumbnails.

mod balance;
mod overlay;
mod preview;
mod thumbnail;
mod words;
mod write;

pub use balance::{Balance, White};
pub use overlay::write_overlay;
pub use preview::{is_preview, write_preview};
pub use thumbnail::{Thumbnail, thumbnail};
pub use write::{png_bytes, write_linear, write_srgb_png};

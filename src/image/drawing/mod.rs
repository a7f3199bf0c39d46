//! Picture output: simulated photographs, previews, overlays, thumbnails.

mod balance;
mod for_the_eye;
mod overlay;
mod preview;
mod thumbnail;
mod words;
mod write;

pub use balance::{Balance, White};
pub use for_the_eye::is_for_the_eye;
pub use overlay::write_overlay;
pub use preview::write_preview;
pub use thumbnail::{Thumbnail, thumbnail};
pub use write::{png_bytes, write_linear, write_srgb_png};

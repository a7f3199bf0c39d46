//! Rendered photographs: a pinhole camera, and the light along its lines of sight.

mod fold;
mod picture;
mod pinhole;

pub use fold::FoldView;
pub use picture::Picture;
pub use pinhole::{Frame, Pinhole, Stand, Viewpoint};

//! The picture of the measured facets drawn by `vextract --overlay`.
//!
//! Only the command line determines which pictures are read: a stream may come from anyone, and can only
//! assign them to its samples.

use std::path::{Component, Path, PathBuf};

use super::html::Html;
use super::{Gallery, SECTIONS_MAX, View};
use crate::error::{Error, Result};
use crate::files::{is_pattern, named};
use crate::image::thumbnail;
use crate::plot::data_uri;

/// Longest side in a report, px: large enough to distinguish facets.
const LONGEST_PX: u32 = 1100;

/// Refuses a picture that belongs to no sample.
///
/// # Errors
/// [`Error::Usage`] if a picture has no sample's name, although only its name could assign it.
pub(super) fn check(gallery: &Gallery, view: &View) -> Result<()> {
    let (failures, failed) = gallery.failures();
    let are_all_known = gallery.seen() <= SECTIONS_MAX && failed <= failures.len();
    let of_a_sample = |path: &&PathBuf| {
        let shown = gallery.in_order().map(|shown| shown.sample.id());
        is_pattern(path) || shown.chain(failures.iter().map(|(id, _)| id.clone())).any(|id| is_of(path, &id))
    };
    match view.overlays.iter().find(|path| !of_a_sample(path)) {
        Some(path) if are_all_known && !is_the_only(gallery, view) => Err(Error::usage(
            "--overlay",
            format!("no sample has the name of {}", path.display()),
            "name pictures after their samples, or put {} in the name, as in overlay-{}.png",
        )),
        _ => Ok(()),
    }
}

/// Whether there is one picture, and one sample that it can belong to.
fn is_the_only(gallery: &Gallery, view: &View) -> bool {
    gallery.seen() == 1 && view.overlays.len() == 1
}

/// The picture of the sample of this name; none if none was stated.
///
/// # Errors
/// [`Error::Field`] if its name would lead to another folder; as [`thumbnail`].
pub(super) fn figure(id: &str, gallery: &Gallery, view: &View) -> Result<Option<Html>> {
    let exact = |path: &&PathBuf| !is_pattern(path) && (is_the_only(gallery, view) || is_of(path, id));
    let found =
        view.overlays.iter().find(exact).or_else(|| view.overlays.iter().find(|path| is_pattern(path)));
    let Some(path) = found else { return Ok(None) };
    if is_pattern(path) && !is_name(id) {
        let problem = format!("'{id}' in the name of --overlay leads to another folder; name its picture");
        return Err(Error::field("id", problem));
    }
    picture(&named(path, id), id).map(Some)
}

/// Whether a picture has the name of a sample.
fn is_of(path: &Path, id: &str) -> bool {
    path.file_stem().is_some_and(|stem| stem == id)
}

/// Whether a text is a file name, not a path.
fn is_name(id: &str) -> bool {
    let mut parts = Path::new(id).components();
    matches!((parts.next(), parts.next()), (Some(Component::Normal(name)), None) if name == id)
}

fn picture(path: &Path, id: &str) -> Result<Html> {
    let small = thumbnail(path, LONGEST_PX)?;
    let attributes = [
        ("src", data_uri("image/jpeg", &small.jpeg)),
        ("width", small.width.to_string()),
        ("height", small.height.to_string()),
        ("alt", format!("photograph of {id} with its panels and facets")),
    ];
    let attributes = attributes.each_ref().map(|(name, value)| (*name, value.as_str()));
    let colours = small.caption.map(|caption| format!(" Colours: {caption}.")).unwrap_or_default();
    let caption =
        format!("What was measured: panels and facets; pixels that were left out are red.{colours}");
    Ok(Html::figure(Html::empty("img", &attributes), &caption))
}

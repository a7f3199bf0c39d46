//! The picture of what was measured, as `vextract --overlay` wrote it.

use std::path::{Path, PathBuf};

use super::html::Html;
use super::{Shown, View};
use crate::error::Result;
use crate::image::thumbnail;
use crate::plot::data_uri;

/// Longest side in a report, px: facets can be told apart.
const LONGEST_PX: u32 = 1100;

/// The picture of a sample; none if there is none.
///
/// # Errors
/// As [`thumbnail`], if the picture was asked for; one that the history tells of may have gone.
pub(super) fn figure(shown: &Shown, view: &View) -> Result<Option<Html>> {
    let id = shown.sample.id();
    match &view.overlay {
        Some(pattern) => picture(&named(pattern, &id), &id).map(Some),
        None => Ok(recorded(shown)?.and_then(|pattern| picture(&named(&pattern, &id), &id).ok())),
    }
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
    let caption = "What was measured: panels and facets, and red the pixels that were left out.";
    Ok(Html::figure(Html::empty("img", &attributes), caption))
}

/// Where vextract was told to draw it.
fn recorded(shown: &Shown) -> Result<Option<PathBuf>> {
    let history = shown.scene.fields.history()?;
    let extract = history.iter().rev().find(|line| line.tool == "vextract");
    Ok(extract.and_then(|line| {
        let mut arguments = line.arguments.iter();
        arguments.find_map(|argument| argument.strip_prefix("--overlay=")).map(PathBuf::from).or_else(|| {
            let flag = line.arguments.iter().position(|argument| argument == "--overlay")?;
            line.arguments.get(flag + 1).map(PathBuf::from)
        })
    }))
}

fn named(pattern: &Path, id: &str) -> PathBuf {
    PathBuf::from(pattern.to_string_lossy().replace("{}", id))
}

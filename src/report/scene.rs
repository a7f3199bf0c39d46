//! The sections on the scenes of the samples shown: what was computed, how, and what was skipped.

use std::sync::Arc;

use super::Gallery;
use super::command::pipeline;
use super::html::Html;
use super::tables::{folded, pairs};
use super::words::words;
use crate::error::Result;
use crate::stream::Scene;

/// Fields with their own table, or too large to read.
const SHOWN_ELSEWHERE: [&str; 4] = ["kind", "history", "response", "skipped"];

/// One section per scene.
pub(super) fn sections(gallery: &Gallery) -> Result<Vec<Html>> {
    let mut scenes: Vec<&Arc<Scene>> = Vec::new();
    for shown in gallery.in_order() {
        if !scenes.iter().any(|scene| Arc::ptr_eq(scene, &shown.scene)) {
            scenes.push(&shown.scene);
        }
    }
    scenes.into_iter().map(|scene| section(scene)).collect()
}

fn section(scene: &Scene) -> Result<Html> {
    let history = scene.fields.history()?;
    let versions = history.iter().map(|line| vec![line.tool.as_str().into(), line.version.as_str().into()]);
    let settings = scene.fields.leaves("").into_iter();
    let settings =
        settings.filter(|(name, _)| !SHOWN_ELSEWHERE.contains(&name.split('.').next().unwrap_or_default()));
    let skipped: Vec<_> = scene
        .skipped()?
        .into_iter()
        .map(|one| vec![words(&one.what).into(), one.count.to_string().into(), one.why.into()])
        .collect();
    let mut parts = vec![Html::element("h2", &[], format!("How it was measured: scene {}", scene.id()?))];
    if !history.is_empty() {
        parts.push(Html::element(
            "p",
            &[],
            "These commands reproduce the records and this page when pasted into a shell, in the folder \
             where they were run first:",
        ));
        parts.push(Html::element("pre", &[], Html::element("code", &[], Html::lines(&pipeline(&history)))));
        parts.push(folded("Versions of the tools", Html::table("Versions", &["tool", "version"], versions)));
    }
    parts.push(folded("All numbers of the scene", pairs("Settings of the scene", settings.collect())));
    if !skipped.is_empty() {
        let table = Html::table("Work that was skipped", &["what", "count", "why"], skipped);
        parts.push(folded("What was not computed, because the result does not need it", table));
    }
    Ok(Html::element("section", &[], parts))
}

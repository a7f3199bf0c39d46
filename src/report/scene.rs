//! The sections of the scenes that shown samples belong to: what was computed, how, and what was skipped.

use std::sync::Arc;

use super::Gallery;
use super::html::Html;
use super::sample::pairs;
use crate::error::Result;
use crate::stream::{HistoryRecord, Scene};

/// Fields that have a table of their own, or are too large to be read.
const SHOWN_ELSEWHERE: [&str; 4] = ["kind", "history", "response", "skipped"];

/// A section each scene.
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
    let row = |line: HistoryRecord| {
        vec![line.tool.into(), line.version.into(), Html::element("code", &[], line.arguments.join(" "))]
    };
    let history = scene.fields.history()?.into_iter().map(row);
    let settings = scene.fields.leaves("").into_iter();
    let settings =
        settings.filter(|(name, _)| !SHOWN_ELSEWHERE.contains(&name.split('.').next().unwrap_or_default()));
    let skipped: Vec<_> = scene
        .skipped()?
        .into_iter()
        .map(|one| vec![one.what.into(), one.count.to_string().into(), one.why.into()])
        .collect();
    let mut parts = vec![
        Html::element("h2", &[], format!("Scene {}", scene.id()?)),
        Html::table("What the tools did", &["tool", "version", "arguments"], history),
        pairs("What was decided", settings.collect()),
    ];
    if !skipped.is_empty() {
        parts.push(Html::table("What was not needed", &["what", "count", "why"], skipped));
    }
    Ok(Html::element("section", &[], parts))
}

//! The page vfold-stream(5): handwritten text, with the fields of all records generated from their types.

use roff::{Roff, bold, italic, roman};

use crate::stream::{FieldOutline, RecordOutline, outline};

/// The page without the records.
const PAGE: &str = include_str!("../../man/vfold-stream.5.in");

/// The page in roff.
pub(super) fn stream_page() -> String {
    PAGE.replace("@VERSION@", env!("CARGO_PKG_VERSION")).replace("@RECORDS@", records().trim_end())
}

fn records() -> String {
    let mut page = Roff::new();
    for RecordOutline { kind, description, writers, fields } in outline() {
        page.control("SS", [kind.as_str()]).text([roman(description + &written(writers.as_deref()))]);
        fields.iter().for_each(|field| add(field, &mut page));
    }
    page.to_roff()
}

fn add(FieldOutline { path, holds, description, writers }: &FieldOutline, page: &mut Roff) {
    page.control("TP", [])
        .text([bold(path), roman("  "), italic(holds)])
        .text([roman(description.clone() + &written(writers.as_deref()))]);
}

/// The sentence on which tools write something, if stated.
fn written(writers: Option<&str>) -> String {
    writers.map(|writers| format!(" Written by {writers}.")).unwrap_or_default()
}

//! Names are the field's words: jargon that was replaced does not come back in identifiers, file names,
//! flags, help or fields of records.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::Workdir;
use crate::imports::{SOURCES, files};

/// Words of no name. `docs/glossary.md` has the field's words.
const OLD: [&str; 25] = [
    "told",
    "untold",
    "said",
    "unsaid",
    "given",
    "believed",
    "belief",
    "beliefs",
    "believes",
    "beside",
    "besides",
    "about",
    "kinds",
    "likely",
    "likelier",
    "likeliest",
    "ways",
    "fuzz",
    "misfit",
    "misfits",
    "maximise",
    "maximises",
    "gloss",
    "inflation",
    "inflated",
];
/// Words that help does not need, whatever else ordinary English does with those above.
const OLD_IN_HELP: [&str; 8] =
    ["told", "untold", "believed", "likelier", "likeliest", "fuzz", "misfit", "beside"];

/// The words that a name is made of, in lower case: those of `DetectedFold` are `found` and `fold`.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = '_';
    for letter in name.chars() {
        let starts = letter.is_ascii_uppercase() && !before.is_ascii_uppercase();
        if starts || !letter.is_ascii_alphanumeric() {
            words.push(String::new());
        }
        if letter.is_ascii_alphanumeric() {
            words.last_mut().unwrap().push(letter.to_ascii_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// What is wrong with a name of a file below `src`, or in it; nothing of most.
fn fault(file: &str, name: &str) -> Option<String> {
    let words = words(name);
    let old = words.iter().find(|word| OLD.contains(&word.as_str()));
    // what a search yields is found; things have names of their own
    let is_thing = words.len() > 1 && !["is", "not"].contains(&words[0].as_str());
    let found = words.iter().find(|word| is_thing && *word == "found");
    // lines of a drawing are curves, those of a camera sensitivities
    let is_drawing = file.starts_with("plot/") || name == "CURVES_MAX";
    let curves = words.iter().find(|word| !is_drawing && *word == "curves");
    old.or(found).or(curves).map(|word| format!("{file}: '{word}' in {name}"))
}

/// A source without comments, strings, letters and its own tests.
fn code(source: &str) -> String {
    let source = source.split("#[cfg(test)]").next().unwrap();
    let (mut code, mut rest) = (String::new(), source);
    while let Some(letter) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("r#\"") {
            rest.find("\"#").map_or(rest.len(), |end| end + 2)
        } else if letter == '"' {
            let mut escaped = false;
            let ends = |letter: char| {
                let ends = letter == '"' && !escaped;
                escaped = letter == '\\' && !escaped;
                ends
            };
            rest[1..].find(ends).map_or(rest.len(), |end| end + 2)
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\\"'") {
            rest[1..].find('\'').map_or(rest.len(), |end| end + 2)
        } else {
            code.push(letter);
            rest = &rest[letter.len_utf8()..];
            continue;
        };
        rest = &rest[skipped..];
        code.push(' ');
    }
    code
}

#[test]
fn names_are_the_fields_words() {
    let mut faults = BTreeSet::new();
    let mut count = 0;
    for path in files(Path::new(SOURCES)) {
        let file = path.strip_prefix(SOURCES).unwrap().to_str().unwrap().to_owned();
        faults.extend(fault(&file, path.file_stem().unwrap().to_str().unwrap()));
        let source = fs::read_to_string(&path).unwrap();
        let code = code(&source);
        let names = code.split(|letter: char| !(letter.is_ascii_alphanumeric() || letter == '_'));
        for name in names.filter(|name| !name.is_empty()) {
            count += 1;
            faults.extend(fault(&file, name));
        }
    }
    assert!(count > 100_000, "{count} names were read");
    let faults: Vec<_> = faults.into_iter().collect();
    assert!(faults.is_empty(), "old words, see docs/glossary.md:\n{}", faults.join("\n"));
}

#[test]
fn flags_and_help_are_in_the_fields_words() {
    for tool in ["vkernel", "vforward", "vextract", "vestimate", "vscore"] {
        let help = Workdir::new().sh(&format!("{tool} --help")).stdout;
        assert!(help.contains("--quiet"), "{tool}: {help}");
        for line in help.lines() {
            let words: Vec<_> = line.split(|letter: char| !letter.is_ascii_alphabetic()).collect();
            let old = words.iter().find(|word| OLD_IN_HELP.contains(&word.to_lowercase().as_str()));
            assert!(old.is_none(), "{tool} --help: {old:?} in {line}");
            let flag = line.split_whitespace().find(|word| word.starts_with("--"));
            let fault = flag.and_then(|flag| fault("--help", flag));
            assert!(fault.is_none(), "{tool}: {fault:?}");
        }
    }
}

#[test]
fn fields_of_records_are_the_fields_words() {
    fn names(schema: &Value, all: &mut BTreeSet<String>) {
        match schema {
            Value::Object(object) => {
                if let Some(properties) = object.get("properties").and_then(Value::as_object) {
                    all.extend(properties.keys().cloned());
                }
                all.extend(object.get("const").and_then(Value::as_str).map(str::to_owned));
                object.values().for_each(|value| names(value, all));
            }
            Value::Array(list) => list.iter().for_each(|value| names(value, all)),
            _ => {}
        }
    }
    let schema = Workdir::new().sh("vscore --generate schema").stdout;
    let mut all = BTreeSet::new();
    names(&serde_json::from_str(&schema).unwrap(), &mut all);
    assert!(all.len() > 150, "{all:?}");
    let faults: Vec<_> = all.iter().filter_map(|name| fault("schema", name)).collect();
    assert!(faults.is_empty(), "{faults:?}");
}

#[test]
fn names_are_read_as_written() {
    assert_eq!(words("FoundFold"), ["found", "fold"]);
    assert_eq!(words("is_told_RGB"), ["is", "told", "rgb"]);
    assert!(fault("camera.rs", "mean_curves").is_some() && fault("plot/spectra.rs", "curves").is_none());
    assert!(fault("stream/mod.rs", "light_found").is_some() && fault("files.rs", "found").is_none());
    assert_eq!(code("a /* b */ \"told \\\" said\" '\"' c // given").split_whitespace().last(), Some("c"));
}

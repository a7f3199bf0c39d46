//! The picture in `src/lib.rs` of which module uses which must be true, and without circles.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

pub const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src");

/// One module uses another.
type Arrow = (String, String);

/// The arrows of a picture, `a, b -> c, d` on a line, from top to bottom.
fn drawn(picture: &str) -> Vec<Arrow> {
    let names = |list: &str| list.split(',').map(|name| name.trim().to_owned()).collect::<Vec<_>>();
    let arrows = |line: &str| {
        let (from, to) = line.split_once("->")?;
        Some(
            names(from)
                .into_iter()
                .flat_map(|from| names(to).into_iter().map(move |to| (from.clone(), to)))
                .collect(),
        )
    };
    picture.lines().filter_map(arrows).collect::<Vec<Vec<_>>>().concat()
}

/// The modules that a source file uses, neither in comments nor in its own tests; `error` for what the crate
/// exports of it.
fn imports(source: &str) -> BTreeSet<String> {
    let code = source.split("#[cfg(test)]").next().unwrap();
    let code: Vec<&str> = code.lines().map(|line| line.split("//").next().unwrap()).collect();
    let code = code.join("\n");
    let names = |rest: &str| -> Vec<String> {
        let several = rest.strip_prefix('{').and_then(|rest| rest.split('}').next());
        let paths = several.map_or(vec![rest], |paths| paths.split(',').collect());
        let first = |path: &str| {
            path.trim()
                .split(|letter: char| !letter.is_alphanumeric() && letter != '_')
                .next()
                .unwrap()
                .to_owned()
        };
        paths.into_iter().map(first).filter(|name| !name.is_empty()).collect()
    };
    let of_crate =
        |name: String| if ["Error", "Result"].contains(&name.as_str()) { "error".to_owned() } else { name };
    code.split("crate::").skip(1).flat_map(names).map(of_crate).collect()
}

/// All source files of a folder.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// Who uses whom among the modules of the library.
fn found() -> BTreeSet<Arrow> {
    let mut arrows = BTreeSet::new();
    for file in files(Path::new(SOURCES)) {
        let within = file.strip_prefix(SOURCES).unwrap();
        let top = within.iter().next().unwrap().to_str().unwrap();
        if top == "bin" || top == "lib.rs" {
            continue;
        }
        let module = top.trim_end_matches(".rs");
        let used = imports(&fs::read_to_string(&file).unwrap()).into_iter().filter(|name| name != module);
        arrows.extend(used.map(|name| (module.to_owned(), name)));
    }
    arrows
}

#[test]
fn the_picture_shows_what_modules_use() {
    let lib = fs::read_to_string(format!("{SOURCES}/lib.rs")).unwrap();
    let lines: String =
        lib.lines().filter_map(|line| line.strip_prefix("//! ")).collect::<Vec<_>>().join("\n");
    let drawn = drawn(lines.split("```text").nth(1).unwrap().split("```").next().unwrap());
    let found = found();
    assert!(found.iter().all(|(from, _)| from != "error"), "`error` stands below all");
    let apart_from_error: BTreeSet<_> = found.into_iter().filter(|(_, to)| to != "error").collect();
    let picture: BTreeSet<_> = drawn.iter().cloned().collect();
    let not_drawn: Vec<_> = apart_from_error.difference(&picture).collect();
    let not_used: Vec<_> = picture.difference(&apart_from_error).collect();
    assert!(not_drawn.is_empty(), "used, but not in the picture of src/lib.rs: {not_drawn:?}");
    assert!(not_used.is_empty(), "in the picture of src/lib.rs, but not used: {not_used:?}");
    for (n, (_, to)) in drawn.iter().enumerate() {
        let above = drawn[..=n].iter().find(|(from, _)| from == to);
        assert!(
            above.is_none(),
            "{to} is used below the line that says what it uses: a circle, or the wrong order"
        );
    }
}

#[test]
fn arrows_and_imports_are_read_as_written() {
    let arrow = |from: &str, to: &str| (from.to_owned(), to.to_owned());
    assert_eq!(drawn("a, b -> c\nno arrow"), [arrow("a", "c"), arrow("b", "c")]);
    let source =
        "use crate::{Error, score};\nuse crate::plot::sheet; // crate::image\nfn f() -> crate::Result<()> {}";
    let test = "#[cfg(test)]\nmod tests {\n    use crate::kernel;\n}";
    assert_eq!(imports(&format!("{source}\n{test}")), ["error", "plot", "score"].map(str::to_owned).into());
}

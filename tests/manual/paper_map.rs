//! The table in `src/lib.rs` that says where each equation of the paper is must be true.

use std::fs;
use std::path::PathBuf;

/// Numbers of the equations that a text cites: `eq. (16)`, `eqs. (16) and (26) to (28)`.
fn cited(text: &str) -> Vec<u32> {
    let mut numbers: Vec<u32> = Vec::new();
    for mut rest in text.split("eq").skip(1) {
        rest = rest.trim_start_matches('s');
        let (mut joint, mut range) = (". (", false);
        while let Some((digits, after)) = rest.strip_prefix(joint).and_then(|rest| rest.split_once(')')) {
            let Ok(number) = digits.parse() else { break };
            let first = if range { numbers[numbers.len() - 1] + 1 } else { number };
            numbers.extend(first..=number);
            rest = after;
            joint = [" and (", " to (", ", ("]
                .into_iter()
                .find(|joint| rest.starts_with(joint))
                .unwrap_or("none");
            range = joint == " to (";
        }
    }
    numbers
}

/// The source file of a path such as `paper::FoldKernel::matrix_row`.
fn source(path: &str) -> PathBuf {
    let modules: Vec<&str> =
        path.split("::").take_while(|part| part.starts_with(char::is_lowercase)).collect();
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
    (1..=modules.len())
        .rev()
        .map(|count| root.join(modules[..count].join("/")))
        .flat_map(|path| [path.with_extension("rs"), path.join("mod.rs")])
        .find(|file| file.is_file())
        .unwrap_or_else(|| panic!("no source of {path}"))
}

/// The source, and where a module only gathers others, theirs.
fn text_of(path: &str) -> String {
    let file = source(path);
    let mut text = fs::read_to_string(&file).unwrap();
    if file.ends_with("mod.rs") {
        let paths = fs::read_dir(file.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
        paths.filter(|path| path.is_file()).for_each(|path| text += &fs::read_to_string(path).unwrap());
    }
    text
}

#[test]
fn each_equation_is_cited_in_the_file_that_the_table_names() {
    let lib = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/src/lib.rs")).unwrap();
    let rows: Vec<&str> = lib
        .lines()
        .filter(|line| line.starts_with("//! | eq. (") || line.starts_with("//! | eqs. ("))
        .collect();
    assert!(rows.len() >= 10, "the table has {} rows", rows.len());
    for row in rows {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let equations = cited(cells[1]);
        assert!(!equations.is_empty(), "no equation in {row}");
        for place in cells[3].split("[`").skip(1).map(|rest| rest.split('`').next().unwrap()) {
            let found = cited(&text_of(place));
            for equation in [equations[0], equations[equations.len() - 1]] {
                assert!(found.contains(&equation), "eq. ({equation}) is not cited in the source of {place}");
            }
        }
    }
}

#[test]
fn citations_are_read_as_written() {
    assert_eq!(cited("eq. (2)"), [2]);
    assert_eq!(cited("as eqs. (16) and (26) to (28) say"), [16, 26, 27, 28]);
    assert_eq!(cited("eq. (1), eq. (4)"), [1, 4]);
}

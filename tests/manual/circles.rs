//! No source files use each other in a circle, however many lie between them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::imports::{SOURCES, files};

/// The path of a module or of an item: `kernel::mesh` as two names.
type Names = Vec<String>;

fn names(path: &str) -> Names {
    path.split("::").map(|name| name.trim().to_owned()).collect()
}

/// A file's code, neither comments nor its own tests.
fn code(path: &Path) -> String {
    let source = fs::read_to_string(path).unwrap();
    let code = source.split("#[cfg(test)]").next().unwrap();
    code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// The paths that a `use` names: `a::{b, c::d as e}` as `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((before, inside)) = tree.strip_suffix('}').and_then(|tree| tree.split_once('{')) else {
        return vec![tree.split(" as ").next().unwrap().trim().to_owned()];
    };
    let (mut all, mut depth, mut start) = (Vec::new(), 0, 0);
    for (at, letter) in inside.char_indices().chain([(inside.len(), ',')]) {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = inside[start..at].trim();
                all.extend(
                    leaves(part).iter().filter(|part| !part.is_empty()).map(|part| format!("{before}{part}")),
                );
                start = at + 1;
            }
            _ => {}
        }
    }
    all
}

/// The library's modules: what each hands on of others, by name, and what it uses.
#[derive(Default)]
struct House {
    handed_on: BTreeMap<Names, BTreeMap<String, Names>>,
    used: BTreeMap<Names, Vec<Names>>,
}

impl House {
    fn read() -> Self {
        let mut house = Self::default();
        let paths =
            files(Path::new(SOURCES)).into_iter().filter(|path| !path.starts_with(format!("{SOURCES}/bin")));
        let modules: Vec<(Names, String)> = paths.map(|path| (module(&path), code(&path))).collect();
        for (module, _) in &modules {
            house.used.insert(module.clone(), Vec::new());
        }
        for (module, code) in modules {
            house.add(&module, &code);
        }
        house
    }

    fn add(&mut self, module: &Names, code: &str) {
        let mut rest = String::new();
        for statement in code.split_inclusive(';') {
            let at = statement.rfind("use ").filter(|at| {
                let before = statement[..*at].rsplit('\n').next().unwrap().trim();
                before.is_empty() || before.starts_with("pub")
            });
            let Some(at) = at else {
                rest += statement;
                continue;
            };
            let hands_on = statement[..at].trim_end().rsplit('\n').next().unwrap().trim().starts_with("pub");
            rest += &statement[..at];
            for path in leaves(statement[at + 4..].trim_end_matches(';')) {
                let Some(path) = self.absolute(module, &path) else { continue };
                if hands_on {
                    let handed_on = self.handed_on.entry(module.clone()).or_default();
                    handed_on.insert(path.last().unwrap().clone(), path);
                } else {
                    self.used.get_mut(module).unwrap().push(path);
                }
            }
        }
        let paths = rest.split(|letter: char| !(letter.is_alphanumeric() || letter == '_' || letter == ':'));
        let paths: Vec<_> =
            paths.filter(|path| path.contains("::")).filter_map(|path| self.absolute(module, path)).collect();
        self.used.get_mut(module).unwrap().extend(paths);
    }

    /// A path from the library's root on; none if it is of another crate or names a type.
    fn absolute(&self, module: &Names, path: &str) -> Option<Names> {
        let mut path = names(path);
        let mut from = module.clone();
        match path[0].as_str() {
            "crate" => from.clear(),
            "self" => {}
            "super" => {
                while path.first().is_some_and(|name| name == "super") {
                    from.pop();
                    path.remove(0);
                }
                return Some([from, path].concat());
            }
            child => {
                let child = [module.as_slice(), &[child.to_owned()]].concat();
                return self.used.contains_key(&child).then(|| [module.clone(), path].concat());
            }
        }
        path.remove(0);
        Some([from, path].concat())
    }

    /// The module in which what a path names is written: those that only hand it on do not count.
    fn source(&self, path: &[String]) -> Names {
        let known = (0..=path.len()).rev().find(|count| self.used.contains_key(&path[..*count])).unwrap();
        let (module, rest) = path.split_at(known);
        let handed_on = rest.first().and_then(|name| self.handed_on.get(module)?.get(name));
        match handed_on.filter(|other| other.as_slice() != path) {
            Some(other) => self.source(&[other.as_slice(), &rest[1..]].concat()),
            None => module.to_vec(),
        }
    }

    fn arrows(&self) -> BTreeMap<Names, BTreeSet<Names>> {
        let of = |(module, used): (&Names, &Vec<Names>)| {
            let to = used.iter().map(|path| self.source(path)).filter(|to| to != module && !to.is_empty());
            (module.clone(), to.collect())
        };
        self.used.iter().map(of).collect()
    }
}

/// The module that a file holds.
fn module(path: &Path) -> Names {
    let within = path.strip_prefix(SOURCES).unwrap().with_extension("");
    let mut names: Names = within.iter().map(|name| name.to_str().unwrap().to_owned()).collect();
    names.retain(|name| !["mod", "lib"].contains(&name.as_str()));
    names
}

/// A circle, if there is one: what is left once modules that use none that is left are taken away, and again.
fn circle(mut arrows: BTreeMap<Names, BTreeSet<Names>>) -> BTreeMap<Names, BTreeSet<Names>> {
    loop {
        let left: BTreeSet<Names> = arrows.keys().cloned().collect();
        arrows.values_mut().for_each(|to| to.retain(|to| left.contains(to)));
        let used: BTreeSet<Names> = arrows.values().flatten().cloned().collect();
        let count = arrows.len();
        arrows.retain(|from, to| !to.is_empty() && used.contains(from));
        if arrows.len() == count {
            return arrows;
        }
    }
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let arrows = House::read().arrows();
    assert!(
        arrows.len() > 300 && arrows.values().map(BTreeSet::len).sum::<usize>() > 1000,
        "files are not read"
    );
    let circle = circle(arrows);
    let shown = circle.iter().map(|(from, to)| {
        let to: Vec<String> = to.iter().map(|to| to.join("::")).collect();
        format!("{} -> {}", from.join("::"), to.join(", "))
    });
    assert!(
        circle.is_empty(),
        "files that use each other in a circle:\n{}",
        shown.collect::<Vec<_>>().join("\n")
    );
}

#[test]
fn circles_are_seen() {
    let arrows = |all: &[(&str, &str)]| {
        let mut arrows: BTreeMap<Names, BTreeSet<Names>> = BTreeMap::new();
        for (from, to) in all {
            arrows.entry(names(from)).or_default().insert(names(to));
            arrows.entry(names(to)).or_default();
        }
        circle(arrows).len()
    };
    assert_eq!(arrows(&[("a", "b"), ("b", "c"), ("a", "c")]), 0);
    assert_eq!(arrows(&[("a", "b"), ("b", "c"), ("c", "a"), ("d", "a"), ("c", "e")]), 3);
    assert_eq!(leaves("a::{b, c::{d as e, f}}"), ["a::b", "a::c::d", "a::c::f"]);
}

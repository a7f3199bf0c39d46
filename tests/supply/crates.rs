//! The crates vfold asks for: each is used, none needs a newer Rust or a network, all come from the registry.

use super::metadata::{list, metadata, others};
use super::{path, sources, text};

/// `1.88` or `1.88.0`, as numbers that compare.
fn version(text: &str) -> Vec<u32> {
    text.split('.').take(2).map(|part| part.parse().unwrap()).collect()
}

/// `tests/msrv` builds with that Rust where it can be had.
#[test]
fn no_crate_needs_a_newer_rust() {
    let ours = env!("CARGO_PKG_RUST_VERSION");
    for package in others(&metadata()) {
        if let Some(theirs) = package["rust_version"].as_str() {
            assert!(version(theirs) <= version(ours), "{} needs Rust {theirs}, not {ours}", package["name"]);
        }
    }
}

#[test]
fn all_crates_come_from_the_registry() {
    let metadata = metadata();
    for package in others(&metadata) {
        let source = package["source"].as_str().unwrap_or("a folder");
        assert!(source.starts_with("registry+"), "{} comes from {source}", package["name"]);
    }
    let lock = text("Cargo.lock");
    let packages = lock.split("[[package]]").filter(|package| package.contains("\nsource = "));
    assert!(packages.into_iter().all(|package| package.contains("\nchecksum = ")));
}

/// Crates that `deny.toml` bans.
fn banned() -> Vec<String> {
    text("deny.toml")
        .split("{ crate = \"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().to_owned())
        .collect()
}

#[test]
fn nothing_talks_to_a_network() {
    let (banned, lock) = (banned(), text("Cargo.lock"));
    assert!(banned.len() >= 10, "{banned:?}");
    for name in banned {
        assert!(
            !lock.contains(&format!("\nname = \"{name}\"\n")),
            "{name} is among the crates, those of `raw` included"
        );
    }
    // one file serves a page to this machine alone; what asks for it in an example is no part of the tools
    let page = path("src/cli/served.rs");
    for file in sources(&path("src")) {
        let source = std::fs::read_to_string(&file).unwrap();
        let code = source.lines().filter(|line| file != page || !line.trim_start().starts_with("///"));
        for word in ["std::net", "TcpStream", "UdpSocket", "rustix::net"] {
            assert!(code.clone().all(|line| !line.contains(word)), "{}: {word}", file.display());
        }
        assert!(!source.contains("tiny_http") || file == page, "{}", file.display());
    }
    assert!(text("src/cli/served.rs").contains(r#"Server::http(("127.0.0.1", 0))"#));
}

#[test]
fn every_crate_is_used() {
    let metadata = metadata();
    let vfold = list(&metadata["packages"]).iter().find(|package| package["name"] == "vfold").unwrap();
    // one of a build without a script is not used, but sets features
    let called = list(&vfold["dependencies"]).iter().filter(|dependency| dependency["kind"] != "build");
    for dependency in called {
        let folders: &[&str] =
            if dependency["kind"] == "dev" { &["tests", "benches", "src"] } else { &["src"] };
        let name =
            dependency["rename"].as_str().unwrap_or(dependency["name"].as_str().unwrap()).replace('-', "_");
        let files = folders.iter().flat_map(|folder| sources(&path(folder)));
        let uses = |source: &str| {
            ["::", "!", ";", " as"].iter().any(|after| source.contains(&format!("{name}{after}")))
        };
        let used = files.into_iter().any(|file| uses(&std::fs::read_to_string(file).unwrap()));
        assert!(used, "{name} is used nowhere in {folders:?}: remove it from Cargo.toml");
    }
}

/// `forbid` cannot be taken back in a file; rustc refuses `unsafe` everywhere in the package then.
#[test]
fn unsafe_code_is_forbidden() {
    let manifest = text("Cargo.toml");
    let lints = manifest.split("[lints.rust]\n").nth(1).unwrap().split("\n[").next().unwrap();
    assert!(lints.lines().any(|line| line == "unsafe_code = \"forbid\""), "{lints}");
}

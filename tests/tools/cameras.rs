//! Cameras known by what they write into their pictures, and by name.

use serde_json::Value;

use crate::common::Workdir;

const CAMERAS: &str = include_str!("../../share/cameras.txt");

/// A small picture with a maker and a model, as `photo.tif`, and `extract`, which measures it.
const SETUP: &str = r#"
    vkernel --facets 1x1 -o scene.json
    cat > picture <<'END'
    oiiotool --pattern constant:color=0.4,0.5,0.3 40x40 3 --attrib Make "$1" --attrib Model "$2" -d uint16 -o photo.tif
END
    cat > extract <<'END'
    exec vextract photo.tif --scene scene.json --illuminant D65 --panel0 '0,0 40,0 40,40 0,40' "$@"
END
"#;

/// Make and Model as the makers write them.
fn exif(maker: &str, model: &str) -> (String, String) {
    match maker {
        "Nikon" => ("NIKON CORPORATION".to_owned(), format!("NIKON {model}")),
        "Canon" => (maker.to_owned(), format!("Canon {model}")),
        "Sony" | "Fujifilm" => (maker.to_uppercase(), model.to_owned()),
        _ => (maker.to_owned(), model.to_owned()),
    }
}

fn scene(stdout: &str) -> Value {
    serde_json::from_str(stdout.lines().next().unwrap()).unwrap()
}

#[test]
fn all_of_rawtoaces_data_are_known_by_their_pictures() {
    let folder = Workdir::new();
    assert_eq!(folder.sh(SETUP).status, 0);
    let listed = folder.sh("vextract --list cameras").stdout;
    for line in CAMERAS.lines() {
        let [maker, model] = [0, 1].map(|k| line.split('\t').nth(k).unwrap());
        let (make, model) = exif(maker, model);
        let run = folder.sh(&format!("sh picture '{make}' '{model}'; sh extract"));
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{make} {model}");
        let camera = &scene(&run.stdout)["camera"];
        let name = camera["name"].as_str().unwrap();
        let plain = |text: &str| text.to_lowercase().replace([' ', '-', '.'], "");
        let of_model = plain(&model).replace("canon", "").replace("nikon", "").replace("eos", "");
        assert!(plain(name).ends_with(&of_model), "{make} {model} is {name}");
        assert!(listed.lines().any(|line| line.split(' ').next() == Some(name)), "{name} is not listed");
        assert_eq!(camera["sensitivities"].as_array().unwrap().len(), 3);
    }
}

#[test]
fn names_may_be_those_of_other_markets() {
    let folder = Workdir::new();
    let run = folder.sh(r"
        vkernel --facets 1x1 -o scene.json
        forward() { vforward scene.json --reflectance 0.5 --camera $1 --no-history | sed s/$1/CAMERA/; }
        forward canon-eos-600d > one
        forward canon-eos-rebel-t3i > two
        cmp one two");
    assert_eq!((run.status, run.stdout.as_str()), (0, ""), "{}", run.stderr);
}

//! Kernels that were made elsewhere.

use crate::{assert_refused, case};

/// Kernels and lights that NumPy writes without complaint.
const ARRAYS: &str = r#"python3 - <<'END'
import numpy as np
good = np.array([[0.0, 0.1], [0.4, 0.0]])
np.save('good.npy', good)
np.save('flat.npy', good[0])
np.save('empty.npy', np.zeros((0, 0)))
np.save('single.npy', good.astype('f4'))
np.save('negative.npy', -good)
np.save('shining.npy', np.full((3, 3), 0.4))
np.save('one-way.npy', np.array([[0.0, 0.1], [0.0, 0.0]]))
np.save('loop.npy', np.array([[0.0, 0.1, 0.2], [0.1, 0.0, 0.1], [0.1, 0.1, 0.0]]))
np.save('alike.npy', np.ones(2))
np.save('no-area.npy', np.zeros(2))
np.save('three.npy', np.ones(3))
np.save('dark.npy', np.array([[1.0, 1.0], [0.0, 0.0]]))
np.save('below.npy', np.array([1.0, -1.0]))
np.save('infinite.npy', np.array([1.0, np.inf]))
END"#;

#[test]
fn kernels_and_lights() {
    assert_refused(
        ARRAYS,
        &[
            case("vforward --reflectance 0.5 --kernel flat.npy", 1, &["square"]),
            case("vforward --reflectance 0.5 --kernel empty.npy", 1, &["square"]),
            case("vforward --reflectance 0.5 --kernel single.npy", 1, &["float64"]),
            case("vforward --reflectance 0.5 --kernel negative.npy", 1, &["not a share"]),
            case("vforward --reflectance 0.5 --kernel shining.npy", 1, &["bounces would not end"]),
            case("vforward --reflectance 0.5 --kernel one-way.npy", 1, &["reciprocity"]),
            case("vforward --reflectance 0.5 --kernel loop.npy", 1, &["reciprocity"]),
            case("vforward --reflectance 0.5 --kernel good.npy --areas alike.npy", 1, &["reciprocity"]),
            case("vforward --reflectance 0.5 --kernel good.npy --areas no-area.npy", 1, &["areas"]),
            case("vforward --reflectance 0.5 --kernel good.npy --areas three.npy", 1, &["three.npy"]),
            case("vforward --reflectance 0.5 --kernel good.npy --irradiance three.npy", 1, &["2 numbers"]),
            case(
                "vforward --reflectance 0.5 --kernel good.npy --irradiance dark.npy",
                1,
                &["row 1 has no light"],
            ),
            case("vforward --reflectance 0.5 --kernel good.npy --irradiance below.npy", 1, &["-1"]),
            case("vforward --reflectance 0.5 --kernel good.npy --irradiance infinite.npy", 1, &["inf"]),
        ],
    );
}

#[test]
fn flags_beside_kernels() {
    assert_refused(
        ARRAYS,
        &[
            case("vforward --irradiance good.npy --reflectance 0.5", 2, &["--kernel"]),
            case("vforward scene.json --kernel good.npy --reflectance 0.5", 2, &["--kernel"]),
            case("vforward --kernel good.npy --reflectance 0.5 --reference-panel 0.5", 1, &["--material"]),
            case("vforward --kernel good.npy --reflectance 0.5 --material a=0.5", 1, &["mesh", "--shape"]),
            case("vforward --kernel good.npy --reflectance 0.5 --render x.png", 1, &["a mesh is needed"]),
            case("vforward --kernel good.npy --reflectance 0.5 --material =0.5", 2, &["GROUP=SPEC"]),
            case(
                "vforward --kernel good.npy --reflectance 0.5 --material a=1 --material a=0",
                2,
                &["stated twice"],
            ),
            case(
                "vforward --kernel good.npy --reflectance 0.5 | vestimate --fit tilt",
                1,
                &["a fold is needed"],
            ),
            case("vkernel | vforward --reflectance 0.5 --material a=1", 1, &["--panel-reflectance"]),
            case("vestimate --camera 1", 2, &["--kernel"]),
        ],
    );
}

/// Scenes of any surface whose parts do not fit each other.
#[test]
fn scenes() {
    let prepare = format!(
        "{ARRAYS}
        vforward --kernel good.npy --reflectance 0.5 --wavelengths-nm 400:700:10 --no-history -o good.ndjson"
    );
    assert_refused(
        &prepare,
        &[
            case(
                "sed 's/\"shape\":\"kernel\"/\"shape\":\"cone\"/' good.ndjson | vestimate",
                1,
                &["-:1", "cone"],
            ),
            case(
                "sed 's/\"count\":2/\"count\":3/' good.ndjson | vestimate",
                1,
                &["-:1", "response.residues"],
            ),
            case("sed 's/\"count\":2/\"count\":-3/' good.ndjson | vestimate", 1, &["-:1", "facets"]),
            case("sed 's/{\"type\":\"per_facet\"}//' good.ndjson | vestimate", 1, &["-:1", "light.sources"]),
            case("sed 's/\"per_facet\"/\"moon\"/' good.ndjson | vestimate", 1, &["-:1", "moon"]),
            case(
                "sed 's/{\"type\":\"per_facet\"}/&,&/' good.ndjson | vestimate",
                1,
                &["-:1", "response.sources", "2 sources"],
            ),
            case("sed 's/\"poles\":\\[/&1.5,/' good.ndjson | vestimate", 1, &["-:1", "response"]),
            case(
                "sed 's/\"shape\":\"kernel\"/\"shape\":\"mesh\"/' good.ndjson | vestimate --material a=1",
                1,
                &["-:1", "vertices"],
            ),
        ],
    );
}

//! Numbers and names on the command line.

use crate::{assert_refused, case};

#[test]
fn geometry() {
    assert_refused(
        "",
        &[
            case("vkernel --angle-deg 0", 2, &["--angle-deg", "above 0"]),
            case("vkernel --angle-deg 180.5", 2, &["--angle-deg", "up to 180"]),
            case("vkernel --angle-deg -10", 2, &["--angle-deg", "-10"]),
            case("vkernel --angle-deg wide", 2, &["--angle-deg", "wide"]),
            case("vkernel --panel 0x1", 2, &["--panel", "above 0"]),
            case("vkernel --panel 1", 2, &["--panel", "10x10"]),
            case("vkernel --panel 1x1001", 2, &["--panel", "1000"]),
            case("vkernel --panel 5e-324x5e-324", 2, &["--panel", "not a panel"]),
            case("vkernel --panel 1e-310x1e-310", 2, &["--panel", "not a panel"]),
            case("vkernel --panel 1e308x1e308", 2, &["--panel", "not a panel"]),
            case("vkernel --panel infxinf", 2, &["--panel", "not a panel"]),
            case("vkernel --panel 1e-99x1e-99 --panel1-depth 5e-324", 2, &["--panel1-depth"]),
            case("vkernel --angle-deg 0.1", 2, &["--angle-deg", "0.1°", "--mesh facets"]),
            case("vkernel --angle-deg 1e-300", 2, &["--angle-deg", "--mesh facets"]),
            case("vkernel --panel infxinf", 2, &["--panel"]),
            case("vkernel --panel1-depth 0", 2, &["--panel1-depth", "0.001 to 1000"]),
            case("vkernel --panel1-depth NaN", 2, &["--panel1-depth", "NaN"]),
            case("vkernel --panel1-depth 1001", 2, &["--panel1-depth", "1000"]),
            case("vkernel --facets 0x10", 2, &["--facets", "at least 1x1"]),
            case("vkernel --facets 1000000x1000000", 2, &["--facets", "4.000e9 GB"]),
            case("vkernel --facets 99999999999999999x3", 2, &["--facets", "GB"]),
            case("vkernel --facets=-1x3", 2, &["--facets"]),
            case("vkernel --mesh 7x10", 2, &["--mesh", "multiples"]),
            case("vkernel --mesh fine", 2, &["--mesh", "auto"]),
            case("vkernel --tolerance 0", 2, &["--tolerance", "1e-12"]),
            case("vkernel --tolerance NaN", 2, &["--tolerance", "NaN"]),
            case("vkernel --angle-deg 1 --tolerance 1e-12", 2, &["--tolerance", "--mesh facets"]),
            case("vkernel --tilt-deg 22.5", 2, &["--tilt-deg", "shade"]),
            case("vkernel --tilt-deg NaN", 2, &["--tilt-deg"]),
            case("vkernel --slant-deg 90", 2, &["--slant-deg"]),
            case("vkernel --sky -0.1", 2, &["--sky", "0 (no sky)"]),
            case("vkernel --sky inf", 2, &["--sky"]),
            case("vkernel --sky 1e9", 2, &["--sky", "0 (no sky) to 1e6"]),
            case("vkernel --samples -5", 2, &["'-5' for '--samples", "0..="]),
            case("vkernel --seed -5", 2, &["'-5' for '--seed", "a whole number of 0 or more"]),
            case("vkernel --facets -5", 2, &["'-5' for '--facets", "10x10"]),
            case("vkernel --plot -", 2, &["--plot", "end the name in .svg or .png"]),
            case("vkernel --threads -5", 2, &["'-5' for '--threads", "1..=1024"]),
            case("vkernel -5", 2, &["unexpected argument '-5'"]),
            case("vkernel --save kernel", 2, &["--save", "FIELD=FILE"]),
            case("vkernel --save kernel=-", 2, &["--save", "an array needs a file"]),
            case("vkernel --save nothing=x.npy", 1, &["x.npy", "no record has the field", "--save"]),
            case("vkernel --save kernel=no/such/K.npy", 1, &["no/such/K.npy"]),
            case("vkernel -o no/such/folder", 1, &["no/such/folder"]),
            case("vkernel -j none", 2, &["--threads"]),
            case("vkernel -j 0", 2, &["--threads", "1024"]),
            case("vkernel -j 1000000", 2, &["--threads", "1024"]),
            case("vkernel --regions none.json", 1, &["none.json"]),
            case("vkernel --regions r.json --folds 3", 2, &["--regions", "--folds"]),
            case("echo '{}' | vkernel --regions -", 1, &["-", "panel0 has no corners", "--angle-deg"]),
            case("vkernel surplus", 2, &["surplus"]),
        ],
    );
}

#[test]
fn kernel_methods() {
    assert_refused(
        "",
        &[
            case("vkernel --method guess", 2, &["--method", "monte-carlo"]),
            case("vkernel --method monte-carlo --samples 0", 2, &["--samples", "give 2"]),
            case("vkernel --method monte-carlo --samples 1", 2, &["--samples", "standard error"]),
            case("vkernel --method monte-carlo --samples=-5", 2, &["--samples"]),
            case("vkernel --method monte-carlo --samples 1e4", 2, &["--samples"]),
            case("vkernel --method monte-carlo --seed=-1", 2, &["--seed"]),
            case("vkernel --method monte-carlo --sampling volume", 2, &["--sampling", "cosine"]),
            case("vkernel --method monte-carlo --mesh auto", 2, &["--mesh", "facets", "--method exact"]),
            case("vkernel --samples 100", 2, &["--samples", "--method monte-carlo"]),
            case("vkernel --method midpoint --seed 1", 2, &["--seed", "--method monte-carlo"]),
            case("vkernel --method midpoint", 2, &["radius 1.93", "0.52", "--method exact", "--check"]),
            case("vkernel --method midpoint --check --save kernel=no/K.npy", 1, &["no/K.npy"]),
            case("vkernel --method midpoint --check", 1, &["largest row sum", "spectral radius"]),
            case("vkernel --check --save nothing=x.npy", 1, &["x.npy", "no record has the field"]),
            case("vkernel --check --facets 0x1", 2, &["--facets", "at least 1x1"]),
            case("vkernel --check --tolerance 0", 2, &["--tolerance", "1e-12"]),
        ],
    );
}

#[test]
fn light_and_camera() {
    assert_refused(
        "vkernel --facets 1x1 -o scene.json",
        &[
            case("vforward scene.json", 2, &["--reflectance"]),
            case("vforward . --reflectance 0.5", 1, &[".", "directory"]),
            case("vforward scene.json --reflectance 1.5", 1, &["1.5", "0..1"]),
            case("vforward scene.json --reflectance -0.1", 1, &["-0.1", "0..1"]),
            case("vforward scene.json --reflectance 0.5 --seed -1", 2, &["'-1' for '--seed", "0 or more"]),
            case("vestimate scene.json --exposure -1", 2, &["'-1' for '--exposure", "a number above 0"]),
            case("vforward scene.json --reflectance NaN", 1, &["NaN"]),
            case("vforward scene.json --reflectance cc24:rad", 1, &["cc24:rad", "cc24:red", "--list"]),
            case("vforward scene.json --reflectance 0.5 --noise-sd -1", 2, &["--noise-sd", "0 or more"]),
            case("vforward scene.json --reflectance 0.5 --noise-sd NaN", 2, &["--noise-sd"]),
            case("vforward scene.json --reflectance 0.5 --photon-noise inf", 2, &["--photon-noise"]),
            case("vforward scene.json --reflectance 0.5 --exposure 0", 2, &["--exposure", "above 0"]),
            case("vforward scene.json --reflectance 0.5 --seed=-1", 2, &["--seed"]),
            case(
                "vforward scene.json --reflectance 0.5 --specular-weight -1",
                2,
                &["--specular-weight", "0 to 2"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --specular-weight NaN",
                2,
                &["--specular-weight", "NaN"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --specular-weight 1 --specular-roughness 0",
                2,
                &["mirror", "0.25"],
            ),
            case("vforward scene.json --reflectance 0.5 --specular-roughness 0.3", 2, &["--specular-weight"]),
            case(
                "vforward scene.json --reflectance 0.5 --specular-weight 1 --bounces 2",
                2,
                &["--specular-weight", "--bounces"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --body-roughness-deg 90",
                2,
                &["--body-roughness-deg", "45"],
            ),
            case("vforward scene.json --reflectance 0.5 --sheen inf", 2, &["--sheen", "0 to 2"]),
            case("vforward scene.json --reflectance 1 --sheen 1", 2, &["--reflectance", "45°:0°"]),
            case(
                "vforward scene.json --reflectance 0.5 --specular-weight 1 --reference-panel 0.9",
                1,
                &["reference_panel"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --camera cannon-5d-mark-ii",
                1,
                &["canon-5d-mark-ii"],
            ),
            case("vforward scene.json --reflectance 0.5 --illuminant D66", 1, &["D66", "D65", "--list"]),
            case("vforward scene.json --reflectance 0.5 --illuminant daylight:1", 1, &["4000..25000 K"]),
            case("vforward scene.json --reflectance 0.5 --illuminant 0", 1, &["zero"]),
            case("vforward scene.json --reflectance 0.5 --wavelengths-nm 400:700:1e-9", 2, &["larger step"]),
            case(
                "vforward scene.json --reflectance 0.5 --wavelengths-nm 300:900:5",
                1,
                &["D65", "380..780 nm"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --reference-panel 2",
                2,
                &["--reference-panel: ", "0..1"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --reference-panel cc24",
                2,
                &["--reference-panel", "a set"],
            ),
            case("vforward scene.json --panel-reflectance 1=0.5", 2, &["--reflectance", "missing"]),
            case("vforward scene.json --reflectance 0.5 --panel-reflectance 2=0.5", 2, &["0=SPEC"]),
            case(
                "vforward scene.json --reflectance 0.5 --panel-reflectance 0=1.5",
                2,
                &["--panel-reflectance: ", "0..1"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --panel-reflectance 1=cc24",
                2,
                &["--panel-reflectance", "a set"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --panel-reflectance 1=0.5 --reference-panel 0.5",
                2,
                &["panel 1 has two reflectances"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --panel-reflectance 0=0.5 --reference-panel 0.5",
                2,
                &["--reflectance", "leave it out"],
            ),
            case("vforward scene.json --reflectance 0.5 --bounces=-1", 2, &["--bounces", "inf, auto"]),
            case(
                "sed 's/accuracy/was/' scene.json | vforward --reflectance 0.5 --bounces auto",
                1,
                &["-:1", "accuracy"],
            ),
            case("vforward scene.json --reflectance 0.5 --render picture.bmp", 1, &["picture.bmp", ".exr"]),
            case("vforward scene.json --reflectance 0.5 --render no/such.exr", 1, &["no/such.exr"]),
            case(
                "vforward scene.json --reflectance 0.5 --render x.exr --render-size 0x9",
                2,
                &["--render-size"],
            ),
            case("vforward scene.json --reflectance 0.5 --save facet_rgb=no/such.npy", 1, &["no/such.npy"]),
        ],
    );
}

#[test]
fn reflectances_of_facets() {
    assert_refused(
        "vkernel --facets 1x1 -o scene.json
         python3 - <<'END'
import numpy as np
np.save('good.npy', np.full((2, 61), 0.5))
np.save('wide.npy', np.full((2, 62), 0.5))
np.save('deep.npy', np.full((1, 2, 61), 0.5))
np.save('single.npy', np.full((2, 61), 0.5, 'f4'))
np.save('bright.npy', np.full((2, 61), 1.5))
np.save('nan.npy', np.full((2, 61), np.nan))
whole = open('good.npy', 'rb').read()
open('cut.npy', 'wb').write(whole[:-8])
open('vast.npy', 'wb').write(whole.replace(b'(2, 61)', b'(9**9,)').replace(b'9**9', b'9999'))
END
",
        &[
            case("vforward scene.json --facet-reflectance no.npy", 1, &["no.npy", "No such file"]),
            case("vforward scene.json --facet-reflectance scene.json", 1, &["scene.json", "NPY"]),
            case(
                "vforward scene.json --facet-reflectance wide.npy",
                1,
                &["[2, 62]", "2 facets by 61 wavebands"],
            ),
            case("vforward scene.json --facet-reflectance deep.npy", 1, &["[1, 2, 61]"]),
            case("vforward scene.json --facet-reflectance vast.npy", 1, &["[9999]"]),
            case("vforward scene.json --facet-reflectance single.npy", 1, &["single.npy", "float64"]),
            case("vforward scene.json --facet-reflectance bright.npy", 1, &["bright.npy", "1.5", "0 to 1"]),
            case("vforward scene.json --facet-reflectance nan.npy", 1, &["nan.npy", "NaN"]),
            case("vforward scene.json --facet-reflectance cut.npy", 1, &["cut.npy"]),
            case("vforward scene.json --facet-reflectance good.npy --reflectance 0.5", 2, &["--reflectance"]),
            case("vforward scene.json --facet-reflectance good.npy --bounces 1", 2, &["--bounces"]),
            case("vforward scene.json --facet-reflectance good.npy --render x.exr", 2, &["--render"]),
        ],
    );
}

#[test]
fn cameras_of_photographs() {
    assert_refused(
        "vkernel --facets 2x2 -o scene.json
        echo 'vforward scene.json --reflectance 0.5 --render x.exr \"$@\"' > render",
        &[
            case("sh render --eye 0,0", 2, &["--eye", "three numbers"]),
            case("sh render --eye 1,2,NaN", 2, &["--eye", "three numbers"]),
            case("sh render --eye 1,2,3 --look-at 1,2,3", 2, &["--eye", "the point that it looks at"]),
            case("sh render --eye 0,0,5 --look-at 0,0,9", 2, &["--eye", "behind the camera"]),
            case("sh render --eye 0,0,5 --up 0,0,1", 2, &["--up", "line of sight"]),
            case("sh render --field-of-view-deg 180", 2, &["--field-of-view-deg", "between 0 and 180"]),
            case("vforward scene.json --reflectance 0.5 --eye 1,2,3", 2, &["--render"]),
        ],
    );
}

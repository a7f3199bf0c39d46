//! Lights around shapes.

use crate::{assert_refused, case};

#[test]
fn lights() {
    assert_refused(
        "",
        &[
            case("vkernel --light 0,0,1", 2, &["--light", "--tilt-deg"]),
            case("vkernel --sky-type overcast", 2, &["--sky-type", "fold"]),
            case("vkernel --folds 2 --light 0,0", 2, &["--light", "X,Y,Z"]),
            case("vkernel --folds 2 --light 0,0,1:", 2, &["--light", "X,Y,Z"]),
            case("vkernel --folds 2 --light point:0,0,x", 2, &["--light", "X,Y,Z"]),
            case("vkernel --folds 2 --light 0,0,0", 2, &["--light", "no direction"]),
            case("vkernel --folds 2 --light 0,0,NaN", 2, &["--light", "0,0,NaN", "write X,Y,Z"]),
            case("vkernel --folds 2 --light 0,0,1:-1", 2, &["--light", "irradiance of -1"]),
            case("vkernel --folds 2 --light point:0,0,inf", 2, &["--light", "0,0,inf", "write X,Y,Z"]),
            case("vkernel --folds 2 --light none", 2, &["--light", "--sky 1"]),
            case("vkernel --folds 2 --sky -1", 2, &["--sky", "irradiance of -1"]),
            case("vkernel --folds 2 --zenith 0,0,1", 2, &["--zenith", "overcast"]),
            case(
                "vkernel --folds 2 --sky 1 --sky-type overcast --zenith 0,0,0",
                2,
                &["--sky", "no direction"],
            ),
            case("vkernel --folds 3 --facets 1x1 --light 0,0,-1", 1, &["no light falls"]),
        ],
    );
}

/// Scenes under several lights, and tools that need a fold.
#[test]
fn scenes() {
    assert_refused(
        "vkernel --folds 2 --facets 1x1 --mesh facets --light 0,0,1 --light 1,0,1 --no-history -o two.json",
        &[
            case(
                "vforward two.json --reflectance 0.5 --illuminant A --illuminant D65 --illuminant FL2",
                1,
                &["3 for 2 sources"],
            ),
            case(
                "vforward two.json --reflectance 0.5 --material attic=1",
                1,
                &["no group is called 'attic'"],
            ),
            case("vforward two.json --reflectance 0.5 --reference-panel 1", 1, &["--material"]),
            case("vforward two.json --reflectance 0.5 | vestimate --fit tilt", 1, &["a fold is needed"]),
            case(
                "vforward two.json --reflectance 0.5 --bounces 2 --material a=1",
                2,
                &["--bounces", "--material"],
            ),
            case(
                "sed 's/\"unknowns\":[0-9]*/\"unknowns\":7/' two.json | vforward --reflectance 0.5 --material \"panel 0=1\"",
                1,
                &["accuracy.unknowns", "vkernel"],
            ),
            case(
                "sed 's/\"faces\":\\[/&[0,1,99],/' two.json | vforward --reflectance 0.5 --material a=1",
                1,
                &["-:1"],
            ),
            case(
                "sed 's/\"towards\":\\[/\"towards\":[0,/' two.json | vforward --reflectance 0.5",
                1,
                &["-:1", "light"],
            ),
        ],
    );
}

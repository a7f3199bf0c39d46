//! Lights around shapes.

use crate::{assert_refused, case};

#[test]
fn lights() {
    assert_refused(
        "",
        &[
            case("vkernel --light 0,0,1 --tilt-deg 5", 2, &["--tilt-deg", "--light X,Y,Z"]),
            case("vkernel --light 0,0,1 --method midpoint", 2, &["--method", "not with --light"]),
            case(
                "vkernel --light 0,0,1 --tolerance 1e-9",
                2,
                &["--tolerance: 1e-9 cannot be kept with --light", "single precision", "give 1e-6 to 0.1"],
            ),
            case("vkernel --folds 3 --tolerance 1e-9", 2, &["--tolerance: 1e-9 cannot be kept on shapes"]),
            case("vkernel --sky-type overcast", 2, &["--sky-type", "no sky", "--sky only"]),
            case("vkernel --sky only --sky-type 16", 2, &["--sky-type", "1 to 15"]),
            case(
                "vkernel --sky only --sky-type clear --zenith 0,0,-1",
                2,
                &["--sky-type", "below its horizon"],
            ),
            case("vkernel --light area:0,0,2", 2, &["--light", "WIDTHxHEIGHT"]),
            case("vkernel --light area:0,0,2,1x0", 2, &["--light", "rectangle"]),
            case("vkernel --folds 2 --light 0,0", 2, &["--light", "X,Y,Z"]),
            case("vkernel --folds 2 --light 0,0,1:", 2, &["--light", "X,Y,Z"]),
            case("vkernel --folds 2 --light point:0,0,x", 2, &["--light", "X,Y,Z"]),
            case("vkernel --folds 2 --light 0,0,0", 2, &["--light", "not a direction"]),
            case("vkernel --folds 2 --light 0,0,NaN", 2, &["--light", "0,0,NaN", "write X,Y,Z"]),
            case("vkernel --folds 2 --light 0,0,1:-1", 2, &["--light", "irradiance -1"]),
            case("vkernel --folds 2 --light point:0,0,inf", 2, &["--light", "0,0,inf", "write X,Y,Z"]),
            case("vkernel --folds 2 --light none", 2, &["--light", "--sky 1"]),
            case("vkernel --folds 2 --sky -1", 2, &["--sky", "irradiance -1"]),
            case("vkernel --folds 2 --zenith 0,0,1", 2, &["--zenith", "overcast"]),
            case(
                "vkernel --folds 2 --sky 1 --sky-type overcast --zenith 0,0,0",
                2,
                &["--sky", "not a direction"],
            ),
            case("vkernel --folds 3 --facets 1x1 --light 0,0,-1", 1, &["no light falls"]),
        ],
    );
}

/// A fold among lamps is estimated as it was stated.
#[test]
fn folds() {
    assert_refused(
        "vkernel --facets 2x2 --light point:0,0,2 --no-history -o lamp.json",
        &[
            case("vforward lamp.json --reflectance 0.5 | vestimate --fit tilt", 1, &["only the exposure"]),
            case("vforward lamp.json --reflectance 0.5 --reference-panel 1", 1, &["--material"]),
        ],
    );
}

/// Scenes under several lights, and tools that need a fold.
#[test]
fn scenes() {
    assert_refused(
        "vkernel --folds 2 --facets 1x1 --mesh facets --light 0,0,1 --light 1,0,1 --no-history -o two.json
        printf 'nm,r\n500,0.5\n600,0.5\n' > narrow.csv",
        &[
            case(
                "vforward two.json --reflectance 0.5 --material attic=narrow.csv",
                2,
                &["--material: spectrum 'narrow'", "500..600 nm"],
            ),
            case(
                "vforward two.json --reflectance 0.5 | vestimate --material attic=narrow.csv",
                2,
                &["vestimate: --material: spectrum 'narrow'", "500..600 nm"],
            ),
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
                "sed 's/\"unknowns\":[0-9]*/\"unknowns\":7/' two.json \
                    | vforward --reflectance 0.5 --material \"panel 0=1\"",
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

/// `sun:` and `sky:`: places, times and angles at which no sun shines.
#[test]
fn computed_daylight() {
    assert_refused(
        "
        vkernel --facets 1x1 -o scene.json
        cat > lit <<'END'
        vforward scene.json --reflectance 0.5 --illuminant \"$@\"
END
        ",
        &[
            case("sh lit sun:", 1, &["sun:", "not a place and time", "sun:40deg"]),
            case("sh lit sun:40", 1, &["sun:40", "not a place and time"]),
            case("sh lit sun:deg", 1, &["not an angle"]),
            case("sh lit sun:NaNdeg", 1, &["NaN° is not an angle"]),
            case("sh lit sun:-5deg", 1, &["-5° is not an angle"]),
            case("sh lit sun:90deg", 1, &["below the horizon", "less than 90"]),
            case("sh lit sun:1e308deg", 1, &["below the horizon"]),
            case("sh lit sun:91,0,2024-06-01T12:00Z", 1, &["'91,0' is not a place", "-90 to 90"]),
            case("sh lit sun:50,NaN,2024-06-01T12:00Z", 1, &["is not a place"]),
            case("sh lit sun:50,8,yesterday", 1, &["'yesterday' is not a time"]),
            case("sh lit sun:50,8,2024-02-30T12:00Z", 1, &["is not a time"]),
            case("sh lit sun:50,8,2024-06-01T12:00", 1, &["is not a time", "UTC"]),
            case("sh lit sun:50,8,999999999999-06-01T12:00Z", 1, &["is not a time"]),
            case("sh lit sun:50,8,2024-06-01T12:00+99:00", 1, &["is not a time"]),
            case("sh lit sun:50,8,2024-06-01T00:00Z", 1, &["below the horizon", "check the time"]),
            case("sh lit sky:", 1, &["sky:"]),
            case("sh lit D65 --sky-illuminant sky", 2, &["--sky-illuminant", "needs a sun", "sky:40deg"]),
            case("sh lit D65 --sky-illuminant sky:99deg", 1, &["sky:99deg", "below the horizon"]),
            case("vkernel --sky sun:95deg", 2, &["--sky", "below the horizon"]),
            case("vkernel --sky sun:", 2, &["--sky", "not a place and time"]),
            case("vkernel --sky sky:40deg", 2, &["--sky"]),
            case("vkernel --sky sun:50,8,2024-12-21T23:00Z", 2, &["--sky", "below the horizon"]),
        ],
    );
}

//! Every kind of hostile input for every tool.
//!
//! The other files of this folder have more of each kind. Closed pipes leave no trace, everything else one
//! line.

use crate::common::Workdir;
use crate::{Case, TOOLS, assert_refused, case, limited};

/// What a tool does with a kind of input.
enum Cell {
    /// Refuses it.
    Refuses(&'static [Case]),
    /// Nothing to be said: exit status 0, and silence.
    Passes(&'static str),
    /// A sample of a stream goes out with an error, which says this: exit status 3.
    Marks(&'static str, &'static str),
    /// Why there is no such input.
    TakesNone(&'static str),
}
use Cell::{Marks, Passes, Refuses, TakesNone};

const NO_ARRAYS: Cell = TakesNone("arrays are written, not read");
const NO_PICTURES: Cell = TakesNone("only vextract reads pictures");

/// A kind of input; then what vkernel, vforward, vextract, vestimate and vscore do with it.
const TABLE: [(&str, [Cell; 5]); 11] = [
    (
        "truncated",
        [
            Refuses(&[case("vkernel --shape cut.ply", 1, &["cut.ply", "not a PLY file", "export"])]),
            Refuses(&[
                case("head -c 400 scene.json | vforward --reflectance 0.5", 1, &["-:1", "cut", "again"]),
                case("vforward scene.json --reflectance 0.5 --camera cut.json", 1, &["cut.json:1", "EOF"]),
                case("vforward --kernel cut.npy --reflectance 0.5", 1, &["cut.npy", "save it again"]),
            ]),
            Refuses(&[
                case("sh extract cut.exr", 1, &["cut.exr", "cut short", "copy it again"]),
                case("sh extract photo.exr --regions cut.json", 1, &["cut.json:1", "EOF", "panel0"]),
                case("sh extract photo.exr --scene cut-scene.json", 1, &["cut-scene.json:1", "cut", "again"]),
            ]),
            Refuses(&[case("vestimate cut.ndjson", 1, &["cut.ndjson:2", "cut", "again"])]),
            Refuses(&[
                case("vscore cut.ndjson", 1, &["cut.ndjson:2", "cut", "again"]),
                case("vscore estimates.ndjson --truth cut.sp", 1, &["cut.sp:6", "END_DATA", "again"]),
            ]),
        ],
    ),
    (
        "NaN",
        [
            Refuses(&[
                case("vkernel --shape nan.obj", 1, &["nan.obj", "vertex", "finite"]),
                case("vkernel --angle-deg NaN", 2, &["--angle-deg", "NaN"]),
            ]),
            Refuses(&[
                case("vforward scene.json --reflectance nan.csv", 1, &["nan.csv:3", "'NaN'", "finite"]),
                case("vforward --kernel nan.npy --reflectance 0.5", 1, &["nan.npy", "NaN"]),
            ]),
            Refuses(&[case("sh extract photo.exr --regions nan.json", 1, &["nan.json:1", "panel0"])]),
            Refuses(&[case("vestimate nan.ndjson", 3, &["nan.ndjson:2", "not a JSON object", "one record"])]),
            Refuses(&[case("vscore estimates.ndjson --truth nan.csv", 1, &["nan.csv:3", "'NaN'", "finite"])]),
        ],
    ),
    (
        "1e308",
        [
            Refuses(&[case("vkernel --shape huge.obj", 1, &["huge.obj", "vertex", "finite"])]),
            Refuses(&[case("vforward scene.json --reflectance huge.csv", 1, &["'r'", "1e308", "rescale"])]),
            Refuses(&[case("sh extract photo.exr --regions huge.json", 1, &["huge.json", "'panel0'"])]),
            Marks("vestimate huge.ndjson", "facet_rgb': 1e308 cannot be"),
            Marks("vscore huge-estimates.ndjson", "estimate"),
        ],
    ),
    (
        "wrong shapes",
        [
            Refuses(&[case(
                "vkernel --shape fifth.obj",
                1,
                &["fifth.obj", "face 0 has 5 corners", "divide"],
            )]),
            Refuses(&[
                case("vforward --kernel wide.npy --reflectance 0.5", 1, &["wide.npy", "[2, 3]", "square"]),
                case("vforward scene.json --facet-reflectance wide.npy", 1, &["wide.npy", "8 facets by 61"]),
            ]),
            Refuses(&[case(
                "sh extract photo.exr --regions three.json",
                1,
                &["'panel0'", "length 3", "four"],
            )]),
            Refuses(&[case("vestimate wide.ndjson", 1, &["wide.ndjson:1", "residues", "facet"])]),
            Marks("vscore long-estimates.ndjson", "estimate"),
        ],
    ),
    (
        "NPY headers that claim terabytes",
        [
            NO_ARRAYS,
            Refuses(&[
                case("vforward --kernel vast.npy --reflectance 0.5", 1, &["vast.npy", "1 to 20000 rows"]),
                case("vforward --kernel lying.npy --reflectance 0.5", 1, &["lying.npy", "holds fewer"]),
                case("vforward --kernel headed.npy --reflectance 0.5", 1, &["headed.npy", "header", "save"]),
                case("vforward --kernel nested.npy --reflectance 0.5", 1, &["nested.npy", "header", "save"]),
                case("vforward scene.json --facet-reflectance vast.npy", 1, &["vast.npy", "8 facets by 61"]),
            ]),
            NO_ARRAYS,
            Refuses(&[case(
                "vestimate --kernel vast.npy --reflectance 0.5 --plan --camera 1",
                1,
                &["vast.npy", "1 to 20000 rows"],
            )]),
            NO_ARRAYS,
        ],
    ),
    (
        "image bombs",
        [
            NO_PICTURES,
            NO_PICTURES,
            Refuses(&[
                case("sh extract bomb.png", 1, &["bomb.png", "2 GiB", "crop"]),
                case("sh extract lean.png", 1, &["lean.png", "too few for", "copy it again"]),
                case("sh extract wide.png", 1, &["wide.png", "65536 px a side", "crop"]),
                case("sh extract bomb.tif", 1, &["bomb.tif", "beyond the end of the file"]),
                case("sh extract photo.exr --white bomb.png", 1, &["bomb.png", "2 GiB", "crop"]),
            ]),
            NO_PICTURES,
            NO_PICTURES,
        ],
    ),
    (
        "deep JSON",
        [
            Refuses(&[case("vkernel --shape deep.json", 1, &["deep.json:1", "vertices"])]),
            Refuses(&[
                case("vforward deep.json --reflectance 0.5", 1, &["deep.json:1", "one record"]),
                case("vforward scene.json --reflectance deeper.json", 1, &["deeper.json:1", "spectral_data"]),
            ]),
            Refuses(&[
                case("sh extract photo.exr --scene deep.json", 1, &["deep.json:1", "one record"]),
                case("sh extract photo.exr --regions deep.json", 1, &["deep.json:1", "panel0"]),
            ]),
            Refuses(&[case("vestimate deep.json", 1, &["deep.json:1", "one record"])]),
            Refuses(&[case("vscore deep.json", 1, &["deep.json:1", "one record"])]),
        ],
    ),
    (
        "non-monotone wavelengths",
        [
            TakesNone("a kernel has no wavelengths"),
            Refuses(&[
                case("vforward scene.json --reflectance falling.csv", 1, &["falling.csv:4", "sort"]),
                case(
                    "vforward scene.json --reflectance 1 --wavelengths-nm 700:400:5",
                    2,
                    &["--wavelengths-nm", "700"],
                ),
            ]),
            Refuses(&[case("sh extract photo.exr --illuminant falling.csv", 1, &["falling.csv:4", "sort"])]),
            Refuses(&[
                case("vestimate samples.ndjson --prior falling.csv", 1, &["falling.csv:4", "sort"]),
                case("vestimate falling.ndjson", 1, &["falling.ndjson:1", "wavelength"]),
            ]),
            Refuses(&[
                case("vscore estimates.ndjson --truth falling.csv", 1, &["falling.csv:4", "sort"]),
                case("vscore falling.ndjson", 1, &["falling.ndjson:1", "wavelength"]),
            ]),
        ],
    ),
    (
        "closed pipes",
        [
            Passes("vkernel"),
            Passes("vforward scene.json --reflectance cc24"),
            Passes("sh extract photo.exr"),
            Passes("vestimate samples.ndjson"),
            Passes("vscore estimates.ndjson"),
        ],
    ),
    (
        "full disks",
        [
            Refuses(&[
                case("vkernel > /dev/full", 1, &["standard output", "No space left"]),
                case("sh full vkernel -o out.json", 1, &["out.json", "too large"]),
                case("sh full vkernel --save kernel=out.npy > /dev/null", 1, &["out.npy", "too large"]),
            ]),
            Refuses(&[
                case("vforward scene.json --reflectance 1 > /dev/full", 1, &["standard output", "No space"]),
                case(
                    "sh full vforward scene.json --reflectance cc24 -o out.json",
                    1,
                    &["out.json", "too large"],
                ),
                case(
                    "sh full vforward scene.json --reflectance 1 --render out.png > /dev/null",
                    1,
                    &["out.png", "too large"],
                ),
            ]),
            Refuses(&[
                case("sh extract photo.exr > /dev/full", 1, &["standard output", "No space left"]),
                case("sh full sh extract photo.exr -o out.json", 1, &["out.json", "too large"]),
                case(
                    "sh full sh extract photo.exr --overlay out.png > /dev/null",
                    1,
                    &["out.png", "too large"],
                ),
            ]),
            Refuses(&[
                case("vestimate samples.ndjson > /dev/full", 1, &["standard output", "No space left"]),
                case("sh full vestimate samples.ndjson -o out.json", 1, &["out.json", "too large"]),
                case(
                    "sh full vestimate samples.ndjson --plot out.png > /dev/null",
                    1,
                    &["out.png", "too large"],
                ),
                case(
                    "sh full vestimate samples.ndjson --trace out.json > /dev/null",
                    1,
                    &["out.json", "too large"],
                ),
            ]),
            Refuses(&[
                case("vscore estimates.ndjson > /dev/full", 1, &["standard output", "No space left"]),
                case("vscore estimates.ndjson --table > /dev/full", 1, &["standard output", "No space left"]),
                case("sh full vscore estimates.ndjson -o out.json", 1, &["out.json", "too large"]),
            ]),
        ],
    ),
    (
        "missing files",
        [
            Refuses(&[
                case("vkernel --shape no.obj", 1, &["no.obj", "No such file"]),
                case("vkernel -o no/such.json", 1, &["no/such.json"]),
            ]),
            Refuses(&[
                case("vforward no.json --reflectance 0.5", 1, &["no.json", "No such file"]),
                case("vforward scene.json --reflectance no.csv", 1, &["no.csv", "No such file"]),
                case("vforward --kernel no.npy --reflectance 0.5", 1, &["no.npy", "No such file"]),
            ]),
            Refuses(&[
                case("sh extract no.exr", 1, &["no.exr", "No such file"]),
                case("sh extract photo.exr --scene no.json", 1, &["no.json", "No such file"]),
                case("sh extract photo.exr --regions no.json", 1, &["no.json", "No such file"]),
            ]),
            Refuses(&[
                case("vestimate no.ndjson", 1, &["no.ndjson", "No such file"]),
                case("vestimate samples.ndjson --prior no.csv", 1, &["no.csv", "No such file"]),
            ]),
            Refuses(&[
                case("vscore no.ndjson", 1, &["no.ndjson", "No such file"]),
                case("vscore estimates.ndjson --truth no.csv", 1, &["no.csv", "No such file"]),
            ]),
        ],
    ),
];

/// Good files, and the bad ones that are made of them.
const SETUP: &str = concat!(
    r#"
    cp '"#,
    env!("CARGO_MANIFEST_DIR"),
    r#"/tests/data/photos/a_ideal_magenta_50.exr' photo.exr
    vkernel --angle-deg 50 --facets 2x2 --no-history -o scene.json
    vforward scene.json --reflectance cc24:red --wavelengths-nm 400:700:10 --no-history -o samples.ndjson
    vestimate samples.ndjson --no-history -o estimates.ndjson
    cat > extract <<'END'
    vextract -q "$@" --panel0 '332,462 345,77 122,12 104,442' --camera canon-5d-mark-ii \
        $([ "$2" = --scene ] || echo --scene scene.json)
END
    cat > full <<'END'
    trap '' XFSZ
    ulimit -f 0
    exec "$@"
END

    printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n' > points
    { cat points; printf 'v 1 nan 0\nf 1 2 5\n'; } > nan.obj
    { cat points; printf 'v 1 1e308 0\nf 1 2 5\n'; } > huge.obj
    { cat points; printf 'v 0 .5 0\nf 1 2 3 4 5\n'; } > fifth.obj
    printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property float x' 'property float y' \
        'property float z' 'element face 1' 'property list uchar int vertex_indices' end_header \
        '0 0 0' '1 0 0' > cut.ply

    printf 'nm,r\n400,0.1\n500,NaN\n700,0.3\n' > nan.csv
    printf 'nm,r\n400,0.1\n700,1e308\n' > huge.csv
    printf 'nm,r\n400,0.1\n700,0.2\n500,0.3\n' > falling.csv
    printf 'SPECT\nBEGIN_DATA_FORMAT\nSPEC_400 SPEC_700\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\n' > cut.sp

    python3 - <<'END'
import struct, zlib
import numpy as np
good = np.array([[0.0, 0.1], [0.4, 0.0]])
np.save('good.npy', good)
np.save('nan.npy', good * [[1.0, np.nan], [1.0, 1.0]])
np.save('wide.npy', np.zeros((2, 3)))
whole = open('good.npy', 'rb').read()
open('cut.npy', 'wb').write(whole[:-8])
for name, count in [('vast.npy', 10**9), ('lying.npy', 19000)]:
    text = b"{'descr': '<f8', 'fortran_order': False, 'shape': (%d, %d), }" % (count, count)
    text = text.ljust(117) + b'\n'
    open(name, 'wb').write(b'\x93NUMPY\x01\x00' + struct.pack('<H', len(text)) + text + bytes(16))
nested = (b"{'descr': " + b'[' * 50 + b"('a', '<f8')" + b']' * 50
          + b", 'fortran_order': False, 'shape': (2, 2), }\n")
open('nested.npy', 'wb').write(b'\x93NUMPY\x01\x00' + struct.pack('<H', len(nested)) + nested + bytes(32))
open('headed.npy', 'wb').write(b'\x93NUMPY\x02\x00\xff\xff\xff\xff' + whole[10:])
def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
for name, size in [('bomb.png', (65535, 65535)), ('lean.png', (26000, 13700)), ('wide.png', (2**31 - 1, 1))]:
    header = chunk(b'IHDR', struct.pack('>IIBBBBB', *size, 16, 2, 0, 0, 0))
    data = chunk(b'IDAT', zlib.compress(bytes(9))) + chunk(b'IEND', b'')
    open(name, 'wb').write(b'\x89PNG\r\n\x1a\n' + header + data)
tags = [(256, 4, 1, 65535), (257, 4, 1, 65535), (258, 3, 1, 16), (259, 3, 1, 1), (262, 3, 1, 1),
        (273, 4, 1, 8), (277, 3, 1, 1), (278, 4, 1, 65535), (279, 4, 1, 2**32 - 1)]
entries = b''.join(struct.pack('<HHII', *tag) for tag in tags)
open('bomb.tif', 'wb').write(b'II*\0' + struct.pack('<IH', 8, len(tags)) + entries + bytes(4))
END

    echo '{"panel0": [[1,1],[99,1]' | tr -d '\n' > cut.json
    echo '{"panel0": [[1,1],[99,1],[99,99],[1,NaN]]}' > nan.json
    echo '{"panel0": [[1,1],[99,1],[99,99],[1,1e308]]}' > huge.json
    echo '{"panel0": [[1,1],[99,1],[99,99]]}' > three.json
    head -c 100000 /dev/zero | tr '\0' '[' > deeper.json
    { cat deeper.json; echo; } > deep.json

    head -c 400 photo.exr > cut.exr
    head -c 400 scene.json > cut-scene.json
    head -c -9 samples.ndjson > cut.ndjson
    sed '2s/"facet_rgb":\[\[/&NaN,/' samples.ndjson > nan.ndjson
    sed '2s/"facet_rgb":\[\[/&1e308,/' samples.ndjson > huge.ndjson
    sed 's/"residues":\[/&[1],/' samples.ndjson > wide.ndjson
    sed 's/"wavelengths_nm":\[/&900,/' estimates.ndjson > falling.ndjson
    sed 's/"estimate":.*"reflectance":\[[^,]*/&e308/' estimates.ndjson > huge-estimates.ndjson
    sed 's/"estimate":.*"reflectance":\[/&0.5,/' estimates.ndjson > long-estimates.ndjson
    "#
);

#[test]
fn every_tool_refuses_every_kind() {
    let cells = || TABLE.iter().flat_map(|(_, cells)| cells);
    let cases = cells().filter_map(|cell| if let Refuses(cases) = cell { Some(*cases) } else { None });
    assert_refused(SETUP, &cases.flatten().copied().collect::<Vec<_>>());
}

#[test]
fn what_is_no_fault_of_the_whole_run() {
    let folder = Workdir::new();
    folder.sh(SETUP);
    for (kind, cells) in TABLE {
        for (cell, tool) in cells.iter().zip(TOOLS) {
            match cell {
                Passes(script) => {
                    let run =
                        folder.sh(&limited(&format!("{{ sleep 0.3; {script} || echo $? >&2; }} | true")));
                    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{kind}: {script}");
                }
                Marks(script, says) => {
                    let run = folder.sh(&limited(script));
                    assert!(run.says_what_failed(), "{kind}: {script}: {run:?}");
                    let marked =
                        run.stdout.lines().filter(|line| line.contains("\"error\":")).collect::<Vec<_>>();
                    assert!(
                        matches!(&marked[..], [line] if line.contains(says)),
                        "{kind}: {tool}: {marked:?}"
                    );
                }
                TakesNone(why) => assert!(!why.is_empty(), "{kind}: {tool}"),
                Refuses(_) => {}
            }
        }
    }
}

//! Files of surfaces that are none.

use crate::{assert_refused, case};

/// A floor in each format, and what can be wrong with it.
const SETUP: &str = r#"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.2 0.2 0\nv 1 1 0.5\n' > points
{ cat points; echo 'f 1 2 9'; } > corner.obj
{ cat points; echo 'f 1 2 5 4'; } > notch.obj
{ cat points; echo 'f 1 2 6 4'; } > bent.obj
{ cat points; echo 'f 1 2 2'; } > thin.obj
{ cat points; echo 'f 1 2 6148914691236517209'; } > modulo.obj
{ cat points; echo 'f 1/1 2/-4 3/1'; echo 'vt 0 0'; } > before.obj
cp points bare.obj
{ cat points; echo 'v 1e400 0 0'; echo 'f 1 2 7'; } > far.obj
{ cat points; echo 'f 1 2 3'; echo 'f 1 x 3'; } > letter.obj
: > empty.obj
head -c 100000 /dev/urandom > noise.obj
cp noise.obj noise.ply
cp noise.obj noise.json
printf 'ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n' > bomb.ply
{
    printf '%s\n' ply 'format binary_little_endian 1.0' 'element vertex 1' 'property float x' \
        'property float y' 'property float z' 'element face 1' 'property list uint int vertex_indices' \
        end_header
    printf '\0\0\0\0\0\0\0\0\0\0\0\0\377\377\377\377'
} > long.ply
printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property float x' 'property float y' \
    'element face 1' 'property list uchar int vertex_indices' end_header '0 0' '1 0' '1 1' '3 0 1 2' \
    > flat.ply
echo '{"vertices": [[0,0,0],[1,0,0],[1,1,0]], "facets": [[0,1,2]], "colour": 1}' > more.json
echo '{"vertices": [[0,0,0],[1,0,0],[1,1,1e999]], "facets": [[0,1,2]]}' > huge.json
echo '{"vertices": [[0,0,0],[1,0,0],[1,1,0]], "facets": [[0,1,18446744073709551615]]}' > index.json
printf '%s %s\n' '{"vertices": [[0,0,0],[1,0,0],[1,1,0]], "facets": [[0,1,2]],' \
    '"groups": [{"name": "a", "facets": [7, 18446744073709551615]}]}' > group.json
echo solid > floor.stl
truncate -s 20M large.ply
ln -s /dev/zero endless.obj
ln -s /dev/zero endless.ply
mkdir folder.obj
python3 -c '
n = 320
print("\n".join(f"v {i} {j} 0" for i in range(n + 1) for j in range(n + 1)))
print("\n".join(
    f"f {i * (n + 1) + j + 1} {(i + 1) * (n + 1) + j + 1} {(i + 1) * (n + 1) + j + 2}"
    for i in range(n) for j in range(n)))
' > many.obj
"#;

#[test]
fn shapes() {
    assert_refused(
        SETUP,
        &[
            case("vkernel --shape corner.obj", 1, &["corner.obj", "vertex"]),
            case("vkernel --shape notch.obj", 1, &["notch.obj", "face 0 is not convex", "divide"]),
            case("vkernel --shape bent.obj", 1, &["bent.obj", "face 0 is not flat", "divide"]),
            case("vkernel --shape modulo.obj", 1, &["modulo.obj", "line 7", "no index"]),
            case("vkernel --shape before.obj", 1, &["before.obj", "not an OBJ"]),
            case("vkernel --shape thin.obj", 1, &["thin.obj", "no face"]),
            case("vkernel --shape bare.obj", 1, &["bare.obj", "no face"]),
            case("vkernel --shape far.obj", 1, &["far.obj"]),
            case("vkernel --shape letter.obj", 1, &["letter.obj"]),
            case("vkernel --shape empty.obj", 1, &["empty.obj", "no face"]),
            case("vkernel --shape noise.obj", 1, &["noise.obj"]),
            case("vkernel --shape noise.ply", 1, &["noise.ply", "not a PLY"]),
            case("vkernel --shape noise.json", 1, &["noise.json"]),
            case("vkernel --shape bomb.ply", 1, &["bomb.ply"]),
            case("vkernel --shape long.ply", 1, &["long.ply"]),
            case("vkernel --shape flat.ply", 1, &["flat.ply", "lacks x, y or z"]),
            case("vkernel --shape more.json", 1, &["more.json:1", "colour"]),
            case("vkernel --shape huge.json", 1, &["huge.json:1", "out of range"]),
            case("vkernel --shape index.json", 1, &["index.json", "face 0 uses vertex"]),
            case("vkernel --shape large.ply", 1, &["large.ply", "16 MiB", "coarser"]),
            case("vkernel --shape endless.obj", 1, &["endless.obj", "no face"]),
            case("vkernel --shape endless.ply", 1, &["endless.ply", "not a PLY"]),
            case("vkernel --shape floor.stl", 1, &["floor.stl", ".obj, .ply or .json"]),
            case("vkernel --shape folder.obj", 1, &["folder.obj"]),
            case("vkernel --shape many.obj", 1, &["many.obj", "102400 facets"]),
            case("vkernel --shape thin.obj --folds 2", 2, &["--shape", "--folds"]),
            case("vkernel --two-sided", 2, &["--shape"]),
            case("vkernel --shape thin.obj --check", 2, &["--check"]),
            case("vkernel --folds 0", 2, &["--folds"]),
            case("vkernel --folds 3 --ridge-deg 400", 2, &["--ridge-deg"]),
            case("vkernel --folds 1000000", 2, &["--folds", "1 to 1000"]),
            case("vkernel --bow-deg 1e9", 2, &["--bow-deg"]),
            case("vkernel --angle-deg 20 --bow-deg -25", 2, &["panels 0 and 1", "--angle-deg"]),
        ],
    );
}

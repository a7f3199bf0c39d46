# vfold-measure: a photograph alone, several with one that fails, and what it says where it stops. Verdicts are a prior's: their sentences are left out.
unset DISPLAY WAYLAND_DISPLAY BROWSER
photos=$CARGO_MANIFEST_DIR/tests/data/photos
cp "$photos/a_ideal_magenta_50.exr" photo.exr
cp "$photos/f_srgb_blue_flower_50.jpg" unsure.jpg
measure() {
    "$CARGO_MANIFEST_DIR/share/vfold-measure" "$@" 2>&1 </dev/null | sed 's/\(good\|doubtful\|wrong\): .*/\1/; s/only [0-9.]* % confidence/only .. % confidence/' || :
}
measure --camera canon-5d-mark-ii --illuminant D65 photo.exr
ls -A vfold-photo
head -n 1 vfold-photo/spectrum.csv
echo '-- several'
measure --yes --camera=canon-5d-mark-ii photo.exr unsure.jpg | grep -v 'daylight assumed\|do not tell'
ls -d vfold-*
grep -o '<th scope="row">.*</th>' vfold-report.html | sed 's/<[^>]*>//g'
echo '-- refused'
measure photo.exr
measure --camera canon-5d-mk2 photo.exr
measure --illuminant D66 photo.exr
measure none.exr photo.exr no.tif
measure --lens x photo.exr
measure --transfer gamma photo.exr
measure --undo none.json photo.exr
measure vfold-photo

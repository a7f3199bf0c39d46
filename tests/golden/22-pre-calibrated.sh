# tolerance 1e-6 1e-9
# The paper's pre-calibration, as examples/paper has it: a camera whose numbers are 0.7 of what they should be.
vkernel --angle-deg 180 --facets 1x1 -o flat.json
vforward flat.json --reflectance cc24 --exposure 0.7 -o measured.ndjson
vforward flat.json --reflectance cc24 -o expected.ndjson
vforward flat.json --reflectance cc24:cyan 0.5 --exposure 0.7 --noise-sd 1e-3 --seed 1 |
    "$CARGO_MANIFEST_DIR/examples/paper/precalibrate" measured.ndjson expected.ndjson | tail -n 2 |
    sed 's/"truth": {[^}]*}/"truth": {}/'

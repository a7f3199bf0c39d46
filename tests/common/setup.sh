# Leaves a scene, samples, estimates, a photograph and a command that knows its corners.
cp "$CARGO_MANIFEST_DIR/tests/data/photos/a_ideal_magenta_50.exr" photo.exr
vkernel --angle-deg 50 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24 --noise-sd 1e-3 -o samples.ndjson
vestimate samples.ndjson -o estimates.ndjson
cat > extract <<'END'
exec vextract "$@" --scene "${scene:-scene.json}" --camera canon-5d-mark-ii --illuminant D65 \
    --panel0 "332,462 345,77 122,12 104,442" --panel1 "332,462 345,77 485,17 472,446"
END

# A camera's own picture: white balance and matrix to sRGB, cut to 0..1, curve, 8 bits. Told what the camera did, vextract
# gives the camera's RGB again; what the camera cut is counted and left out. Exposed four times as long, much is cut.
vkernel --angle-deg 50 --facets 2x2 -o scene.json
cat > did.json <<'END'
{"white_balance_gains": [2.0, 1.0, 1.5],
 "camera_to_linear_srgb": [[1.5, -0.4, -0.1], [-0.2, 1.5, -0.3], [0.1, -0.5, 1.4]]}
END
crease="358.28,441.60 346.13,100.03"
measure() {
    vextract -q --exact-corners "$@" --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "$crease 155.42,55.00 166.27,426.90" \
        --panel1 "$crease 469.63,38.40 484.58,413.42" --save facet_rgb=$1.npy --save facet_clipped=clipped.npy >sample.ndjson
}
for exposure in 1 4; do
    vforward scene.json --reflectance cc24:light-skin --exposure $exposure --render photo.exr -o sample.ndjson 2>/dev/null
    measure photo.exr
    # oiiotool multiplies rows by the matrix: it takes the transpose
    oiiotool photo.exr --mulc 2,1,1.5 --ccmatrix 1.5,-0.2,0.1,-0.4,1.5,-0.5,-0.1,-0.3,1.4 -o linear.exr
    oiiotool linear.exr --colorconvert linear sRGB --clamp:min=0:max=1 -d uint8 -o srgb.png
    oiiotool linear.exr --colorconvert linear sRGB --clamp:min=0:max=1 -d uint8 --compression jpeg:98 -o srgb.jpg
    for photo in linear.exr srgb.png srgb.jpg; do
        measure $photo --undo did.json
        python3 - $photo $exposure <<'END'
import json, sys
import numpy as np
photo, exposure = sys.argv[1:]
limit = {"linear.exr": 1e-3, "srgb.png": 2e-3, "srgb.jpg": 5e-3}[photo]
if exposure == "4": # the rest of a facet that is clipped in part says less of it
    limit = 1e-2
reference, got = (np.array(np.load(name + ".npy"), float) for name in ("photo.exr", photo))
error, seen = np.nanmax(np.abs(got / reference - 1)), np.isfinite(got).all(-1).sum()
undone = json.loads(open("sample.ndjson").readlines()[-1])["image"]["undone"]
assert undone == json.load(open("did.json"))
print(f"exposure {exposure}, {photo}: {seen} facets", "within" if error < limit else f"off by {error:.2%}, not", f"{limit:.1%};",
      int(np.load("clipped.npy").sum()), "clipped")
END
    done
done

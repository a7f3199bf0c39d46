# A picture stored in any of the eight orientations, at any depth, gives the facets of the upright one.
vkernel --angle-deg 50 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2>/dev/null
crease="358.28,441.60 346.13,100.03"
measure() {
    vextract $1 --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "$crease 155.42,55.00 166.27,426.90" \
        --panel1 "$crease 469.63,38.40 484.58,413.42" --save facet_rgb=$1.npy
}
measure photo.exr >upright.ndjson
while read orientation turn; do
    for depth in uint16 float; do
        oiiotool photo.exr $turn --orientation $orientation -d $depth -o turned.tif
        measure turned.tif >turned.ndjson
        python3 - $orientation $depth <<'END'
import json, sys
import numpy as np
error = np.abs(np.load("turned.tif.npy") / np.load("photo.exr.npy") - 1).max()
image = json.loads(open("turned.ndjson").readlines()[-1])["image"]
print("orientation", image["orientation"], image["stored_as"], f"{image['width']} x {image['height']}:",
      "the same facets" if error < {"uint16": 1e-3, "float": 1e-9}[sys.argv[2]] else f"off by {error:.2%}")
END
    done
done <<'END'
1
2 --flop
3 --rotate180
4 --flip
5 --transpose
6 --rotate270
7 --transpose --rotate180
8 --rotate90
END

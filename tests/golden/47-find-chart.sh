# A colour chart beside the fold is found like the fold, whichever way it lies, and calibrates as one whose corners are told; what cannot be used
# is left out, and that is said.
vkernel --angle-deg 45 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --render fold.exr 2> corners >/dev/null
vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance cc24 --save facet_rgb=chart.npy >/dev/null

# 6 x 4 patches of 48 px with 6 px between them, their block from (650, 100) to (968, 310), on black paper with an edge
fills=$(python3 - <<'END'
import numpy as np
for k, rgb in enumerate(np.load("chart.npy")[:, 0]):
    print("--fill:color={0:.9f},{1:.9f},{2:.9f} 48x48+{3}+{4}".format(*rgb, 650 + 54 * (k % 6), 100 + 54 * (k // 6)))
END
)
oiiotool fold.exr --create 1000x480 3 --paste +0+0 --fill:color=0.02,0.02,0.02 342x234+638+88 $fills --mulc 0.48,0.6,0.66 \
    --noise:type=gaussian:stddev=0.002:seed=3 -d uint16 -o photo.tif
chart="650,100 968,100 968,310 650,310"
oiiotool photo.tif --rotate180 -o turned.tif
oiiotool photo.tif --cut 400x480+600+0 -o alone.tif
oiiotool alone.tif --fill:color=0.2,0.12,0.1 60x90+170+230 -o covered.tif
oiiotool photo.tif --crop 400x480+600+0 --resize 400x216 --origin +600+60 --fullsize 1000x480 --croptofull photo.tif --cut 600x480+0+0 --origin +0+0 --fullsize 1000x480 --croptofull --add -o flat.tif

vextract --find photo.tif turned.tif alone.tif covered.tif flat.tif --overlay 'overlay-{}.png' > found.json
python3 - <<'END'
import json, os
import numpy as np
true = np.array([[650, 100], [968, 100], [968, 310], [650, 310]], float)
places = {"photo.tif": true, "turned.tif": [1000, 480] - true, "alone.tif": true - [600, 0]}
for line in open("found.json"):
    found = json.loads(line)
    name, is_fold = found["image"], "a fold" if "panel0" in found else found["reason"]
    if name not in places:
        print(f"{name}: {is_fold}, {'a chart' if 'chart' in found else 'no chart'}")
        continue
    off = np.hypot(*(np.array(found["chart"]) - places[name]).T).max()
    drawn = "drawn" if os.path.exists(f"overlay-{name[:-4]}.png") else ""
    print(f"{name}: {is_fold}, a chart,", "within 2 px" if off < 2 else f"{off:.1f} px off", drawn)
END

extract() { vextract "$@" --scene scene.json --camera canon-5d-mark-ii; }
said() { sed 's|[0-9.]* % sure|.. % sure|; s|faces [0-9]*°|faces ..°|' said; }
head -1 found.json > one.json
python3 -c 'import json; found = json.load(open("one.json")); print(json.dumps({"panel0": found["panel0"], "panel1": found["panel1"]}))' > panels.json
extract photo.tif --illuminant D65 --regions panels.json --chart "$chart" -o told.ndjson
extract photo.tif --illuminant D65 -o found.ndjson 2> said
said
python3 - <<'END'
import json
import numpy as np
told, found = (json.loads(open(name).read().splitlines()[-1]) for name in ("told.ndjson", "found.ndjson"))
off = np.abs(np.array(found["facet_rgb"]) / np.array(told["facet_rgb"]) - 1).max()
print("facets", "alike" if off < 5e-3 else off, "exposure", "alike" if abs(found["exposure"] / told["exposure"] - 1) < 2e-3 else found["exposure"])
print("confidence", "kept" if found["calibration"]["detection_confidence"] >= 0.97 else "lost", "of the found one alone:", "detection_confidence" not in told["calibration"])
END

echo what is left out
exposure() { sed -n '2s/.*"exposure":\([0-9.]*\).*/\1/p' sample.ndjson | grep . || echo no exposure; }
extract photo.tif --illuminant D65 --exposure 0.5 -o sample.ndjson 2> said && said && exposure
extract photo.tif --illuminant unknown -o sample.ndjson 2> said && said && exposure
extract photo.tif --illuminant unknown --regions one.json -o sample.ndjson 2> said && said && exposure
extract flat.tif --illuminant D65 -o sample.ndjson 2> said && said && exposure
grep flat.tif found.json > flat.json
echo unless the cosine is told
extract flat.tif --illuminant D65 --regions flat.json --chart-cos 0.45 -o sample.ndjson 2> said && said
sed -n 2p sample.ndjson | grep -o '"cos":[0-9.]*'

echo a chart alone makes a camera
grep alone.tif found.json > alone.json
vextract alone.tif --regions alone.json --illuminant D65 --save-camera mine.csv 2>/dev/null && head -1 mine.csv

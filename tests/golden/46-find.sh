# From a photograph alone: the fold is found, measured and estimated; what shows none, or one that is cut, is refused with what to do.
cp "$CARGO_MANIFEST_DIR/tests/data/photos/a_ideal_magenta_50.exr" photo.exr
oiiotool photo.exr -d uint16 -o photo.tif
oiiotool photo.exr --rotate90 -d uint16 -o turned.tif
oiiotool photo.exr --cut 300x480+200+0 -d uint16 -o cut.tif
oiiotool --pattern constant:color=0.2,0.15,0.1 640x480 3 --noise:type=gaussian:stddev=0.005:seed=3 -d uint16 -o table.tif

vextract --find photo.tif turned.tif cut.tif table.tif --overlay 'overlay-{}.png' > found.json
python3 - <<'END'
import json, os
import numpy as np
crease, a, b = [[332.146, 462.515], [345.327, 77.055]], [[121.901, 11.939], [103.863, 442.247]], [[484.922, 16.705], [472.044, 453.388]]
upright = np.array([crease + a, crease + b])
turned = np.stack([480 - upright[..., 1], upright[..., 0]], -1)
# of a level crease the lower panel is 0, its right end 0
true = {"photo.tif": upright, "turned.tif": turned[::-1, [1, 0, 3, 2]]}
for line in open("found.json"):
    found = json.loads(line)
    name = found["image"]
    if name not in true:
        print(f"{name}: {found}")
        continue
    off = np.hypot(*np.moveaxis(np.array([found["panel0"], found["panel1"]]) - true[name], -1, 0)).max()
    drawn = os.path.exists(f"overlay-{name[:-4]}.png")
    print(f"{name}:", "within 1 px" if off < 1 else f"{off:.1f} px off", "sure" if found["confidence"] >= 0.97 else found["confidence"], "drawn" if drawn else "")
END

# what may be white is offered, and drawn; it is used once somebody says that it is white
white=topleft=0.75,0.75,0.75:topright=0.8,0.8,0.8:bottomleft=0.78,0.78,0.78:bottomright=0.8,0.8,0.8
oiiotool photo.exr --fill:$white 80x80+530+370 -o paper.exr
vextract --find paper.exr --overlay paper.png > paper.json
python3 - <<'END'
import json
found = json.load(open("paper.json"))
(a, b, c, d), = found["white_candidates"]
on_paper = all(530 <= x <= 610 and 370 <= y <= 450 for x, y in (a, b, c, d))
print("white candidate:", "on the paper" if on_paper and c[0] - a[0] > 40 else found["white_candidates"], "used" if "white" in found else "not used")
json.dump(found | {"white": [a, b, c, d]}, open("white.json", "w"))
END
vkernel --regions paper.json -o of_paper.json
for regions in paper white; do
    vextract paper.exr --scene of_paper.json --regions $regions.json --camera canon-5d-mark-ii --illuminant D65 2>/dev/null | grep -c white_paper || true
done

vkernel --angle-deg 50 --facets 4x4 -o scene.json
extract() { vextract "$@" --scene scene.json --camera canon-5d-mark-ii --illuminant D65; }
head -1 found.json > one.json
extract photo.tif --regions one.json -o told.ndjson
extract photo.tif -o found.ndjson 2> said
sed 's|[0-9.]* % sure|.. % sure|' said
vestimate found.ndjson -o estimate.ndjson
python3 - <<'END'
import json
import numpy as np
read = lambda name: json.loads(open(name).read().splitlines()[-1])
told, found, estimate = map(read, ["told.ndjson", "found.ndjson", "estimate.ndjson"])
off = np.abs(np.array(found["facet_rgb"]) / np.array(told["facet_rgb"]) - 1).max()
print("facets", "alike" if off < 1e-3 else off, "confidence", "kept" if found["image"]["detection_confidence"] >= 0.97 else "lost")
truth = json.load(open(f"{__import__('os').environ['CARGO_MANIFEST_DIR']}/tests/data/photos/a_ideal_magenta_50.json"))["reflectance"]
rmse = np.sqrt(np.mean((np.array(estimate["estimate"]["reflectance"]) - truth) ** 2))
print("RMSE below 0.05" if rmse < 0.05 else f"RMSE {rmse:.3f}")
END

refused() { extract "$@" 2>&1 >/dev/null || echo "status $?"; }
refused table.tif
refused cut.tif
refused table.tif --regions found.json
sed '1!d; s/"confidence":[0-9.]*/"confidence":0.4/' found.json > unsure.json
refused photo.tif --regions unsure.json

# Corners typed four pixels off find the panels in a photograph that other programs turned, scaled, cropped and made noisy; facets
# then agree with those at the true corners.
vkernel --angle-deg 50 --facets 4x4 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2>/dev/null
oiiotool photo.exr --noise:type=gaussian:stddev=0.004:seed=7 -d uint16 -o noisy.tif
oiiotool photo.exr --resize:filter=box 1280x960 -d half -o scaled.exr
oiiotool photo.exr --rotate90 -d half -o turned.exr
oiiotool photo.exr --cut 400x440+120+20 -d half -o cropped.exr

for photo in photo.exr noisy.tif scaled.exr turned.exr cropped.exr; do
    python3 - $photo <<'END'
import sys, json
import numpy as np
place = {  # where a point of the photograph is in the picture
    "scaled.exr": lambda p: 2 * p,
    "turned.exr": lambda p: np.stack([480 - p[:, 1], p[:, 0]], 1),
    "cropped.exr": lambda p: p - [120, 20],
}.get(sys.argv[1], lambda p: p)
crease, outer = [[358.28, 441.60], [346.13, 100.03]], [[[155.42, 55.00], [166.27, 426.90]], [[469.63, 38.40], [484.58, 413.42]]]
panels = [place(np.array(crease + ends)) for ends in outer]
off = [[4 * np.cos(k), 4 * np.sin(k)] for k in (0.3, 2.5, 4.4, 1.2)]
for k, panel in enumerate(panels):
    write = lambda corners: " ".join(f"{x:.2f},{y:.2f}" for x, y in corners)
    open(f"true{k}", "w").write(write(panel))
    open(f"typed{k}", "w").write(write(panel + off))
json.dump([panel.tolist() for panel in panels], open("true.json", "w"))
END
    extract() { vextract $photo --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "$(cat ${1}0)" --panel1 "$(cat ${1}1)" "$2" --save facet_rgb=$1.npy; }
    extract true --exact-corners >/dev/null
    extract typed --refine | tail -1 > found.json
    python3 - $photo <<'END'
import sys, json
import numpy as np
found, true = json.load(open("found.json"))["image"], np.array(json.load(open("true.json")))
off = np.hypot(*np.moveaxis(np.array(found["panels"]) - true, -1, 0)).max()
moved = np.array(found["refined"]["moved_px"])
error = np.abs(np.load("typed.npy") / np.load("true.npy") - 1)[..., 0].max()
print(f"{sys.argv[1]}: corners moved by {moved.min():.0f} to {moved.max():.0f} px", end=", ")
print("to within 0.2 px" if off < 0.2 else f"and still {off:.2f} px off", end="; ")
print("red within 0.2%" if error < 2e-3 else f"red off by {error:.2%}", end="; ")
print("without edge:", *found["refined"]["sides_without_edge"] or ["none"])
END
done

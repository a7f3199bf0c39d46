# The spectrum of a sheet folded to a W, from a photograph in which the panels hide each other in part: every panel that shows its
# reflecting side is measured, what others hide is null, and so is a panel that was not marked.
vkernel --folds 3 --angle-deg 60 --ridge-deg 100 --facets 4x4 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --eye=-3,-5,12 --render w.exr --render-size 960x720 -o simulated.ndjson 2>/dev/null
vforward scene.json --reflectance cc24:orange --exposure 2 -q --render above.exr -o above.ndjson
oiiotool w.exr --noise:type=gaussian:stddev=0.004:seed=7 -d uint16 -o noisy.png

extract() { vextract --exact-corners "$@" --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --no-history; }
extract w.exr --regions simulated.ndjson --overlay overlay.png --save facet_rgb=w.npy > w.ndjson
extract noisy.png --regions simulated.ndjson -o noisy.ndjson
extract above.exr --regions above.ndjson -o all.ndjson
eval "set -- $(vforward scene.json --reflectance 0.5 --exposure 2 --eye=-3,-5,12 --render again.exr --render-size 960x720 2>&1 >/dev/null |
    sed 's/.*corners at //')"
extract w.exr "$@" --save facet_rgb=flags.npy >/dev/null

python3 - <<'END'
import json
import numpy as np
sample = lambda name: [json.loads(line) for line in open(name + ".ndjson")][-1]
true = np.array(sample("simulated")["facet_rgb"]).reshape(4, 16, 3)
for name in "all", "w", "noisy":
    rgb = sample(name)["facet_rgb"]
    seen = np.array([facet is not None for facet in rgb]).reshape(4, 16)
    off = [abs(np.array(rgb[k]) / true.reshape(-1, 3)[k] - 1)[:2].max() for k in range(64) if rgb[k]]
    print(f"{name}: facets seen of each panel {seen.sum(1).tolist()}, red and green within {100 * max(off):.2f}%")
given, flags = (np.load(f"{name}.npy") for name in ("w", "flags"))
print("flags as the file:", bool(np.allclose(given, flags, rtol=1e-3, equal_nan=True)))
END
for photo in all w noisy; do
    vestimate $photo.ndjson --exposure 2 --no-history | vscore --truth cc24:orange --no-history | tail -1
done | below RMSE=0.015 CIEDE2000=0.4 PD=0.001
oiiotool --info overlay.png

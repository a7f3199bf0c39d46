# tolerance 2e-3 2e-3
# A colour chart beside the fold: whatever the exposure, the gains of the channels and stray light, facets come out as the scene's
# camera would have them, and the exposure is known. The flat chart's colours come from vforward, by way of a sheet of 180 degrees.
vkernel --angle-deg 45 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --render fold.exr -o truth.ndjson 2> corners
crease=$(sed 's/.*--panel0 "\([^ ]* [^ ]*\) .*/\1/' corners)
eval "panels() { vextract \"\$@\" --scene scene.json --camera canon-5d-mark-ii --illuminant D65 $(grep -o -- '--panel0.*"' corners); }"
test -n "$crease"
vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance cc24 --save facet_rgb=chart.npy >/dev/null

# 6 x 4 patches of 48 px with 6 px between them, their block from (650, 100) to (968, 310)
fills=$(python3 - <<'END'
import numpy as np
for k, rgb in enumerate(np.load("chart.npy")[:, 0]):
    print("--fill:color={0:.9f},{1:.9f},{2:.9f} 48x48+{3}+{4}".format(*rgb, 650 + 54 * (k % 6), 100 + 54 * (k // 6)))
END
)
oiiotool fold.exr --create 1000x480 3 --paste +0+0 $fills -o ideal.exr
chart="650,100 968,100 968,310 650,310"

oiiotool ideal.exr --mulc 0.48,0.6,0.66 -d half -o gains.exr
oiiotool ideal.exr --mulc 0.48,0.6,0.66 --addc 0.001 --noise:type=gaussian:stddev=0.002:seed=3 -d uint16 -o noisy.tif
oiiotool ideal.exr --mulc 0.6 ideal.exr --mulc 0.6 --dup --mul --mulc 0.05 --add -o bent.exr
oiiotool ideal.exr --mulc 0.48,0.6,0.66 --rotate90 -d uint16 -o turned.tif

for photo in gains.exr noisy.tif bent.exr; do
    panels $photo --chart "$chart" --save facet_rgb=got.npy -o sample.ndjson
    python3 - $photo <<'END'
import json, sys
import numpy as np
truth, sample = (json.loads(open(name).readlines()[1]) for name in ("truth.ndjson", "sample.ndjson"))
exposure, residual = sample["exposure"], max(sample["calibration"]["residual_rms"])
print(sys.argv[1], "exposure", round(exposure, 3), "residual below 1 %:", residual < 0.01)
error = np.load("got.npy")[0] / exposure / np.array(truth["facet_rgb"]) - 1
limit = np.array([0.005, 0.005, 0.05])  # blue is at 2 % of white: stray light there
print("facets right:", bool((np.sqrt((error**2).mean(0)) < limit).all()))
END
done

echo the chart at 60 degrees to the sun gets half the light
panels gains.exr --chart "$chart" --chart-cos 0.5 | grep -o '"exposure":[0-9.]*' | tail -n 1 | sed 's/.*/{&}/'
echo what is refused
oiiotool ideal.exr --mulc 1.2 -d uint16 -o clipped.tif
panels clipped.tif --chart "$chart" 2>&1 || echo "exit status $?"
panels gains.exr --chart "968,310 650,310 650,100 968,100" 2>&1 || echo "exit status $?"
panels gains.exr --chart "968,100 650,100 650,310 968,310" 2>&1 || echo "exit status $?"
panels gains.exr --chart "150,100 468,100 468,310 150,310" 2>&1 || echo "exit status $?"
panels gains.exr --chart "$chart" --chart-grid 6x4 2>&1 || echo "exit status $?"
oiiotool gains.exr --colorconvert linear sRGB -d uint8 -o srgb.png
panels srgb.png --transfer linear --chart "$chart" 2>&1 || echo "exit status $?"

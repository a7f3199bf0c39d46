# Sheets that fluoresce: what they send out and what they reflect bounce alike. NumPy solves B = (I - rho K)^-1 (rho + f) E0 waveband by
# waveband for a fold in slanting light, by all bounces and by one, and for an accordion.
printf 'nm,f\n400,0\n450,1.2\n500,0.1\n550,0\n700,0\n' > f.csv
flat="--camera 1 --illuminant 1 --wavelengths-nm 400:700:50"
vkernel --angle-deg 45 --facets 3x4 --mesh facets --tolerance 1e-9 --tilt-deg 10 --save kernel=fold-K.npy -o fold.json
vkernel --folds 3 --angle-deg 60 --facets 2x2 --mesh facets --tolerance 1e-6 --save kernel=accordion-K.npy -o accordion.json
vforward accordion.json --reflectance 1 $flat --bounces 0 --save facet_rgb=accordion-E.npy >accordion-0.ndjson
for run in "fold inf" "fold 1" "accordion inf"; do
    set -- $run
    vforward $1.json --reflectance 0.6 0 --fluorescence f.csv $flat --bounces $2 --save facet_rgb=rgb.npy -o samples.ndjson
    python3 - $1 $2 <<'END'
import json, sys
import numpy as np
name, bounces = sys.argv[1:]
K, f = np.load(name + "-K.npy"), np.array([0, 1.2, 0.1, 0, 0, 0, 0])
E = np.sin(np.radians([22.5 + 10, 22.5 - 10])).repeat(12) if name == "fold" else np.load(name + "-E.npy").ravel()
weights = np.array([0.5, 1, 1, 1, 1, 1, 0.5]) / 6
samples = [json.loads(line) for line in open("samples.ndjson")][1:]
for r, rgb, sample in zip([0.6, 0.0], np.load("rgb.npy"), samples):
    first = np.outer(E, r + f)
    B = np.linalg.solve(np.eye(len(K)) - r * K, first) if bounces == "inf" else first + r * K @ first
    truth = sample["truth"]["total_radiance_factor"]
    print(name, bounces, r, f"off by {abs(rgb[:, 0] - B @ weights).max():.0e}" if not np.allclose(rgb[:, 0], B @ weights, rtol=0, atol=1e-7) else "as NumPy", truth)
END
done
vforward fold.json --reflectance 0.5 --fluorescence -0.1 2>&1 || echo $?
vforward fold.json --reflectance 0.5 --fluorescence 0.1 --illuminant D50 --illuminant A 2>&1 || echo $?
vforward fold.json --reflectance 0.5 --fluorescence 0.1 --reference-panel 0.9 2>&1 | head -n 1

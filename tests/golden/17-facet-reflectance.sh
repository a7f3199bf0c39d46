# A reflectance of its own for every facet: eq. (24) as it stands, beside NumPy's solution of eq. (15) a waveband.
# Two files are two samples; what they hold has no single spectrum, so samples have no truth.
vkernel --angle-deg 50 --facets 3x4 --spacing graded --panel1-depth 0.7 --mesh facets --sky 0.2 --tilt-deg 4 --save kernel=K.npy -o scene.json
python3 - <<'END_PYTHON'
import numpy as np
stripes = np.where(np.arange(24)[:, None] % 2, np.linspace(0.1, 0.9, 7), 0.0)
np.save("stripes.npy", stripes)
np.save("mosaic.npy", np.asfortranarray(0.5 + 0.5 * np.sin(np.arange(24 * 7).reshape(24, 7))))
END_PYTHON
vforward scene.json --facet-reflectance stripes.npy mosaic.npy --camera 1 --illuminant 1 --wavelengths-nm 400:700:50 \
    --save facet_rgb=rgb.npy -o samples.ndjson
python3 - <<'END_PYTHON'
import json
import numpy as np
K = np.load("K.npy")
direct = np.sin(np.radians([25 + 4, 25 - 4])).repeat(12) + 0.2 * (1 - K.sum(axis=1))
weights = np.array([0.5, 1, 1, 1, 1, 1, 0.5]) / 6
samples = [json.loads(line) for line in open("samples.ndjson")][1:]
for sample, rgb in zip(samples, np.load("rgb.npy")):
    R = np.load(sample["id"] + ".npy")
    want = sum(w * r * np.linalg.solve(np.eye(24) - K * r, direct) for w, r in zip(weights, R.T))
    print(sample["id"], "truth" in sample, "as NumPy" if np.allclose(rgb[:, 0], want, rtol=0, atol=1e-13) else "differs", *rgb[:4, 0])
END_PYTHON

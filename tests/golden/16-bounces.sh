# Light after n bounces, eq. (14), beside all light: what is missing in the worst facet, and how many bounces are as good
# as all of them to the scene's tolerance. NumPy adds the bounces up one by one.
vkernel --angle-deg 45 --facets 6x5 --mesh facets --tolerance 1e-6 --tilt-deg 10 --save kernel=K.npy -o scene.json
for bounces in 0 1 2 5 10 auto; do
    vforward scene.json --reflectance 0.1 0.5 0.9 --camera 1 --illuminant 1 --wavelengths-nm 400:700:100 --bounces $bounces \
        --save facet_rgb=$bounces.npy --save bounces.count=count.npy --save bounces.missing=missing.npy >/dev/null
    python3 - $bounces <<'END_PYTHON'
import sys
import numpy as np
K, count, missing = (np.load(name) for name in ("K.npy", "count.npy", "missing.npy"))
direct = np.sin(np.radians([22.5 + 10, 22.5 - 10])).repeat(30)
off = 0
for r, n, rgb in zip([0.1, 0.5, 0.9], count, np.load(sys.argv[1] + ".npy")):
    light = sum(np.linalg.matrix_power(r * K, b) @ direct for b in range(int(n) + 1))
    off = max(off, abs(rgb[:, 0] / (r * light) - 1).max())
print(sys.argv[1], "bounces:", *count, "missing:", *missing.round(9), "as NumPy" if off < 1e-6 else f"off by {off}")
END_PYTHON
done

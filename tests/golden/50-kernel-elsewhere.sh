# A kernel made with NumPy, of facets of several sizes that see each other in no particular way, under two lights: facets as NumPy's
# dense solution of eq. (15) has them, with one reflectance and with one per facet; then a sheet estimated from samples alone.
python3 - <<'END'
import numpy as np
area = np.linspace(0.5, 2, 12)
flux = np.abs(np.sin(np.add.outer(np.arange(12), 3 * np.arange(12))))
flux = flux + flux.T
np.fill_diagonal(flux, 0)
kernel = flux / area[:, None]
np.save("K.npy", kernel * 0.8 / kernel.sum(axis=1).max())
np.save("areas.npy", area)
np.save("E0.npy", np.array([np.linspace(0, 1, 12), np.cos(np.arange(12)) ** 2]))
np.save("R.npy", np.linspace(0, 1, 12)[:, None])
END
flat="--camera 1 --illuminant 1 --wavelengths-nm 400:700:300 --no-history"
vforward --kernel K.npy --irradiance E0.npy --reflectance 0 0.6 1 $flat --save facet_rgb=one.npy -o one.ndjson
vforward --kernel K.npy --irradiance E0.npy --areas areas.npy --reflectance 0.6 $flat --save facet_rgb=areas-given.npy -o same.ndjson
python3 - <<'END'
import numpy as np
np.save("R.npy", np.repeat(np.load("R.npy"), 2, axis=1))
END
vforward --kernel K.npy --irradiance E0.npy --facet-reflectance R.npy $flat --save facet_rgb=each.npy -o each.ndjson
python3 - <<'END'
import numpy as np
K, light = np.load("K.npy"), np.load("E0.npy").sum(axis=0)
def dense(r):
    return r * np.linalg.solve(np.eye(12) - K * r, light)
cases = [(0, np.load("one.npy")[0]), (0.6, np.load("one.npy")[1]), (1, np.load("one.npy")[2])]
cases += [(0.6, np.load("areas-given.npy")[0]), (np.load("R.npy")[:, 0], np.load("each.npy")[0])]
for r, ours in cases:
    print("as NumPy" if np.abs(ours[:, 0] - dense(r * np.ones(12))).max() < 1e-8 else "not as NumPy", ours[:2, 0])
END
colours="--illuminant D65 --illuminant A"
vforward --kernel K.npy --irradiance E0.npy --reflectance cc24:red cc24:cyan $colours --noise-sd 1e-3 |
    grep '"sample"' | vestimate --kernel K.npy --irradiance E0.npy $colours | vscore | tail -n 1 | below RMSE=0.03 CIEDE2000=0.6 PD=0.005

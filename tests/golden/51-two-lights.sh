# tolerance 1e-5 1e-7
# Three squares that meet in a corner, under two suns of unlike spectra: each facet as NumPy has it by the dense solution of eq. (15), of
# one reflectance, beside a known material, and with one reflectance per facet. Then spectra from such facets, with noise.
python3 - <<'END'
import itertools
axes = [(1, 2), (2, 0), (0, 1)]
with open("corner.obj", "w") as obj:
    for name, (u, v) in zip(["east", "north", "floor"], axes):
        print("g", name, file=obj)
        for i, j in itertools.product(range(2), range(2)):
            for a, b in [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]:
                corner = [0, 0, 0]
                corner[u], corner[v] = a / 2, b / 2
                print("v", *corner, file=obj)
            print("f -4 -3 -2 -1", file=obj)
END
vkernel --shape corner.obj --mesh facets --light 1,2,2 --light 3,1,1:0.5 --tolerance 1e-6 --save kernel=K.npy -o scene.json
bands="--wavelengths-nm 400:700:100 --camera 1 --no-history"
python3 - <<'END'
import numpy as np
np.save("each.npy", np.linspace(0, 1, 48).reshape(12, 4))
END
for spectrum in "lamp 400:3,500:2,600:1,700:1" "paint 400:0.2,500:0.4,600:0.6,700:0.8" "sheet 400:0.9,500:0.5,600:0.5,700:0.1"; do
    echo "wavelength,${spectrum%% *}" | cat - > "${spectrum%% *}.csv"
    echo "${spectrum#* }" | tr ':,' ',\n' >> "${spectrum%% *}.csv"
done
vforward scene.json --reflectance sheet.csv $bands --illuminant 1 --illuminant lamp.csv --save facet_rgb=one.npy -o one.ndjson
vforward scene.json --reflectance sheet.csv --material floor=paint.csv $bands --illuminant 1 --illuminant lamp.csv --save facet_rgb=beside.npy -o beside.ndjson
vforward scene.json --facet-reflectance each.npy $bands --illuminant 1 --illuminant lamp.csv --save facet_rgb=own.npy -o own.ndjson
python3 - <<'END'
import numpy as np
K = np.load("K.npy")
normals = np.repeat(np.eye(3), 4, axis=0)
width = np.array([0.5, 1, 1, 0.5])
lamp, paint, sheet = np.array([3, 2, 1, 1.0]), np.array([0.2, 0.4, 0.6, 0.8]), np.array([0.9, 0.5, 0.5, 0.1])
suns = [(np.array([1, 2, 2]) / 3, 1.0, np.ones(4)), (np.array([3, 1, 1]) / 11**0.5, 0.5, lamp)]
def rgb(R):
    total = 0
    for towards, irradiance, power in suns:
        weights = width * power / (width * power).sum()
        for band in range(4):
            r = R[:, band]
            total = total + weights[band] * r * np.linalg.solve(np.eye(12) - K * r, irradiance * normals @ towards)
    return total
one = np.tile(sheet, (12, 1))
beside = one.copy()
beside[8:] = paint
for name, R in [("one", one), ("beside", beside), ("own", np.load("each.npy"))]:
    ours = np.load(name + ".npy")[0][:, 0]
    print(name, "as NumPy" if np.abs(ours - rgb(R)).max() < 1e-6 else "not as NumPy", *ours[::4])
END
vkernel --shape corner.obj --light 1,2,2 --light 3,1,1:0.5 |
    vforward --reflectance cc24:red cc24:cyan --illuminant D65 --illuminant A --material floor=cc24:yellow --noise-sd 1e-3 --seed 1 |
    vestimate | vscore | tail -n 1 | below RMSE=0.04,0.03 CIEDE2000=1 PD=0.003

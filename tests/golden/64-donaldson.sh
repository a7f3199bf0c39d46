# Sheets by their Donaldson matrices, a made-up one of a brightener: a NumPy solution of all facets and all bands at once, under a sun and a sky of
# other spectra, which reach to 300 nm. The third light does not, and it is said; the matrix in the other direction is refused.
python3 - <<'END'
import numpy as np
emission, excitation = np.arange(380, 701, 20.0), np.arange(300, 701, 20.0)
lam, mu = np.meshgrid(emission, excitation, indexing="ij")
D = np.where(lam > mu, 0.12 * np.exp(-((lam - 440) / 30) ** 2 - ((mu - 370) / 40) ** 2), 0)
D += np.where((lam > mu) & (mu > 400), 0.03 * np.exp(-((lam - 560) / 30) ** 2), 0)
D[lam == mu] = np.linspace(0.4, 0.9, 17)
rows = lambda sign, D: "".join(f"{nm:g}" + "".join(f"{sign}{value:.17g}" for value in row) + "\n" for nm, row in zip(emission, D))
noisy = D + np.where(lam < mu, 0.004 * np.sin(lam * mu), 0)
noisy[5, 4] = noisy[6, 0] = -0.001
D[5, 4] = D[6, 0] = 0
np.save("D.npy", D)
open("sheet.csv", "w").write("emission_nm" + "".join(f",{nm:g}" for nm in excitation) + "\n" + rows(",", noisy))
open("sheet.BFC", "w").write("VEC_01\t9\nBFC-450 Matrix File\n;a sheet\n380\t700\t20\t21\t300\t20\nr:c:\t" + "".join(f"{nm:g}\t" for nm in excitation) + "\n" + rows("\t", D))
open("turned.csv", "w").write("excitation_nm" + "".join(f",{nm:g}" for nm in emission) + "\n" + "".join(f"{nm:g}" + "".join(f",{value:.17g}" for value in row) + "\n" for nm, row in zip(excitation, D.T)))
nm = np.arange(300, 701, 10.0)
for name, power in (("sun", nm / 500), ("sky", (450 / nm) ** 3)):
    open(name + ".csv", "w").write("nm,power\n" + "".join(f"{x:g},{y:.17g}\n" for x, y in zip(nm, power)))
END
printf 'nm,r,b\n380,0.4,0\n400,0.5,0.8\n500,0,0.8\n600,1,0\n700,1,0.1\n' > camera.csv
flags="--camera camera.csv --illuminant sun.csv --wavelengths-nm 400:700:20"
vkernel --angle-deg 45 --facets 3x2 --mesh facets --tolerance 1e-9 --tilt-deg 10 --sky 0.2 --save kernel=fold-K.npy -o fold.json
vkernel --folds 3 --angle-deg 60 --facets 1x2 --mesh facets --tolerance 1e-6 --save kernel=accordion-K.npy -o accordion.json
vforward accordion.json --reflectance 1 $flags --bounces 0 --save facet_rgb=accordion-E.npy >accordion-0.ndjson
for run in "fold inf csv" "fold 1 csv" "accordion inf BFC"; do
    set -- $run
    vforward $1.json --donaldson sheet.$3 $flags --sky-illuminant sky.csv --bounces $2 --save facet_rgb=rgb.npy -o samples.ndjson
    python3 - $1 $2 <<'END'
import json, sys
import numpy as np
name, bounces = sys.argv[1:]
K, D = np.load(name + "-K.npy"), np.load("D.npy")
facets, bands = len(K), D.shape[1]
matrix = np.zeros((bands, bands))
matrix[4:] = D
matrix[:4, :4] = np.eye(4) * D[0, 4]
nm = np.arange(300, 701, 20.0)
# samples 10 nm apart, joined by lines, under triangles of 20 nm to either side
fine = (450 / np.arange(280, 721, 10.0)) ** 3
sky = np.convolve(fine, np.array([1, 6, 10, 6, 1]) / 24, "valid")[::2]
sky[[0, -1]] = fine[[2, -3]]
seen = slice(5, None)
weights = np.full(16, 1.0)
weights[[0, -1]] = 0.5
camera = np.loadtxt("camera.csv", delimiter=",", skiprows=1)
weights = np.array([np.interp(nm[seen], camera[:, 0], channel) for channel in camera.T[1:]]) * weights
if name == "fold":
    lights = [(np.sin(np.radians([22.5 + 10, 22.5 - 10])).repeat(6), nm / 500), (0.2 * (1 - K.sum(axis=1)), sky)]
else:
    # white in direct light, in the strongest channel
    lights = [(np.load("accordion-E.npy")[0].max(axis=1), nm / 500)]
want, strongest = 0, None
for E, S in lights:
    light = np.outer(E, S).ravel()
    sent, exchanged = np.kron(np.eye(facets), matrix), np.kron(K, np.eye(bands))
    if bounces == "inf":
        B = np.linalg.solve(np.eye(facets * bands) - sent @ exchanged, sent @ light)
    else:
        B = sent @ (light + exchanged @ sent @ light)
    white = weights @ S[seen]
    strongest = white.argmax() if strongest is None else strongest
    want = want + B.reshape(facets, bands)[:, seen] @ weights.T / white[strongest]
off = abs(np.load("rgb.npy")[0] - want).max()
sample = json.loads(open("samples.ndjson").readlines()[1])
total = (matrix @ (nm / 500) / (nm / 500))[seen]
truth = sample["truth"]
same = np.allclose(truth["total_radiance_factor"], total, atol=1e-12) and np.allclose(truth["reflectance"], matrix.diagonal()[seen], atol=1e-12)
print(name, bounces, sample["id"], "as NumPy" if off < 2e-7 else f"off by {off:.1e}", same, np.round(total[:4], 3))
END
done
vforward fold.json --donaldson turned.csv $flags 2>&1 || echo $?
vforward fold.json --donaldson sheet.csv --camera camera.csv --illuminant LED-B1 2>&1 >said.ndjson
vforward fold.json --donaldson sheet.csv $flags --reference-panel 0.9 2>&1 | head -n 1

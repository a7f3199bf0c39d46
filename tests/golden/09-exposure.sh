# Exposure known from the sample, fitted, or divided out as in the paper; vforward's pictures are twice as bright as said. Whether it is found
# within 0.2 %, and the spectrum within 0.005.
vkernel --facets 4x4 | vforward --reflectance cc24:red --exposure 2 -o sample.ndjson
for exposure in 2 free sum; do
    vestimate sample.ndjson --exposure $exposure --save exposure=$exposure.npy --save reflectance=r-$exposure.npy >/dev/null
done
python3 - <<'END'
import json
import numpy as np
truth = np.array([json.loads(line) for line in open("sample.ndjson")][-1]["truth"]["reflectance"])
for name in ["2", "free", "sum"]:
    exposure, reflectance = np.load(name + ".npy")[0], np.load(f"r-{name}.npy")[0]
    print(name, abs(exposure / 2 - 1) < 2e-3, np.sqrt(np.mean((reflectance - truth) ** 2)) < 0.005)
END

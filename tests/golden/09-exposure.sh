# tolerance 1e-3 1e-4
# Exposure known from the sample, fitted, or divided out as in the paper; vforward's pictures are twice as bright as said.
vkernel --facets 4x4 | vforward --reflectance cc24:red --exposure 2 -o sample.ndjson
for exposure in 2 free sum; do
    vestimate sample.ndjson --exposure $exposure --save exposure=$exposure.npy --save reflectance=r-$exposure.npy >/dev/null
done
python3 - <<'END'
import numpy as np
for name in ["2", "free", "sum"]:
    print(name, np.load(name + ".npy")[0], *np.load(f"r-{name}.npy")[0, ::15])
END

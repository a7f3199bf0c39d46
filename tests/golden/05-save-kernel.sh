# The full matrix of eq. (10) as NumPy reads it: no facet hands on all its light, and exchange is mutual.
vkernel --angle-deg 60 --facets 3x4 --save kernel=K.npy -o scene.json
python3 - <<'END'
import numpy as np
K = np.load("K.npy")
print(K.dtype, K.shape, "mutual" if np.allclose(K, K.T, rtol=1e-14) else "one-sided")
print("to the other panel from the crease, the middle and the outer row:", *K[[0, 4, 8]].sum(axis=1))
print("largest eigenvalue:", np.abs(np.linalg.eigvalsh(K)).max())
END

# An accordion whose outer panels see each other over the ridge in part; the same surface as an OBJ file with one facet a panel and two
# that are left out; the V of a file is the fold.
flat="--camera 1 --illuminant 1 --wavelengths-nm 400:700:300 --no-history"
vkernel --folds 3 --angle-deg 60 --ridge-deg 100 --facets 1x1 --mesh facets --save kernel=W.npy |
    vforward --reflectance 0.5 $flat | tail -n 1
cat >w.obj <<'END'
v 0 -0.5 0
v 0 0.5 0
v 0.8660254037844386 -0.5 0.5
v 0.8660254037844386 0.5 0.5
v 0.8660254037844386 -0.5 -0.5
v 0.8660254037844386 0.5 -0.5
g left
f 1 2 4 3
g right
f 5 6 2 1
f 5 5 6
f 1 5 6 2
END
vkernel --shape w.obj --light 1,0,0 --mesh facets --save kernel=V.npy 2>&1 >v.ndjson
vkernel --angle-deg 60 --facets 1x1 --mesh facets --save kernel=fold.npy -o fold.ndjson
python3 - <<'END'
import numpy as np
print(np.round(np.load("W.npy"), 5).tolist())
print(abs(np.load("V.npy") - np.load("fold.npy")).max() < 1e-7)
END
vkernel --shape w.obj --check 2>&1 || echo $?
vkernel --folds 0 2>&1 || echo $?
vkernel --shape w.stl 2>&1 || echo $?

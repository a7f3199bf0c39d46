# Fields of a batch as one stack each: 24 samples of 2 x 2 x 2 facets and of 61 wavebands, in the order of the stream.
vkernel --facets 2x2 | vforward --reflectance cc24 --save facet_rgb=rgb.npy --save truth.reflectance=truth.npy -o samples.ndjson
python3 - <<'END'
import json
import numpy as np
rgb, truth = np.load("rgb.npy"), np.load("truth.npy")
samples = [json.loads(line) for line in open("samples.ndjson")][1:]
print(rgb.shape, truth.shape, truth.flags["C_CONTIGUOUS"])
print(np.array_equal(rgb, [sample["facet_rgb"] for sample in samples]))
print(np.array_equal(truth, [sample["truth"]["reflectance"] for sample in samples]))
END

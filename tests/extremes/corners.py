"""What a camera sees of a fold, by NumPy's dense solver: facet by channel, from a scene and the kernel matrix of eq. (10).

Deeb et al., eq. (24) with one reflectance: irradiance E = E0 + r K E in every waveband. Prints how far the facets of the
one sample are from that, relative to the brightest, then the root mean square of the estimate's errors in units of their standard deviations.
"""
import json
import sys

import numpy as np

from camera import deviations, seen


def finite(value):
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return not isinstance(value, float) or np.isfinite(value)


def direct(scene, kernel):
    sun = np.repeat(scene["light"]["panel_irradiance"], len(kernel) // 2)
    return sun + scene["light"]["sky"] * (1 - kernel.sum(axis=1))


def radiance(scene, kernel, reflectance):
    """Of a sheet: waveband by facet."""
    solve = lambda r: np.linalg.solve(np.eye(len(kernel)) - r * kernel, direct(scene, kernel))
    return [r * solve(r) for r in reflectance]


records = [json.loads(line, parse_constant=lambda name: sys.exit(f"{name} in the stream")) for line in sys.stdin]
scene, sample = records[0], records[1]
if not finite(records):
    sys.exit("a number that is not finite")
kernel = np.load("K.npy")
leaving = radiance(scene, kernel, sample["truth"]["reflectance"])
want = np.stack([seen(scene, light, leaving) for light in scene["illuminants"]])
got = np.load("clean.npy").reshape(want.shape)
print(np.abs(got / sample["exposure"] - want).max() / max(want.max(), sys.float_info.min))
if "error" not in sample:
    print(deviations(sample))

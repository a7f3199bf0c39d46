"""What a camera sees of a fold, by NumPy's dense solver: facet by channel, from a scene and the kernel matrix of eq. (10).

Deeb et al., eq. (24) with one reflectance: irradiance E = E0 + r K E in every waveband, then the camera's trapezoid sum. White
that faces the sun is 1 in the strongest channel. Prints how far the facets of the one sample are from that, relative to the
brightest, then the root mean square of the estimate's errors in units of their standard deviations.
"""
import json
import sys

import numpy as np


def finite(value):
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return not isinstance(value, float) or np.isfinite(value)


def direct(scene, kernel):
    sun = np.repeat(scene["light"]["panel_irradiance"], len(kernel) // 2)
    return sun + scene["light"]["sky"] * (1 - kernel.sum(axis=1))


def seen(scene, kernel, reflectance, light):
    wavelengths = np.array(scene["wavelengths_nm"])
    weights = np.gradient(wavelengths)
    weights[[0, -1]] /= 2
    camera = np.array(scene["camera"]["sensitivities"]) * np.array(light["power"]) * weights
    radiance = [
        r * np.linalg.solve(np.eye(len(kernel)) - r * kernel, direct(scene, kernel)) for r in reflectance
    ]
    return np.array(radiance).T @ camera.T / camera.sum(axis=1).max()


records = [json.loads(line, parse_constant=lambda name: sys.exit(f"{name} in the stream")) for line in sys.stdin]
scene, sample = records[0], records[1]
if not finite(records):
    sys.exit("a number that is not finite")
kernel = np.load("K.npy")
truth = np.array(sample["truth"]["reflectance"])
want = np.stack([seen(scene, kernel, truth, light) for light in scene["illuminants"]])
got = np.load("clean.npy").reshape(want.shape)
print(np.abs(got / sample["exposure"] - want).max() / max(want.max(), sys.float_info.min))
if "error" in sample:
    sys.exit(0)
estimate = sample["estimate"]
error = np.array(estimate["reflectance"]) - truth
sd = np.array(estimate["reflectance_sd"])
print(np.sqrt(np.mean((error / sd) ** 2)))

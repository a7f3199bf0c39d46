"""How far the tools are from NumPy and from the truth, as a line of numbers: facets, relative to the brightest; RMSE of the estimate;
the root mean square of its errors in units of their standard deviations. Without the last two if it was refused.

Reads what the tools left of one fold in the sun: the samples `clean` with their facets `clean.npy`, and the samples `scored`.
"""
import json
import sys

import numpy as np

from fold import Fold
from undivided import undivided


def records(path):
    refuse = lambda name: sys.exit(f"{name} in {path}")
    with open(path) as lines:
        return [json.loads(line, parse_constant=refuse) for line in lines]


def row_edges(scene):
    """Of both panels, in units of a facet's width."""
    (width, depth), facets = scene["geometry"]["panel"], scene["facets"]
    depths = depth, scene["geometry"].get("panel1_depth", depth)
    return [np.linspace(0, d * facets["cols"] / width, facets["rows"] + 1) for d in depths]


def irradiance(scene):
    """Irradiance as a function of reflectance: panel, row, column. Facets are flat patches of even radiance, or panels undivided."""
    angle_deg, light = scene["geometry"]["angle_deg"], scene["light"]["panel_irradiance"]
    edges, cols = row_edges(scene), scene["facets"]["cols"]
    if scene["accuracy"]["mesh"] == "auto":
        return lambda reflectance: undivided(angle_deg, edges, cols, light, reflectance)
    fold = Fold.of_facets(angle_deg, edges, cols)
    return lambda reflectance: fold.irradiance(light, reflectance)


def seen(scene, reflectance):
    """What the camera sees, facet by channel: a trapezoid sum; white that faces the sun is 1 in the strongest channel."""
    weights = np.gradient(np.array(scene["wavelengths_nm"]))
    weights[[0, -1]] /= 2
    channels = np.array(scene["camera"]["sensitivities"]) * np.array(scene["illuminants"][0]["power"]) * weights
    solve, once = irradiance(scene), sorted(set(reflectance))
    radiance = {r: r * np.ravel(solve(r)) for r in once}
    return np.array([radiance[r] for r in reflectance]).T @ channels.T / channels.sum(axis=1).max()


(scene, clean), (_, scored, *_) = records("clean"), records("scored")
want = seen(scene, clean["truth"]["reflectance"])
got = np.load("clean.npy").reshape(want.shape)
print(np.abs(got - want).max() / max(want.max(), sys.float_info.min))
if "error" not in scored:
    estimate = scored["estimate"]
    error = np.array(estimate["reflectance"]) - scored["truth"]["reflectance"]
    print(scored["metrics"]["rmse"], np.sqrt(np.mean((error / estimate["reflectance_sd"]) ** 2)))

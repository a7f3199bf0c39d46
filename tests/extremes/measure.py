"""How far the tools are from NumPy and from the truth, as a line of numbers: facets, relative to the brightest; RMSE of the estimate;
the root mean square of its errors in units of their standard deviations. Without the last two if it was refused.

Reads what the tools left of one fold in the sun: the samples `clean` with their facets `clean.npy`, and the samples `scored`.
"""
import json
import sys

import numpy as np

from camera import deviations, seen
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


def radiance(scene, reflectance):
    """Of a sheet: waveband by facet."""
    solve = irradiance(scene)
    once = {r: r * np.ravel(solve(r)) for r in sorted(set(reflectance))}
    return [once[r] for r in reflectance]


(scene, clean), (_, scored, *_) = records("clean"), records("scored")
want = seen(scene, scene["illuminants"][0], radiance(scene, clean["truth"]["reflectance"]))
got = np.load("clean.npy").reshape(want.shape)
print(np.abs(got - want).max() / max(want.max(), sys.float_info.min))
if "error" not in scored:
    print(scored["metrics"]["rmse"], deviations(scored))

#!/usr/bin/env python3
"""Writes `sheets.json`: what tests/sheets.rs compares with.

    OMP_NUM_THREADS=1 python3 make.py SHARED KERNEL.npy GLOSS.ndjson ROUGH.ndjson

SHARED: the folder of real/ and materials/. KERNEL: `vkernel --angle-deg A --mesh facets --save kernel=KERNEL.npy -o scene.json` with the angle of
materials/notebook.json. The others: `vkernel --angle-deg 48 -o scene.json`, then `vextract one_gloss.tif --scene scene.json --panel0 ... --panel1
... --refine` and the same of one_rough, corners as told. Photographs: means of the facets of a row, both panels. Material: the same by
materials/transport.py, flat patches, a few percent off at the crease.
"""

import json
import sys
from pathlib import Path

import numpy as np

shared, kernel, *extracted = sys.argv[1:]
sys.path.insert(0, f"{shared}/materials")
from brdf import Material  # noqa: E402
from transport import facet_rgb, fold  # noqa: E402


def rows(values):
    return np.round(np.array(values, float).reshape(2, 10, 10, 3).mean((0, 2)), 6).tolist()


def photograph(name, record):
    side = json.loads(Path(f"{shared}/real/{name}.json").read_text())
    sample = json.loads(Path(record).read_text().splitlines()[-1])
    step_nm = np.full(61, 5.0)
    step_nm[[0, -1]] = 2.5
    weights = np.array(side["camera_sensitivities_rgb"]) * side["illuminant_spd"] * step_nm
    weights *= max(side["white_rgb"]) / weights.sum(1).max()
    eye = np.array(side["camera_pose"]["position_mm"]) / side["panel_side_mm"]
    return {
        "name": name,
        "angle_deg": side["angle_deg"],
        "eye": np.round(eye, 6).tolist(),
        "reflectance": np.round(side["reflectance"], 6).tolist(),
        "weights": np.round(weights, 8).tolist(),
        "rows": rows(sample["facet_rgb"]),
    }


def material(name):
    side = json.loads(Path(f"{shared}/materials/{name}.json").read_text())
    form_factors = np.load(kernel)[:100, 100:]
    rgb = facet_rgb(Material(side["material"]), form_factors, side["angle_deg"], side["tilt_deg"], side["camera"])
    eye = fold(side["angle_deg"], side["tilt_deg"], side["camera"], 1)[3]
    keys = {key: side[key] for key in ("angle_deg", "tilt_deg", "reflectance_45_0")}
    return {"name": name, **keys, "eye": np.round(eye, 6).tolist(), "rows": rows(rgb)}


data = {
    "photographs": [photograph(*pair) for pair in zip(("one_gloss", "one_rough"), extracted)],
    "material": material("notebook"),
}
(Path(__file__).parent / "sheets.json").write_text(json.dumps(data) + "\n")

#!/usr/bin/env python3
"""Photographs and folds of measured materials with their truth, each a stream of its own, for `cargo bench --bench photograph_priors`.

    photograph_priors.py TOOLS SHARED OUT        TOOLS: folder of the tools; SHARED: folder of `train` and `materials`; OUT: where NAME.ndjson are written

Folds of materials stand there twice, with their exposure and without.
"""

import json
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from photographs import Tools, of_material, of_real

shared, out = Path(sys.argv[2]), Path(sys.argv[3])
# Names that the built-in table has for materials that it has by another name.
NAMES = {"felt_green": "acrylic_felt_green", "felt_orange": "acrylic_felt_orange"}


def write(of, sidecar, name, fields):
    with tempfile.TemporaryDirectory() as work:
        records, truth = of(Tools(sys.argv[1]), sidecar, Path(work))
    scene, sample = map(json.loads, records.splitlines()[:2])
    sample |= fields
    known = {nm: truth[nm] for nm in scene["wavelengths_nm"] if nm in truth}
    sample["truth"] = {"wavelengths_nm": list(known), "reflectance": list(known.values())}
    lines = [json.dumps(scene), json.dumps(sample)]
    (out / f"{name}.ndjson").write_text("\n".join(lines) + "\n", encoding="utf-8")


with ThreadPoolExecutor(2) as pool:
    jobs = [pool.submit(write, of_real, sidecar, sidecar.stem, {}) for sidecar in sorted((shared / "train").glob("*.json"))]
    for sidecar in sorted((shared / "materials").glob("*.json")):
        name = NAMES.get(sidecar.stem, sidecar.stem)
        jobs.append(pool.submit(write, of_material, sidecar, f"{name}-free", {}))
        jobs.append(pool.submit(write, of_material, sidecar, f"{name}-known", {"exposure": 1.0}))
    for job in jobs:
        job.result()

#!/usr/bin/env python3
"""Photographs with their truth, each a stream of its own, for `cargo bench --bench beliefs`.

    beliefs.py TOOLS FOLDER OUT        TOOLS: folder of the tools; FOLDER: photographs with a sidecar each; OUT: where NAME.ndjson are written
"""

import json
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from photographs import Tools, of_real

folder, out = Path(sys.argv[2]), Path(sys.argv[3])


def write(sidecar):
    with tempfile.TemporaryDirectory() as work:
        records, truth = of_real(Tools(sys.argv[1]), sidecar, Path(work))
    scene, sample = map(json.loads, records.splitlines()[:2])
    known = {nm: truth[nm] for nm in scene["wavelengths_nm"]}
    sample["truth"] = {"wavelengths_nm": list(known), "reflectance": list(known.values())}
    lines = [json.dumps(scene), json.dumps(sample)]
    (out / f"{sidecar.stem}.ndjson").write_text("\n".join(lines) + "\n", encoding="utf-8")


with ThreadPoolExecutor(2) as pool:
    list(pool.map(write, sorted(folder.glob("*.json"))))

#!/usr/bin/env python3
"""What it costs to state nothing but camera and light: photographs with fold, angle and chart stated and found, as rows of a table.

    find_stated.py TOOLS SIDECAR...        TOOLS: folder of the tools

Stated: corners, angle and tilt as a careful user knows them, and the chart. Found: what `vextract --find` prints. Photographs whose fold is not
claimed are left out of both.
"""

import json
import statistics
import sys
import tempfile
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from photographs import Tools, of_real, table
from sheets import errors, estimated, within

# the confidence from which vextract measures without asking
SURE = 0.97


def found_records(tools, sidecar, work):
    """Records of a photograph of which camera and light are stated; none if its fold is not claimed. A failing tool ends the run."""
    said = json.loads(sidecar.read_text(encoding="utf-8"))
    told, nm, photo = said["told"], said["wavelengths_nm"], sidecar.with_suffix(".tif")
    regions = work / "regions.json"
    found = tools.run("vextract", "-q", "--find", photo)[0]
    if json.loads(found).get("confidence", 0.0) < SURE:
        return None
    regions.write_text(found, encoding="utf-8")
    camera = table(work / "camera.csv", nm, told["camera_sensitivities_rgb"])
    light = table(work / "light.csv", nm, [told["illuminant_spd"]])
    scene, _ = tools.run("vkernel", "-q", "--regions", regions)
    return tools.run("vextract", "-q", photo, "--regions", regions, "--camera", camera, "--illuminant", light, "--refine", given=scene)[0]


def measured(tools, sidecar):
    """RMSE and errors over their standard deviations, stated and found; none of a photograph whose fold is not claimed."""
    with tempfile.TemporaryDirectory() as work:
        records, truth = of_real(tools, sidecar, Path(work))
        found = found_records(tools, sidecar, Path(work))
        if not found:
            return None
        scores = []
        for each in (records, found):
            nm, estimate, _ = estimated(tools, each, [])
            scores.append(errors(nm, estimate, truth))
        return scores


def main(folder, *sidecars):
    tools, sets = Tools(folder), defaultdict(list)
    with ThreadPoolExecutor() as several:
        for sidecar, scores in zip(sidecars, several.map(lambda sidecar: measured(tools, Path(sidecar)), sidecars), strict=True):
            sets[Path(sidecar).parent.name].append(scores)
    print("| set | pictures | claimed | RMSE, stated | found | median, stated | found | worst, stated | found | within 1, 2 sd, %, stated | found |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for name, all_scores in sets.items():
        claimed = [scores for scores in all_scores if scores]
        cells = []
        for score in (statistics.fmean, statistics.median, max):
            cells += [f"{score([scores[way][0] for scores in claimed]):.4f}" for way in (0, 1)]
        cells += [within([z for scores in claimed for z in scores[way][1]]) for way in (0, 1)]
        print(f"| {name} | {len(all_scores)} | {len(claimed)} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])

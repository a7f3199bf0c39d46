#!/usr/bin/env python3
"""Photographs with something stated wrongly, as rows of a table: README's, an ideal fold of 50 degrees under D65 by a Canon EOS 5D Mark II, or
rendered photographs of real sheets in the sun, under each of several lights.

misstated.py TOOLS PHOTOS         TOOLS: folder of the tools; PHOTOS: tests/data/photos
misstated.py TOOLS SHARED real    SHARED: folder of `real`
"""

import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import sheets
from photographs import Tools, of_real, points

RIGHT = {"angle": 50, "light": "D65", "camera": "canon-5d-mark-ii", "flags": [], "out": 0}
STATED = [
    ("everything correct", {}),
    ("48° for 50°", {"angle": 48}),
    ("51°", {"angle": 51}),
    ("45°", {"angle": 45}),
    ("55°", {"angle": 55}),
    ("48°, with `--fit none`", {"angle": 48, "flags": ["--fit", "none"]}),
    ("D60 for D65", {"light": "D60"}),
    ("D55 for D65", {"light": "D55"}),
    ("D50 for D65", {"light": "D50"}),
    ("A for D65", {"light": "A"}),
    ("nikon-d5100 for canon-5d-mark-ii", {"camera": "nikon-d5100"}),
    ("outer corners 40 px too far out", {"out": 40}),
    ("outer corners 60 px too far in", {"out": -60}),
]
LIGHTS = ["sun:40deg", "D50", "D55", "D65", "daylight:8000", "A"]


def corners(photo, out):
    """Corners of both panels, the outer ones moved away from the crease by px."""
    panels = json.loads(photo.with_suffix(".json").read_text(encoding="utf-8"))["panels_px"]
    for name, side in (("A", -1), ("B", 1)):
        panel = panels[name]
        moved = [[panel[corner][0] + side * out, panel[corner][1]] for corner in ("outer_1", "outer_0")]
        yield [panel["crease_0"], panel["crease_1"], *moved]


def row(tools, photo, name, stated):
    scene, _ = tools.run("vkernel", "--angle-deg", stated["angle"])
    panels = [word for k, panel in enumerate(corners(photo, stated["out"])) for word in (f"--panel{k}", points(panel))]
    facets, _ = tools.run("vextract", "-q", photo, "--camera", stated["camera"], "--illuminant", stated["light"], *panels, given=scene)
    try:
        estimates, _ = tools.run("vestimate", "-q", *stated["flags"], given=facets)
    except subprocess.CalledProcessError as refused:
        print(f"| {name} | | | | refused | {refused.stderr.split('; first: ')[-1].strip()} |")
        return
    record = json.loads(tools.run("vscore", "-q", "--truth", "cc24:magenta", given=estimates)[0].splitlines()[1])
    estimate, metrics = record["estimate"], record["metrics"]
    columns = zip(estimate["reflectance"], estimate["reflectance_sd"], record["truth"]["reflectance"], strict=True)
    within = statistics.fmean(abs(r - t) < 2 * sd for r, sd, t in columns)
    verdict = estimate["verdict"]
    cells = [name, f"{metrics['rmse']:.3f}", f"{metrics['ciede2000']:.1f}", f"{100 * within:.0f}", verdict["level"], verdict["because"]]
    print(f"| {' | '.join(cells)} |", flush=True)


def of_light(tools, shared, light, work):
    """Rendered photographs of real sheets, a light being stated for all."""
    sidecars = [sidecar for pattern in ("real/all_*.json", "real/more/*.json") for sidecar in sorted(shared.glob(pattern))]
    errors, off, good = [], [], 0
    for sidecar in sidecars:
        records, truth = of_real(tools, sidecar, work, light)
        nm, estimate, _ = sheets.estimated(tools, records, [])
        error, of_one = sheets.errors(nm, estimate, truth)
        errors.append(error)
        off += of_one
        good += estimate["verdict"]["level"] == "good"
    print(f"| {light} | {len(errors)} | {statistics.fmean(errors):.4f} | {sheets.within(off)} | {good} |", flush=True)


def main(folder, photos, *real):
    if real:
        with tempfile.TemporaryDirectory() as work:
            for light in LIGHTS:
                of_light(Tools(folder), Path(photos), light, Path(work))
        return
    for name, wrong in STATED:
        row(Tools(folder), Path(photos) / "a_ideal_magenta_50.exr", name, {**RIGHT, **wrong})


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""Accuracy in three rows: ideal folds, rendered photographs of real sheets, unseen sheets.

accuracy.py TOOLS SHARED SET.csv    TOOLS: folder of the tools; SHARED: folder of `real`, `sky` and `ground`
"""

import json
import statistics
import sys
import tempfile
from pathlib import Path

import sheets
from photographs import Tools, of_real, table

SEEDS = range(1, 21)
PHOTOGRAPHS = ["real/all_*.json", "real/more/*.json", "real/pairs/*.json", "sky/*.json", "ground/*.json"]
PAPER = {"ideal, simulated": "0.017 / 0.29, without noise", "rendered, all effects": "0.046 / 3.82, photographed", "rendered, unseen sheets": "-"}


def scored(tools, records, truth, flags=()):
    """Scores and errors in standard deviations of every sample in a stream of records."""
    estimates, _ = tools.run("vestimate", "-q", *flags, given=records)
    told = [] if truth is None else ["--truth", truth]
    said, _ = tools.run("vscore", "-q", *told, given=estimates)
    for record in map(json.loads, said.splitlines()):
        if record["kind"] == "sample":
            estimate, true = record["estimate"], record["truth"]["reflectance"]
            columns = zip(estimate["reflectance"], estimate["reflectance_sd"], true, strict=True)
            yield record["metrics"], [abs(r - t) / sd for r, sd, t in columns]


def ideal(tools):
    """The ColorChecker in the paper's setting, with noise."""
    scene, _ = tools.run("vkernel", "--angle-deg", 45)
    for seed in SEEDS:
        light = ["--camera", "sigma-sd-merrill", "--noise-sd", 1e-3, "--seed", seed]
        yield from scored(tools, tools.run("vforward", "--reflectance", "cc24", *light, given=scene)[0], None)


def photographed(tools, work, photographs):
    """Photographs as records, truth at wavelengths, and flags."""
    for records, truth, *flags in photographs:
        spectrum = table(work / "truth.csv", truth.keys(), [truth.values()])
        yield from scored(tools, records, spectrum, *flags)


def row(name, scores):
    metrics, off = zip(*scores, strict=True)
    mean = {name: statistics.fmean(one[name] for one in metrics) for name in ("rmse", "ciede2000")}
    within = sheets.within([z for one in off for z in one])
    print(f"| {name} | {len(metrics)} | {mean['rmse']:.4f} | {mean['ciede2000']:.2f} | {within} | {PAPER[name]} |", flush=True)


def main(folder, shared, unseen):
    tools, shared = Tools(folder), Path(shared)
    row("ideal, simulated", ideal(tools))
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        sidecars = [sidecar for pattern in PHOTOGRAPHS for sidecar in sorted(shared.glob(pattern))]
        row("rendered, all effects", photographed(tools, work, (of_real(tools, sidecar, work) for sidecar in sidecars)))
        unseen_sheets = sheets.set_of(tools, sheets.two_cameras(shared, work), Path(unseen))
        row("rendered, unseen sheets", photographed(tools, work, unseen_sheets))


if __name__ == "__main__":
    main(*sys.argv[1:])

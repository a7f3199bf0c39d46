#!/usr/bin/env python3
"""What a fold of a known sheet adds to the others, their light stated or unknown: rows of a table.

    known_fold.py TOOLS

The ColorChecker's 24 patches at noise 1e-3, exposure free, with a grey fold of reflectance 0.5; three seeds of noise.
"""

import argparse
import json
import math
import statistics
from pathlib import Path
from tempfile import TemporaryDirectory

from photographs import Tools

LIGHTS = ["D50", "D65", "A", "FL11", "LED-B3"]
SEEDS = [1, 2, 3]
GREY = "0.5"


def errors(record):
    """RMSE, and which wavebands are within two standard deviations."""
    estimate, truth = record["estimate"], record["truth"]
    off = [found - true for found, true in zip(estimate["reflectance"], truth["reflectance"], strict=True)]
    within = [abs(off) <= 2 * sd for off, sd in zip(off, estimate["reflectance_sd"], strict=True)]
    return math.sqrt(statistics.fmean(x * x for x in off)), statistics.fmean(within)


def cell(found):
    rmse = [rmse for rmse, _ in found]
    within = statistics.fmean(within for _, within in found)
    return f"{statistics.fmean(rmse):.4f} / {statistics.median(rmse):.4f} / {max(rmse):.3f} / {100 * within:.0f} %"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools")
    tools = Tools(parser.parse_args().tools)
    scene = tools.run("vkernel")[0]
    print("| light | stated | stated, known fold | unknown | unknown, known fold |\n|---|---|---|---|---|")
    everything = [[] for _ in range(4)]
    for light in LIGHTS:
        columns = [[] for _ in range(4)]
        for seed in SEEDS:
            taken = lambda sheet, noise_seed: tools.run(
                "vforward", "-q", "--reflectance", sheet, "--illuminant", light, "--noise-sd", "1e-3", "--seed", noise_seed, given=scene
            )[0]
            samples = taken("cc24", seed)
            with TemporaryDirectory() as work:
                card = Path(work) / "card.ndjson"
                card.write_text(taken(GREY, 100 + seed), encoding="utf-8")
                known = ["--known-fold", f"{card}={GREY}"]
                unknown = ["--illuminant", "unknown"]
                for column, flags in zip(columns, ([], known, unknown, unknown + known), strict=True):
                    said, _ = tools.run("vestimate", "-q", "--exposure", "free", *flags, given=samples)
                    column += [errors(json.loads(line)) for line in said.splitlines()[1:]]
        print(f"| {light} | {' | '.join(map(cell, columns))} |", flush=True)
        for all, column in zip(everything, columns, strict=True):
            all += column
    print(f"| all | {' | '.join(map(cell, everything))} |")


if __name__ == "__main__":
    main()

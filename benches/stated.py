#!/usr/bin/env python3
"""How often vestimate names another light as more probable than the stated one, where that is right and where it is wrong: rows of tables.

    stated.py TOOLS SHARED [--pick N]       TOOLS: folder of the tools; SHARED: folder of `data` and `train`

Computed facets of the sheets of `lights.py`, exposure free; then photographs of `train`, whose lights are daylight, which people state by any name.
"""

import argparse
import json
import statistics
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from lights import LISTED, NOISES, Bench
from photographs import Tools, of_real

# A daylight stated as one of nearly its temperature is neither right nor wrong.
NEAR = [{"D50", "D55"}, {"D55", "D65"}, {"D65", "D75"}]
TRUE = [*LISTED, "D60", "LED-B2", "FL8"]
LAMPS = ["A", "3000K", "FL2", "FL11", "LED-B3"]


def is_named(one):
    return "times as probable as" in one["estimate"]["verdict"]["because"]


def per_cent(all):
    return f"{100 * statistics.fmean(map(is_named, all)):.1f}"


def of_facets(bench, noise):
    """Per cent of estimates that name another light, of those with it stated rightly, nearly so, and wrongly."""
    found = {"right": [], "near": [], "wrong": []}
    for true in TRUE:
        records = bench.taken(true, noise, bench.fold)
        for stated in LISTED:
            kind = "right" if stated == true else "near" if {stated, true} in NEAR else "wrong"
            found[kind] += bench.stated(records, stated)
    return [per_cent(all) for all in found.values()]


def of_photographs(bench, sidecar):
    """Estimates of the photograph, its own light stated and each lamp."""
    tools = bench.tools
    with TemporaryDirectory() as work:
        records, _ = of_real(tools, sidecar, Path(work))
    estimated = lambda records: json.loads(tools.run("vestimate", "-q", given=records)[0].splitlines()[1])
    scene, *samples = records.splitlines()
    def in_lamp(lamp):
        lit = json.loads(scene) | {"illuminants": [{"name": lamp, "power": bench.power(lamp)}]}
        return estimated("\n".join([json.dumps(lit), *samples]) + "\n")
    return estimated(records), [in_lamp(lamp) for lamp in LAMPS]


def of_charts(bench, sidecars, pool):
    """Per cent by which the patches of each photograph's chart are off, its own light stated (None), D65 and each lamp."""
    def residual(sidecar, light):
        with TemporaryDirectory() as work:
            records, _ = of_real(bench.tools, sidecar, Path(work), light)
        return 100 * max(json.loads(records.splitlines()[1])["calibration"]["residual_rms"])
    charted = [sidecar for sidecar in sidecars if "chart" in json.loads(sidecar.read_text(encoding="utf-8"))["told"]]
    for light in [None, "D65", *LAMPS]:
        yield light, sorted(pool.map(lambda sidecar: residual(sidecar, light), charted))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools")
    parser.add_argument("shared", type=Path)
    parser.add_argument("--pick", type=int, default=0)
    given = parser.parse_args()
    with TemporaryDirectory() as work, ThreadPoolExecutor(2) as pool:
        bench = Bench(Tools(given.tools), given.shared, given.pick, Path(work))
        print("| facets | stated rightly | as a near daylight | stated wrongly |")
        print("|---|---|---|---|")
        for noise, named in zip(NOISES, pool.map(lambda noise: of_facets(bench, noise), NOISES), strict=True):
            print(f"| computed, noise {noise} | {' | '.join(named)} |")
        sidecars = sorted((given.shared / "train").glob("*.json"))
        rightly, wrongly = zip(*pool.map(lambda sidecar: of_photographs(bench, sidecar), sidecars), strict=True)
        print(f"| photographs | {per_cent(rightly)} | | {per_cent([one for all in wrongly for one in all])} |")
        print("\n| photographs in daylight, stated as | named |\n|---|---|")
        for lamp, all in zip(LAMPS, zip(*wrongly, strict=True), strict=True):
            print(f"| {lamp} | {per_cent(all)} |")
        print("\n| charts, light stated as | least | median | most |\n|---|---|---|---|")
        for light, off in of_charts(bench, sidecars, pool):
            print(f"| {light or 'it is'} | {off[0]:.1f} | {statistics.median(off):.1f} | {off[-1]:.1f} |")


if __name__ == "__main__":
    main()

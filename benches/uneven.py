#!/usr/bin/env python3
"""What light that is not the sun's does to estimates of photographs for which sunlight is stated: rows of a table.

    uneven.py TOOLS

Every fourth patch of the ColorChecker, folded to 50 degrees, rendered with photon noise, and estimated with its light stated as D55: in the
sun, in the light of a lamp straight above or off along the crease, and in the sun with a shadow on a panel, which oiiotool puts there.
"""

import argparse
import json
import math
import statistics
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from photographs import Tools

PATCHES = ["dark-skin", "bluish-green", "purplish-blue", "orange-yellow", "magenta", "neutral-6-5"]
SIZE = (320, 240)
# what is rendered, the light for vkernel, the rectangle of the shadow and its depth, and what the verdict is to name
CASES = [
    ("the sun", ["--tilt-deg", "1"], None, None),
    ("a lamp 20 panel depths away", ["--light", "point:0,0,20"], None, "away"),
    ("a lamp 8 depths away", ["--light", "point:0,0,8"], None, "away"),
    ("a lamp 5 depths away", ["--light", "point:0,0,5"], None, "away"),
    ("a lamp 3 depths away", ["--light", "point:0,0,3"], None, "away"),
    ("a lamp 5 depths away, 1.5 along the crease", ["--light", "point:0,-1.5,5"], None, "along the crease"),
    ("a shadow that takes half of the light", ["--tilt-deg", "1"], (60, 70, 80, 20, 0.5), "shadow"),
    ("a shadow that takes a fifth", ["--tilt-deg", "1"], (60, 70, 80, 20, 0.8), "shadow"),
]


def estimated(tools, work, patch, flags, shadow):
    """The record of a sheet, and its true reflectance."""
    scene, _ = tools.run("vkernel", "-q", "--angle-deg", 50, *flags)
    photo = work / "photo.tif"
    size = "x".join(map(str, SIZE))
    light = ["--illuminant", "daylight:5400", "--exposure", 0.7, "--noise-sd", "1e-3", "--photon-noise", "1e-2"]
    said, _ = tools.run("vforward", "-q", "--reflectance", f"cc24:{patch}", *light, "--render", photo, "--render-size", size, given=scene)
    rendered = work / "rendered.json"
    rendered.write_text(said.splitlines()[-1], encoding="utf-8")
    if shadow:
        wide, high, left, top, rest = shadow
        darker = ["--pattern", "constant:color=1,1,1", size, "3", f"--fill:color={rest},{rest},{rest}", f"{wide}x{high}+{left}+{top}", "--mul"]
        subprocess.run(["oiiotool", str(photo), *darker, "-d", "uint16", "-o", str(photo)], check=True)
    plain, _ = tools.run("vkernel", "--angle-deg", 50)
    stated = ["--exact-corners", "--camera", "canon-5d-mark-ii", "--illuminant", "D55", "--regions", rendered]
    facets, _ = tools.run("vextract", photo, *stated, "-q", given=plain)
    records, _ = tools.run("vestimate", "-q", given=facets)
    truth = json.loads(said.splitlines()[-1])["truth"]["reflectance"]
    return json.loads(records.splitlines()[-1])["estimate"], truth


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools")
    tools = Tools(parser.parse_args().tools)
    print("| light | sheets | RMSE | median | worst | within 2 sd, % | good / doubtful / wrong | named |\n|---|---|---|---|---|---|---|---|")
    with TemporaryDirectory() as work:
        for name, flags, shadow, word in CASES:
            found = [estimated(tools, Path(work), patch, flags, shadow) for patch in PATCHES]
            off = [[own - true for own, true in zip(one["reflectance"], truth, strict=True)] for one, truth in found]
            rmse = [math.sqrt(statistics.fmean(x * x for x in one)) for one in off]
            pairs = [pair for one, (estimate, _) in zip(off, found, strict=True) for pair in zip(one, estimate["reflectance_sd"], strict=True)]
            within = statistics.fmean(abs(x) <= 2 * sd for x, sd in pairs)
            levels = [estimate["verdict"]["level"] for estimate, _ in found]
            judged = " / ".join(str(levels.count(level)) for level in ("good", "doubtful", "wrong"))
            named = str(sum(word in json.dumps([one["verdict"], one.get("findings")]) for one, _ in found)) if word else "–"
            each = f"{statistics.fmean(rmse):.3f} | {statistics.median(rmse):.3f} | {max(rmse):.3f}"
            print(f"| {name} | {len(found)} | {each} | {100 * within:.0f} | {judged} | {named} |", flush=True)


if __name__ == "__main__":
    main()

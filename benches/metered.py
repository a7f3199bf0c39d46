#!/usr/bin/env python3
"""What the camera's settings add to photographs without a chart or a card, as rows of a table: without them, and with an exposure time written
into the file's EXIF that is off from the true one as light meters, makers and air are.

    metered.py TOOLS SHARED        TOOLS: folder of the tools; SHARED: folder of `train` and `real`
"""

import json
import math
import random
import shutil
import statistics
import struct
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from photographs import Tools, of_real
from sheets import errors, estimated, within

SETS = [("train", "train/*.json"), ("real, all effects", "real/all_*.json"), ("real, more", "real/more/*.json"), ("real, pairs", "real/pairs/*.json")]
TIMES = 3
LN_DARKER, LN_ERROR = 0.7, 0.3
# ISO 12232, and a clear sun 45° high
F_NUMBER, ISO = 8, 100
WHITE_PER_S = 0.65 / math.pi * ISO / (78 * F_NUMBER**2) * 127500 * math.exp(-0.21 * math.sqrt(2))


def is_bare(sidecar):
    return not {"chart", "white_region"} & set(json.loads(sidecar.read_text(encoding="utf-8"))["told"])


def with_settings(tiff, exposure_s):
    """The bytes of a little-endian TIFF whose EXIF tells the camera's settings: a new first directory at its end."""
    tiff += bytes(len(tiff) % 2)
    (at,) = struct.unpack_from("<I", tiff, 4)
    (count,) = struct.unpack_from("<H", tiff, at)
    entries = [tiff[at + 2 + 12 * n :][:12] for n in range(count)]
    ratios = struct.pack("<4I", round(1e9 * exposure_s), 10**9, F_NUMBER, 1)
    exif_at = len(tiff) + len(ratios)
    entry = lambda tag, kind, value: struct.pack("<HHII", tag, kind, 1, value)
    exif = struct.pack("<H", 3) + entry(33434, 5, len(tiff)) + entry(33437, 5, len(tiff) + 8) + entry(34855, 3, ISO) + bytes(4)
    entries = sorted([*entries, entry(34665, 4, exif_at)], key=lambda entry: struct.unpack_from("<H", entry))
    directory = struct.pack("<H", len(entries)) + b"".join(entries) + bytes(4)
    return tiff[:4] + struct.pack("<I", exif_at + len(exif)) + tiff[8:] + ratios + exif + directory


class Brightened(Tools):
    """The tools, that take numbers of photographs for more or less light."""

    def __init__(self, folder, brightness):
        super().__init__(folder)
        self.white_level = 65535 / brightness

    def run(self, tool, *arguments, given=""):
        level = ["--white-level", self.white_level] if tool == "vextract" else []
        return super().run(tool, *arguments, *level, given=given)


def measured(folder, sidecar, brightness, error):
    """Score of a picture of some brightness whose EXIF tells an exposure time that is off by an error, or none."""
    exposure = brightness * max(json.loads(sidecar.read_text(encoding="utf-8"))["white_rgb"])
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        copy, tiff = work / sidecar.name, sidecar.with_suffix(".tif").read_bytes()
        shutil.copy(sidecar, copy)
        if error is not None:
            tiff = with_settings(tiff, exposure * math.exp(error) / WHITE_PER_S)
        copy.with_suffix(".tif").write_bytes(tiff)
        tools = Brightened(folder, brightness)
        records, truth = of_real(tools, copy, work)
        nm, estimate, _ = estimated(tools, records, [])
    return *errors(nm, estimate, truth), math.log(estimate["exposure"] / exposure), estimate["verdict"]["level"] == "good"


def row(name, settings, found):
    each, off, exposures, good = zip(*found, strict=True)
    scores = " | ".join(f"{score(each):.4f}" for score in (statistics.fmean, statistics.median, max))
    exposure = 100 * statistics.median(map(abs, exposures))
    print(f"| {name} | {settings} | {len(found)} | {scores} | {within([z for one in off for z in one])} | {exposure:.0f} | {sum(good)} |", flush=True)


def main(folder, shared):
    draw = random.Random(1)
    print("| set | settings | count | RMSE | median | worst | within 1, 2 sd, % | exposure off, %, median | good |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, pattern in SETS:
        sidecars = [sidecar for sidecar in sorted(Path(shared).glob(pattern)) if is_bare(sidecar)]
        jobs = [(sidecar, math.exp(-abs(draw.gauss(0, LN_DARKER))), draw.gauss(0, LN_ERROR)) for sidecar in sidecars for _ in range(TIMES)]
        with ThreadPoolExecutor() as several:
            of = lambda job, is_told: measured(folder, *job[:2], job[2] if is_told else None)
            for settings, is_told in [("not told", False), ("told", True)]:
                if jobs:
                    row(name, settings, list(several.map(of, jobs, [is_told] * len(jobs))))


if __name__ == "__main__":
    main(*sys.argv[1:])

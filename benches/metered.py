#!/usr/bin/env python3
"""What the camera's settings and white paper add to photographs without a chart or a card, as rows of a table: without them, with an exposure time
written into the file's EXIF that is off from the true one as light meters, makers and air are, and with what paper next to the sheet would show.

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
# uncertainty by vextract of white paper, and true error of how it lies and is lit
PAPER_SD, PAPER_ERROR = 0.05, 0.064
# ISO 12232, and a clear sun 45° high
F_NUMBER, ISO = 8, 100
WHITE_PER_S = 0.65 / math.pi * ISO / (78 * F_NUMBER**2) * 127500 * math.exp(-0.21 * math.sqrt(2))


def is_bare(sidecar):
    return not {"chart", "white_region"} & set(json.loads(sidecar.read_text(encoding="utf-8"))["told"])


def with_settings(tiff, exposure_s):
    """The bytes of a little-endian TIFF whose EXIF has the camera's settings: a new first directory at its end."""
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


def with_paper(records, exposure):
    """Records with white paper that shows this exposure, in the light of sun and sky."""
    paper = {"corners": [[0, 0], [1, 0], [1, 1], [0, 1]], "cos": 1, "measured": [], "exposure": exposure, "exposure_sd": PAPER_SD * exposure}
    lines = [json.loads(line) for line in records.splitlines()]
    return "".join(json.dumps({**line, "white_paper": paper} if line.get("kind") == "sample" else line) + "\n" for line in lines)


def measured(folder, sidecar, brightness, said, error):
    """Score of a picture of some brightness whose exposure nothing says, or the settings or paper, off by an error in standard deviations."""
    known = json.loads(sidecar.read_text(encoding="utf-8"))
    exposure = brightness * max(known["white_rgb"])
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        copy, tiff = work / sidecar.name, sidecar.with_suffix(".tif").read_bytes()
        shutil.copy(sidecar, copy)
        if said == "settings":
            tiff = with_settings(tiff, exposure * math.exp(LN_ERROR * error) / WHITE_PER_S)
        copy.with_suffix(".tif").write_bytes(tiff)
        tools = Brightened(folder, brightness)
        records, truth = of_real(tools, copy, work)
        if said == "white paper":
            sky = known["rendered"].get("sky", {}).get("share", 0)
            records = with_paper(records, exposure * (1 + sky) * math.exp(PAPER_ERROR * error))
        nm, estimate, _ = estimated(tools, records, [])
    return *errors(nm, estimate, truth), math.log(estimate["exposure"] / exposure), estimate["verdict"]["level"] == "good"


def row(name, said, found):
    each, off, exposures, good = zip(*found, strict=True)
    scores = " | ".join(f"{score(each):.4f}" for score in (statistics.fmean, statistics.median, max))
    exposure = 100 * statistics.median(map(abs, exposures))
    print(f"| {name} | {said} | {len(found)} | {scores} | {within([z for one in off for z in one])} | {exposure:.0f} | {sum(good)} |", flush=True)


def main(folder, shared):
    draw = random.Random(1)
    print("| set | exposure by | count | RMSE | median | worst | within 1, 2 sd, % | median exposure error, % | good |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, pattern in SETS:
        sidecars = [sidecar for sidecar in sorted(Path(shared).glob(pattern)) if is_bare(sidecar)]
        jobs = [(sidecar, math.exp(-abs(draw.gauss(0, LN_DARKER))), draw.gauss(0, 1)) for sidecar in sidecars for _ in range(TIMES)]
        with ThreadPoolExecutor() as several:
            for said in ["nothing", "settings", "white paper"] if jobs else []:
                row(name, said, list(several.map(lambda job, said=said: measured(folder, *job[:2], said, job[2]), jobs)))


if __name__ == "__main__":
    main(*sys.argv[1:])

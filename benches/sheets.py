#!/usr/bin/env python3
"""Photographs of real sheets: errors of estimates, how often error bars hold, and times, as rows of a table.

    sheets.py TOOLS SHARED SET.csv...        TOOLS: folder of the tools; SHARED: folder of `real`, `sky`, `ground` and `materials`

First those that were rendered or measured without vfold, then forty sheets drawn from each set, rendered by vforward: gloss, rough bodies, a
blue sky, a warm sun and a camera of which another measurement is stated; angle, tilt, light and corners are stated as a user knows them, of
half of them the exposure, too.
"""

import json
import random
import statistics
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from photographs import Tools, extracted, of_material, of_real, rmse, table

SHEETS = 40
FAR = 0.1
# Of the corners, px, of the angle and the tilt, degrees, and of the exposure, relative: how far off a user is.
CORNER_SD, ANGLE_SD_DEG, TILT_SD_DEG, EXPOSURE_SD = 0.5, 1.2, 2.0, 0.05
SKY_CCT_K = 11000
GIVEN = [
    ("rendered, all effects", of_real, "real/all_*.json", []),
    ("rendered, one effect", of_real, "real/one_*.json", []),
    ("rendered, all effects, more", of_real, "real/more/*.json", []),
    ("rendered, two of one sheet", of_real, "real/pairs/*.json", []),
    ("rendered, other skies", of_real, "sky/*.json", []),
    ("rendered, other grounds", of_real, "ground/*.json", []),
    ("measured materials", of_material, "materials/*.json", ["--exposure", "1"]),
]
# days among the rendered photographs; of the first, only photographs without a chart
DAYS = [
    ("clear sky", ["real/all_*.json", "real/more/*.json", "real/pairs/*.json"]),
    ("haze, thin cloud", ["sky/k02.json", "sky/k06.json", "sky/k08.json"]),
    ("overcast", ["sky/k01.json", "sky/k03.json", "sky/k05.json", "sky/k07.json"]),
    ("shade", ["sky/k04.json"]),
]


def simulated(tools, cameras, spec, draw, work):
    """Records of a sheet that vforward photographs, its truth, and the exposure if that is stated."""
    angle_deg, exposure = draw.uniform(44, 72), draw.uniform(0.4, 0.9)
    true_camera, told_camera = cameras
    sky, tilt_deg = draw.uniform(0.05, 0.15), draw.gauss(0, TILT_SD_DEG)
    scene, _ = tools.run("vkernel", "--angle-deg", angle_deg, "--tilt-deg", tilt_deg, "--sky", sky)
    light = ["--illuminant", f"daylight:{draw.uniform(5100, 5500):.0f}", "--sky-illuminant", f"daylight:{SKY_CCT_K}"]
    surface = ["--specular-weight", draw.uniform(0, 0.5), "--specular-roughness", draw.uniform(0.38, 0.55), "--body-roughness-deg", draw.uniform(0, 20)]
    noise = ["--noise-sd", 1e-3, "--photon-noise", 1e-2, "--seed", draw.randrange(10000)]
    picture = ["--exposure", exposure, *noise, "--render", work / "sheet.tif", "--render-size", "400x300"]
    said, _ = tools.run("vforward", "-q", "--percent=no", "--reflectance", spec, "--camera", true_camera, *light, *surface, *picture, given=scene)
    sample = json.loads(said.splitlines()[-1])
    truth = dict(zip(sample["truth"]["wavelengths_nm"], sample["truth"]["reflectance"], strict=True))
    moved = {}
    for panel in ("panel0", "panel1"):
        for corner in map(tuple, sample["regions"][panel]):
            moved.setdefault(corner, tuple(x + draw.gauss(0, CORNER_SD) for x in corner))
    corners = {panel: [moved[tuple(corner)] for corner in sample["regions"][panel]] for panel in ("panel0", "panel1")}
    told_light = draw.choice(["D50", "D55", "D65"])
    fold = ["--angle-deg", angle_deg + draw.gauss(0, ANGLE_SD_DEG)]
    records = extracted(tools, fold, work / "sheet.tif", told_camera, told_light, corners, [])
    told_exposure = exposure * (1 + draw.gauss(0, EXPOSURE_SD))
    return records, truth, ["--exposure", told_exposure] if draw.random() < 0.5 else []


def two_cameras(shared, work):
    """Files of a camera's spectral sensitivities: as they are, and as another measurement has them."""
    said = json.loads((shared / "real/all_blue_paint.json").read_text(encoding="utf-8"))
    measured = {"true": said["camera_sensitivities_rgb"], "told": said["told"]["camera_sensitivities_rgb"]}
    return [table(work / f"{which}.csv", said["wavelengths_nm"], columns) for which, columns in measured.items()]


def set_of(tools, cameras, path):
    """Forty sheets of a set, as [`simulated`] has them."""
    names = path.read_text(encoding="utf-8").splitlines()[0].split(",")[1:]
    draw = random.Random(path.stem)
    drawn = [(name, draw.random()) for name in draw.sample(names, min(SHEETS, len(names)))]

    def sheet(one):
        with tempfile.TemporaryDirectory() as work:
            return simulated(tools, cameras, f"{path}:{one[0]}", random.Random(one[1]), Path(work))

    with ThreadPoolExecutor() as several:
        return list(several.map(sheet, drawn))


def estimated(tools, records, flags):
    """Wavelengths, estimate and ms of the only sample, by one thread."""
    said, ms = tools.run("vestimate", "-q", "-j", 1, *flags, given=records)
    scene, record = (json.loads(line) for line in said.splitlines())
    return scene["wavelengths_nm"], record["estimate"], ms


def errors(nm, estimate, truth):
    """RMSE, and errors in standard deviations."""
    found = zip(nm, estimate["reflectance"], estimate["reflectance_sd"], strict=True)
    off = [abs(r - truth[n]) / sd for n, r, sd in found if n in truth]
    return rmse({"estimate": estimate, "wavelengths_nm": nm}, truth), off


def within(off):
    """Per cent of errors within one and two standard deviations."""
    return " / ".join(f"{100 * statistics.fmean(z < most for z in off):.0f}" for most in (1, 2))


def measured(tools, records, truth, flags):
    """RMSE, errors in standard deviations, ms."""
    nm, estimate, ms = estimated(tools, records, flags)
    return *errors(nm, estimate, truth), ms


def row(tools, name, photographs):
    all_of_them = [measured(tools, *one) for one in photographs]
    off = [z for _, of_one, _ in all_of_them for z in of_one]
    each, ms = [one[0] for one in all_of_them], statistics.median(one[2] for one in all_of_them)
    far = sum(error > FAR for error in each)
    print(f"| {name} | {len(each)} | {statistics.fmean(each):.4f} | {far} | {within(off)} | {ms:.0f} |", flush=True)


def by_day(tools, shared, work):
    print("\n## By the day\n\n| day | count | RMSE | worst | within |\n|---|---|---|---|---|")
    for name, patterns in DAYS:
        sidecars = [sidecar for pattern in patterns for sidecar in sorted(shared.glob(pattern)) if "chart" not in json.loads(sidecar.read_text())["told"]]
        measurements = [measured(tools, *of_real(tools, sidecar, work), []) for sidecar in sidecars]
        if measurements:
            each = [one[0] for one in measurements]
            off = [z for _, of_one, _ in measurements for z in of_one]
            print(f"| {name} | {len(each)} | {statistics.fmean(each):.4f} | {max(each):.4f} | {within(off)} |", flush=True)


def main(folder, shared, *sets):
    tools, shared = Tools(folder), Path(shared)
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        for name, kind, pattern, flags in GIVEN:
            sidecars = sorted(shared.glob(pattern))
            if sidecars:
                row(tools, name, [(*kind(tools, sidecar, work), flags) for sidecar in sidecars])
        cameras = two_cameras(shared, work)
        for path in map(Path, sets):
            row(tools, path.stem, set_of(tools, cameras, path))
        by_day(tools, shared, work)


if __name__ == "__main__":
    main(*sys.argv[1:])

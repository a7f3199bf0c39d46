#!/usr/bin/env python3
"""What a change of the estimator or the prior does, in a few minutes, as one table on standard output.

    loop.py TOOLS SHARED [--pulls]        TOOLS: folder of the tools; SHARED: folder of `train`, `real` and the other sets

Photographs with the default options (`vestimate --fit auto`), then simulated samples of two charts, exposure known. Count, RMSE (mean, median,
worst), per cent of true values within one and two standard deviations, how many estimates are called good, processor's ms of an estimate.
With --pulls a second table: of every unknown that was fitted in `train`, found minus true over its standard deviation.
"""

import json
import statistics
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from subprocess import CalledProcessError

from photographs import Tools, extracted, of_material, of_real
from sheets import errors, estimated, within

CORNERS = ["crease_0", "crease_1", "outer_1", "outer_0"]
CAMERAS = {"Canon EOS 5D Mark II": "canon-5d-mark-ii", "Nikon 5100 (NPL)": "nikon-d5100"}
NOISES = ["0", "1e-3"]


def of_photo(tools, sidecar, work):
    """Records and truth of the picture of an ideal fold, of which all is told but the exposure."""
    said = json.loads(sidecar.read_text(encoding="utf-8"))
    part = said["ambient_fraction"]
    fold = ["--angle-deg", said["angle_deg"], "--tilt-deg", said["light_tilt_deg"], "--sky", part / (1 - part)]
    flags = ["--sky-illuminant", "daylight:8000"] if part else []
    if "jpeg" in said:
        did = work / f"{sidecar.stem}-did.json"
        did.write_text(json.dumps({name: said["jpeg"][name] for name in ("white_balance_gains", "camera_to_linear_srgb")}), encoding="utf-8")
        flags += ["--undo", did]
    corners = {f"panel{n}": [said["panels_px"][panel][corner] for corner in CORNERS] for n, panel in enumerate("AB")}
    photo = sidecar.with_name(said["file"])
    records = extracted(tools, fold, photo, CAMERAS[said["camera"]], said["illuminant"], corners, flags)
    return records, dict(zip(said["wavelengths_nm"], said["reflectance"], strict=True))


def without_card(sidecar):
    """Not the sheet beside a card, which is another estimator's."""
    return "card_reflectance" not in json.loads(sidecar.read_text(encoding="utf-8"))


SETS = [
    ("train", of_real, "train/*.json", []),
    ("real, all effects", of_real, "real/all_*.json", []),
    ("real, one effect", of_real, "real/one_*.json", []),
    ("real, more", of_real, "real/more/*.json", []),
    ("real, pairs", of_real, "real/pairs/*.json", []),
    ("other daylight", of_real, "sky/*.json", []),
    ("coloured grounds", of_real, "ground/*.json", []),
    ("brightened sheets", of_real, "fluorescence/photos/*.json", []),
    ("materials, exposure known", of_material, "materials/*.json", ["--exposure", "1"]),
    ("materials, exposure free", of_material, "materials/*.json", ["--exposure", "free"]),
    ("ideal folds", of_photo, "photos/*.json", []),
]


def photographs(tools, kind, sidecars):
    """Records and truths of the pictures, with the sidecar of each; pictures that the tools, as they were built, do not read are left out."""

    def one(sidecar):
        with tempfile.TemporaryDirectory() as work:
            try:
                return sidecar, *kind(tools, sidecar, Path(work))
            except CalledProcessError as ended:
                print(f"loop.py: {sidecar.stem} left out: {ended.stderr.strip()}", file=sys.stderr)
                return None

    with ThreadPoolExecutor() as several:
        return [picture for picture in several.map(one, sidecars) if picture]


def row(name, found):
    """A row of the table, of an estimate's wavelengths, itself, its truth and its ms."""
    each, off = zip(*(errors(nm, estimate, truth) for nm, estimate, truth, _ in found), strict=True)
    scores = " | ".join(f"{score(each):.4f}" for score in (statistics.fmean, statistics.median, max))
    good = sum(estimate["verdict"]["level"] == "good" for _, estimate, _, _ in found)
    ms = statistics.fmean(ms for *_, ms in found)
    print(f"| {name} | {len(found)} | {scores} | {within([z for of_one in off for z in of_one])} | {good} | {ms:.1f} |", flush=True)


def simulated(tools, spec, noise):
    """Estimates of a chart's samples, as [`row`] takes them."""
    scene, _ = tools.run("vkernel", "--angle-deg", 45)
    samples, _ = tools.run("vforward", "-q", "--reflectance", spec, "--camera", "canon-5d-mark-ii", "--noise-sd", noise, given=scene)
    said, ms = tools.run("vestimate", "-q", "-j", 1, given=samples)
    scene, *records = (json.loads(line) for line in said.splitlines())
    truths = [dict(zip(record["truth"]["wavelengths_nm"], record["truth"]["reflectance"], strict=True)) for record in records]
    return [
        (scene["wavelengths_nm"], record["estimate"], truth, ms / len(records))
        for record, truth in zip(records, truths, strict=True)
    ]


def at(nm, wavelengths_nm, values):
    return values[wavelengths_nm.index(nm)]


def true_sizes(said):
    """What was rendered of every unknown, as the record names them; of what a picture does not have, such as the colour of no sky, nothing.
    Gains are not among them: units of a camera differ in their curves."""
    rendered = said["rendered"]
    sheet, lens, nm = rendered["bsdf"], rendered["camera_effects"], said["wavelengths_nm"]
    true = {
        "exposure": max(said["white_rgb"]),
        "angle_deg": said["angle_deg"],
        "tilt_deg": said["light_tilt_deg"],
        "specular_weight": sheet["gloss"],
        "body_roughness_deg": sheet["sigma_deg"],
        "sheen": 0.0,
        "crease_radius": rendered["crease_radius"],
        "bow_deg": -rendered["bow_deg"],
        "bow_difference_deg": 0.0,
        "vignetting": lens["vignetting"],
        "veiling_glare": lens["glare"],
        "sky": 0.0,
    }
    if sheet["gloss"] > 0:
        true["specular_roughness"] = sheet["alpha"]
    if isinstance(rendered["illuminant"], str):
        true["sun_cct_k"] = float(rendered["illuminant"].rsplit(" ", 1)[1])
    if "sky" in rendered:
        share = rendered["sky"]["share"]
        height = sum(a * b for a, b in zip(rendered["up"], said["light_direction_towards_light"], strict=True))
        true["sky"] = share / (1 - share) * height
        true["sky_cct_k"] = float(rendered["sky"]["illuminant"].rsplit(" ", 1)[1])
    if "ground" in rendered:
        green, red = (at(band, nm, said["ground_albedo"]) for band in (550.0, 700.0))
        true |= {"ground": green, "ground_redness": red / green - 1}
    return true


def print_pulls(found):
    """The table of what was found of every unknown, of sidecars and estimates."""
    pulls, off = {}, {}
    for sidecar, estimate in found:
        true = true_sizes(json.loads(sidecar.read_text(encoding="utf-8")))
        for name, fitted in estimate.get("fit", {}).items():
            if name in true and fitted["sd"] > 0:
                off.setdefault(name, []).append(fitted["value"] - true[name])
                pulls.setdefault(name, []).append(off[name][-1] / fitted["sd"])
    print("\n| unknown | count | off, rms | pull, mean | pull, rms | furthest |\n|---|---|---|---|---|---|")
    for name, each in pulls.items():
        rms_off, rms = (statistics.fmean(x * x for x in values) ** 0.5 for values in (off[name], each))
        furthest = max(each, key=abs)
        print(f"| {name} | {len(each)} | {rms_off:.3g} | {statistics.fmean(each):.2f} | {rms:.2f} | {furthest:.1f} |")


def main(folder, shared, *flags):
    tools, shared = Tools(folder), Path(shared)
    of_train = []
    print("| set | count | RMSE | median | worst | within | good | ms |\n|---|---|---|---|---|---|---|---|", flush=True)
    for name, kind, pattern, told in SETS:
        sidecars = [sidecar for sidecar in sorted(shared.glob(pattern)) if without_card(sidecar)]
        if not sidecars:
            continue
        pictures = photographs(tools, kind, sidecars)
        found = [(sidecar, truth, *estimated(tools, records, told)) for sidecar, records, truth in pictures]
        row(name, [(nm, estimate, truth, ms) for _, truth, nm, estimate, ms in found])
        if name == "train":
            of_train = [(sidecar, estimate) for sidecar, _, _, estimate, _ in found]
    chart = shared / "data/reflectance/colorchecker_sg140.csv"
    for name, spec in [("cc24", "cc24"), *([(chart.stem, chart)] if chart.exists() else [])]:
        for noise in NOISES:
            row(f"{name}, noise {noise}", simulated(tools, spec, noise))
    if "--pulls" in flags:
        print_pulls(of_train)


if __name__ == "__main__":
    main(*sys.argv[1:])

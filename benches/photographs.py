#!/usr/bin/env python3
"""Time and error of vestimate on photographs of real sheets, as rows `panel,series,setting,ms,error`: what each unknown of the scene costs, and
what it buys. Time is the processor's, one thread, the mean over a panel's photographs in one stream.

    photographs.py TOOLS SHARED        TOOLS: folder of the tools; SHARED: folder of `real` and `materials`
"""

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

RUNS = 5
OF_MATERIALS = ["none", "angle", "tilt", "sky", "auto"]
OF_REAL = ["none", "exposure", "angle", "tilt", "sky", "daylight", "angle,tilt,sky,daylight", "auto"]


def points(corners):
    return " ".join(f"{x},{y}" for x, y in corners)


def table(path, wavelengths_nm, columns):
    lines = ["nm" + "".join(f",c{n}" for n in range(len(columns)))]
    lines += [",".join(map(repr, row)) for row in zip(wavelengths_nm, *columns, strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


class Tools:
    """The tools, the processor time of which is told."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, tool, *arguments, given=""):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        program = [os.path.join(self.folder, tool), *map(str, arguments)]
        said = subprocess.run(program, input=given, capture_output=True, text=True, check=True).stdout
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return said, 1e3 * (after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)


def of_real(tools, sidecar, work, light=None):
    """Records of a picture with all that real ones have, in another light than its own statement, if one is given, and its truth: reflectance at
    wavelengths."""
    said = json.loads(sidecar.read_text(encoding="utf-8"))
    told, nm = said["told"], said["wavelengths_nm"]
    calibration = []
    if "chart" in told:
        calibration = ["--chart", points(told["chart"]), "--chart-cos", told["chart_cos"], "--chart-reference", "cc24-babelcolor"]
    elif "white_region" in told:
        calibration = ["--white-region", points(told["white_region"]), "--white-cos", told["white_cos"]]
        calibration += ["--white-reflectance", told["white_reflectance"]]
    fold = ["--angle-deg", told["angle_deg"], "--tilt-deg", told["tilt_deg"], "--slant-deg", told["slant_deg"]]
    camera = table(work / "camera.csv", nm, told["camera_sensitivities_rgb"])
    light = light or table(work / "light.csv", nm, [told["illuminant_spd"]])
    records = extracted(tools, fold, sidecar.with_suffix(".tif"), camera, light, told, [*calibration, "--refine"])
    return records, dict(zip(nm, said["reflectance"], strict=True))


def of_material(tools, sidecar, work):
    """Records of a fold of a measured material in three narrow bands, and its truth there."""
    said = json.loads(sidecar.read_text(encoding="utf-8"))
    nm = [400.0 + 5.0 * n for n in range(61)]
    camera = table(work / "camera.csv", nm, [[float(abs(n - band) < 0.1) for n in nm] for band in said["bands_nm"]])
    light = table(work / "light.csv", nm, [[1.0] * len(nm)])
    fold = ["--angle-deg", said["angle_deg"], "--tilt-deg", said["tilt_deg"]]
    records = extracted(tools, fold, sidecar.with_suffix(".exr"), camera, light, said, [])
    return records, {nm[round((band - 400) / 5)]: r for band, r in zip(said["bands_nm"], said["reflectance_45_0"], strict=True)}


def extracted(tools, fold, photo, camera, light, corners, flags):
    scene, _ = tools.run("vkernel", *fold)
    panels = ["--panel0", points(corners["panel0"]), "--panel1", points(corners["panel1"])]
    return tools.run("vextract", "-q", photo, "--camera", camera, "--illuminant", light, *panels, *flags, given=scene)[0]


def rmse(record, truth):
    nm = record["wavelengths_nm"]
    reflectance = dict(zip(nm, record["estimate"]["reflectance"], strict=True))
    return statistics.fmean((reflectance[n] - r) ** 2 for n, r in truth.items()) ** 0.5


def row(panel, series, setting, ms, error):
    print(f"{panel},{series},{setting},{ms:.3e},{error:.3e}", flush=True)


def measure(tools, panel, photographs, fits, flags):
    stream = "".join(records for records, _ in photographs)
    for fit in fits:
        runs = [tools.run("vestimate", "-q", "-j", 1, "--fit", fit, *flags, given=stream) for _ in range(RUNS)]
        took = statistics.median(ms for _, ms in runs) / len(photographs)
        records = [json.loads(line) for line in runs[0][0].splitlines()]
        scene, errors = None, []
        for record in records:
            if record["kind"] == "scene":
                scene = record
            else:
                errors.append(rmse({**record, "wavelengths_nm": scene["wavelengths_nm"]}, photographs[len(errors)][1]))
        row(panel, "vestimate --fit", fit.replace(",", " "), took, statistics.fmean(errors))


def main(folder, shared):
    tools, shared = Tools(folder), Path(shared)
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        for panel, kind, pattern, fits, flags in [
            ("photographs as people take them", of_real, "real/all_*.json", OF_REAL, []),
            ("photographs with one effect each", of_real, "real/one_*.json", OF_REAL, []),
            ("more photographs as people take them", of_real, "real/more/*.json", OF_REAL, []),
            ("measured materials: exposure known", of_material, "materials/*.json", OF_MATERIALS, ["--exposure", "1"]),
        ]:
            sidecars = sorted(shared.glob(pattern))
            if sidecars:
                measure(tools, panel, [kind(tools, sidecar, work) for sidecar in sidecars], fits, flags)


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""Time and error of NumPy, SciPy and colour-science, as rows `panel,series,setting,ms,error`; one thread, processor time.

    pareto_peers.py response KERNEL.npy PANEL        dense solutions for 61 wavebands; KERNEL.npy from `vkernel --mesh facets --save`
    pareto_peers.py estimate SMOOTHNESS PANEL        the paper's objective by SciPy, of the samples on standard input
    pareto_peers.py colour PANEL...                  flat sheets by colour-science from their true XYZ, of the same samples
"""

import os

os.environ.update(dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1"))

import json
import statistics
import sys
import time
import warnings

import numpy as np

BANDS = 61
RUNS = 5
RADIANCE = os.path.join(os.path.dirname(__file__), "../tests/data/reference/radiance.json")


def timed(work):
    """Processor time in ms of one run, and its result."""
    start = time.process_time()
    result = work()
    return 1e3 * (time.process_time() - start), result


def row(panel, series, setting, ms, error):
    print(f"{panel},{series},{setting},{ms:.3e},{error:.3e}", flush=True)


def response(kernel, panel):
    """`(I - rK) E = E0` for 61 reflectances, those with a solution in 14 digits among them."""
    print(f"# NumPy {np.__version__}")
    kernel = np.load(kernel)
    half = len(kernel) // 2
    with open(RADIANCE, encoding="utf-8") as file:
        systems = json.load(file)["systems"]
    truth = next(s for s in systems if s["theta_deg"] == 45 and s["nx"] == 10)["radiance"]
    wanted = [np.hstack([np.array(t["L"]), np.array(t["L"])[:, ::-1]]).ravel() * np.pi / t["r"] for t in truth]
    r = np.concatenate([[t["r"] for t in truth], np.arange(len(truth), BANDS) / BANDS])
    # Facets of one size: what a facet gets is what it gives. Panels that are alike may be solved as one.
    for setting, matrix in (("solve 200 x 200", kernel), ("solve 100 x 100", kernel[:half, half:])):
        eye, light = np.eye(len(matrix)), np.ones(len(matrix))

        def solve():
            return [np.linalg.solve(eye - one * matrix, light)[:half] for one in r]

        times, found = zip(*(timed(solve) for _ in range(RUNS)), strict=True)
        errors = [abs(a / b - 1).max() for a, b in zip(found[0], wanted)]
        row(panel, "NumPy", setting, statistics.median(times), max(errors))


def records():
    scene, samples = None, []
    for line in sys.stdin:
        record = json.loads(line)
        if record["kind"] == "scene":
            scene = record
        elif record["kind"] == "sample":
            samples.append(record)
    return scene, samples


def rmse(found, sample):
    return np.sqrt(np.mean((found - np.array(sample["truth"]["reflectance"])) ** 2))


def summary(panel, series, setting, found):
    times, errors = zip(*found, strict=True)
    row(panel, series, setting, statistics.median(times), np.mean(errors))


def estimate(smoothness, panel):
    import scipy
    from scipy_estimate import problem, trf, trust_constr

    print(f"# SciPy {scipy.__version__}")
    scene, samples = records()
    start = np.full(BANDS, 0.5)
    for setting, method in (("trf", trf), ("trust-constr", trust_constr)):
        found = []
        for sample in samples:
            equations = problem(scene, sample, float(smoothness))
            ms, r = timed(lambda: method(*equations, start))
            found.append((ms, rmse(r, sample)))
        summary(panel, "SciPy eq. (36)", setting, found)


def colour(*panels):
    """From the XYZ under D65 that a perfect colorimeter would measure, which is kind: no camera, no noise."""
    warnings.simplefilter("ignore")
    import colour

    print(f"# colour-science {colour.__version__}")
    shape = colour.SpectralShape(400, 700, 5)
    cmfs = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    light = colour.SDS_ILLUMINANTS["D65"].copy().align(shape)
    _, samples = records()
    for method in ("Jakob 2019", "Otsu 2018", "Meng 2015"):
        found = []
        for sample in samples:
            truth = colour.SpectralDistribution(sample["truth"]["reflectance"], shape.wavelengths)
            xyz = colour.sd_to_XYZ(truth, cmfs, light, method="Integration") / 100
            ms, sd = timed(lambda: colour.XYZ_to_sd(xyz, method=method, cmfs=cmfs, illuminant=light))
            found.append((ms, rmse(np.interp(shape.wavelengths, sd.wavelengths, sd.values), sample)))
        for panel in panels:
            summary(panel, "colour-science from true XYZ", method, found)


if __name__ == "__main__":
    {"response": response, "estimate": estimate, "colour": colour}[sys.argv[1]](*sys.argv[2:])

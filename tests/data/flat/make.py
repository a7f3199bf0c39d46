#!/usr/bin/env python3
"""Writes flat_sheets.json beside it: spectra that Park's and Khan's estimators give, computed another way.

    python3 -m venv venv && venv/bin/pip install numpy==2.2.6 scipy
    venv/bin/python tests/data/flat/make.py

Least squares with linear inequalities as a least distance problem, solved by non-negative least squares (Lawson and Hanson,
Solving Least Squares Problems, 1974, chapter 23): exact, and nothing like the interior point method of vfold.
"""

import csv
import json
from pathlib import Path

import numpy as np
from scipy.optimize import nnls

HERE = Path(__file__).parent
SHARE = HERE.parents[2] / "share"
NM = np.arange(400.0, 701.0, 5.0)
PATCHES = ["orange", "blue", "magenta", "black"]


def table(name):
    rows = list(csv.reader(open(SHARE / name)))
    numbers = np.array(rows[1:], float)
    inside = (NM >= numbers[0, 0]) & (NM <= numbers[-1, 0])
    return {column: np.interp(NM, numbers[:, 0], numbers[:, k]) * inside for k, column in enumerate(rows[0]) if k}


def view(camera, lights):
    """Channels of all pictures by waveband, white 1 in the strongest channel of each."""
    width = np.full(len(NM), 5.0)
    width[[0, -1]] = 2.5
    sensitivities, powers = table(camera), table("illuminants.csv")
    pictures = [np.array([s * powers[light] * width for s in sensitivities.values()]) for light in lights]
    return np.vstack([picture / picture.sum(axis=1).max() for picture in pictures])


def bounded(matrix, right, basis, high):
    """Weights of least |matrix w - right| with 0 <= basis w <= high; high may be infinite."""
    u, s, vt = np.linalg.svd(matrix, full_matrices=False)
    back = vt.T / s  # w = back (z + u'right): |z| is to be least
    limits = basis if np.isinf(high) else np.vstack([basis, -basis])
    at_least = np.zeros(len(limits))
    at_least[len(basis) :] = -high if len(limits) > len(basis) else 0.0
    g, h = limits @ back, at_least - limits @ back @ (u.T @ right)
    solution, _ = nnls(np.vstack([g.T, h]), np.append(np.zeros(g.shape[1]), 1.0), maxiter=100_000)
    r = np.vstack([g.T, h]) @ solution - np.append(np.zeros(g.shape[1]), 1.0)
    return back @ (-r[:-1] / r[-1] + u.T @ right)


def estimate(basis, camera_view, values, smoothness, known):
    """A spectrum; with an unknown exposure its peak is 1/2."""
    roughness = np.diff(np.eye(len(NM)), 2, axis=0)
    matrix = np.vstack([camera_view @ basis, np.sqrt(smoothness) * roughness @ basis])
    right = np.append(values, np.zeros(len(roughness)))
    reflectance = basis @ bounded(matrix, right, basis, 1.0 if known else np.inf)
    return reflectance if known else reflectance * 0.5 / reflectance.max()


chips = np.load(SHARE / "munsell1269.npy")[:, 4:65] / 50_000
correlation = chips.T @ chips / len(chips)
principal = np.linalg.eigh(correlation)[1][:, ::-1]
patches = table("cc24.csv")
cases = []
for lights, park, khan in [(["A", "D65", "FL11"], 8, 9), (["D65"], 3, 3)]:
    camera_view = view("sigma-sd-merrill.csv", lights)
    seen = correlation @ camera_view.T
    power, axes = np.linalg.eigh(camera_view @ seen)
    khans = (seen @ axes / np.sqrt(power))[:, ::-1][:, :khan]
    for known in [True, False]:
        for method, basis, smoothness in [("park", principal[:, :park], 1e-4), ("khan", khans, 0.0)]:
            spectra = {
                patch: estimate(basis, camera_view, camera_view @ patches[patch], smoothness, known).round(8).tolist()
                for patch in PATCHES
            }
            cases.append({"method": method, "lights": lights, "exposure_known": known, "spectra": spectra})
(HERE / "flat_sheets.json").write_text(json.dumps(cases) + "\n")

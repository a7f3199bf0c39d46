#!/usr/bin/env python3
"""The paper's estimator by SciPy beside vestimate: cost, time and RMSE of every sample of a stream.

    vkernel --mesh facets | vforward --reflectance cc24 | vestimate --prior smooth |
        python3 benches/scipy_estimate.py [--smoothness 1e-5]

    vkernel --mesh facets | vforward --reflectance cc24 | python3 benches/scipy_estimate.py --times

Solves eq. (36) of Deeb et al. within 0 <= r <= 1 from r = 0.5 by two methods of SciPy: trf (least_squares) and
trust-constr (minimize). One sheet lit evenly, exposure as the sample says.
"""

import os

os.environ.update(dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1"))

import argparse
import json
import sys
import time

import numpy as np
from scipy.optimize import Bounds, least_squares, minimize


def problem(scene, sample, smoothness):
    """Residuals and Jacobian of eq. (36) as functions of reflectance."""
    poles = np.array(scene["response"]["poles"])
    light = np.array(scene["light"]["panel_irradiance"])
    assert np.ptp(light) == 0 and scene["light"]["sky"] == 0, "one sheet lit evenly"
    facets = np.tile(light[0] * np.array(scene["response"]["residues"]), (2, 1))
    weights = camera_weights(scene)
    data = np.array(sample["facet_rgb"])
    exposure = sample["exposure"]
    bands = weights.shape[1]
    roughness = np.sqrt(smoothness) * np.diff(np.eye(bands), 2, axis=0)

    def residuals(r):
        terms = r[:, None] / (1 - np.outer(r, poles))
        model = exposure * facets @ (terms.T @ weights.T)
        return np.concatenate([(model - data).T.ravel(), roughness @ r])

    def jacobian(r):
        slopes = 1 / (1 - np.outer(r, poles)) ** 2
        by_facet = exposure * facets @ slopes.T
        return np.vstack([by_facet * channel for channel in weights] + [roughness])

    return residuals, jacobian


def camera_weights(scene):
    """Channel by waveband: trapezoid rule, white facing the sun being 1 in the strongest channel."""
    wavelengths = np.array(scene["wavelengths_nm"])
    width = np.gradient(wavelengths)
    width[[0, -1]] /= 2
    sensitivities = np.array(scene["camera"]["sensitivities"])
    weights = sensitivities * np.array(scene["illuminants"][0]["power"]) * width
    return weights / weights.sum(axis=1).max()


def trf(residuals, jacobian, start):
    tight = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-12, "max_nfev": 2000}
    return least_squares(residuals, start, jacobian, bounds=(0, 1), method="trf", **tight).x


def trust_constr(residuals, jacobian, start):
    def cost(r):
        return np.sum(residuals(r) ** 2)

    def gradient(r):
        return 2 * jacobian(r).T @ residuals(r)

    def hessian(r):
        return 2 * jacobian(r).T @ jacobian(r)

    options = {"gtol": 1e-12, "xtol": 1e-14, "barrier_tol": 1e-12, "maxiter": 2000}
    bounds = Bounds(0, 1)
    return minimize(
        cost, start, jac=gradient, hess=hessian, bounds=bounds, method="trust-constr", options=options
    ).x


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoothness", type=float, default=1e-5)
    parser.add_argument("--times", action="store_true", help="only the times of trf, for samples without estimates")
    args = parser.parse_args()
    if args.times:
        return times(args.smoothness)
    print("| sample | method | cost | over the best | ms | RMSE |\n|---|---|---|---|---|---|")
    scene = None
    for line in sys.stdin:
        record = json.loads(line)
        if record["kind"] == "scene":
            scene = record
        if record["kind"] == "sample":
            compare(scene, record, args.smoothness)


def times(smoothness):
    scene, *samples = map(json.loads, sys.stdin)
    took, off = [], []
    for sample in samples:
        truth = np.array(sample["truth"]["reflectance"])
        began = time.process_time()
        found = trf(*problem(scene, sample, smoothness), np.full(len(truth), 0.5))
        took.append(1e3 * (time.process_time() - began))
        off.append(np.sqrt(np.mean((found - truth) ** 2)))
    spread = [np.mean(took), *np.quantile(took, [0.5, 0.95, 1.0])]
    print(f"| {np.mean(off):.4f} | {' / '.join(f'{ms:.0f}' for ms in spread)} |")


def compare(scene, sample, smoothness):
    residuals, jacobian = problem(scene, sample, smoothness)
    truth = np.array(sample["truth"]["reflectance"])
    start = np.full(len(truth), 0.5)
    found = [("vestimate", np.array(sample["estimate"]["reflectance"]), 0.0)]
    for name, method in (("trf", trf), ("trust-constr", trust_constr)):
        began = time.process_time()
        found.append((name, method(residuals, jacobian, start), 1e3 * (time.process_time() - began)))
    costs = [np.sum(residuals(r) ** 2) for _, r, _ in found]
    for (name, r, ms), cost in zip(found, costs, strict=True):
        rmse = np.sqrt(np.mean((r - truth) ** 2))
        print(f"| {sample['id']} | {name} | {cost:.9e} | {cost - min(costs):.1e} | {f'{ms:.0f}' if ms else ''} | {rmse:.4f} |", flush=True)


if __name__ == "__main__":
    main()

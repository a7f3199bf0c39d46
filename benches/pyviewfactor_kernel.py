#!/usr/bin/env python3
"""Time and error of pyviewfactor on a 45-degree fold with 10 x 10 facets per panel.

    pyviewfactor_kernel.py KERNEL.npy OUT.csv      KERNEL.npy from `vkernel --save kernel=KERNEL.npy`

Only view factors are timed: facets exist and code is compiled before. One thread.
"""

import os

os.environ["NUMBA_NUM_THREADS"] = "1"

import statistics
import sys
import time
from importlib.metadata import version

import numpy as np
import pyviewfactor as pvf
import pyvista as pv

ANGLE = np.radians(45)
RUNS = 3


def facet(panel, row, col, n):
    """Corners of a facet, so that both panels show their inner side."""
    away = [0, 1, 0] if panel == 0 else [0, np.cos(ANGLE), np.sin(ANGLE)]
    corners = [np.multiply(away, s) + [x, 0, 0] for x, s in ((col, row), (col + 1, row), (col + 1, row + 1), (col, row + 1))]
    return np.array(corners if panel == 0 else corners[::-1]) / n


def timed(work):
    """Median processor time in ms of several runs after a first one, and the result."""
    work()
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        result = work()
        times.append(1e3 * (time.process_time() - start))
    return statistics.median(times), result


def main(kernel, out):
    exact = np.load(kernel)
    count = len(exact) // 2
    n = round(count**0.5)
    exact = exact[:count, count:]
    facets = [facet(panel, row, col, n) for panel in (0, 1) for row in range(n) for col in range(n)]
    cells = [pv.PolyData(corners, faces=[4, 0, 1, 2, 3]) for corners in facets]
    faces = np.hstack([[4, *range(4 * k, 4 * k + 4)] for k in range(2 * count)])
    sheet = pv.PolyData(np.vstack(facets), faces=faces)

    def pairs():
        return np.array([[pvf.compute_viewfactor(to, of) for to in cells[count:]] for of in cells[:count]])

    def matrix():
        return pvf.compute_viewfactor_matrix(sheet, skip_obstruction=True).T[:count, count:]

    with open(out, "w", encoding="utf-8") as lines:
        print(f"# pyviewfactor {version('pyviewfactor')}, numba {version('numba')}, one thread", file=lines)
        print("setting,kernel_ms,entry_error,row_sum_error", file=lines)
        for name, work in (("a call a pair", pairs), ("matrix", matrix)):
            milliseconds, found = timed(work)
            entry, row_sum = abs(found - exact).max(), abs((found - exact).sum(axis=1)).max()
            print(f"{name},{milliseconds:.4g},{entry:.3e},{row_sum:.3e}", file=lines)


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""Time and error of pyviewfactor, obstruction tests on, beside vkernel on shapes whose facets hide each other.

    pyviewfactor_shapes.py VKERNEL SHAPE.obj... > OUT.csv

The error of an entry is its distance from a kernel of 1000 times smaller tolerance. Of pyviewfactor only view factors are timed, on one
thread and after a first run; of vkernel the whole run, reading and writing included, on one thread.
"""

import os

os.environ["NUMBA_NUM_THREADS"] = "1"

import subprocess
import sys
import tempfile
from importlib.metadata import version

import numpy as np
import pyviewfactor as pvf
import pyvista as pv


def timed(work):
    """The processor's time in ms of a run after a first one, programs that it starts included, and its result."""
    work()
    start = sum(os.times()[:4])
    result = work()
    return 1e3 * (sum(os.times()[:4]) - start), result


def read(path):
    """The facets of an OBJ file of quadrilaterals in their order."""
    rows = [line.split() for line in open(path, encoding="utf-8")]
    vertices = [[float(x) for x in row[1:]] for row in rows if row and row[0] == "v"]
    faces = [[4, *(int(n.split("/")[0]) - 1 for n in row[1:])] for row in rows if row and row[0] == "f"]
    return pv.PolyData(np.array(vertices), faces=np.hstack(faces))


def kernel(vkernel, shape, tolerance):
    with tempfile.NamedTemporaryFile(suffix=".npy") as file:
        command = [vkernel, "-q", "-j", "1", "--shape", shape, "--mesh", "facets", "--tolerance", tolerance, "--save", f"kernel={file.name}"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return np.load(file.name)


def main(vkernel, *shapes):
    print(f"# pyviewfactor {version('pyviewfactor')}, numba {version('numba')}, one thread each; errors against vkernel at a 1000 times smaller tolerance")
    print("shape,facets,method,kernel_ms,entry_error,row_sum_error")
    for shape in shapes:
        mesh, exact = read(shape), kernel(vkernel, shape, "5e-6")
        rows = (
            ("vkernel", lambda: kernel(vkernel, shape, "5e-3")),
            ("pyviewfactor", lambda: pvf.compute_viewfactor_matrix(mesh, skip_visibility=False, skip_obstruction=False).T),
        )
        for name, work in rows:
            milliseconds, found = timed(work)
            entry, row_sum = abs(found - exact).max(), abs((found - exact).sum(axis=1)).max()
            print(f"{os.path.basename(shape)},{len(exact)},{name},{milliseconds:.4g},{entry:.3e},{row_sum:.3e}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])

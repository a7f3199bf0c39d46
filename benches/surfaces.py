"""Shapes for surfaces.sh, and how far off what vkernel makes of them is.

    surfaces.py box N            a closed box of 1 x 0.6 x 1.5, N x N squares a side, as OBJ
    surfaces.py crumpled N       a sheet with eight creases in any direction, 2 N N triangles, as OBJ
    surfaces.py flux SCENE       closed surface of quadrilaterals: light in all bounces, off its sum Φ/(1 − r), Φ the direct light
    surfaces.py against SCENE BETTER     facet irradiances, off those of a better solution
    surfaces.py dense SCENE KERNEL       facet irradiances, off NumPy's dense solver with all pairs

Errors are relative, at reflectance 0.9: of the sum, or root mean square of all facets.
"""
import json
import math
import random
import sys

import numpy as np

REFLECTANCE = 0.9
FOLDS = 8


def obj(vertices, faces):
    lines = [f"v {x} {y} {z}" for x, y, z in vertices]
    return "\n".join(lines + ["f " + " ".join(str(k + 1) for k in face) for face in faces])


def box(n):
    size = (1, 0.6, 1.5)
    vertices, faces = [], []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            first = len(vertices)
            for i in range(n + 1):
                for j in range(n + 1):
                    point = [0, 0, 0]
                    point[axis], point[u], point[v] = side * size[axis], i * size[u] / n, j * size[v] / n
                    vertices.append(point)
            for i in range(n):
                for j in range(n):
                    a, b = first + i * (n + 1) + j, first + (i + 1) * (n + 1) + j
                    faces.append([a, a + 1, b + 1, b] if side else [a, b, b + 1, a + 1])  # inwards
    return obj(vertices, faces)


def crumpled(n):
    random.seed(1)
    folds = [(random.uniform(0, math.pi), random.uniform(-0.5, 0.5), random.uniform(0.1, 0.3)) for _ in range(FOLDS)]
    height = lambda x, y: sum(
        slope * abs((x - 0.5) * math.cos(way) + (y - 0.5) * math.sin(way) - off) for way, off, slope in folds
    )
    vertices = [(i / n, j / n, height(i / n, j / n)) for i in range(n + 1) for j in range(n + 1)]
    corner = lambda i, j: i * (n + 1) + j
    squares = [(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)) for i in range(n) for j in range(n)]
    return obj(vertices, [face for a, b, c, d in squares for face in ((a, b, c), (a, c, d))])


def irradiance(path, reflectance):
    (source,) = json.load(open(path))["response"]["sources"]
    return np.array(source["residues"]) @ (1 / (1 - reflectance * np.array(source["poles"])))


def areas(path):
    """Of quadrilaterals: half the product of the diagonals."""
    geometry = json.load(open(path))["geometry"]
    a, b, c, d = np.moveaxis(np.array(geometry["vertices"])[np.array(geometry["faces"])], 1, 0)
    return np.linalg.norm(np.cross(c - a, d - b), axis=1) / 2


def flux(scene):
    sums = [areas(scene) @ irradiance(scene, r) for r in (REFLECTANCE, 0)]
    return abs(sums[0] * (1 - REFLECTANCE) / sums[1] - 1)


def rms(got, want):
    return math.sqrt(np.mean((got - want) ** 2) / np.mean(want**2))


def against(scene, better):
    return rms(irradiance(scene, REFLECTANCE), irradiance(better, REFLECTANCE))


def dense(scene, kernel):
    kernel = np.load(kernel)
    want = np.linalg.solve(np.eye(len(kernel)) - REFLECTANCE * kernel, irradiance(scene, 0))
    return rms(irradiance(scene, REFLECTANCE), want)


if __name__ == "__main__":
    what, *given = sys.argv[1:]
    if what in ("box", "crumpled"):
        print({"box": box, "crumpled": crumpled}[what](int(given[0])))
    else:
        print(f"{({'flux': flux, 'against': against, 'dense': dense}[what])(*given):.1e}")

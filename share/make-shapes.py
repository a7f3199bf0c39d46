#!/usr/bin/env python3
"""Writes `sheet-shapes.npy` and `sheet-shapes.txt`: how measured papers, felts, card, cloth and flat paints reflect over the directions.

    OMP_NUM_THREADS=1 python3 share/make-shapes.py FOLDER    FOLDER has weights.npz and brdf.py of the Neural-BRDF fits

Of each material, f = rho (1 - kappa rho) B + kappa rho^2 / pi + S: rho the 45:0 reflectance of a channel, B the body common to the channels
(pi B = 1 at 45:0), S a colourless surface (0 there), both by least squares over the three channels with weights between relative and absolute
ones and a little ridge on S; kappa how much light that is scattered often levels the body, what leaves least of all felts, or of all others.
Values are averages over both senses of the light, which the fits do not quite keep. Array: material, node of the angle of incidence, of exit
(not beyond that of incidence), of the azimuth between them, (B, S), as 16-bit floats, 1/sr; the grid is that of `src/sheet/table.rs`. Lines
of names: material, kappa.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, sys.argv[1])
from brdf import Material, direction  # noqa: E402

SHARE = Path(__file__).parent
NAMES = (
    "acrylic_felt_green acrylic_felt_orange acrylic_felt_white acrylic_felt_yellow cardboard cm_toxic_green cm_white colodur_azure_4e "
    "colodur_connemara_4c colodur_kalahari_2a colodur_napoli_4f ilm_l3_37_matte ilm_solo_millennium_falcon leaf_maple notebook paper_blue "
    "paper_white paper_yellow"
).split()
ANGLES, AZIMUTHS, STEEPEST_DEG = 20, 16, 86
RIDGE = 0.02
KAPPAS = np.arange(21) / 20


def material(name):
    try:
        return Material(f"{name}_rgb")
    except KeyError:
        return Material(name)


def angles_deg():
    """theta = 86 (1 - (1 - x)^1.5), x even from 0 to 1: narrow towards grazing angles, beyond which the fits mean nothing."""
    return STEEPEST_DEG * (1 - (1 - np.linspace(0, 1, ANGLES)) ** 1.5)


def azimuths_deg():
    """phi = 180 (1 - (1 - x)^1.5): narrow towards the mirror direction."""
    return 180 * (1 - (1 - np.linspace(0, 1, AZIMUTHS)) ** 1.5)


def mean_of_senses(m, theta_in, theta_out, phi):
    """f, mean over both senses and both azimuths, by direction and channel, and rho."""
    pairs = [(a, b, sign) for a, b in ((theta_in, theta_out), (theta_out, theta_in)) for sign in (1, -1)]
    f = sum(m(direction(a), direction(b, sign * phi)) for a, b, sign in pairs) / len(pairs)
    return f, np.pi * m(direction(45.0), direction(0.01))[0]


def decompose(f, rho, kappa):
    """B and S, and what they leave relative to f or, where that is larger, to f at 45:0."""
    weight = 1 / (rho + 0.02)
    level = kappa * rho**2 / np.pi
    r, rest = rho * (1 - kappa * rho), f - level
    rr, r1, s1 = (weight * r * r).sum(), (weight * r).sum(), weight.sum() + RIDGE * weight.max()
    b1, b2 = (rest * (weight * r)).sum(-1), (rest * weight).sum(-1)
    det = rr * s1 - r1 * r1
    body, surface = (b1 * s1 - b2 * r1) / det, (rr * b2 - r1 * b1) / det
    left = (np.outer(body, r) + surface[:, None] - rest) / np.maximum(f, rho / np.pi)
    return np.stack([body, surface], -1), left


def levelling(materials, shares):
    """The kappa that leaves least of these materials, with these shares of the directions."""
    left = [sum(np.average((decompose(*one, kappa)[1] ** 2).mean(-1), weights=shares) for one in materials) for kappa in KAPPAS]
    return KAPPAS[np.argmin(left)]


def main():
    i, o = np.tril_indices(ANGLES)
    theta, phi = np.maximum(angles_deg(), 0.01), azimuths_deg()
    grid = [np.repeat(theta[i], AZIMUTHS), np.repeat(theta[o], AZIMUTHS), np.tile(phi, len(i))]
    # as under light from everywhere
    shares = np.prod([np.sin(np.radians(2 * angle)) for angle in grid[:2]], 0)
    materials = {name: mean_of_senses(material(name), *grid) for name in NAMES}
    felts = [name for name in NAMES if "felt" in name]
    kappas = {}
    for kind in (felts, [name for name in NAMES if name not in felts]):
        kappas |= dict.fromkeys(kind, levelling([materials[name] for name in kind], shares))
    tables = np.array([decompose(*one, kappas[name])[0] for name, one in materials.items()])
    tables = tables.reshape(len(NAMES), len(i), AZIMUTHS, 2)
    np.save(SHARE / "sheet-shapes.npy", tables.astype("<f2"))
    (SHARE / "sheet-shapes.txt").write_text("".join(f"{name} {kappas[name]:g}\n" for name in NAMES))


main()

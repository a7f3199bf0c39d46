#!/usr/bin/env python3
"""Writes sets of spectra that the Python package luxpy has, as CSV files, and prints their names.

    unseen.py SITE_PACKAGES FOLDER [NAME...]

210 measured samples of CRI2012 (K. Smet and others, 2013), the 215 test colours of J. J. Opstelten (1983), and twice 300 drawn of the 2696
that differ of the IES's 4880 (TM-30-15): some that choices may be made with, and others to judge. From 400 to 700 nm by 5. luxpy is under
the GPL: its data are measured with, not shipped.
"""

import sys
from pathlib import Path

import numpy as np

NM = np.arange(400.0, 701.0, 5.0)


def write(path, nm, spectra):
    rows = np.column_stack([NM, *(np.interp(NM, nm, spectrum) for spectrum in spectra)])
    names = ",".join(["nm", *(f"x{n}" for n in range(len(spectra)))])
    np.savetxt(path, rows, "%.6g", delimiter=",", header=names, comments="")
    print(path)


def main(packages, folder, *wanted):
    data, folder = Path(packages) / "luxpy/data/rfls", Path(folder)
    sets = {}
    for name, table in (("cri2012", "CRI2012_R210.dat"), ("opstelten", "Opstelten1983_215.dat")):
        nm, *spectra = np.loadtxt(data / table, delimiter=",").T
        sets[name] = (nm, spectra)
    nm, *spectra = np.load(data / "IESTM30_15_R4880.npz")["_IESTM30_R4880"]
    differing = np.loadtxt(data / "IESTM30-R4880-subset-with-unique-rfls--2696.dat").astype(int)
    drawn = np.random.default_rng(3).permutation(differing)
    for name, some in (("tm30", drawn[:300]), ("tm30_kept", drawn[500:800])):
        sets[name] = (nm, [spectra[n] for n in some])
    for name in wanted or sets:
        write(folder / f"{name}.csv", *sets[name])


if __name__ == "__main__":
    main(*sys.argv[1:])

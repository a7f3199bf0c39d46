"""Estimated spectra as a table: one row per photograph, one column per wavelength. python3 table.py FILE... > spectra.csv"""

import csv
import json
import sys


def estimates(paths):
    """Name and estimate of every sample that has one."""
    for path in paths:
        with open(path) as lines:
            for record in map(json.loads, lines):
                if "estimate" in record:
                    yield record["id"], record["estimate"]


def write(paths, file):
    table = csv.writer(file, lineterminator="\n")
    for number, (name, estimate) in enumerate(estimates(paths)):
        if number == 0:
            table.writerow(["photograph"] + [f"{nm:g} nm" for nm in estimate["wavelengths_nm"]])
        table.writerow([name] + [f"{r:.5f}" for r in estimate["reflectance"]])


if "snakemake" in globals():
    with open(snakemake.output[0], "w") as file:
        write(snakemake.input, file)
else:
    write(sys.argv[1:], sys.stdout)

#!/usr/bin/env python3
"""Reads what the tools write: records from the stream, arrays from NPY; judges and plots them with colour-science.

    vkernel | vforward --reflectance cc24 --noise-sd 1e-3 |
        vestimate --save estimate.reflectance=spectra.npy -o estimates.ndjson
    examples/python/read_stream.py estimates.ndjson spectra.npy spectra.png

Needs NumPy, colour-science and matplotlib.
"""

import json
import sys
import warnings

import numpy as np

warnings.filterwarnings("ignore")  # colour-science speaks of optional packages
import matplotlib  # before colour-science, which puts a stand-in where it is missing
import colour

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def read(path):
    """Scenes by id, and samples without an error, of a stream: a JSON record a line."""
    with open(path) as stream:
        records = [json.loads(line) for line in stream]
    scenes = {record["id"]: record for record in records if record["kind"] == "scene"}
    samples = [record for record in records if record["kind"] == "sample" and "error" not in record]
    return scenes, samples


def spectrum(record, name):
    """An estimate or truth as a spectral distribution."""
    return colour.SpectralDistribution(record["reflectance"], record["wavelengths_nm"], name=name)


def lab(reflectance):
    """CIELAB under D65 for the 10 degree observer, over the wavelengths of the spectrum, as vscore has it."""
    d65, observer = [
        spectra.copy().align(reflectance.shape)
        for spectra in (colour.SDS_ILLUMINANTS["D65"], colour.MSDS_CMFS["CIE 1964 10 Degree Standard Observer"])
    ]
    light = d65.values[:, np.newaxis] * observer.values
    xyz, white = [
        np.trapezoid(values[:, np.newaxis] * light, reflectance.wavelengths, axis=0)
        for values in (reflectance.values, np.ones_like(reflectance.values))
    ]
    return colour.XYZ_to_Lab(xyz / white[1], colour.XYZ_to_xy(white))


def main(stream, array, picture):
    scenes, samples = read(stream)
    spectra = np.load(array)
    figure, axes = plt.subplots(figsize=(8, 5))
    for sample, row in zip(samples, spectra, strict=True):
        estimate, truth = spectrum(sample["estimate"], sample["id"]), spectrum(sample["truth"], sample["id"])
        assert np.array_equal(estimate.values, row), "the NPY array holds what the stream holds"
        rmse = np.sqrt(np.mean((estimate.values - truth.values) ** 2))
        difference = colour.delta_E(lab(estimate), lab(truth), method="CIE 2000")
        angle = scenes[sample["scene"]]["geometry"]["angle_deg"]
        print(f"{sample['id']:<28} {angle:5.1f} {rmse:8.4f} {difference:8.3f}")
        (line,) = axes.plot(estimate.wavelengths, estimate.values)
        sd = np.array(sample["estimate"]["reflectance_sd"])
        axes.fill_between(
            estimate.wavelengths, row - 2 * sd, row + 2 * sd, color=line.get_color(), alpha=0.2, linewidth=0
        )
    axes.set(xlabel="wavelength, nm", ylabel="reflectance")
    figure.savefig(picture, dpi=150, bbox_inches="tight")


if __name__ == "__main__":
    main(*sys.argv[1:])

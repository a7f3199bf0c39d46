#!/usr/bin/env python3
"""A notebook: from a photograph to a spectrum and its colour, then many spectra at once.

    examples/python/measure.py [FOLDER]

writes spectrum.png and patches.png into the folder, by default this one. Editors that know `# %%` run it cell by
cell; Jupytext makes an .ipynb of it. Needs the five tools on PATH, NumPy, colour-science and matplotlib.
"""

# %% The module is one file; share/install puts it into share/vfold/python of its prefix
import subprocess
import sys
import warnings
from pathlib import Path

project = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(project / "share/python"))
folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")

warnings.filterwarnings("ignore")  # colour-science speaks of optional packages
import matplotlib  # before colour-science, which puts a stand-in where it is missing

matplotlib.use("Agg")
import colour
import matplotlib.pyplot as plt
import numpy as np
import vfold

# %% A photograph that comes with vfold, of a magenta sheet; nothing in it says the camera or the light
photograph = project / "tests/data/photos/a_ideal_magenta_50.exr"
try:
    vfold.measure(photograph)
except vfold.Error as error:
    print(f"refused: {error}")

sheet = vfold.measure(photograph, camera="canon-5d-mark-ii", illuminant="D65")
print(f"{sheet.verdict}: {sheet.because}")
confidence, angle_deg = sheet.record["image"]["detection_confidence"], sheet.scene["geometry"]["angle_deg"]
print(f"corners found, {confidence:.1%} sure; angle {angle_deg:.1f} degrees")


# %% Its colour: CIELAB under D65 for the 10 degree observer, over the spectrum's own wavelengths, as vscore has it
def lab(reflectance):
    tables = colour.SDS_ILLUMINANTS["D65"], colour.MSDS_CMFS["CIE 1964 10 Degree Standard Observer"]
    d65, observer = [table.copy().align(reflectance.shape) for table in tables]
    light = d65.values[:, np.newaxis] * observer.values
    xyz, white = [
        np.trapezoid(values[:, np.newaxis] * light, reflectance.wavelengths, axis=0)
        for values in (reflectance.values, np.ones_like(reflectance.values))
    ]
    return colour.XYZ_to_Lab(xyz / white[1], colour.XYZ_to_xy(white))


print("CIELAB", np.round(lab(sheet.spectral_distribution()), 1))


# %% Its spectrum with two standard deviations to either side
def plot(axes, sheet):
    (line,) = axes.plot(sheet.wavelengths_nm, sheet.reflectance, label=sheet.name)
    low, high = sheet.reflectance - 2 * sheet.reflectance_sd, sheet.reflectance + 2 * sheet.reflectance_sd
    axes.fill_between(sheet.wavelengths_nm, low, high, color=line.get_color(), alpha=0.2, linewidth=0)
    axes.set(xlabel="wavelength, nm", ylabel="reflectance", ylim=(0, 1))


figure, axes = plt.subplots(figsize=(8, 5))
plot(axes, sheet)
figure.savefig(folder / "spectrum.png", dpi=120, bbox_inches="tight")

# %% Many at once: the tools as in a shell, then their records and arrays. Here 24 simulated sheets of known spectra
pipeline = """
vkernel | vforward --reflectance cc24 --noise-sd 1e-3 |
    vestimate --save estimate.reflectance=patches.npy -o patches.ndjson
"""
subprocess.run(pipeline, shell=True, check=True, cwd=folder)
stream = vfold.read_stream(folder / "patches.ndjson")
array = vfold.read_npy(folder / "patches.npy")
print(f"{len(stream.sheets)} sheets, {len(stream.failures)} failures, an array of {array.shape}")

figure, axes = plt.subplots(figsize=(8, 5))
for patch, row in zip(stream.sheets, array, strict=True):
    assert np.array_equal(patch.reflectance, row), "the NPY array holds what the stream holds"
    truth = vfold.Spectrum(patch.name, patch.wavelengths_nm, patch.truth)
    rmse = np.sqrt(np.mean((patch.reflectance - truth.reflectance) ** 2))
    seen = [lab(spectrum.spectral_distribution()) for spectrum in (patch, truth)]
    difference = colour.delta_E(*seen, method="CIE 2000")
    print(f"{patch.name:<28} {rmse:8.4f} {difference:8.3f}")
    plot(axes, patch)
figure.savefig(folder / "patches.png", dpi=120, bbox_inches="tight")

#!/usr/bin/env python3
"""Writes the CSV tables of this folder from the Python package colour-science 0.4.7.

    python3 -m venv venv && venv/bin/pip install colour-science==0.4.7 numpy
    venv/bin/python share/make.py

The numbers are the package's own: nothing is smoothed, scaled or resampled; values keep ten digits, and the
illuminants are cut to 380..780 nm. The Munsell chips come from a Rust crate instead: `cargo run --release --example make-munsell`.
"""

from pathlib import Path

import colour

SHARE = Path(__file__).parent
PATCHES = (
    "dark-skin light-skin blue-sky foliage blue-flower bluish-green orange purplish-blue moderate-red purple "
    "yellow-green orange-yellow blue green red yellow magenta cyan white neutral-8 neutral-6-5 neutral-5 "
    "neutral-3-5 black"
).split()
ILLUMINANTS = (
    ["A", "D50", "D55", "D60", "D65", "D75", "E"]
    + [f"FL{n}" for n in range(1, 13)]
    + [f"FL3.{n}" for n in range(1, 16)]
    + ["LED-B1", "LED-B2", "LED-B3", "LED-B4", "LED-B5", "LED-BH1", "LED-RGB1", "LED-V1", "LED-V2"]
)


def write(name, wavelengths_nm, columns):
    """Writes one table; `columns` maps a name to a function of the wavelength in nm."""
    lines = [",".join(["wavelength", *columns])]
    for nm in wavelengths_nm:
        lines.append(",".join([f"{nm:g}", *(f"{column(nm):.10g}" for column in columns.values())]))
    (SHARE / name).write_text("\n".join(lines) + "\n")


def colour_checker(name, key):
    patches = list(colour.SDS_COLOURCHECKERS[key].values())
    for short, patch in zip(PATCHES, patches, strict=True):
        long = patch.name.lower().replace(" ", "-").replace(".", "-")
        assert long.startswith(short), f"{key}: patch {patch.name} is not {short}"
    columns = {short: patch.__getitem__ for short, patch in zip(PATCHES, patches)}
    write(name, patches[0].wavelengths, columns)


def illuminants():
    tables = {name: colour.SDS_ILLUMINANTS[name].__getitem__ for name in ILLUMINANTS}
    display = colour.MSDS_DISPLAY_PRIMARIES["Apple Studio Display"]
    # Its own numbers: what it interpolates is off by 1e-18 and below zero.
    rows = dict(zip(display.wavelengths, display.values, strict=True))
    tables |= {f"LCD-{primary}": (lambda nm, k=k: rows[nm][k]) for k, primary in enumerate("RGB")}
    write("illuminants.csv", range(380, 781, 5), tables)
    basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    write("daylight.csv", basis["S0"].wavelengths, {name: basis[name].__getitem__ for name in ("S0", "S1", "S2")})


def camera(name, curves):
    channels = {channel: (lambda nm, k=k: curves[nm][k]) for k, channel in enumerate("RGB")}
    write(name, curves.wavelengths, channels)


def canon_5d_mark_ii():
    package = Path(colour.__file__).parent
    table = package / "characterisation/datasets/rawtoaces/CANON_EOS_5DMark_II_RGB_Sensitivities.csv"
    return colour.characterisation.RGB_CameraSensitivities(colour.read_sds_from_csv_file(table))


assert colour.__version__ == "0.4.7", "the tables are those of colour-science 0.4.7"
colour_checker("cc24.csv", "ColorChecker N Ohta")
colour_checker("cc24-babelcolor.csv", "BabelColor Average")
illuminants()
camera("nikon-d5100.csv", colour.MSDS_CAMERA_SENSITIVITIES["Nikon 5100 (NPL)"])
camera("sigma-sd-merrill.csv", colour.MSDS_CAMERA_SENSITIVITIES["Sigma SDMerill (NPL)"])
camera("canon-5d-mark-ii.csv", canon_5d_mark_ii())

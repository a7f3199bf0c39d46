#!/usr/bin/env python3
"""Writes `clear-sky.csv`: the sun above the atmosphere and what the air absorbs, from the Python package pvlib 0.16.1.

    python3 -m venv venv && venv/bin/pip install pvlib==0.16.1
    venv/bin/python share/make-clear-sky.py

Table 2-1 of R. Bird, C. Riordan, SERI/TR-215-2436 (1984), as far as cameras and CIE tables see, 300 to 840 nm: irradiance at the mean distance
of the sun, W/(m² nm), and coefficients of absorption of water vapour, 1/cm, ozone, 1/(atm cm), and mixed gases.
"""

from pathlib import Path

import pvlib
from pvlib.spectrum.spectrl2 import _SPECTRL2_COEFFS as TABLE

assert pvlib.__version__ == "0.16.1", "the table is that of pvlib 0.16.1"
COLUMNS = ["spectral_irradiance_et", "water_vapor_absorption", "ozone_absorption", "mixed_absorption"]
lines = ["wavelength,sun,water,ozone,mixed"]
for row in TABLE[TABLE["wavelength"] <= 840]:
    lines.append(",".join(f"{row[column]:g}" for column in ["wavelength", *COLUMNS]))
(Path(__file__).parent / "clear-sky.csv").write_text("\n".join(lines) + "\n")

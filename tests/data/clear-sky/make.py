#!/usr/bin/env python3
"""Writes `spectrl2.json` and `sun.json`: clear skies and places of the sun as pvlib 0.16.1 has them.

    python3 -m venv venv && venv/bin/pip install pvlib==0.16.1
    venv/bin/python tests/data/clear-sky/make.py

Twenty skies: direct normal and diffuse horizontal irradiance, W/(m² nm), at 300 to 840 nm, over zenith angle, day, pressure, turbidity, water,
ozone and albedo. Twelve places of the sun: apparent zenith angle in degrees, by `solarposition.spa_python`.
"""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pvlib

HERE = Path(__file__).parent
assert pvlib.__version__ == "0.16.1"

random = np.random.default_rng(1986)
skies = []
for k in range(20):
    sky = {
        # the first is the usual sky, the others spread over what there is
        "zenith_deg": 40.0 if k == 0 else round(float(random.uniform(0, 85)), 2),
        "day_of_year": int(random.integers(1, 366)),
        "pressure_pa": 101300.0 if k == 0 else round(float(random.uniform(65e3, 103e3))),
        "turbidity": 0.1 if k == 0 else round(float(random.uniform(0.02, 0.5)), 3),
        "water_cm": 1.42 if k == 0 else round(float(random.uniform(0.2, 5)), 2),
        "ozone_atm_cm": 0.344 if k == 0 else round(float(random.uniform(0.2, 0.45)), 3),
        "ground_albedo": 0.2 if k == 0 else round(float(random.uniform(0, 0.8)), 2),
    }
    zenith = sky["zenith_deg"]
    air_mass = pvlib.atmosphere.get_relative_airmass(zenith, model="kastenyoung1989")
    spectra = pvlib.spectrum.spectrl2(
        apparent_zenith=zenith,
        aoi=zenith,
        surface_tilt=0,
        ground_albedo=sky["ground_albedo"],
        surface_pressure=sky["pressure_pa"],
        relative_airmass=air_mass,
        precipitable_water=sky["water_cm"],
        ozone=sky["ozone_atm_cm"],
        aerosol_turbidity_500nm=sky["turbidity"],
        dayofyear=sky["day_of_year"],
    )
    visible = spectra["wavelength"] <= 840
    for name in "dni", "dhi":
        sky[name] = [float(f"{value:.7g}") for value in spectra[name][visible, 0]]
    skies.append(sky)
(HERE / "spectrl2.json").write_text("[\n" + ",\n".join(json.dumps(sky) for sky in skies) + "\n]\n")

places = [
    (48.14, 11.58, "2026-06-21T12:00:00+02:00"),
    (48.14, 11.58, "2026-12-21T12:00:00+01:00"),
    (-33.87, 151.21, "2025-01-15T09:30:00+11:00"),
    (0.0, 0.0, "2024-03-20T12:00:00Z"),
    (71.17, 25.78, "2024-06-30T23:59:59+02:00"),
    (64.15, -21.94, "2027-09-01T18:00:00Z"),
    (40.71, -74.01, "2026-11-22T15:45:00-05:00"),
    (35.68, 139.69, "2026-02-28T08:00:00+09:00"),
    (28.61, 77.21, "2024-02-29T13:15:00+05:30"),
    (-54.8, -68.3, "2026-06-21T12:00:00-03:00"),
    (19.43, -99.13, "2000-01-01T12:00:00-06:00"),
    (90.0, 0.0, "2026-06-21T00:00:00Z"),
]
suns = []
for latitude, longitude, time in places:
    place = pvlib.solarposition.spa_python(pd.DatetimeIndex([time]), latitude, longitude)
    zenith = float(f"{place['apparent_zenith'].iloc[0]:.7g}")
    suns.append({"latitude_deg": latitude, "longitude_deg": longitude, "time": time, "zenith_deg": zenith})
(HERE / "sun.json").write_text("[\n" + ",\n".join(json.dumps(sun) for sun in suns) + "\n]\n")

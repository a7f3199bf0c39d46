#!/usr/bin/env python3
"""Writes `cameras.npy` and `cameras.txt`: the cameras of rawtoaces-data, measured by others.

    git clone https://github.com/AcademySoftwareFoundation/rawtoaces-data
    python3 share/make-cameras.py rawtoaces-data        needs NumPy; written from commit e9b8503 (release 1.1.0)

Array: camera, channel (R, G, B), wavelength 380..780 nm by 5, in units of 1/50000 of the file's own numbers, whose peak is 1. Text: a line a
camera, tabs between maker, model, who measured it and when, other names of the model, and models with the same sensor.
"""

import json
import sys
from pathlib import Path

import numpy as np

SHARE = Path(__file__).parent
WAVELENGTHS_NM = range(380, 781, 5)
UNIT = 50_000


def curves(spectral_data):
    assert spectral_data["index"]["main"] == ["R", "G", "B"]
    rows = spectral_data["data"]["main"]
    assert sorted(map(int, rows)) == list(WAVELENGTHS_NM)
    table = np.array([rows[str(nm)] for nm in WAVELENGTHS_NM]).T
    assert table.shape == (3, 81) and table.min() >= 0 and abs(table.max() - 1) < 1e-9
    return np.rint(UNIT * table).astype("<u2")


def aliases(of_maker, model):
    """Other names of a model, and models with its sensor."""
    called = [(name, alias["comments"]) for name, alias in of_maker.items() if alias["model"] == model]
    for _, comments in called:
        assert comments.endswith(("same model, alternative name", "same sensor")), comments
    return [";".join(name for name, comments in called if comments.endswith(kind)) for kind in ("name", "sensor")]


folder = Path(sys.argv[1]) / "data"
by_maker = json.loads((folder / "aliases.json").read_text())["data"]["camera"]["model"]
cameras = []
for file in (folder / "camera").glob("*.json"):
    content = json.loads(file.read_text())
    header = content["header"]
    assert header["license"] == "Apache-2.0", file
    maker, model = header["manufacturer"], header["model"]
    measured = f"{header.get('laboratory') or header['document_creator']} {header['document_creation_date'][:4]}"
    line = "\t".join([maker, model, measured, *aliases(by_maker.get(maker, {}), model)])
    cameras.append((maker.lower(), model.lower(), line, curves(content["spectral_data"])))
cameras.sort(key=lambda camera: camera[:2])
np.save(SHARE / "cameras.npy", np.array([camera[3] for camera in cameras]))
(SHARE / "cameras.txt").write_text("\n".join(camera[2] for camera in cameras) + "\n")

#!/usr/bin/env python3
"""Writes `camera-matrices.csv`: published colour matrices of cameras of `cameras.txt`.

    cargo vendor /tmp/vendor && python3 share/make-camera-matrices.py /tmp/vendor/rawler        written from rawler 0.7.2

Rows of a matrix from XYZ to the camera's R, G and B under D65, as the tag ColorMatrix of DNG has it, whose numbers are Adobe's; through the cameras
that the crate rawler knows. Cameras that it does not know are left out.
"""

import re
import sys
import tomllib
from pathlib import Path

SHARE = Path(__file__).parent


def plain(model):
    return re.sub("[^a-z0-9]", "", model.lower())


def name(maker, model):
    return "-".join(re.findall("[a-z0-9]+", f"{maker} {model}".lower()))


matrices = {}
for file in sorted((Path(sys.argv[1]) / "data/cameras").rglob("*.toml")):
    said = tomllib.loads(file.read_text().replace("[cameras.color_matrix]", "[color_matrix]"))
    if "D65" in said.get("color_matrix", {}):
        matrices[plain(said.get("clean_model", said["model"]))] = said["color_matrix"]["D65"]

lines = ["camera,rx,ry,rz,gx,gy,gz,bx,by,bz"]
for line in (SHARE / "cameras.txt").read_text().splitlines():
    maker, model, _, aliases, _ = line.split("\t")
    known = [matrices[plain(one)] for one in [model, *aliases.split(";")] if plain(one) in matrices]
    if known:
        lines.append(",".join([name(maker, model), *map(str, known[0][:9])]))
(SHARE / "camera-matrices.csv").write_text("\n".join(lines) + "\n")

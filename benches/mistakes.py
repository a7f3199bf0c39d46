#!/usr/bin/env python3
"""What becomes of mistakes: simulated photographs in which one thing is wrong, and what vestimate answers, as rows of a table.

    mistakes.py TOOLS [--records FOLDER] [GROUP...]     TOOLS: folder of the tools; FOLDER: for a JSON file per answer

Every mistake is made with eight matte sheets of the ColorChecker, 180 x 135 px with the noise of 20000 electrons at 1; mistakes of a group
share what is wrong and differ in how much. An answer is

    right      good, off by at most 0.03 (root mean square)
    held       good, 85 per cent of the true values within two standard deviations
    doubtful   doubtful
    wrong      wrong
    refused    no spectrum, and a line with the reason
    lie        good, and none of the above
"""

import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from pathlib import Path

import numpy as np
import photographs

WIDTH, HEIGHT = 180, 135
EXPOSURE = 0.85
ANGLE_DEG = 45
CAMERA, LIGHT = "canon-5d-mark-ii", "sun:40deg"
ELECTRONS, READ_SD = 20000, 5e-4
# The verdict's bounds were looked at with magenta, neutral-8, moderate-red, orange, light-skin, yellow, blue-flower and foliage in view: these
# are others.
SHEETS = ["dark-skin", "blue-sky", "bluish-green", "orange-yellow", "purplish-blue", "yellow-green", "red", "neutral-6-5"]
RIGHT, HELD = 0.03, 0.85
ANSWERS = ["right", "held", "doubtful", "wrong", "refused", "lie"]


class Refused(Exception):
    """A tool that ends with an error."""


class Tools(photographs.Tools):
    """The tools, that may refuse."""

    def run(self, tool, *arguments, given=""):
        try:
            return super().run(tool, *arguments, given=given)[0]
        except subprocess.CalledProcessError as ended:
            if ended.returncode == 3:
                return ended.stdout
            raise Refused(ended.stderr.strip().splitlines()[-1]) from None

    @cache
    def scene(self, *fold):
        return self.run("vkernel", "-q", *fold)

    @cache
    def render(self, sheet, fold=(), light=(LIGHT,), flags=()):
        """Light without noise, by row, column and channel, and the true corners of the panels."""
        with tempfile.TemporaryDirectory() as work:
            picture = Path(work) / "sheet.tif"
            reflectance = ["--reflectance", f"cc24:{sheet}"] if sheet else []
            lights = ["--illuminant", *light[:1], *(["--sky-illuminant", light[1]] if light[1:] else [])]
            told = self.run(
                "vforward", "-q", *reflectance, "--camera", CAMERA, *lights, "--exposure", EXPOSURE, *flags,
                "--render", picture, "--render-size", f"{WIDTH}x{HEIGHT}",
                given=self.scene("--angle-deg", ANGLE_DEG, *fold) if "--angle-deg" not in fold else self.scene(*fold),
            )
            regions = json.loads(told.splitlines()[-1])["regions"]
            return read_tiff(picture), {panel: np.array(regions[panel]) for panel in ("panel0", "panel1")}

    @cache
    def truth(self, sheet):
        told = self.run("vforward", "-q", "--reflectance", f"cc24:{sheet}", given=self.scene("--angle-deg", ANGLE_DEG))
        return np.array(json.loads(told.splitlines()[-1])["truth"]["reflectance"])


def read_tiff(path):
    """A 16-bit TIFF in strips without compression, white being 1."""
    data = path.read_bytes()
    end = "<" if data[:2] == b"II" else ">"
    (at,) = struct.unpack_from(end + "I", data, 4)
    (count,) = struct.unpack_from(end + "H", data, at)
    tags = {}
    for n in range(count):
        tag, kind, length, _ = struct.unpack_from(end + "HHII", data, at + 2 + 12 * n)
        letter, size = {3: ("H", 2), 4: ("I", 4)}.get(kind, ("B", 1))
        place = at + 10 + 12 * n if length * size <= 4 else struct.unpack_from(end + "I", data, at + 10 + 12 * n)[0]
        tags[tag] = struct.unpack_from(f"{end}{length}{letter}", data, place)
    assert tags.get(259, (1,)) == (1,), "compressed"
    strips = b"".join(data[at : at + length] for at, length in zip(tags[273], tags[279], strict=True))
    return np.frombuffer(strips, end + "u2").reshape(tags[257][0], tags[256][0], 3) / 65535.0


def write_tiff(path, stored, model=None):
    """Integers of 8 or 16 bits or floats of 32 as TIFF."""
    height, width, channels = stored.shape
    bits, form = 8 * stored.itemsize, 3 if stored.dtype.kind == "f" else 1
    pixels = stored.astype(stored.dtype.newbyteorder("<")).tobytes()
    words = [(271, model.split()[0]), (272, model)] if model else []
    texts = b"".join(text.encode() + b"\0" for _, text in words)
    samples_at = 8 + len(pixels)
    text_at = samples_at + 12
    directory_at = text_at + len(texts) + (len(texts) & 1)
    tags = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 3, samples_at), (259, 3, 1, 1), (262, 3, 1, 2)]
    for tag, text in words:
        tags.append((tag, 2, len(text) + 1, text_at))
        text_at += len(text) + 1
    tags += [(273, 4, 1, 8), (277, 3, 1, channels), (278, 4, 1, height), (279, 4, 1, len(pixels)), (339, 3, 3, samples_at + 6)]
    out = b"II*\0" + struct.pack("<I", directory_at) + pixels + struct.pack("<6H", *[bits] * 3, *[form] * 3)
    out = (out + texts).ljust(directory_at, b"\0") + struct.pack("<H", len(tags))
    out += b"".join(struct.pack("<HHI", *tag[:3]) + struct.pack("<I", tag[3]) for tag in sorted(tags)) + bytes(4)
    path.write_bytes(out)


def write_png(path, stored):
    """Integers of 8 bits as PNG that says nothing of itself."""
    height, width, _ = stored.shape
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + row.tobytes() for row in stored)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


# ---- pictures ----


def homography(corners):
    """From a panel (0 to 1 along the crease, 0 to 1 from the crease outwards) to the picture."""
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    rows, values = [], []
    for (u, v), (x, y) in zip(square, corners, strict=True):
        rows += [[u, v, 1, 0, 0, 0, -u * x, -v * x], [0, 0, 0, u, v, 1, -u * y, -v * y]]
        values += [x, y]
    return np.append(np.linalg.solve(rows, values), 1).reshape(3, 3)


def at(corners, u, v):
    x, y, w = homography(corners) @ [u, v, 1]
    return np.array([x / w, y / w])


def part(corners, along, out):
    """The part of both panels from along[0] to along[1] and out[0] to out[1]."""
    of = lambda panel: np.array([at(panel, along[0], out[0]), at(panel, along[1], out[0]), at(panel, along[1], out[1]), at(panel, along[0], out[1])])
    return {panel: of(four) for panel, four in corners.items()}


def places(corners):
    """For every pixel its place on the panel: along, outwards."""
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    u, v, w = np.linalg.inv(homography(corners)) @ np.stack([x.ravel(), y.ravel(), np.ones(x.size)])
    return (u / w).reshape(x.shape), (v / w).reshape(x.shape)


def inside(corners):
    u, v = places(corners)
    return (u >= 0) & (u <= 1) & (v >= 0) & (v <= 1)


def on_panels(corners):
    return inside(corners["panel0"]) | inside(corners["panel1"])


def from_centre():
    x, y = np.meshgrid((np.arange(WIDTH) + 0.5) / WIDTH - 0.5, (np.arange(HEIGHT) + 0.5) / HEIGHT - 0.5)
    return x, y, (x * x + y * y) / 0.5


def vignetted(light, loss):
    return light * (1 - loss * from_centre()[2])[..., None]


def blurred(light, sigma):
    size = int(4 * sigma) + 1
    kernel = np.exp(-0.5 * (np.arange(-size, size + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        pad = [(size, size) if n == axis else (0, 0) for n in range(3)]
        light = np.apply_along_axis(np.convolve, axis, np.pad(light, pad, "edge"), kernel, "valid")
    return light


def distorted(light, k1):
    """As a lens of this first coefficient draws it, nearest pixel."""
    x, y, r2 = from_centre()
    factor = 1 + k1 * r2
    column = np.clip(((x * factor + 0.5) * WIDTH).astype(int), 0, WIDTH - 1)
    row = np.clip(((y * factor + 0.5) * HEIGHT).astype(int), 0, HEIGHT - 1)
    return light[row, column]


def srgb(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


MATRIX = np.array([[1.7, -0.6, -0.1], [-0.15, 1.65, -0.5], [0.05, -0.55, 1.5]])


class Shot:
    """One photograph and all that is stated of it."""

    def __init__(self, tools, sheet, draw):
        self.tools, self.sheet, self.draw = tools, sheet, draw
        self.light, self.corners = tools.render(sheet)
        self.stated_fold = ["--angle-deg", ANGLE_DEG]
        self.extract, self.estimate = ["--camera", CAMERA, "--illuminant", LIGHT], []
        self.clip, self.develop, self.store, self.model = 1.0, None, "tif16", None

    def rendered(self, fold=(), light=(LIGHT,), flags=(), sheet="same"):
        self.light, self.corners = self.tools.render(self.sheet if sheet == "same" else sheet, tuple(fold), tuple(light), tuple(flags))

    def write(self, work):
        light = np.maximum(self.light, 0)
        noise = self.draw.normal(size=light.shape) * np.sqrt(light / ELECTRONS + READ_SD**2)
        light = np.clip(light + noise, -0.01, self.clip)
        if self.develop:
            light = self.develop(light)
        if self.store == "float":
            path = work / "photo.tif"
            write_tiff(path, light.astype(np.float32))
        elif self.store == "png8":
            path = work / "photo.png"
            write_png(path, np.rint(255 * np.clip(light, 0, 1)).astype(np.uint8))
        elif self.store == "jpeg":
            path = work / "photo.jpg"
            write_png(work / "photo.png", np.rint(255 * np.clip(light, 0, 1)).astype(np.uint8))
            subprocess.run(["oiiotool", work / "photo.png", "--compression", "jpeg:90", "-o", path], check=True, capture_output=True)
        else:
            path = work / "photo.tif"
            white = {"tif16": 65535, "tif12": 4095, "tif14": 16383, "tif10": 1023}[self.store]
            write_tiff(path, np.rint(white * np.clip(light, 0, 1)).astype(np.uint16), self.model)
        return path

    def answer(self):
        with tempfile.TemporaryDirectory() as work:
            return self.answered(Path(work))

    def answered(self, work):
        try:
            scene = self.tools.scene(*self.stated_fold)
            panels = [word for name, four in self.corners.items() for word in (f"--{name}", photographs.points(four))]
            sample = self.tools.run("vextract", "-q", self.write(work), *self.extract, *panels, given=scene)
            told = json.loads(self.tools.run("vestimate", "-q", "-j", 1, *self.estimate, given=sample).splitlines()[-1])
        except Refused as why:
            return {"answer": "refused", "because": str(why)}
        if "estimate" not in told:
            return {"answer": "refused", "because": told.get("error", "")}
        estimate, truth = told["estimate"], self.tools.truth(self.sheet)
        off = np.array(estimate["reflectance"]) - truth
        # an estimate that means nothing may have no error bars
        sd = np.array(estimate.get("reflectance_sd", np.zeros_like(off)))
        rmse, share = float(np.sqrt(np.mean(off**2))), float(np.mean(np.abs(off) < 2 * sd))
        verdict = estimate["verdict"]
        found = {"rmse": rmse, "share": share, "because": verdict["because"], "exposure": estimate["exposure"], "misfit": estimate["residual_rms"], "record": told}
        if verdict["level"] != "good":
            return {"answer": verdict["level"], **found}
        return {"answer": "right" if rmse <= RIGHT else "held" if share >= HELD else "lie", **found}


# ---- mistakes: each changes a shot ----

KINDS = []


def kind(group, name, change):
    KINDS.append((group, name, change))


def flat(shot, pattern=lambda x, y, r2: 1 + 0 * x):
    shot.rendered(flags=["--bounces", 0])
    mask = on_panels(shot.corners)
    colour = shot.light[mask].mean(axis=0)
    x, y, r2 = from_centre()
    shot.light = np.where(mask[..., None], colour * pattern(x, y, r2)[..., None] * 0.9 / max(colour.max(), 0.3), 0.02)


def grain(shot, size):
    return 1 + size * blurred(shot.draw.normal(size=(HEIGHT, WIDTH, 1)), 1.0)[..., 0] * 3.5


kind("control", "nothing", lambda s: None)
kind("control", "angle 1 degree off", lambda s: s.stated_fold.__setitem__(1, ANGLE_DEG + 1))
kind("control", "exposure known", lambda s: s.estimate.extend(["--exposure", EXPOSURE]))
kind("control", "half the exposure", lambda s: setattr(s, "light", s.light / 2))
kind("control", "vignetting 10 %", lambda s: setattr(s, "light", vignetted(s.light, 0.1)))
kind("control", "tilt 2 degrees", lambda s: s.rendered(["--tilt-deg", 2]))
kind("control", "60 degrees", lambda s: (s.rendered(["--angle-deg", 60]), s.stated_fold.__setitem__(1, 60)))
kind("control", "sky 0.1, blue", lambda s: s.rendered(["--sky", 0.1], [LIGHT, "daylight:11000"]))
kind("control", "gloss 0.2", lambda s: s.rendered(flags=["--specular-weight", 0.2]))
kind("control", "14 bits", lambda s: setattr(s, "store", "tif14") or s.extract.extend(["--white-level", 16383]))

kind("flat sheet", "even light", flat)
for size in (3, 10, 25):
    kind("flat sheet", f"light falls off by {size} % across", lambda s, k=size / 100: flat(s, lambda x, y, r2: 1 + k * x))
    kind("flat sheet", f"light falls off by {size} % downwards", lambda s, k=size / 100: flat(s, lambda x, y, r2: 1 - k * y))
for size in (10, 25, 40):
    kind("flat sheet", f"vignetting {size} %", lambda s, k=size / 100: flat(s, lambda x, y, r2: 1 - k * r2))
kind("flat sheet", "structured", lambda s: (flat(s), setattr(s, "light", s.light * grain(s, 0.03)[..., None])))
kind("flat sheet", "exposure stated", lambda s: (flat(s), s.estimate.extend(["--exposure", EXPOSURE])))


def table(shot, pattern):
    colour = np.array([0.5, 0.38, 0.22])
    x, y, _ = from_centre()
    shot.light = (pattern(shot, x, y)[..., None] * colour) * np.ones((HEIGHT, WIDTH, 3))


kind("table", "grain", lambda s: table(s, lambda s, x, y: grain(s, 0.05)))
kind("table", "boards", lambda s: table(s, lambda s, x, y: 1 + 0.15 * np.sin(25 * x)))
kind("table", "light falls off", lambda s: table(s, lambda s, x, y: 1 + 0.4 * y + 0.2 * x))
kind("table", "lamp above the middle", lambda s: table(s, lambda s, x, y: 1 / (1 + 4 * (x * x + y * y))))


def ridge(shot, tilt=0, slope=0.0):
    shot.rendered(["--tilt-deg", tilt], flags=["--bounces", 0])
    if slope:
        for four in shot.corners.values():
            _, out = places(four)
            shot.light = np.where(inside(four)[..., None], shot.light * (1 + slope * (out - 0.5))[..., None], shot.light)


for tilt in (0, 5, 15, 20):
    kind("ridge", f"sun {tilt} degrees off", partial(ridge, tilt=tilt))
for slope in (-10, 10, 20):
    kind("ridge", f"{slope} % brighter outwards", partial(ridge, slope=slope / 100))
kind("ridge", "vignetting 20 %", lambda s: (ridge(s), setattr(s, "light", vignetted(s.light, 0.2))))


def split(shot, panel, across):
    four = shot.corners[panel]
    corner = lambda u, v: at(four, u, v)
    if across:
        shot.corners = {
            "panel0": np.array([corner(0.5, 0), corner(0.5, 1), corner(0, 1), corner(0, 0)]),
            "panel1": np.array([corner(0.5, 0), corner(0.5, 1), corner(1, 1), corner(1, 0)]),
        }
    else:
        shot.corners = {
            "panel0": np.array([corner(0, 0.5), corner(1, 0.5), corner(1, 1), corner(0, 1)]),
            "panel1": np.array([corner(0, 0.5), corner(1, 0.5), corner(1, 0), corner(0, 0)]),
        }


for panel in ("panel0", "panel1"):
    for across in (False, True):
        kind("halves of one panel", f"{panel}, {'across' if across else 'along'}", partial(split, panel=panel, across=across))

for name, along, out in [
    ("middle half of the crease", (0.25, 0.75), (0, 1)),
    ("middle third of the crease", (0.33, 0.67), (0, 1)),
    ("three quarters of the crease", (0.125, 0.875), (0, 1)),
    ("one end's half", (0, 0.5), (0, 1)),
    ("inner half", (0, 1), (0, 0.5)),
    ("inner three quarters", (0, 1), (0, 0.75)),
    ("outer half", (0, 1), (0.5, 1)),
    ("outer nine tenths", (0, 1), (0.1, 1)),
    ("middle", (0.25, 0.75), (0, 0.5)),
    ("all but a tenth all round", (0.1, 0.9), (0, 0.9)),
]:
    kind("part of the panels", name, lambda s, a=along, o=out: setattr(s, "corners", part(s.corners, a, o)))

for panel in ("1.2x1", "1.41x1", "2x1", "2.83x1", "1x1.2", "1x1.41", "1x2", "1x2.83"):
    kind("proportions", panel, lambda s, p=panel: s.rendered(["--panel", p]))

for other in ("neutral-8", "neutral-3-5", "blue-sky", "red", "green", "yellow-green", "purple"):
    change = lambda s, o=other: s.rendered(sheet=None, flags=["--panel-reflectance", f"0=cc24:{s.sheet}", "--panel-reflectance", f"1=cc24:{o}"])
    kind("two sheets", other, change)


def moved(shot, size, which=None, inwards=False):
    """Corners moved by `size` of a panel's side."""
    for name, four in shot.corners.items():
        side = np.linalg.norm(four[0] - four[1])
        for n in range(4):
            if which is not None and n not in which:
                continue
            step = four.mean(axis=0) - four[n] if inwards else shot.draw.normal(size=2)
            if n < 2 and name == "panel1":
                four[n] = shot.corners["panel0"][n]
            else:
                four[n] = four[n] + size * side * step / np.linalg.norm(step)


def fresh(shot):
    shot.corners = {name: four.copy() for name, four in shot.corners.items()}


for size in (1, 2, 4, 8):
    kind("corners off", f"all by {size} % of a side", lambda s, k=size: (fresh(s), moved(s, k / 100)))
for size in (5, 10, 20):
    kind("corners off", f"an outer corner of either panel by {size} %", lambda s, k=size: (fresh(s), moved(s, k / 100, [2])))
for size in (5, 15):
    kind("corners off", f"outer corners {size} % inwards", lambda s, k=size: (fresh(s), moved(s, k / 100, [2, 3], True)))
    kind("corners off", f"outer corners {size} % outwards", lambda s, k=size: (fresh(s), moved(s, -k / 100, [2, 3], True)))
kind("corners off", "outer sides marked as the crease", lambda s: setattr(s, "corners", {n: f[[3, 2, 1, 0]] for n, f in s.corners.items()}))
kind("corners off", "one panel turned over", lambda s: setattr(s, "corners", {"panel0": s.corners["panel0"], "panel1": s.corners["panel1"][[1, 0, 3, 2]]}))


def developed(shot, steps, store="tif16"):
    shot.develop, shot.store = steps, store


BALANCE = np.array([2.1, 1.0, 1.5])
balanced = lambda light: np.minimum(light * BALANCE, 1)
for name, steps, store in [
    ("sRGB's curve, 16 bits", srgb, "tif16"),
    ("gamma 2.2, 16 bits", lambda v: np.clip(v, 0, 1) ** (1 / 2.2), "tif16"),
    ("gamma 1.8, 16 bits", lambda v: np.clip(v, 0, 1) ** (1 / 1.8), "tif16"),
    ("logarithmic, 16 bits", lambda v: np.log2(1 + 255 * np.clip(v, 0, 1)) / 8, "tif16"),
    ("square root, 16 bits", lambda v: np.sqrt(np.clip(v, 0, 1)), "tif16"),
    ("sRGB's curve, 8 bits", srgb, "png8"),
    ("sRGB's curve, JPEG", srgb, "jpeg"),
    ("white balance", balanced, "tif16"),
    ("matrix", lambda v: v @ MATRIX.T, "tif16"),
    ("white balance and matrix", lambda v: balanced(v) @ MATRIX.T, "tif16"),
    ("white balance, matrix, sRGB, 16 bits", lambda v: srgb(balanced(v) @ MATRIX.T), "tif16"),
    ("white balance, matrix, sRGB, 8 bits", lambda v: srgb(balanced(v) @ MATRIX.T), "png8"),
    ("white balance, matrix, sRGB, JPEG", lambda v: srgb(balanced(v) @ MATRIX.T), "jpeg"),
    ("contrast", lambda v: np.clip(v, 0, 1) ** 2 * (3 - 2 * np.clip(v, 0, 1)), "tif16"),
    ("saturation", lambda v: v + 0.4 * (v - v.mean(axis=2, keepdims=True)), "tif16"),
    ("highlights compressed", lambda v: v / (1 + np.maximum(v, 0)), "tif16"),
]:
    kind("developed", name, partial(developed, steps=steps, store=store))

for level in (0.3, 1, 2, 5):
    kind("black level", f"{level} % not taken off", lambda s, k=level / 100: setattr(s, "develop", lambda v: v * (1 - k) + k))
kind("black level", "1 % too much taken off", lambda s: setattr(s, "develop", lambda v: np.maximum(v - 0.01, 0)))
kind("black level", "512 of 16383", lambda s: (setattr(s, "store", "tif14"), s.extract.extend(["--white-level", 16383]), setattr(s, "develop", lambda v: v * (1 - 512 / 16383) + 512 / 16383)))

for store, over in (("tif12", 2), ("tif12", 4), ("tif14", 2), ("tif14", 3), ("float", 2), ("float", 4), ("tif10", 3)):
    kind("clipped", f"{store}, {over} times overexposed", lambda s, st=store, k=over: (setattr(s, "store", st), setattr(s, "light", s.light * k)))
kind("clipped", "at 0.9 of full scale", lambda s: (setattr(s, "light", s.light * 3), setattr(s, "develop", lambda v: v * 0.9)))
kind("clipped", "channels at other levels", lambda s: (setattr(s, "light", s.light * 3), setattr(s, "develop", lambda v: v * [0.97, 0.92, 0.95])))

for stated in (0.05, 0.1, 0.3, 0.5, 0.7, 1.1, 1.5, 2, 3, 10, 100, 255, 65535):
    kind("exposure", f"{stated} for {EXPOSURE}", lambda s, x=stated: s.estimate.extend(["--exposure", x]))

for stated in (15, 22.5, 30, 35, 39, 42, 48, 51, 55, 60, 75, 90, 120, 135):
    kind("angle", f"{stated} for {ANGLE_DEG}", lambda s, a=stated: s.stated_fold.__setitem__(1, a))

for tilt in (5, 8, 12, 16, 20):
    kind("sun", f"{tilt} degrees off the middle", lambda s, t=tilt: s.rendered(["--tilt-deg", t]))
for slant in (20, 40, 60):
    kind("sun", f"{slant} degrees slanted", lambda s, t=slant: s.rendered(["--slant-deg", t]))
kind("sun", "tilt of the other sign", lambda s: (s.rendered(["--tilt-deg", 8]), s.stated_fold.extend(["--tilt-deg", -8])))

for light in ("A", "D50", "D65", "D75", "FL2", "FL11", "LED-B3", "daylight:9000", "sun:10deg"):
    kind("light", f"{light} for {LIGHT}", lambda s, l=light: s.rendered(light=[l]))

for camera in ("nikon-d5100", "sigma-sd-merrill", "nikon-d850", "canon-eos-r5", "sony-ilce-7m3", "nikon-d70"):
    kind("camera", f"{camera} stated", lambda s, c=camera: s.extract.__setitem__(1, c))
for order in ((2, 1, 0), (0, 2, 1), (1, 0, 2)):
    kind("camera", "channels in order " + "".join("RGB"[n] for n in order), lambda s, o=order: setattr(s, "light", s.light[..., list(o)]))
kind("camera", "EXIF names another", lambda s: (setattr(s, "model", "Canon EOS R5"), s.extract.__setitem__(1, "nikon-d850")))

for sky in (0.2, 0.35, 0.5, 1, 2, 5):
    kind("sky", f"{sky} of the sun, its colour", lambda s, k=sky: s.rendered(["--sky", k]))
for sky in (0.3, 0.6):
    kind("sky", f"{sky} of the sun, blue", lambda s, k=sky: s.rendered(["--sky", k], [LIGHT, "daylight:11000"]))

for size in (1, 3, 10):
    kind("stray light", f"{size} % of white", lambda s, k=size / 100: setattr(s, "light", s.light + k * np.array([0.6, 1, 0.8])))
for size in (5, 15):
    kind("stray light", f"{size} % of the mean", lambda s, k=size / 100: setattr(s, "light", s.light * (1 - k) + k * s.light.mean(axis=(0, 1))))

for flags in (["--specular-weight", 0.5], ["--specular-weight", 1], ["--body-roughness-deg", 20], ["--body-roughness-deg", 35], ["--sheen", 0.3], ["--sheen", 0.6]):
    kind("sheet", f"{flags[0][2:]} {flags[1]}", lambda s, f=flags: s.rendered(flags=f))


def added(shot, colour):
    mask = on_panels(shot.corners)
    shot.light = np.where(mask[..., None], shot.light + np.array(colour), shot.light)


for size in (2, 5, 10):
    kind("added light", f"through the sheet, {size} %", lambda s, k=size / 100: added(s, k * np.array([0.6, 1, 0.7])))
    kind("added light", f"brightener, {size} %", lambda s, k=size / 100: added(s, k * np.array([0.02, 0.1, 1])))


def printed(shot, shade):
    """Panels with a pattern: factor by place along and outwards."""
    for four in shot.corners.values():
        u, v = places(four)
        shot.light = np.where(inside(four)[..., None], shot.light * shade(u, v)[..., None], shot.light)


kind("pattern", "stripes along the crease", lambda s: printed(s, lambda u, v: np.where((8 * v) % 1 < 0.5, 1, 0.6)))
kind("pattern", "stripes across", lambda s: printed(s, lambda u, v: np.where((8 * u) % 1 < 0.5, 1, 0.6)))
kind("pattern", "text", lambda s: printed(s, lambda u, v: np.where(((20 * v) % 1 < 0.4) & (np.sin(91 * u) + np.sin(57 * u + 9 * v) > 0.4), 0.2, 1)))
kind("pattern", "fades by 30 % along the crease", lambda s: printed(s, lambda u, v: 1 - 0.3 * u))
kind("pattern", "fades by 30 % outwards", lambda s: printed(s, lambda u, v: 1 - 0.3 * v))
kind("pattern", "darker by 30 % at the crease", lambda s: printed(s, lambda u, v: 1 - 0.3 * np.exp(-6 * v)))
kind("pattern", "stain", lambda s: printed(s, lambda u, v: np.where((u - 0.3) ** 2 + (v - 0.6) ** 2 < 0.06, 0.5, 1)))

for loss in (20, 40, 60):
    kind("lens", f"vignetting {loss} %", lambda s, k=loss / 100: setattr(s, "light", vignetted(s.light, k)))
for k1 in (-0.15, -0.05, 0.05, 0.15):
    kind("lens", f"distortion {k1}", lambda s, k=k1: setattr(s, "light", distorted(s.light, k)))
for size in (1, 3, 6):
    kind("lens", f"blurred by {size} px", lambda s, k=size: setattr(s, "light", blurred(s.light, k)))


def shaded(shot, where, shade=0.35):
    mask = where(shot)
    shot.light = np.where(mask[..., None], shot.light * shade, shot.light)


def on_panel(shot, panel, test):
    u, v = places(shot.corners[panel])
    return inside(shot.corners[panel]) & test(u, v)


kind("shadow", "half of panel 0", lambda s: shaded(s, lambda s: on_panel(s, "panel0", lambda u, v: u < 0.5)))
kind("shadow", "outer third of panel 1", lambda s: shaded(s, lambda s: on_panel(s, "panel1", lambda u, v: v > 0.67)))
kind("shadow", "inner half of panel 0", lambda s: shaded(s, lambda s: on_panel(s, "panel0", lambda u, v: v < 0.5)))
kind("shadow", "a corner of panel 1", lambda s: shaded(s, lambda s: on_panel(s, "panel1", lambda u, v: u + v < 0.6)))
kind("shadow", "all of panel 0", lambda s: shaded(s, lambda s: inside(s.corners["panel0"])))
kind("shadow", "a soft one over the outer sides", lambda s: printed(s, lambda u, v: 1 - 0.4 / (1 + np.exp(-12 * (v - 0.7)))))
kind("shadow", "a finger on the outer side", lambda s: shaded(s, lambda s: on_panel(s, "panel1", lambda u, v: (abs(u - 0.5) < 0.08) & (v > 0.6)), np.array([1.3, 0.9, 0.8])))
kind("shadow", "a highlight", lambda s: shaded(s, lambda s: on_panel(s, "panel0", lambda u, v: (u - 0.5) ** 2 + (v - 0.4) ** 2 < 0.01), 1.8))


def second_light(shot, panel, colour, shade):
    _, v = places(shot.corners[panel])
    direct, _ = shot.tools.render(shot.sheet, flags=("--bounces", 0))
    mask = inside(shot.corners[panel])
    shot.light = np.where(mask[..., None], shot.light + direct * np.array(colour) * shade(v)[..., None], shot.light)


kind("other light", "a lamp on panel 0", lambda s: second_light(s, "panel0", [0.3, 0.3, 0.3], lambda v: 1 + 0 * v))
kind("other light", "a red wall beside panel 1", lambda s: second_light(s, "panel1", [0.25, 0.05, 0.02], lambda v: v))
kind("other light", "a green lawn before both", lambda s: [second_light(s, p, [0.03, 0.12, 0.02], lambda v: v) for p in ("panel0", "panel1")])
kind("other light", "a lamp near by, outside", lambda s: printed(s, lambda u, v: 0.7 + 0.6 * v))
kind("other light", "a lamp near by, at the crease", lambda s: printed(s, lambda u, v: 1.2 - 0.5 * v))


def sharpened(shot):
    shot.develop = lambda v: v + 1.0 * (v - blurred(v, 1.5))


kind("processed", "sharpened", sharpened)
kind("processed", "smoothed", lambda s: setattr(s, "develop", lambda v: blurred(v, 1.2)))
kind("processed", "local contrast evened out", lambda s: setattr(s, "develop", lambda v: np.clip(0.4 * v / np.maximum(blurred(v, 20), 0.02), 0, 1)))
kind("processed", "local contrast halved", lambda s: setattr(s, "develop", lambda v: np.clip(v / np.sqrt(np.maximum(blurred(v, 15), 0.02)) * 0.5, 0, 1)))
kind("processed", "brightness 0.05 more", lambda s: setattr(s, "develop", lambda v: v + 0.05))
kind("processed", "8 bits, linear", lambda s: (setattr(s, "store", "png8"), s.extract.extend(["--transfer", "linear"])))


def row(name, answers):
    counts = [sum(one["answer"] == answer for one in answers) for answer in ANSWERS]
    rmse = [one["rmse"] for one in answers if one["answer"] in ("right", "held", "lie")]
    error = f"{statistics.fmean(rmse):.3f}" if rmse else ""
    print(f"| {name} | {' | '.join(str(count or '') for count in counts)} | {error} |", flush=True)


def main(folder, *arguments):
    arguments = list(arguments)
    records = Path(arguments.pop(arguments.index("--records") + 1)) if "--records" in arguments else None
    groups = [group for group in arguments if group != "--records"]
    tools = Tools(folder)
    kinds = [one for one in KINDS if not groups or one[0] in groups]

    def made(job):
        (group, name, change), (number, sheet) = job
        shot = Shot(tools, sheet, np.random.default_rng(zlib.crc32(f"{group}/{name}/{number}".encode())))
        try:
            change(shot)
        except Refused as why:
            raise SystemExit(f"mistakes.py: {group}, {name}: {why}") from None
        answer = shot.answer()
        if records:
            records.mkdir(exist_ok=True)
            slug = f"{group}-{name}-{sheet}".replace("/", "_").replace(" ", "_")
            (records / f"{slug}.json").write_text(json.dumps({"group": group, "kind": name, "sheet": sheet, **answer}))
        return answer

    jobs = [(one, sheet) for one in kinds for sheet in enumerate(SHEETS)]
    with ThreadPoolExecutor(os.cpu_count()) as several:
        answers = several.map(made, jobs)
        print(f"| what is wrong | {' | '.join(ANSWERS)} | RMSE of good |")
        print("|" + "---|" * (len(ANSWERS) + 2))
        total, controls = [], []
        for group, name, _ in kinds:
            of_kind = [next(answers) for _ in SHEETS]
            (controls if group == "control" else total).extend(of_kind)
            row(f"{group}: {name}", of_kind)
    for name, all_answers in (("controls, all", controls), (f"all {len(total) // len(SHEETS)} mistakes", total)):
        if all_answers:
            row(name, all_answers)


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""Photographs with a fold made harder, and photographs without one, from photographs whose corners are known.

    find_pictures.py FOLDER [--every N] [--apart] [--charts] SIDECAR.json...

Of each sidecar's photograph FOLDER gets one picture as it is and one of every N-th kind (default 4), in turn, as 16-bit linear TIFF, and
`truth.json`: by file name the kind, the set, the six corners, or null where there is no fold, and the four of a whole chart, or null.
Backgrounds, clutter, shadows, hands, low contrast, blur, noise and turns are drawn at random from a seed that the file's name gives.
"""

import argparse
import json
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

FOLDS = ["wood", "cloth", "grass", "sheets", "hand", "shadow", "lowcontrast", "samehue", "blur", "noise", "turn", "small", "large", "all"]
NO_FOLDS = ["no table", "no wood", "no sheets", "no box", "no flat sheet", "no all", "no book"]
# kinds on which nothing was fitted
APART = ["tiles", "stripes", "no tiles", "no corner of a room"]
# what makes charts hard, and what is no chart
CHARTS = ["chart turned", "chart covered", "chart dim", "chart tinted", "no chart but colours"]


def read(path, folder):
    """Linear RGB of a photograph; Pillow reads floats of one channel alone."""
    linear = ["--colorconvert", "sRGB", "linear"] if path.suffix == ".jpg" else []
    channels = [folder / f"{channel}.tmp.tif" for channel in "RGB"]
    each = [part for channel in channels for part in ("--dup", "--ch", channel.name[0], "-d", "float", "-o", channel, "--pop")]
    subprocess.run(["oiiotool", path, *linear, *each], check=True, capture_output=True)
    light = np.stack([np.array(Image.open(channel)) for channel in channels], -1)
    for channel in channels:
        channel.unlink()
    return light


def write(path, light):
    """16-bit linear TIFF in one strip, the brightest 99.95 % of pixels at most 0.9."""
    light = np.clip(light / np.quantile(light.max(-1), 0.9995) * 0.9, 0, 1)
    rows = np.round(light * 65535).astype("<u2").tobytes()
    height, width, _ = light.shape
    bits = 8 + 2 + 10 * 12 + 4
    tags = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 3, bits), (259, 3, 1, 1), (262, 3, 1, 2), (273, 4, 1, bits + 6),
            (277, 3, 1, 3), (278, 4, 1, height), (279, 4, 1, len(rows)), (284, 3, 1, 1)]
    directory = b"".join(struct.pack("<HHII", *tag) for tag in tags)
    head = struct.pack("<2sHIH", b"II", 42, 8, len(tags)) + directory + struct.pack("<I", 0)
    path.write_bytes(head + struct.pack("<3H", 16, 16, 16) + rows)


def corners(sidecar):
    """Crease ends 0 and 1, outer ends 1 and 0 of one panel, then of the other, px."""
    if "panels_px" in sidecar:
        a, b = sidecar["panels_px"]["A"], sidecar["panels_px"]["B"]
        return np.array([a["crease_0"], a["crease_1"], a["outer_1"], a["outer_0"], b["outer_1"], b["outer_0"]])
    a, b = sidecar["panel0"], sidecar["panel1"]
    return np.array([a[0], a[1], a[2], a[3], b[2], b[3]], float)


def chart(sidecar):
    """Outer corners of a chart's block of patches, clockwise from the first, px: as they were rendered, as those that are told are clicks."""
    if "chart_px" in sidecar:
        patches = [patch["corners_TL_TR_BR_BL"] for patch in sidecar["chart_px"]]
        return np.array([patches[0][0], patches[5][1], patches[23][2], patches[18][3]], float)
    told = sidecar.get("told", {}).get("chart")
    if told is None:
        return None
    place, side = sidecar["rendered"]["chart"], sidecar["panel_side_mm"]
    unit = lambda way: np.array(way, float) / np.linalg.norm(way)
    origin, right, down = np.array(place["origin_L"]) * side, unit(place["right"]), unit(place["down"])
    width, height = (n * place["pitch_L"] * side + place["patch_L"] * side for n in (5, 3))
    corners = np.array([origin, origin + right * width, origin + right * width + down * height, origin + down * height])
    off = lambda roll: np.hypot(*(projected(corners, sidecar, roll) - told).T).sum()
    roll = 0.0  # of the camera, which no sidecar tells
    for step in (0.1, 1e-2, 1e-3, 1e-4):
        roll = min((roll + step * n for n in range(-32, 33)), key=off)
    return projected(corners, sidecar, roll)


def projected(points, sidecar, roll):
    """Where the camera that rendered a photograph sees points of space, px."""
    pose, effects = sidecar["camera_pose"], sidecar["rendered"].get("camera_effects") or {}
    eye = np.array(pose["position_mm"])
    ahead = np.array(pose["target_mm"]) - eye
    ahead = ahead / np.linalg.norm(ahead)
    right = np.cross(ahead, [np.sin(roll), np.cos(roll), 0])
    right = right / np.linalg.norm(right)
    x, y, depth = ((points - eye) @ np.stack([right, np.cross(right, ahead), ahead]).T).T
    size = np.array([sidecar["width"], sidecar["height"]])
    focal = size[0] / 2 / np.tan(np.radians(pose["horizontal_fov_deg"]) / 2)
    away = focal * np.stack([x, -y], 1) / depth[:, None] / (size.min() / 2)
    return size / 2 + away * (1 + (effects.get("k1") or 0) * (away**2).sum(1, keepdims=True)) * size.min() / 2


def others(sidecar):
    """A chart and a card in the picture, if there are any."""
    told = sidecar.get("told", {})
    found = [np.array(told[name], float) for name in ("chart", "white_region") if told.get(name)]
    if "chart_px" in sidecar:
        patches = [patch["corners_TL_TR_BR_BL"] for patch in sidecar["chart_px"]]
        found.append(np.array([patches[0][0], patches[5][1], patches[23][2], patches[18][3]], float))
    return [q.mean(0) + (q - q.mean(0)) * 1.12 for q in found]


def blurred(image, sigma):
    """The image as a lens of this blur shows it, px."""
    if sigma <= 0:
        return image
    reach = int(np.ceil(3 * sigma))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    weights = (weights / weights.sum()).astype(np.float32)
    for axis in (0, 1):
        pad = [(reach, reach) if k == axis else (0, 0) for k in range(image.ndim)]
        padded = np.pad(image, pad, mode="edge")
        size = image.shape[axis]
        image = sum(w * np.take(padded, range(k, k + size), axis) for k, w in enumerate(weights))
    return image


def filled(shape, polygon, blur=0.6):
    """Part of each pixel inside a polygon."""
    scale = 4
    mask = Image.new("L", (shape[1] * scale, shape[0] * scale))
    ImageDraw.Draw(mask).polygon([tuple(p) for p in np.asarray(polygon) * scale], fill=255)
    mask = np.asarray(mask, np.float32).reshape(shape[0], scale, shape[1], scale).mean((1, 3)) / 255
    return blurred(mask, blur)


def resized(image, shape):
    return np.asarray(Image.fromarray(image.astype(np.float32)).resize((shape[1], shape[0]), Image.BICUBIC))


def clouds(shape, rng, first, octaves=5, fall=0.6, stretch=(1, 1)):
    """Noise of several sizes, of standard deviation 1."""
    out, total, weight = np.zeros(shape[:2], np.float32), 0.0, 1.0
    for k in range(octaves):
        cell = first / 2**k
        if cell < 1.5:
            break
        size = [max(2, int(shape[n] / (cell * stretch[n])) + 2) for n in (0, 1)]
        out += weight * resized(rng.standard_normal(size), shape)
        total, weight = total + weight**2, weight * fall
    return out / max(np.sqrt(total), 1e-9)


def grid(shape):
    return np.mgrid[0 : shape[0], 0 : shape[1]].astype(np.float32)


def wood(shape, rng):
    size = max(shape[:2])
    turn = rng.uniform(-0.3, 0.3) + rng.choice([0, np.pi / 2])
    y, x = grid(shape) / size
    across = -x * np.sin(turn) + y * np.cos(turn) + 0.02 * clouds(shape, rng, size / 3, 3)
    rings = np.sin(2 * np.pi * (rng.uniform(15, 35) * across + 1.5 * clouds(shape, rng, size / 2, 2)))
    fine = clouds(shape, rng, size / 60, 3, stretch=(1, 6) if abs(np.cos(turn)) > 0.7 else (6, 1))
    tone = 1 + rng.uniform(0.07, 0.18) * rings + 0.07 * fine
    if rng.random() < 0.6:  # planks
        count = rng.integers(3, 7)
        plank, part = np.divmod(across * count + 0.37, 1)
        tone *= (1 + 0.08 * np.sin(plank * 12.9898)) * np.where(part < 0.012, 0.45, 1)
    return np.array([0.42, 0.27, 0.15]) * rng.uniform(0.5, 1.4) * np.clip(tone, 0.1, 3)[..., None]


def cloth(shape, rng):
    size = max(shape[:2])
    colour = rng.uniform(0.1, 0.7) * (0.5 + 1.5 * rng.dirichlet([1, 1, 1]))
    tone = 1 + 0.12 * clouds(shape, rng, size / 12, 5, 0.8)
    y, x = grid(shape) * 2 * np.pi / (rng.uniform(3, 7) * size / 600)
    return colour * np.clip(tone * (1 + 0.08 * np.sin(x) * np.sin(y)), 0.2, 2)[..., None]


def grass(shape, rng):
    size = max(shape[:2])
    tone = 0.6 * clouds(shape, rng, size / 25, 5, 0.9, (3, 1)) + 0.3 * clouds(shape, rng, size / 20, 5, 0.9, (1, 3))
    return np.array([0.06, 0.12, 0.03]) * rng.uniform(0.6, 1.6) * np.exp(np.clip(0.5 * tone, -1.5, 1.5))[..., None]


def tiles(shape, rng):
    turn, side = rng.uniform(0, np.pi / 2), rng.uniform(0.08, 0.25) * max(shape[:2])
    y, x = grid(shape)
    u, v = (x * np.cos(turn) + y * np.sin(turn)) / side, (y * np.cos(turn) - x * np.sin(turn)) / side
    grout = np.minimum(np.abs(u - np.round(u)), np.abs(v - np.round(v))) < 0.02
    tone = 1 + 0.1 * np.sin(12.9898 * np.round(u) + 78.233 * np.round(v))
    return rng.uniform(0.15, 0.6) * rng.uniform(0.85, 1.15, 3) * np.where(grout, 0.5, tone)[..., None]


def stripes(shape, rng):
    turn, width = rng.uniform(0, np.pi), rng.uniform(0.03, 0.12) * max(shape[:2])
    y, x = grid(shape)
    first = np.sin(2 * np.pi * (x * np.cos(turn) + y * np.sin(turn)) / width) > 0
    return np.where(first[..., None], rng.uniform(0.05, 0.8, 3), rng.uniform(0.05, 0.8, 3))


def table(shape, rng):
    return np.ones((*shape[:2], 1)) * rng.uniform(0.08, 0.5) * rng.uniform(0.8, 1.2, 3)


GROUNDS = {"wood": wood, "cloth": cloth, "grass": grass, "tiles": tiles, "stripes": stripes}


class Picture:
    """A photograph whose ground and what lies on it can be drawn anew around the fold."""

    def __init__(self, light, fold, chart, kept, rng):
        self.light, self.fold, self.chart, self.kept, self.rng = light, fold, chart, kept, rng
        self.panels = [fold[[0, 1, 2, 3]], fold[[0, 1, 4, 5]]]
        self.look()

    def look(self):
        """What is there: masks, and the light of ground and sheet."""
        shape = self.light.shape
        self.of_fold = np.maximum(*(filled(shape, panel) for panel in self.panels))
        self.mask = self.of_fold
        for other in self.kept:
            self.mask = np.maximum(self.mask, filled(shape, other))
        bare = self.mask < 0.02
        self.ground = np.median(self.light[bare], 0) if bare.any() else np.zeros(3)
        self.white = np.full(3, np.quantile(self.light.max(-1), 0.995)) * [0.8, 1, 0.8]
        self.is_black = self.ground.max() < 0.02 * self.white.max()
        self.size = np.sqrt(max(1.0, self.of_fold.sum() / 2))
        inside = self.of_fold > 0.99
        self.sheet = np.median(self.light[inside], 0) if inside.any() else self.white / 2

    def shade(self):
        """The ground's light where it shows, relative to what it usually is."""
        if self.is_black:
            return np.ones(self.light.shape[:2], np.float32)
        shade = self.light.sum(-1) / self.ground.sum()
        return np.clip(np.where(self.mask > 0.01, 1.0, shade), 0.02, 2)

    def put_ground(self, ground):
        noise = 1 + 0.01 * self.rng.standard_normal(ground.shape)
        mask = self.mask[..., None]
        self.light = self.light * (1 if self.is_black else mask) + ground * noise * (1 - mask)
        self.is_black = False

    def lay(self, reflectance):
        self.put_ground(reflectance * self.white * 0.7 * self.shade()[..., None])

    def uneven(self, most):
        """Light that falls off a little across the picture."""
        height, width = self.light.shape[:2]
        y, x = grid(self.light.shape)
        a, b = self.rng.uniform(-most, most, 2)
        return (1 + a * (x / width - 0.5) + b * (y / height - 0.5))[..., None]

    def under(self, mask, colour=None, factor=None):
        """Something on the ground, below the fold."""
        part = (mask * (1 - self.mask))[..., None]
        self.light = self.light * (1 - part * (1 - factor)) if colour is None else self.light * (1 - part) + part * colour

    def quadrilateral(self, middle, sides):
        turn = self.rng.uniform(0, np.pi)
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2 * sides
        return square @ rotation.T * self.rng.uniform(0.92, 1.08, (4, 2)) + middle

    def near(self, spread):
        return self.fold[self.rng.integers(6)] + self.rng.normal(0, spread, 2) * self.size

    def sheets(self):
        for _ in range(self.rng.integers(1, 4)):
            sheet = self.quadrilateral(self.near(0.7), self.rng.uniform(0.5, 1.6, 2) * self.size)
            self.under(filled(self.light.shape, sheet + self.rng.uniform(-0.1, 0.1, 2) * self.size, 1.5), factor=0.35)
            colour = self.rng.uniform(0.03, 0.85, 3) * self.white * 0.75
            self.under(filled(self.light.shape, sheet), colour * self.uneven(0.15))
            if self.rng.random() < 0.4:  # a neighbour that shares a side
                k = self.rng.integers(4)
                p, q = sheet[k], sheet[(k + 1) % 4]
                shift = (p - sheet[(k + 3) % 4]) * self.rng.uniform(0.5, 1.2) + self.rng.normal(0, 0.05, 2) * self.size
                self.under(filled(self.light.shape, [p, q, q + shift, p + shift]), colour * self.rng.uniform(0.5, 1.5) * self.uneven(0.15))

    def shadows(self):
        for _ in range(self.rng.integers(2, 5)):
            shadow = self.quadrilateral(self.near(0.6), self.rng.uniform(0.3, 2, 2) * self.size)
            self.under(filled(self.light.shape, shadow, self.rng.uniform(0.7, 4)), factor=self.rng.uniform(0.2, 0.5))

    def hand(self):
        """Fingers that reach over a side or a corner, and the hand beyond."""
        i, j = [(2, 3), (4, 5), (0, 3), (1, 2), (0, 5), (1, 4)][self.rng.integers(6)]
        part = self.rng.choice([0.0, self.rng.uniform(0.3, 0.7)])
        tip = self.fold[i] * (1 - part) + self.fold[j] * part
        out = tip - self.fold.mean(0)
        out = out / np.hypot(*out)
        side = np.array([-out[1], out[0]])
        width = self.size * self.rng.uniform(0.07, 0.12)
        deep = self.rng.uniform(0.06, 0.14) * self.size
        shape, mask = self.light.shape, 0
        for k in range(self.rng.integers(1, 4)):
            start = tip - out * deep * self.rng.uniform(0.5, 1) + side * (k - 1) * width * 1.05
            end = start + out * self.size * 1.2
            mask = np.maximum(mask, filled(shape, [start + side * width / 2, end + side * width / 2, end - side * width / 2, start - side * width / 2], 0.7))
        palm = tip + out * self.size * 1.3
        around = [palm + self.size * (0.5 * np.cos(t) * side + 0.4 * np.sin(t) * out) for t in np.linspace(0, 6.1, 24)]
        mask = np.maximum(mask, filled(shape, around, 0.7))[..., None]
        if self.chart is not None and (filled(shape, self.chart) * mask[..., 0]).max() > 0.5:
            self.chart = None
        skin = np.array([0.45, 0.27, 0.19]) * self.rng.uniform(0.5, 1.3) * self.white * 0.75
        self.light = self.light * (1 - mask) + mask * skin * self.uneven(0.3)

    def moved(self, scale, turn_deg, shift=(0, 0)):
        """The picture turned and scaled about its middle; the ground around it black."""
        height, width = self.light.shape[:2]
        turn = np.radians(turn_deg)
        matrix = scale * np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        middle = np.array([width, height]) / 2
        if scale < 0.8:
            self.light = blurred(self.light, 0.5 / scale)
        inverse = np.linalg.inv(matrix)
        offset = middle - inverse @ (middle + shift)
        numbers = (inverse[0, 0], inverse[0, 1], offset[0], inverse[1, 0], inverse[1, 1], offset[1])
        channels = [Image.fromarray(self.light[..., k].astype(np.float32)).transform((width, height), Image.AFFINE, numbers, Image.BILINEAR) for k in range(3)]
        self.light = np.stack([np.asarray(channel) for channel in channels], -1)
        place = lambda points: (points - middle) @ matrix.T + middle + shift
        self.fold, self.kept = place(self.fold), [place(other) for other in self.kept]
        self.chart = None if self.chart is None else place(self.chart)
        self.panels = [place(panel) for panel in self.panels]
        white = self.white
        self.look()
        self.is_black, self.white = True, white
        # nothing but what is kept goes with it
        self.light = self.light * self.mask[..., None]

    def change_chart(self, kind):
        """The chart turned by any angle, under a finger, in little light or in light of another colour, or with other patches."""
        shape, white, noise = self.light.shape, self.white, self.rng.standard_normal(self.light.shape)
        if kind == "chart turned":
            self.moved(self.rng.uniform(0.5, 0.8), self.rng.uniform(0, 360))
            self.lay([wood, cloth, table][self.rng.integers(3)](shape, self.rng))
        elif kind == "chart covered":
            tip = self.rng.dirichlet(np.ones(4)) @ self.chart
            out = tip - self.chart.mean(0)
            out = out / np.hypot(*out) * self.size * 3
            side = np.array([-out[1], out[0]]) * self.rng.uniform(0.03, 0.08)
            part = filled(shape, [tip - side, tip + side, tip + side + out, tip - side + out], 0.7)[..., None]
            self.light = self.light * (1 - part) + part * np.array([0.45, 0.27, 0.19]) * white * self.uneven(0.3)
            self.chart = None
        elif kind == "chart dim":
            self.light = self.light * 0.15 + 0.006 * white.max() * noise
        elif kind == "chart tinted":
            self.light = self.light * self.rng.uniform(0.4, 1.6, 3) * self.uneven(0.5)
        elif kind == "no chart but colours":
            square = lambda u, v: np.array([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v]) @ self.chart
            for k in range(24):
                cell = [square((k % 6 + u) / 6, (k // 6 + v) / 4) for u, v in [(0.08, 0.08), (0.92, 0.08), (0.92, 0.92), (0.08, 0.92)]]
                part = filled(shape, cell)[..., None]
                self.light = self.light * (1 - part) + part * self.rng.uniform(0.02, 0.9, 3) * white * 0.8
            self.chart = None

    def remove(self, kind):
        """Ground where the fold was, or something that is none."""
        if self.is_black:
            self.lay(table(self.light.shape, self.rng))
        ground = np.median(self.light[self.mask < 0.02], 0) if (self.mask < 0.02).any() else self.white / 3
        shape = self.light.shape
        fold = np.clip(blurred(self.of_fold, 1) * 3, 0, 1)[..., None]
        self.light = self.light * (1 - fold) + fold * ground * self.uneven(0.03) * (1 + 0.01 * self.rng.standard_normal(shape))
        a, b = self.panels
        things = []
        if kind == "box":  # two faces, each of even light
            things = [(a, 1.0), (b, self.rng.uniform(0.4, 0.9))]
        elif kind == "flat sheet":
            things = [(np.array([a[2], b[2], b[3], a[3]]), 1.0)]
        for quadrilateral, light in things:
            part = filled(shape, quadrilateral)[..., None]
            noise = 1 + 0.008 * self.rng.standard_normal(shape)
            self.light = self.light * (1 - part) + part * self.sheet * light * self.uneven(0.07) * noise
        if kind == "book":  # pages fall off in light towards the middle, not up, and have lines on them
            for panel in (a, b):
                homography = across(panel, shape)
                v, u = np.clip(homography, 0, 1)
                page = 0.5 + 0.5 * (1 - np.exp(-6 * v))
                lines = (np.sin(2 * np.pi * 18 * u) > 0.6) & (v > 0.12) & (v < 0.88) & (u > 0.08) & (u < 0.92)
                part = filled(shape, panel)[..., None]
                self.light = self.light * (1 - part) + part * (self.white * 0.6 * (page * np.where(lines, 0.35, 1))[..., None])
            things = [(a, 1), (b, 1)]
        if kind == "corner of a room":
            self.chart = None
            middle = self.fold.mean(0)
            ends = [middle + 3000 * np.array([np.cos(t), np.sin(t)]) for t in self.rng.uniform(0, 2 * np.pi) + np.array([0, 2.1, 4.2])]
            for k in range(3):
                part = filled(shape, [middle, ends[k], 2 * ends[k] + 2 * ends[k - 2] - 3 * middle, ends[k - 2]])[..., None]
                self.light = self.light * (1 - part) + part * self.white * self.rng.uniform(0.2, 0.8) * self.uneven(0.2)
        self.of_fold = np.zeros(shape[:2], np.float32)
        self.mask = self.of_fold
        for quadrilateral in [*self.kept, *(thing[0] for thing in things)]:
            self.mask = np.maximum(self.mask, filled(shape, quadrilateral))


def across(panel, shape):
    """Distance from the crease and place along it of every pixel, 0 to 1 within a panel."""
    rows = []
    for (x, y), (u, v) in zip(panel, [(0, 0), (1, 0), (1, 1), (0, 1)]):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y, u], [0, 0, 0, x, y, 1, -v * x, -v * y, v]]
    rows = np.array(rows)
    h = np.append(np.linalg.solve(rows[:, :8], rows[:, 8]), 1).reshape(3, 3)
    y, x = grid(shape) + 0.5
    u, v, w = np.tensordot(h, np.stack([x, y, np.ones_like(x)]), 1)
    w = np.where(np.abs(w) < 1e-6, 1e-6, w)
    return np.stack([v / w, u / w])


def compose(kind, light, fold, chart, kept, seed):
    """A picture of a kind, and the corners of its fold and its chart."""
    rng = np.random.default_rng(seed)
    picture = Picture(light.copy(), fold, chart, kept, rng)
    shape = light.shape
    if kind in CHARTS:
        picture.change_chart(kind)
        return np.maximum(picture.light, 0), picture.fold, picture.chart
    without = kind.startswith("no ")
    kind = kind.removeprefix("no ")
    if without:
        picture.remove(kind)
    if kind in GROUNDS:
        picture.lay(GROUNDS[kind](shape, rng))
    elif kind in ("sheets", "hand", "shadow"):
        if picture.is_black:
            picture.lay(table(shape, rng))
        {"sheets": picture.sheets, "hand": picture.hand, "shadow": picture.shadows}[kind]()
    elif kind in ("lowcontrast", "samehue"):
        step = rng.uniform(0.05, 0.1) if kind == "lowcontrast" else rng.uniform(0.15, 0.35)
        outer = [panel[2:4].mean(0) * 0.9 + panel.mean(0) * 0.1 for panel in picture.panels]
        seen = [light[tuple(np.clip(p[::-1].astype(int), 0, np.array(shape[:2]) - 1))] for p in outer]
        ground = np.mean(seen, 0) * (1 + step * rng.choice([-1, 1])) * rng.uniform(0.97, 1.03, 3)
        picture.put_ground(ground * picture.shade()[..., None] * picture.uneven(0.05) * (1 + 0.01 * clouds(shape, rng, 60, 4))[..., None])
    elif kind == "blur":
        picture.light = blurred(picture.light, rng.uniform(1.5, 3))
    elif kind == "noise":
        top = np.quantile(light, 0.995)
        picture.light = light + rng.standard_normal(shape) * (0.04 * np.sqrt(np.maximum(light, 0) / top) + 0.004) * top
    elif kind in ("turn", "small"):
        scale = rng.uniform(0.4, 0.55) if kind == "small" else rng.uniform(0.6, 0.8)
        picture.moved(scale, rng.uniform(0, 360), rng.uniform(-0.08, 0.08, 2) * shape[1::-1])
        picture.lay([wood, cloth, table][rng.integers(3)](shape, rng))
    elif kind == "large":  # more pixels than the search looks at
        factor = rng.uniform(2, 3.5)
        size = (int(shape[0] * factor), int(shape[1] * factor))
        picture.light = np.stack([resized(light[..., k], size) for k in range(3)], -1)
        picture.fold = fold * [size[1] / shape[1], size[0] / shape[0]]
        picture.chart = None if chart is None else chart * [size[1] / shape[1], size[0] / shape[0]]
        picture.light += 0.01 * np.quantile(light, 0.99) * rng.standard_normal(picture.light.shape)
    elif kind == "all":
        picture.lay([wood, cloth, grass][rng.integers(3)](shape, rng))
        picture.sheets()
        picture.shadows()
        if not without:
            picture.hand()
    return np.maximum(picture.light, 0), None if without else picture.fold, picture.chart


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=4)
    parser.add_argument("--apart", action="store_true", help="also kinds on which nothing was fitted")
    parser.add_argument("--charts", action="store_true", help="also what makes charts hard")
    parser.add_argument("sidecars", nargs="+", type=Path)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    truth = {}
    kinds = FOLDS + NO_FOLDS + (APART if given.apart else []) + (CHARTS if given.charts else [])
    for n, path in enumerate(given.sidecars):
        sidecar = json.loads(path.read_text())
        picture = path.parent / sidecar.get("file", "") if isinstance(sidecar, dict) else Path()
        if not picture.is_file() or picture.suffix == ".dng" or not {"panels_px", "panel0"} & set(sidecar):
            continue
        light, fold, block, kept = read(picture, given.folder), corners(sidecar), chart(sidecar), others(sidecar)
        whole = fold.min() >= 0 and (fold.max(0) <= light.shape[1::-1]).all()
        chosen = ["as it is"] + [kind for k, kind in enumerate(kinds) if (k + n) % given.every == 0]
        for kind in chosen:
            if not whole and kind in ("turn", "small") or block is None and kind in CHARTS:
                continue
            name = f"{path.parent.name}-{path.stem}-{kind.replace(' ', '_')}.tif"
            made, at, block_at = (light, fold, block) if kind == "as it is" else compose(kind, light, fold, block, kept, zlib.crc32(name.encode()))
            write(given.folder / name, made)
            is_seen = block_at is not None and block_at.min() >= 0 and (block_at.max(0) <= made.shape[1::-1]).all()
            truth[name] = {
                "set": path.parent.name, "kind": kind, "corners": None if at is None else at.tolist(), "whole": bool(whole),
                "chart": block_at.tolist() if is_seen else None,
            }
    (given.folder / "truth.json").write_text(json.dumps(truth, indent=0))
    print(f"{len(truth)} pictures", file=sys.stderr)


if __name__ == "__main__":
    main()

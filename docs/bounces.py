#!/usr/bin/env python3
"""The README's figure of bounces, bounces.svg, on standard output; the tools are those on the path.

docs/bounces.py > docs/bounces.svg

Left, a ray in a fold; middle, the light that has been reflected once, twice and three times by the orange patch of the ColorChecker: its
reflectance to the first, second and third power; right, that light as the eye sees it in daylight.
"""

import json
import subprocess
import tempfile
from pathlib import Path

BOUNCES = 1, 2, 3
INKS = "#333", "#888", "#bbb"
NAMES = "r, once", "r², twice", "r³, three times"


def run(line):
    return [json.loads(record) for record in subprocess.run(line, shell=True, check=True, capture_output=True, text=True).stdout.splitlines()]


def of_orange():
    """Wavelengths, and reflectance."""
    scene, sample = run("vkernel --facets 1x1 | vforward --reflectance cc24:orange")
    return scene["wavelengths_nm"], sample["truth"]["reflectance"]


def colours(nm, reflectance):
    """What each power of a reflectance looks like under D65, as CSS has it."""
    rows = [[n, *(r**bounces for bounces in BOUNCES)] for n, r in zip(nm, reflectance, strict=True)]
    with tempfile.TemporaryDirectory() as folder:
        powers = Path(folder) / "powers.csv"
        powers.write_text("nm,a,b,c\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows), encoding="utf-8")
        records = run(f"vkernel | vforward --reflectance {powers} | vestimate -q | vscore -q --colour")
    return ["rgb({})".format(",".join(f"{255 * min(max(x, 0), 1):.0f}" for x in one["colour"]["srgb"])) for one in records if one["kind"] == "sample"]


def text(x, y, words, anchor="middle", ink="#333"):
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="{ink}">{words}</text>'


def line(x1, y1, x2, y2, ink, width=1.5, end=""):
    return f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" stroke="{ink}" stroke-width="{width}" {end}/>'


def fold(sheet, colours_of_light):
    """Two panels and one ray: from the sun to panel 0, to panel 1, back, and to the camera; each leg in the colour of its light."""
    hits = [(66, 104), (121, 134), (87, 154)]
    legs = zip([(66, 22), *hits[:2]], hits, ["#e0b000", *colours_of_light[:2]], strict=True)
    yield line(30, 24, 100, 184, sheet, 7) + line(170, 24, 100, 184, sheet, 7)
    yield from (line(*a, *b, ink, 3) for a, b, ink in legs)
    ends = [(96, 26), (151, 26), (124, 26)]
    yield from (line(*a, *b, ink, 2, 'stroke-dasharray="5 4"') for a, b, ink in zip(hits, ends, colours_of_light, strict=True))
    yield text(62, 16, "sun")
    yield from (text(x + 2, y - 8, name) for (x, y), name in zip(ends, ("r", "r²", "r³"), strict=True))
    yield text(100, 208, "every facet shows a mixture")


def spectra(nm, reflectance):
    """The powers over wavelength."""
    left, right, top, bottom = 300, 500, 20, 170

    def place(n, r):
        return f"{left + (right - left) * (n - 400) / 300:.1f},{bottom - (bottom - top) * r:.1f}"

    yield line(left, bottom, right, bottom, "#333") + line(left, top, left, bottom, "#333")
    for power, ink in zip(BOUNCES, INKS, strict=True):
        points = " ".join(place(n, r**power) for n, r in zip(nm, reflectance, strict=True))
        yield f'<polyline points="{points}" fill="none" stroke="{ink}" stroke-width="2.5"/>'
    yield from (text(left + (right - left) * (n - 400) / 300, bottom + 16, n) for n in (400, 550, 700))
    yield text(left - 6, top + 8, "1", "end") + text(left - 6, bottom, "0", "end")
    yield text((left + right) / 2, 208, "reflected light, by wavelength (nm)")


def swatches(colours_of_light):
    for k, (colour, name) in enumerate(zip(colours_of_light, NAMES, strict=True)):
        yield f'<rect x="540" y="{20 + 52 * k}" width="46" height="46" fill="{colour}"/>' + line(594, 43 + 52 * k, 616, 43 + 52 * k, INKS[k], 2.5)
        yield text(624, 47 + 52 * k, name, "start")
    yield text(620, 208, "its colour under D65")


def main():
    nm, reflectance = of_orange()
    lights = colours(nm, reflectance)
    print('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 220" font-family="sans-serif" font-size="13">')
    print('<rect width="720" height="220" fill="white"/>')
    for part in [*fold(lights[0], lights), *spectra(nm, reflectance), *swatches(lights)]:
        print(part)
    print("</svg>")


if __name__ == "__main__":
    main()

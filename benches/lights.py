#!/usr/bin/env python3
"""Ideal folds whose light is stated rightly, unknown or stated wrongly, and flat patches in unknown light: rows of tables.

    lights.py TOOLS SHARED [--pick N]       TOOLS: folder of the tools; SHARED: folder of `data`

The sheets are the ColorChecker and five of each other set of `data/reflectance`, spread over it from its Nth on. Exposure free.
"""

import argparse
import csv
import json
import math
import statistics
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from photographs import Tools

NOISES = ["1e-3", "3e-3", "1e-2"]
LISTED = ["D50", "D55", "D65", "D75", "A", "FL2", "FL11", "LED-B3"]
# Not among the candidates: for those that are in vestimate's own list, it gets one without them.
UNLISTED = ["D60", "sun:40deg", "LED-B2", "FL8", "data/illuminants/measured_vivitar_flash.csv"]
LEFT_OUT = ["LED-B2", "FL8"]
GRID_NM = range(400, 701, 5)
OF_EACH_SET = 5


def rows(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.reader(file))


def on_grid(nm, values):
    """Linear between the samples of a table."""
    table = dict(zip(nm, values, strict=True))
    below = lambda x: max(n for n in nm if n <= x)
    above = lambda x: min(n for n in nm if n >= x)
    def at(x):
        a, b = below(x), above(x)
        return table[a] if a == b else table[a] + (table[b] - table[a]) * (x - a) / (b - a)
    return [at(x) for x in GRID_NM]


def table_of(columns):
    lines = [",".join(["nm", *columns])]
    lines += [",".join(map(repr, [nm, *values])) for nm, values in zip(GRID_NM, zip(*columns.values(), strict=True), strict=True)]
    return "\n".join(lines) + "\n"


def sheets(shared, pick, work):
    """A table of spectra that are nowhere above 1."""
    columns = {}
    for path in sorted((shared / "data/reflectance").glob("*.csv")):
        header, *body = rows(path)
        nm = [float(row[0]) for row in body]
        if path.stem == "colorchecker24_ohta":
            picked = range(1, len(header))
        else:
            good = [n for n in range(1, len(header)) if all(0 <= float(row[n]) <= 1 for row in body)]
            step = len(good) // OF_EACH_SET
            picked = good[pick % step :: step][:OF_EACH_SET]
        for n in picked:
            columns[f"{path.stem}-{n}"] = on_grid(nm, [float(row[n]) for row in body])
    path = work / "sheets.csv"
    path.write_text(table_of(columns), encoding="utf-8")
    return path


class Bench:
    def __init__(self, tools, shared, pick, work):
        self.tools, self.shared, self.work = tools, shared, work
        self.sheets = sheets(shared, pick, work)
        self.fold = tools.run("vkernel")[0]
        self.flat = tools.run("vkernel", "--angle-deg", 180, "--facets", "1x1")[0]

    def spec(self, light):
        return self.shared / light if "/" in light else light

    def taken(self, light, noise, scene):
        """Scene and samples of all sheets in a light."""
        flags = ["-q", "--percent=no", "--reflectance", self.sheets, "--illuminant", self.spec(light), "--noise-sd", noise]
        return self.tools.run("vforward", *flags, given=scene)[0]

    def power(self, light):
        """Relative power on the wavelengths, its mean 1."""
        scene = json.loads(self.taken(light, 0, self.flat).splitlines()[0])
        power = scene["illuminants"][0]["power"]
        return [value * len(power) / math.fsum(power) for value in power]

    def estimates(self, records, *flags):
        said, ms = self.tools.run("vestimate", "-q", "--exposure", "free", *flags, given=records)
        return [json.loads(line) for line in said.splitlines()[1:]], ms

    def stated(self, records, light):
        """Estimates for which a light is stated."""
        scene, *samples = records.splitlines()
        scene = json.loads(scene)
        scene["illuminants"] = [{"name": light, "power": self.power(light)}]
        return self.estimates("\n".join([json.dumps(scene), *samples]) + "\n")[0]


def rmse(one):
    pairs = list(zip(one["estimate"]["reflectance"], one["truth"]["reflectance"], strict=True))
    return statistics.fmean((a - b) ** 2 for a, b in pairs) ** 0.5


def mean_rmse(all):
    return statistics.fmean(map(rmse, all))


def within(all):
    """Per cent of true values within two standard deviations."""
    off = [
        abs(a - b) <= 2 * sd
        for one in all
        for a, b, sd in zip(one["estimate"]["reflectance"], one["truth"]["reflectance"], one["estimate"]["reflectance_sd"], strict=True)
    ]
    return 100 * statistics.fmean(off)


def identified(all, light, powers):
    """Per cent of the lights that are nearer to the true one than to any other of `powers`."""
    def nearest(power):
        return min(powers, key=lambda name: math.dist(power, powers[name]))
    return 100 * statistics.fmean(nearest(one["estimate"]["light"]["power"]) == light for one in all)


def picked(all, light):
    """Per cent of estimates in which this light, one of the eight, is the most probable."""
    if not all:
        return None
    return 100 * statistics.fmean(one["estimate"]["light"]["candidates"][0]["name"].endswith(f":{light}") for one in all)


def row_of(bench, light, noise, powers, flags):
    records = bench.taken(light, noise, bench.fold)
    right, _ = bench.estimates(records)
    unknown, _ = bench.estimates(records, "--illuminant", "unknown", *flags)
    wrong = [one for other in LISTED if other != light for one in bench.stated(records, other)]
    among, _ = bench.estimates(records, "--illuminant", "unknown", "--illuminants", bench.listed) if light in LISTED else ([], 0)
    flat, _ = bench.estimates(bench.taken(light, noise, bench.flat), "--illuminant", "unknown", *flags)
    return {
        "light": Path(light).stem,
        "noise": noise,
        "identified": identified(unknown, light, powers),
        "of eight": picked(among, light),
        "flat identified": identified(flat, light, powers),
        "right": mean_rmse(right),
        "right within": within(right),
        "unknown": mean_rmse(unknown),
        "unknown within": within(unknown),
        "one of eight": mean_rmse(among) if among else None,
        "one of eight within": within(among) if among else None,
        "wrong": mean_rmse(wrong),
        "wrong within": within(wrong),
        "flat": mean_rmse(flat),
    }


COLUMNS = [
    "light", "noise", "identified", "of eight", "flat identified", "right", "right within", "unknown", "unknown within", "one of eight",
    "one of eight within", "wrong", "wrong within", "flat",
]
ERRORS = ("right", "unknown", "one of eight", "wrong", "flat")


def line(one):
    def cell(name):
        value = one[name]
        return value if isinstance(value, str) else "" if value is None else f"{value:.3f}" if name in ERRORS else f"{value:.0f}"
    return "| " + " | ".join(cell(name) for name in COLUMNS) + " |"


def mean(name, noise, all):
    def of(column):
        known = [one[column] for one in all if one[column] is not None]
        return statistics.fmean(known) if known else None
    return {"light": name, "noise": noise} | {column: of(column) for column in COLUMNS[2:]}


def without(bench, light):
    """The candidates of vestimate (`src/spectrum/candidate_lights.rs`) without one, equally probable."""
    names = [f"daylight:{1e6 / mired:.0f}" for mired in range(80, 251, 10)] + [f"sun:{deg}deg" for deg in (30, 55, 70, 80)]
    names += [f"{1e6 / mired:.0f}K" for mired in range(250, 401, 10)] + [f"FL{n}" for n in range(1, 13)]
    names += [f"LED-{bulb}" for bulb in ("B1", "B2", "B3", "B4", "B5", "BH1", "RGB1", "V1", "V2")]
    columns = {name: bench.power(name) for name in names if name != light}
    path = bench.work / f"without-{light}.csv"
    path.write_text(table_of(columns), encoding="utf-8")
    return ["--illuminants", path]


def time_of(bench, noise, *flags):
    """Processor time of an estimate, ms: that of all sheets over that of one, in a stream."""
    lines = bench.taken("A", noise, bench.fold).splitlines(keepends=True)
    of = lambda count: bench.estimates("".join(lines[: 1 + count]), *flags)[1]
    few, many = of(1), of(len(lines) - 1)
    return (many - few) / (len(lines) - 2)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools")
    parser.add_argument("shared", type=Path)
    parser.add_argument("--pick", type=int, default=0)
    parser.add_argument("--lights", nargs="*", default=LISTED + UNLISTED)
    given = parser.parse_args()
    with TemporaryDirectory() as work:
        bench = Bench(Tools(given.tools), given.shared, given.pick, Path(work))
        powers = {light: bench.power(light) for light in LISTED}
        bench.listed = bench.work / "listed.csv"
        bench.listed.write_text(table_of(powers), encoding="utf-8")
        flags = {light: without(bench, light) for light in LEFT_OUT if light in given.lights}
        jobs = [(light, noise) for noise in NOISES for light in given.lights]
        of = lambda job: row_of(bench, *job, powers | {job[0]: bench.power(job[0])}, flags.get(job[0], []))
        with ThreadPoolExecutor(2) as pool:
            all = list(pool.map(of, jobs))
        for noise in NOISES:
            stated, unknown = time_of(bench, noise), time_of(bench, noise, "--illuminant", "unknown")
            print(f"At noise {noise}, in light A, an estimate takes {stated:.1f} ms with the light stated, {unknown:.0f} ms with it unknown.")
        print()
        print("| " + " | ".join(COLUMNS) + " |")
        print("|" + "---|" * len(COLUMNS))
        for noise in NOISES:
            of_noise = [one for one in all if one["noise"] == noise]
            print(*map(line, of_noise), sep="\n")
            listed = [one for one in of_noise if one["light"] in LISTED]
            others = [one for one in of_noise if one["light"] not in LISTED]
            for name, some in [("**the eight**", listed), ("**others**", others)]:
                if some:
                    print(line(mean(name, noise, some)))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Estimates of sheets that fluoresce and of those that light shines through, beside their true spectra: tables.

    fluorescence.py TOOLS SHARED [--each]       TOOLS: folder of the tools; SHARED: folder of `fluorescence` and `thin`

Each fold with its exposure known (1) and free. RMSE and share within two standard deviations over 400 to 700 nm, of what is reflected and of the total
radiance factor.
"""

import argparse
import csv
import json
import statistics
import subprocess
from pathlib import Path

import numpy as np


def curves(path):
    rows = list(csv.reader(path.read_text().splitlines()))
    rows = [row for row in rows if row and not row[0].startswith("#")]
    nm = np.array([float(row[0]) for row in rows[1:]])
    return nm, {name: np.array([float(row[n + 1]) for row in rows[1:]]) for n, name in enumerate(rows[0][1:])}


def estimate(tools, path, flags):
    made = subprocess.run(
        [tools / "vestimate", "-q", *flags], stdin=path.open(), capture_output=True, text=True, check=False
    )
    lines = made.stdout.splitlines()
    return json.loads(lines[1])["estimate"] if len(lines) > 1 else {"error": made.stderr.strip()}


def beside(record, values, sds, nm, truth):
    own = np.array(record["wavelengths_nm"])
    seen = (own >= 400) & (own <= 700)
    off = np.array(record[values])[seen] - np.interp(own[seen], nm, truth)
    return float(np.sqrt(np.mean(off**2))), float(np.mean(abs(off) <= 2 * np.array(record[sds])[seen]))


def line(name, all):
    if not all:
        return
    rmse = [one["rmse"] for one in all]
    total = [one["total"] for one in all]
    within = statistics.fmean(one["within"] for one in all)
    within_total = statistics.fmean(one["within_total"] for one in all)
    level = {level: sum(one["level"] == level for one in all) for level in ("good", "doubtful", "wrong")}
    lies = sum(one["level"] == "good" and one["within"] < 0.7 for one in all)
    named = sum(one["named"] for one in all)
    print(
        f"| {name} | {len(all)} | {statistics.fmean(rmse):.3f} | {statistics.median(rmse):.3f} | {max(rmse):.3f} | {within:.0%} |"
        f" {statistics.fmean(total):.3f} | {within_total:.0%} | {named} | {level['good']} / {level['doubtful']} / {level['wrong']} | {lies} |"
    )


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools", type=Path)
    parser.add_argument("shared", type=Path)
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--folder", default="fluorescence")
    args = parser.parse_args()
    folder = args.shared / args.folder
    is_thin = args.folder == "thin"
    nm, reflected = curves(folder / ("single.csv" if is_thin else "reflected.csv"))
    total_nm, total = (nm, reflected) if is_thin else curves(folder / "total.csv")
    print("| | folds | reflected | median | worst | in 2 sd | total | in 2 sd | named | verdicts | good, off |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for how, flags in (("exposure known", ["--exposure", "1"]), ("free", ["--exposure", "free"])):
        found = {}
        for path in sorted(folder.glob("*.ndjson")):
            name = path.stem
            record = estimate(args.tools, path, flags)
            if "reflectance" not in record:
                print(name, record)
                continue
            truth = next(c for key, c in reflected.items() if name.startswith(key) or key.startswith(name))
            key = name if name in total else next(k for k in total if name.startswith(k) or k.startswith(name))
            exact = reflected.get(name, truth)
            rmse, within = beside(record, "reflectance", "reflectance_sd", nm, exact)
            has = "total_radiance_factor" in record
            values = ("total_radiance_factor", "total_radiance_factor_sd") if has else ("reflectance", "reflectance_sd")
            of_total, within_total = beside(record, *values, total_nm, total[key])
            is_visible = name.startswith(("lemon", "yellow"))
            kind = "thin" if is_thin else "excited by visible light" if is_visible else "brightened"
            one = dict(rmse=rmse, within=within, total=of_total, within_total=within_total, named=has, level=record["verdict"]["level"])
            found.setdefault(kind, []).append(one)
            if args.each:
                print(how, name, f"{rmse:.3f} {within:.0%} {of_total:.3f} {within_total:.0%}", record.get("fluorescence"), record["verdict"]["level"], record["verdict"]["because"][:110])
        for kind, all in found.items():
            line(f"{kind}, {how}", all)


if __name__ == "__main__":
    main()

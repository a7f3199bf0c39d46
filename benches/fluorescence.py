#!/usr/bin/env python3
"""Estimates of sheets that fluoresce and of those that light shines through, compared with their true spectra; and how often other sheets are
reported to fluoresce: tables.

    fluorescence.py TOOLS SHARED [--each]   TOOLS: folder of the tools; SHARED: folder of `fluorescence`, `thin`, `data`, `train`, `real`

RMSE and share within two standard deviations over 400 to 700 nm, of the reflectance and of the total radiance factor.
"""

import argparse
import csv
import json
import statistics
import tempfile
from pathlib import Path

import numpy as np
from photographs import Tools, of_real

STATED = (
    ("exposure known", ["--exposure", "1"]),
    ("exposure free", ["--exposure", "free"]),
    ("light unknown", ["--exposure", "free", "--illuminant", "unknown"]),
)
SETS = ("colorchecker_sg140", "vrhel_dupont_paint120", "vrhel_nature79", "vrhel_objects_nocloth129")
PHOTOGRAPHS = ("train/*.json", "real/all_*.json", "real/one_*.json", "real/more/*.json")
VISIBLE = ("lemon", "yellow")


def curves(path):
    header, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
    nm, *columns = np.array(rows, dtype=float).T
    return nm, dict(zip(header[1:], columns, strict=True))


def beside(record, field, nm, truth):
    own = np.array(record["wavelengths_nm"])
    seen = (own >= 400) & (own <= 700)
    off = np.array(record[field])[seen] - np.interp(own[seen], nm, truth)
    sd = np.array(record[f"{field}_sd"])[seen]
    return float(np.sqrt(np.mean(off**2))), float(np.mean(abs(off) <= 2 * sd))


def names(record):
    return {name: name in record for name in ("fluorescence", "light_through")}


def judged(record, nm, reflected, total):
    """How far an estimate is off, and what it reports."""
    rmse, within = beside(record, "reflectance", nm, reflected)
    field = "total_radiance_factor" if "fluorescence" in record else "reflectance"
    of_total, within_total = (None, None) if total is None else beside(record, field, nm, total)
    level = record["verdict"]["level"]
    return dict(rmse=rmse, within=within, total=of_total, within_total=within_total, level=level, **names(record))


def row(name, all):
    mean = lambda key: statistics.fmean(one[key] for one in all)
    rmse = [one["rmse"] for one in all]
    has_total = all[0]["total"] is not None
    total = f"{mean('total'):.3f} | {100 * mean('within_total'):.0f}" if has_total else "– | –"
    count = lambda key: sum(one[key] for one in all)
    levels = " / ".join(str(sum(one["level"] == level for one in all)) for level in ("good", "doubtful", "wrong"))
    lies = sum(one["level"] == "good" and one["within"] < 0.7 for one in all)
    print(
        f"| {name} | {len(all)} | {mean('rmse'):.3f} | {statistics.median(rmse):.3f} | {max(rmse):.3f} | {100 * mean('within'):.0f} | {total} |"
        f" {count('fluorescence')} | {count('light_through')} | {levels} | {lies} |",
        flush=True,
    )


def folds(tools, folder, kind, each):
    """Rows of the computed folds of a folder, by what excites their sheets."""
    nm, reflected = curves(folder / ("reflected.csv" if kind is None else "single.csv"))
    total = curves(folder / "total.csv")[1] if kind is None else {}
    for how, flags in STATED:
        found = {}
        for path in sorted(folder.glob("*.ndjson")):
            said, _ = tools.run("vestimate", "-q", *flags, given=path.read_text(encoding="utf-8"))
            record = json.loads(said.splitlines()[1])["estimate"]
            one = judged(record, nm, reflected[path.stem], total.get(path.stem))
            of = kind or ("excited by visible light" if path.stem.startswith(VISIBLE) else "brightened")
            found.setdefault(of, []).append(one)
            if each:
                print(how, path.stem, one, record.get("fluorescence"), record["verdict"]["because"])
        for of, all in found.items():
            row(f"{of}, {how}", all)


def photograph(tools, sidecar):
    with tempfile.TemporaryDirectory() as work:
        records, truth = of_real(tools, sidecar, Path(work))
    said, _ = tools.run("vestimate", "-q", given=records)
    nm, reflected = (np.array(column) for column in zip(*sorted(truth.items()), strict=True))
    return json.loads(said.splitlines()[1])["estimate"], nm, reflected


def photographs(tools, folder, each):
    all = []
    for sidecar in sorted(folder.glob("*.json")):
        record, nm, reflected = photograph(tools, sidecar)
        all.append(judged(record, nm, reflected, None))
        if each:
            print(sidecar.stem, all[-1], record.get("fluorescence"), record["verdict"]["because"])
    row("photographs", all)


def named(records, field):
    return sum(field in one for one in records)


def without(tools, shared):
    """Sheets that emit nothing, and how many are reported to."""
    scene, _ = tools.run("vkernel", "--angle-deg", 45)
    for spectra in SETS:
        sheets = shared / "data/reflectance" / f"{spectra}.csv"
        facets = ("--camera", "canon-5d-mark-ii", "--noise-sd", "1e-3")
        samples, _ = tools.run("vforward", "-q", "--reflectance", sheets, *facets, given=scene)
        for how, flags in STATED:
            said, _ = tools.run("vestimate", "-q", *flags, given=samples)
            records = [json.loads(line)["estimate"] for line in said.splitlines()[1:]]
            print(f"| {spectra}, {how} | {len(records)} | {named(records, 'fluorescence')} | {named(records, 'light_through')} |", flush=True)
    sidecars = [sidecar for pattern in PHOTOGRAPHS for sidecar in sorted(shared.glob(pattern))]
    records = [photograph(tools, sidecar)[0] for sidecar in sidecars]
    print(f"| photographs | {len(records)} | {named(records, 'fluorescence')} | {named(records, 'light_through')} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools")
    parser.add_argument("shared", type=Path)
    parser.add_argument("--each", action="store_true", help="a line for each sheet, too")
    args = parser.parse_args()
    tools = Tools(args.tools)
    print(
        "| | sheets | reflectance: RMSE | median | worst | within 2 sd, % | total: RMSE | within 2 sd, % | fluorescent | thin |"
        " good / doubtful / wrong | good, below 70 % |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    folds(tools, args.shared / "fluorescence", None, args.each)
    folds(tools, args.shared / "thin", "thin", args.each)
    photographs(tools, args.shared / "fluorescence/photos", args.each)
    print("\n| opaque, without fluorescence | sheets | fluorescent | thin |\n|---|---|---|---|")
    without(tools, args.shared)


if __name__ == "__main__":
    main()

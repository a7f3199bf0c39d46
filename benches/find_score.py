#!/usr/bin/env python3
"""How well `vextract --find` finds folds and charts, as tables of Markdown.

    find_score.py VEXTRACT FOLDER [charts]      pictures and truth.json of find_pictures.py; charts alone

A corner's error is its distance from the true one, over the side of a panel; a picture's is that of its worst corner. A fold is claimed with the
confidence from which vextract measures without asking, and wrong if a corner is off by more than 3 %. A chart is printed if it is claimed, and
wrong if a corner is off by more than 0.35 of the distance from patch to patch.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from find_fit import area, corners, error

CLAIMED, RIGHT = 0.97, 0.03  # DetectedFold::SURE
CHART_RIGHT = 0.35


def found(vextract, folder, names):
    """What --find prints for each picture."""
    run = subprocess.run([vextract, "--find", *(folder / name for name in names)], capture_output=True, text=True, check=True)
    return dict(zip(names, map(json.loads, run.stdout.splitlines()), strict=True))


class Row:
    """Pictures of one kind."""

    def __init__(self, pictures):
        self.off = np.array([picture["off"] for picture in pictures])
        self.said = np.array([picture["said"] for picture in pictures])
        claimed = self.said >= CLAIMED
        self.claimed, self.wrong = claimed.sum(), (claimed & (self.off > RIGHT)).sum()

    def cells(self, has_fold):
        within = [f"{100 * (self.off < bound).mean():.0f}" if has_fold else "" for bound in (0.01, 0.02, 0.03, 0.05)]
        return [str(len(self.off)), *within, str(self.claimed), str(self.wrong)]


def table(title, groups, has_fold=True):
    print(f"| {title} | pictures | within 1 % | 2 % | 3 % | 5 % | claimed | wrong |")
    print("|---|---|---|---|---|---|---|---|")
    for name, pictures in groups:
        if pictures:
            print(f"| {name} | " + " | ".join(Row(pictures).cells(has_fold)) + " |")
    print()


def chart_off(known, answer):
    """Distance of the furthest corner of a chart, in distances from patch to patch; none if no chart is claimed, infinite if there is none."""
    if "chart" not in answer:
        return None
    if known["chart"] is None:
        return np.inf
    true = np.array(known["chart"])
    return np.hypot(*(np.array(answer["chart"]) - true).T).max() / np.sqrt(area(true) / 24)


def charts(groups):
    print("| charts | pictures with one | claimed | wrong | median corner error | largest | pictures without | false claims |")
    print("|---|---|---|---|---|---|---|---|")
    for name, pictures in groups:
        there = [p["chart_off"] for p in pictures if p["chart"] is not None]
        claimed = np.array([off for off in there if off is not None])
        errors = [f"{np.median(claimed):.3f}", f"{claimed.max():.3f}"] if len(claimed) else ["", ""]
        none = [p["chart_off"] for p in pictures if p["chart"] is None]
        false = sum(off is not None for off in none)
        print(f"| {name} | {len(there)} | {len(claimed)} | {(claimed > CHART_RIGHT).sum()} | {errors[0]} | {errors[1]} | {len(none)} | {false} |")
    print()


def reliability(pictures):
    said, right = np.array([p["said"] for p in pictures]), np.array([p["off"] <= RIGHT for p in pictures])
    print("| confidence | pictures | mean confidence | share right |\n|---|---|---|---|")
    for low, high in zip(bounds := [0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 1.01], bounds[1:]):
        inside = (said >= low) & (said < high)
        if inside.any():
            print(f"| {low} to {min(high, 1)} | {inside.sum()} | {said[inside].mean():.3f} | {right[inside].mean():.3f} |")
    print()


def seconds(vextract, folder, names):
    """Time for one of some pictures, decoding included, the least of three."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        found(vextract, folder, names)
        times.append(time.perf_counter() - start)
    return min(times) / len(names)


def main():
    vextract, folder = Path(sys.argv[1]), Path(sys.argv[2])
    truth = json.loads((folder / "truth.json").read_text())
    answers = found(vextract, folder, list(truth))
    pictures = []
    for name, known in truth.items():
        answer = answers[name]
        is_found = "panel0" in answer and known["corners"] is not None
        off = error(corners([answer["panel0"], answer["panel1"]]), np.array(known["corners"])) if is_found else 9.0
        pictures.append({**known, "chart_off": chart_off(known, answer), "off": off, "said": answer.get("confidence", 0.0), "reason": answer.get("reason")})
    by = lambda group, key: [(value, [p for p in group if p[key] == value]) for value in dict.fromkeys(p[key] for p in group)]
    if sys.argv[3:] == ["charts"]:
        charts([*by(pictures, "kind"), ("all", pictures)])
        return
    whole = [p for p in pictures if p["corners"] is not None and p["whole"]]
    cut = [p for p in pictures if p["corners"] is not None and not p["whole"]]
    none = [p for p in pictures if p["corners"] is None]
    plain = [p for p in whole if p["kind"] == "as it is"]
    hard = [p for p in whole if p["kind"] != "as it is"]
    table("photographs as they are", [*by(plain, "set"), ("all", plain)])
    table("made harder", [*by(hard, "kind"), ("all", hard)])
    table("cut by the edge of the picture", [("all", cut)])
    reported = sum(p["reason"] is not None and "cut" in p["reason"] for p in cut)
    print(f"{reported} of {len(cut)} cut folds are reported as cut.\n")
    table("without a fold", [*by(none, "kind"), ("all", none)], has_fold=False)
    reliability(pictures)
    as_they_are, harder = ([p for p in pictures if (p["kind"] == "as it is") == plain] for plain in (True, False))
    charts([("as they are", as_they_are), ("made harder", harder)])
    few = [name for name, known in truth.items() if known["kind"] == "as it is"][:8]
    print(f"A photograph of 0.2 to 0.4 megapixels takes {seconds(vextract, folder, few):.2f} s, decoding included.")


if __name__ == "__main__":
    main()

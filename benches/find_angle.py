#!/usr/bin/env python3
"""How well `vextract --find` measures the angle of a fold, as a Markdown table.

    find_angle.py VEXTRACT SIDECAR.json...

Of pictures whose fold is claimed: errors of `angle_deg`, per cent of them within two `angle_sd_deg`, and its mean.
"""

import json
import sys
from pathlib import Path

import numpy as np
from find_score import CLAIMED, found


def answers(vextract, sidecars):
    """Set, true angle and answer of every picture, folder by folder: answers have no folder."""
    for folder in dict.fromkeys(sidecar.parent for sidecar in sidecars):
        known = {}
        for sidecar in (sidecar for sidecar in sidecars if sidecar.parent == folder):
            told = json.loads(sidecar.read_text())
            known[told["file"]] = told["angle_deg"]
        for name, answer in found(vextract, folder, list(known)).items():
            yield folder.name, known[name], answer


def row(name, told):
    claimed = [(true, answer) for _, true, answer in told if answer.get("confidence", 0) >= CLAIMED and "angle_deg" in answer]
    if not claimed:
        return f"| {name} | {len(told)} | 0 | | | | | | |"
    off = np.abs([answer["angle_deg"] - true for true, answer in claimed])
    sd = np.array([answer["angle_sd_deg"] for _, answer in claimed])
    squares = sum("panel" not in answer for _, answer in claimed)
    errors = [np.median(off), np.quantile(off, 0.9), np.sqrt((off**2).mean())]
    cells = [len(told), len(claimed), *(f"{error:.2f}" for error in errors), f"{100 * (off < 2 * sd).mean():.0f}", f"{sd.mean():.2f}", squares]
    return f"| {name} | " + " | ".join(map(str, cells)) + " |"


def main():
    told = list(answers(Path(sys.argv[1]), [Path(sidecar) for sidecar in sys.argv[2:]]))
    print("| angle error, degrees | pictures | claimed | median | 90 % | root mean square | within 2 sd, % | mean sd | taken as square |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in dict.fromkeys(each[0] for each in told):
        print(row(name, [each for each in told if each[0] == name]))
    print(row("all", told))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Weights of the search for folds, fitted to pictures whose corners are known, as src/image/finding/weights.rs.

    find_fit.py TRUTH.json WEIGHED.ndjson > weights.rs      what find_pictures.py and `cargo bench --bench find -- FOLDER/*.tif` wrote
    find_fit.py TRUTH.json WEIGHED.ndjson charts            the same of `cargo bench --bench find -- charts FOLDER/*.tif`: offset and weights of charts

Two fits: a conditional logit over the hypotheses of each picture and "no fold", and boosted trees for the probability that all corners of a
refined candidate are within 3 % of a panel's side. The trees' numbers are calibrated on what each picture's best candidate gets from trees
that were fitted without that sheet's pictures; standard error has a table of what was said and what was.

The second fit's clues begin with the first one's odds, so that after the first the pictures are weighed again: run it until the logit stays.
"""

import json
import sys
from pathlib import Path

import numpy as np

RIGHT, NEAR = 0.03, 0.05  # a candidate is right, a hypothesis worth refining, of a panel's side
CHART_RIGHT, CHART_RIDGE = 0.35, 0.03  # of the distance from patch to patch
GROUPS = 5
TREES, DEPTH, RATE, BINS, LEAF, RIDGE = 120, 3, 0.06, 32, 15, 4.0
NAMINGS = [[0, 1, 2, 3, 4, 5], [1, 0, 3, 2, 5, 4], [0, 1, 4, 5, 2, 3], [1, 0, 5, 4, 3, 2]]


def corners(panels):
    """Crease ends, outer ends of one panel and of the other."""
    return np.array(panels[0] + panels[1][2:])


def area(q):
    (ax, ay), (bx, by) = q[0] - q[2], q[1] - q[3]
    return abs(ax * by - ay * bx) / 2


def error(found, true):
    """The furthest corner's distance, over the side of a panel."""
    size = np.sqrt((area(true[[0, 1, 2, 3]]) + area(true[[0, 1, 4, 5]])) / 2)
    return min(np.hypot(*(found[naming] - true).T).max() for naming in NAMINGS) / size


def of_charts(truth, weighed):
    """Offset and weights of what makes a chart's confidence: a logistic regression by Newton's method, hardly any weight being as likely as much."""
    truth, clues, right = json.loads(Path(truth).read_text()), [], []
    for line in Path(weighed).read_text().splitlines():
        seen = json.loads(line)
        if seen["chart"] is None:
            continue
        true = truth[Path(seen["image"]).name]["chart"]
        off = np.inf if true is None else np.hypot(*(np.array(seen["chart"]) - true).T).max() / np.sqrt(area(np.array(true)) / 24)
        clues.append([1, *seen["weighed"]])
        right.append(off <= CHART_RIGHT)
    clues, right = np.array(clues), np.array(right, float)
    weights, ridge = np.zeros(clues.shape[1]), CHART_RIDGE * np.array([0.01, *[1] * (clues.shape[1] - 1)])
    for _ in range(100):
        said = 1 / (1 + np.exp(-clues @ weights))
        curvature = clues.T @ (clues * (said * (1 - said))[:, None]) + np.diag(ridge)
        weights += np.linalg.solve(curvature, clues.T @ (right - said) - ridge * weights)
    return weights


def pictures(truth, weighed):
    """Per picture: its sheet, whether it shows a whole fold, and of hypotheses and candidates what was weighed and how far off they are."""
    truth = json.loads(Path(truth).read_text())
    for line in Path(weighed).read_text().splitlines():
        seen = json.loads(line)
        known = truth[Path(seen["image"]).name]
        true = None if known["corners"] is None else np.array(known["corners"])
        off = lambda fold: 9.0 if true is None else error(corners(fold["panels"]), true)
        sets = [(np.array([fold["weighed"] for fold in seen[kind]]), np.array([off(fold) for fold in seen[kind]])) for kind in ("hypotheses", "candidates")]
        yield {"sheet": Path(seen["image"]).name.split("-")[1], "kind": known["kind"], "fold": true is not None and known["whole"], "sets": sets}


def logit(groups, ridge=1.0, steps=1500):
    """Weights of the features of a picture's hypotheses, and of "no fold", by Adam."""
    features = groups[0][0].shape[1]
    every = np.concatenate([group[0] for group in groups])
    mean, spread = every.mean(0), every.std(0) + 1e-9
    longest = max(len(group[0]) for group in groups)
    shown = np.zeros((len(groups), longest + 1, features + 1))
    there, right = np.zeros(shown.shape[:2], bool), np.zeros(shown.shape[:2], bool)
    shown[:, -1, -1], there[:, -1] = 1, True
    for n, (weighed, off) in enumerate(groups):
        shown[n, : len(off), :-1] = (weighed - mean) / spread
        there[n, : len(off)], right[n, : len(off)] = True, off < NEAR
        right[n, -1] = not (off < NEAR).any()
    weights, first, second = np.zeros((3, features + 1))
    for k in range(steps):
        score = np.where(there, shown @ weights, -np.inf)
        likely = np.exp(score - score.max(1, keepdims=True))
        of_right = likely * right
        pull = likely / likely.sum(1, keepdims=True) - of_right / of_right.sum(1, keepdims=True)
        slope = (pull[..., None] * shown).sum((0, 1)) + ridge * np.append(weights[:-1], 0)
        first, second = 0.9 * first + 0.1 * slope, 0.99 * second + 0.01 * slope**2
        step = (first / (1 - 0.9 ** (k + 1))) / (np.sqrt(second / (1 - 0.99 ** (k + 1))) + 1e-8)
        weights = weights - 0.05 / (1 + k / 400) * step
    return weights[:-1] / spread, weights[-1] + (mean / spread) @ weights[:-1]


def boost(clues, right):
    """Trees of three questions each, and what is said before any."""
    base = np.log(right.mean() / (1 - right.mean()))
    bounds = [np.unique(np.quantile(column, np.linspace(0, 1, BINS + 1)[1:-1])) for column in clues.T]
    bins = np.stack([np.searchsorted(bound, column) for bound, column in zip(bounds, clues.T)], 1)
    said, trees = np.full(len(right), base), []
    for _ in range(TREES):
        likely = 1 / (1 + np.exp(-said))
        slope, curve = right - likely, likely * (1 - likely)
        node, questions = np.zeros(len(right), int), []
        for at in range(2**DEPTH - 1):
            inside = np.flatnonzero(node == at)
            best = (1e-9, 0, np.inf)
            total = slope[inside].sum(), curve[inside].sum()
            for k, bound in enumerate(bounds):
                if not len(bound) or len(inside) < 2 * LEAF:
                    continue
                sums = [np.cumsum(np.bincount(bins[inside, k], weight, len(bound) + 1))[:-1] for weight in (slope[inside], curve[inside], None)]
                gain = sums[0] ** 2 / (sums[1] + RIDGE) + (total[0] - sums[0]) ** 2 / (total[1] - sums[1] + RIDGE)
                gain = np.where((sums[2] >= LEAF) & (len(inside) - sums[2] >= LEAF), gain - total[0] ** 2 / (total[1] + RIDGE), 0)
                if gain.max() > best[0]:
                    best = (gain.max(), k, bound[gain.argmax()])
            questions.append(best[1:])
            node[inside] = 2 * at + np.where(clues[inside, best[1]] <= best[2], 1, 2)
        leaves = node - (2**DEPTH - 1)
        sums = [np.bincount(leaves, weight, 2**DEPTH) for weight in (slope, curve)]
        answers = RATE * sums[0] / (sums[1] + RIDGE)
        said = said + answers[leaves]
        trees.append((questions, answers))
    return base, trees


def say(model, clues):
    base, trees = model
    said = np.full(len(clues), base)
    for questions, answers in trees:
        node = np.zeros(len(clues), int)
        clue, bound = map(np.array, zip(*questions))
        for _ in range(DEPTH):
            node = 2 * node + np.where(clues[np.arange(len(clues)), clue[node]] <= bound[node], 1, 2)
        said += answers[node - (2**DEPTH - 1)]
    return said


def calibration(said, right):
    """Slope and offset by Newton's method."""
    design, weights = np.stack([said, np.ones_like(said)], 1), np.array([1.0, 0.0])
    for _ in range(30):
        likely = 1 / (1 + np.exp(-design @ weights))
        curve = (design * (likely * (1 - likely))[:, None]).T @ design + 1e-6 * np.eye(2)
        weights = weights + np.linalg.solve(curve, design.T @ (right - likely))
    return weights


def main():
    if sys.argv[3:] == ["charts"]:
        print(", ".join(f"{weight:.4g}" for weight in of_charts(*sys.argv[1:3])))
        return
    shown = list(pictures(*sys.argv[1:]))
    # what a cut picture shows of a fold is neither one nor none
    ranked = [one["sets"][0] for one in shown if one["fold"] or one["kind"].startswith("no ")]
    rank, no_fold = logit([one for one in ranked if len(one[1])])
    tried = [one for one in shown if len(one["sets"][1][1])]
    sheets = sorted({one["sheet"] for one in tried})
    group = {sheet: n % GROUPS for n, sheet in enumerate(sheets)}

    def fit(chosen):
        return boost(np.concatenate([one["sets"][1][0] for one in chosen]), np.concatenate([one["sets"][1][1] for one in chosen]) < RIGHT)

    picks = []
    for n in range(GROUPS):
        model = fit([one for one in tried if group[one["sheet"]] != n])
        for one in (one for one in tried if group[one["sheet"]] == n):
            clues, off = one["sets"][1]
            said = say(model, clues)
            picks.append((said.max(), off[said.argmax()] < RIGHT, one["kind"], one["sheet"], off[said.argmax()]))
    said, right = np.array([pick[0] for pick in picks]), np.array([pick[1] for pick in picks])
    slope, offset = calibration(said, right)
    likely = 1 / (1 + np.exp(-slope * said - offset))
    for low, high in zip(edges := [0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.99, 1.001], edges[1:]):
        inside = (likely >= low) & (likely < high)
        if inside.any():
            print(f"{low:.2f} to {high:.2f}: {inside.sum()}, said {likely[inside].mean():.3f}, was {right[inside].mean():.3f}", file=sys.stderr)
    for p, pick in sorted(zip(likely, picks), key=lambda pair: -pair[0]):
        if p > 0.9 and not pick[1]:
            print(f"wrong at {p:.3f}: {pick[3]} {pick[2]}, off by {pick[4]:.3f}", file=sys.stderr)
    base, trees = fit(tried)
    number = lambda x: "f64::INFINITY" if np.isinf(x) else repr(float(f"{x:.5g}"))
    print("//! Fitted weights: made by `benches/find_fit.py` from rendered photographs and composites of them, not to be\n//! edited.")
    print("\n#![allow(clippy::excessive_precision, clippy::approx_constant)] // what was fitted\n")
    print("use super::features::FEATURES;\nuse super::tree::Tree;\n")
    print("/// Weights of the features of a hypothesis.\n#[rustfmt::skip]\npub(super) const RANK: [f64; FEATURES] = [")
    for n in range(0, len(rank), 10):
        print(f"    {', '.join(map(number, rank[n:n + 10]))},")
    print("];")
    print(f"/// The score of \"no fold\".\npub(super) const NO_FOLD: f64 = {number(no_fold)};")
    print(f"/// What is said before any tree, and how sums are made log odds.\npub(super) const BASE: f64 = {number(base)};")
    print(f"pub(super) const SLOPE: f64 = {number(slope)};\npub(super) const OFFSET: f64 = {number(offset)};")
    print(f"#[rustfmt::skip]\npub(super) static TREES: [Tree; {len(trees)}] = [")
    for questions, answers in trees:
        asked = [f"({clue}, {number(bound)})" for clue, bound in questions]
        print(f"    Tree {{ questions: [{', '.join(asked[:3])},\n        {', '.join(asked[3:])}],")
        print(f"        answers: [{', '.join(map(number, answers))}] }},")
    print("];")


if __name__ == "__main__":
    main()

"""Panels that are not divided: the limit of ever finer patches of even radiance."""
import numpy as np

from fold import Fold

# A crease so many times as long as the panels are deep has no end.
LONG = 100
# Halvings of the first row towards the crease and of the last towards the outer edge, where light changes fast.
HALVINGS = 10


def undivided(angle_deg, edges, cols, light, reflectance):
    """Means over facets: panel, row, column. Both panels have the row `edges`, in units of a facet's width.

    Errors of patches fall by four with each halving of the rows, and nearly so with each of the columns.
    """
    assert np.array_equal(*edges)
    facet_rows, endless = edges[0], cols >= LONG * edges[0][-1]

    def means(parts, wide):
        ends = divided(facet_rows, parts)
        patches = [ends * wide, ends * wide]
        fold = Fold.without_end(angle_deg, patches) if endless else Fold.of_facets(angle_deg, patches, cols * wide)
        return np.array([pooled(panel, ends, facet_rows, cols) for panel in fold.irradiance(light, reflectance)])

    coarse = means(4, 8)
    deeper = (means(8, 8) - coarse) * 4 / 3
    if endless:
        return coarse + deeper
    wider, widest = means(4, 16), means(4, 32)
    first, second = wider - coarse, widest - wider
    ratio = np.clip(second / np.where(first == 0, 1, first), 0, 0.7)
    return widest + second * ratio / (1 - ratio) + deeper


def divided(facet_rows, parts):
    """Ends of rows, `parts` of each facet row and of each of what halving it towards the crease and the outer edge leaves."""
    halves = 0.5 ** np.arange(1, HALVINGS + 1)
    inner = facet_rows[0] + halves * (facet_rows[1] - facet_rows[0])
    outer = facet_rows[-1] - halves * (facet_rows[-1] - facet_rows[-2])
    ends = np.unique(np.concatenate([facet_rows, inner, outer]))
    between = [a + (b - a) * np.arange(parts) / parts for a, b in zip(ends, ends[1:])]
    return np.concatenate([*between, facet_rows[-1:]])


def pooled(panel, ends, facet_rows, cols):
    """Means over facets by area."""
    first = np.searchsorted(ends, facet_rows[:-1])
    rows = np.add.reduceat(panel * np.diff(ends)[:, None], first) / np.diff(facet_rows)[:, None]
    return rows.reshape(len(rows), cols, -1).mean(axis=2)

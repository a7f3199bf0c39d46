"""Light on a fold by NumPy alone, for comparison with vfold: nothing here is how vfold does it.

Form factors come from the double integral around both facets (E. M. Sparrow, *J. Heat Transfer* 85 (1963), p. 81),

    2 pi A F = - sum over pairs of edges of +- cos(angle of the edges) times the integral of ln(distance) along both,

bounces by conjugate gradients. Facets of a row are shifts of each other along the crease, so that sums over columns are
convolutions. Lengths are in units of a facet's width.
"""
import numpy as np


class Fold:
    """Two panels from what their facets exchange: shift along the crease, row of one panel, row of the other."""

    def __init__(self, between, edges):
        self.heights = [np.diff(e) for e in edges]
        self.cols = len(between)
        self.spectrum = np.empty((self.cols + 1, *between.shape[1:]))
        for row in range(between.shape[1]):
            near = between[:, row]
            self.spectrum[:, row] = np.fft.rfft(np.concatenate([near, 0 * near[:1], near[:0:-1]]), axis=0).real

    @classmethod
    def of_facets(cls, angle_deg, edges, cols):
        """`cols` facets along the crease, whose rows end `edges[panel]` from it."""
        return cls(exchange(np.radians(angle_deg), *edges, cols), edges)

    @classmethod
    def without_end(cls, angle_deg, edges):
        """Rows along a crease without end, by crossed strings (H. C. Hottel, in *Heat Transmission* (1954), chapter 4)."""
        return cls(-corners(distance(np.radians(angle_deg), *edges))[None] / 2, edges)

    def received(self, leaving):
        """Irradiance of both panels from what leaves the other's facets, each row by column."""
        return [
            self._carried(self.spectrum, leaving[1]) / self.heights[0][:, None],
            self._carried(self.spectrum.transpose(0, 2, 1), leaving[0]) / self.heights[1][:, None],
        ]

    def _carried(self, spectrum, leaving):
        waves = np.fft.rfft(leaving, 2 * self.cols).T
        carried = spectrum @ np.stack([waves.real, waves.imag], axis=2)
        return np.fft.irfft((carried[..., 0] + 1j * carried[..., 1]).T, 2 * self.cols)[:, : self.cols]

    def irradiance(self, direct, reflectance, residual=1e-13):
        """Solves E = E0 + r K E: the irradiance of both panels, each row by column, that of the light being `direct`."""
        area = [np.tile(h[:, None], self.cols) for h in self.heights]
        inner = lambda a, b: sum(np.sum(w * x * y) for w, x, y in zip(area, a, b))
        found = [np.full_like(w, e) for w, e in zip(area, direct)]
        step = rest = [reflectance * e for e in self.received(found)]
        size, least = inner(rest, rest), residual**2 * inner(found, found)
        for _ in range(1000):
            if size <= least:
                return found
            kept = [s - reflectance * e for s, e in zip(step, self.received(step))]
            length = size / inner(step, kept)
            found = [e + length * s for e, s in zip(found, step)]
            rest = [x - length * k for x, k in zip(rest, kept)]
            size, before = inner(rest, rest), size
            step = [x + size / before * s for x, s in zip(rest, step)]
        raise ArithmeticError("conjugate gradients do not converge")


def exchange(angle, edges0, edges1, cols):
    """Area times form factor of facets: shift along the crease, row of one panel, row of the other."""
    potential = lambda shift: (
        corners(twice_along(shift, distance(angle, edges0, edges1)))
        - np.cos(angle) * away_from_crease(shift, angle, edges0, edges1)
    )
    found = np.empty((cols, len(edges0) - 1, len(edges1) - 1))
    here, beyond = potential(0), potential(1)
    before = beyond
    for shift in range(cols):
        found[shift] = (2 * here - before - beyond) / (2 * np.pi)
        before, here, beyond = here, beyond, potential(shift + 2)
    return found


def distance(angle, edges0, edges1):
    """Between lines along the crease."""
    s, t = edges0[:, None], edges1[None, :]
    return np.sqrt((s - t) ** 2 + 4 * s * t * np.sin(angle / 2) ** 2)


def corners(value):
    return np.diff(np.diff(value, axis=0), axis=1)


def twice_along(shift, q):
    """ln of the distance between points `shift` apart on lines q apart, integrated twice over the shift; but for what q alone
    adds, which differences of shifts lose anyway, and digits with it."""
    square = np.maximum(q**2, 1e-300)
    log = shift**2 * np.log(np.maximum(shift**2 + square, 1e-300)) - square * np.log1p(shift**2 / square)
    return log / 4 + shift * q * np.arctan2(shift, q) - 0.75 * shift**2


def away_from_crease(shift, angle, edges0, edges1):
    """ln of the distance between points of two sides `shift` apart, integrated over both."""
    x, weight = nodes(shift / max(np.diff(edges0).max(), np.diff(edges1).max()))
    rows = 1 + 2**16 // (len(x) * len(edges1))  # at a time, so that they stay in the cache
    found = []
    for first in range(0, len(edges0) - 1, rows):
        ends = edges0[first : first + rows + 1]
        height = np.diff(ends)[:, None]
        s = ends[:-1, None] + height * x
        h = np.sqrt(shift**2 + (s * np.sin(angle)) ** 2)[..., None]
        w = edges1 - s[..., None] * np.cos(angle)
        once = w * np.log(np.maximum(w**2 + h**2, 1e-300)) / 2 - w + h * np.arctan2(w, h)
        found.append(np.einsum("spt,p->st", np.diff(once, axis=2), weight) * height)
    return np.concatenate(found)


def nodes(apart):
    """Gauss-Legendre on [0, 1], of sides near each other in parts that halve towards both ends, where the distance may vanish."""
    x, w = np.polynomial.legendre.leggauss(5 if apart > 8 else 12)
    x, w = (x + 1) / 2, w / 2
    if apart > 0.5:
        return x, w
    ends = np.concatenate([[0], 0.5 ** np.arange(20, 0, -1.0)])
    half = np.concatenate([a + (b - a) * x for a, b in zip(ends, ends[1:])])
    weight = np.concatenate([(b - a) * w for a, b in zip(ends, ends[1:])])
    return np.concatenate([half, 1 - half]), np.concatenate([weight, weight])

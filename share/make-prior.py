#!/usr/bin/env python3
"""Writes `prior.npy` and `prior.txt` of this folder: the prior of `vestimate`, classes of spectra as Gaussians of logit.

    python3 -m venv venv && venv/bin/pip install numpy==2.2.6
    venv/bin/python share/make-prior.py

Painted chips are the 1269 measured ones of Munsell (`munsell1269.npy`) in the classes of `munsell1269-classes.txt`. All other kinds are
generated: absorption bands and edges that are published, in amounts drawn at random, made a reflectance by the law that holds for the kind.
No measured set but Munsell's goes in, so that all others can judge.

`prior.npy`: class by (mean, then factors) by wavelength, 380..780 nm by 5, half precision; the covariance of a class is the sum of its
factors' squares. The last class is all spectra together. `prior.txt`: name and share of each class.

Laws: P. Kubelka, F. Munk (1931), thick sheets and thin layers; J. L. Saunderson, JOSA 32 (1942), p. 727, the surface of paint and plastics;
J. A. C. Yule, W. J. Nielsen (1951) with the coverages of M. E. Demichel, prints.
"""

from math import factorial
from pathlib import Path

import numpy as np

SHARE = Path(__file__).parent
NM = np.arange(380.0, 781.0, 5.0)
# Reflectances are kept that far inside 0 and 1, as in src/estimate/gaussian.rs.
MARGIN = 2e-3
# Factors of a class; what they leave out is below what src/estimate/prior.rs adds.
RANK = 16
MUNSELL_SHARE = 0.79
# Shares of classes are raised to that power: how often spectra are met is a guess, and nobody folds paint charts alone.
SHARE_POWER = 0.7
# What is of no kind: any smooth spectrum, of that standard deviation in logit, alike within so many nm.
ANY_SHARE, ANY_SD, ANY_NM = 0.01, 1.2, 40

# ---- laws


def band(centre_nm, width_per_cm, skew=0.0):
    """An absorption band, Gaussian in wavenumber, by its full width at half of its height."""
    off = (1e7 / NM - 1e7 / centre_nm) / width_per_cm
    return np.exp(-4 * np.log(2) * (off / np.where(off > 0, 1 + skew, 1 - skew)) ** 2)


def edge(centre_nm, width_nm):
    """An absorption edge, Urbach's exponential in energy towards the red."""
    energy, gap = 1239.84 / NM, 1239.84 / centre_nm
    return 1 / (1 + np.exp(-(energy - gap) / (width_nm * 1239.84 / centre_nm**2)))


def thick(ks):
    """Kubelka and Munk: reflectance of a thick layer of absorption over scattering `ks`."""
    return 1 + ks - np.sqrt(ks * ks + 2 * ks)


def ks_of(reflectance):
    return (1 - reflectance) ** 2 / (2 * reflectance)


def thin(ks, scattering):
    """Kubelka and Munk: reflectance of a layer that scatters `scattering` in all, over nothing."""
    a = 1 + ks
    b = np.sqrt(np.maximum(a * a - 1, 1e-9))
    depth = np.minimum(b * scattering, 50)
    return np.sinh(depth) / (a * np.sinh(depth) + b * np.cosh(depth))


# PROSPECT's leaf: refractive index, and the angle to the normal, degrees, within which light meets the uppermost surface.
LEAF_INDEX, LEAF_CONE_DEG = 1.45, 40


def transmitted(index, cone_deg):
    """Fresnel: share of the light from within a cone, diffuse there, that a surface lets in."""
    nodes, weights = np.polynomial.legendre.leggauss(64)
    # uniform in the square of the sine, as diffuse light is
    squared = (1 + nodes) / 2 * np.sin(np.radians(cone_deg)) ** 2
    cosine, inside = np.sqrt(1 - squared), np.sqrt(1 - squared / index**2)
    across = (cosine - index * inside) / (cosine + index * inside)
    along = (index * cosine - inside) / (index * cosine + inside)
    return weights @ (1 - (across**2 + along**2) / 2) / 2


def plates(absorption, layers):
    """PROSPECT (S. Jacquemoud, F. Baret, 1990): reflectance of a leaf of so many plates, `absorption` of all of them together."""
    nodes, weights = np.polynomial.legendre.leggauss(48)
    cosine = (1 + nodes[:, None]) / 2
    through = weights @ (cosine * np.exp(-absorption / layers / cosine))
    first, diffuse = transmitted(LEAF_INDEX, LEAF_CONE_DEG), transmitted(LEAF_INDEX, 90)
    out = diffuse / LEAF_INDEX**2
    kept = (1 - out) * through
    top_down = first * through * out / (1 - kept**2)
    top = 1 - first + kept * top_down
    down = diffuse * through * out / (1 - kept**2)
    back = 1 - diffuse + kept * down
    # those beneath the first, after G. G. Stokes (1862)
    root = np.sqrt((1 + back + down) * (1 + back - down) * (1 - back + down) * (1 - back - down))
    a = (1 + back**2 - down**2 + root) / (2 * back)
    b = ((1 - back**2 + down**2 + root) / (2 * down)) ** (layers - 1)
    beneath = a * (b**2 - 1) / (a**2 * b**2 - 1)
    return top + top_down * beneath * down / (1 - beneath * back)


def coated(reflectance, inside, gloss):
    """Saunderson: under a surface of refractive index 1.5, which keeps `inside` of the light in; `gloss` of its reflection is seen."""
    return gloss * 0.04 + 0.96 * (1 - inside) * reflectance / (1 - inside * reflectance)


def veiled(reflectance, most, draw):
    """Some light comes back from the surface without having met a dye."""
    veil = draw.uniform(0, most)
    return veil + (1 - veil) * reflectance


def log_uniform(draw, least, most):
    return np.exp(draw.uniform(np.log(least), np.log(most)))


# ---- cloth: dyes on white fibres

# Where the first line of dyes of each hue lies, nm, and how often they are met (Colour Index; H. Zollinger, *Color Chemistry*).
DYES = {
    "yellow": (385, 440, 0.22),
    "orange": (440, 500, 0.10),
    "red": (490, 555, 0.25),
    "violet": (545, 590, 0.10),
    "blue": (575, 640, 0.25),
    "turquoise": (620, 680, 0.08),
}


def dye(draw, hue=None):
    """A line of 1100 to 2600 cm-1 (phthalocyanines 700 to 1500) with the steps of a vibration above it, 1100 to 1500 cm-1 apart and as high as
    Franck and Condon have them, so that the flank towards the red is the steep one, and the next transition 6500 to 11000 cm-1 above it."""
    hue = hue or draw.choice(list(DYES), p=[share for *_, share in DYES.values()])
    first, last, _ = DYES[hue]
    energy, step = 1e7 / draw.uniform(first, last), draw.uniform(1100, 1500)
    if hue == "turquoise":
        line, coupling = draw.uniform(700, 1500), draw.uniform(0.1, 0.5)
    else:
        line, coupling = log_uniform(draw, 1100, 2600), draw.uniform(0.2, 1.2)
    above = lambda more, width: band(1e7 / (energy + more), width)
    main = sum(coupling**n / factorial(n) * above(n * step, line * (1 + 0.1 * n)) for n in range(4))
    return main / main.max() + draw.uniform(0.05, 0.6) * above(draw.uniform(6500, 11000), draw.uniform(4000, 7000))


def white_cloth(draw):
    """K/S of bleached or raw fibres, more towards the violet."""
    fall = draw.uniform(0, 0.5) * draw.choice([1, 1, 0.3])
    violet = 1 + 30 * fall * np.exp(-(NM - 380) / draw.uniform(30, 90))
    return ks_of(draw.uniform(0.72, 0.92)) * violet * (NM / 550) ** draw.uniform(-2, 0.5)


def textile(draw):
    """One to three dyes, pale to full; one in seven a black or navy of three."""
    count, depth = draw.choice([1, 2, 3], p=[0.35, 0.35, 0.3]), log_uniform(draw, 0.08, 30)
    if draw.random() < 0.15:
        count, depth = 3, log_uniform(draw, 8, 40)
    hues = draw.permutation(["yellow", "red", "blue"])[:count] if draw.random() < 0.6 else [None] * count
    dyes = zip(draw.dirichlet(np.ones(count)), hues, strict=True)
    return veiled(thick(white_cloth(draw) + depth * sum(share * dye(draw, hue) for share, hue in dyes)), 0.03, draw)


# ---- paint and plastics: pigments in a binder


def pigment(draw):
    """Absorption of a pigment; bands from the literature on artists' and industrial pigments (*Artists' Pigments*, vols. 1 to 4; W. Herbst,
    K. Hunger, *Industrial Organic Pigments*), with a scatter of a few nm between makes."""
    near = lambda centre, sd=5: centre + draw.normal(0, sd)
    kinds = {
        # cadmium yellow to red, bismuth vanadate
        "edge": (0.15, lambda: edge(draw.uniform(440, 640), draw.uniform(3, 9))),
        # azo yellow to perylene red
        "organic": (
            0.18,
            lambda: edge(draw.uniform(450, 620), draw.uniform(6, 16))
            * (1 + draw.uniform(-0.3, 0.3) * band(near(480, 40), 4000))
            + 0.002,
        ),
        # haematite: pair transition at 530 nm, ligand field at 660 and 860
        "iron red": (
            0.1,
            lambda: edge(near(575, 6), draw.uniform(10, 18))
            + 0.12 * band(near(660, 8), 2200)
            + 0.04 * band(860, 3000)
            + 0.25 * band(near(530), 2500),
        ),
        # goethite
        "iron yellow": (
            0.12,
            lambda: edge(near(515, 7), draw.uniform(14, 24)) + 0.06 * band(near(650, 8), 2000) + 0.05 * band(930, 3500),
        ),
        # S3- radical
        "ultramarine": (0.06, lambda: band(near(600), 4200) + 0.02 * band(390, 4000) + 0.02),
        # tetrahedral Co2+, three bands
        "cobalt blue": (
            0.06,
            lambda: 0.75 * band(near(545, 3), 1600)
            + 0.95 * band(near(588, 3), 1500)
            + band(near(630, 3), 1500)
            + 0.02
            + 0.15 * band(390, 4500),
        ),
        "phthalocyanine blue": (
            0.1,
            lambda: 0.9 * band(near(615), 2400)
            + 0.8 * band(near(700, 8), 1900)
            + 0.3 * band(near(560), 3000)
            + 0.55 * band(345, 5200)
            + 0.01,
        ),
        "phthalocyanine green": (
            0.08,
            lambda: 0.9 * band(near(650, 6), 2300)
            + 0.8 * band(near(735, 10), 1900)
            + 0.3 * band(near(590), 3000)
            + 0.7 * band(near(390, 8), 4200)
            + 0.01,
        ),
        "quinacridone": (
            0.05,
            lambda: 0.8 * band(near(565), 1400)
            + 0.9 * band(near(532), 1700)
            + 0.6 * band(near(498), 2600)
            + 0.25 * band(380, 6000)
            + 0.005,
        ),
        # Cr3+ in oxide or viridian
        "chromium green": (
            0.04,
            lambda: 0.8 * band(near(600), 3200) + 0.9 * band(near(450, 8), 4200) + 0.5 * band(380, 5000) + 0.1,
        ),
        "carbon black": (0.03, lambda: np.ones_like(NM)),
        "umber": (0.03, lambda: (NM / 450) ** -draw.uniform(2.5, 5) + 0.3 * edge(near(560, 20), 25)),
    }
    shares = [share for share, _ in kinds.values()]
    return kinds[draw.choice(list(kinds), p=shares)][1]()


def rutile(draw):
    """Titanium white, K/S: an edge with which the 60 brightest chips of Munsell are white to 0.004 from 380 to 460 nm."""
    return log_uniform(draw, 0.9, 2.6) * edge(draw.normal(388, 1.5), draw.uniform(4.6, 5.7))


def painted(draw, tint, grey):
    """One to three pigments in titanium white; one in three greyed with black."""
    count, depth = draw.choice([1, 2, 3], p=[0.4, 0.4, 0.2]), log_uniform(draw, *tint)
    ks = ks_of(draw.uniform(0.9, 0.97)) + rutile(draw)
    ks = ks + depth * sum(share * pigment(draw) for share in draw.dirichlet(np.ones(count)))
    if draw.random() < 0.35:
        ks = ks + log_uniform(draw, *grey)
    return coated(thick(ks * (NM / 550) ** draw.uniform(-0.3, 1.0)), draw.uniform(0.4, 0.6), draw.uniform(0, 0.6))


def paint(draw):
    """Pale to full."""
    return painted(draw, (0.05, 25), (0.01, 1.5))


def white(draw):
    """White to pale."""
    return painted(draw, (0.0005, 0.1), (0.0001, 0.1))


# ---- plants


# Chlorophyll a and b in leaves, cm2/ug: height, centre in nm and width in 1/cm of bands, fitted to the spectra of two models of leaves, to
# 0.0025 from 400 to 780 nm and 0.001 in the red: PROSPECT-5 (J.-B. Feret and others, 2008) and PROSPECT-D (the same, 2017), as they are in
# the Python package prosail 2.0.5.
CHLOROPHYLL = (
    (
        (0.0239, 681, 400),
        (0.0079, 668, 280),
        (0.029, 667, 1000),
        (0.0212, 630, 2010),
        (0.0137, 569, 2630),
        (0.0366, 482, 1770),
        (0.0702, 437, 2300),
        (0.0346, 409, 1390),
    ),
    (
        (0.0093, 681, 250),
        (0.0473, 675, 580),
        (0.0227, 652, 1600),
        (0.0061, 651, 330),
        (0.0177, 593, 2530),
        (0.0358, 478, 1850),
        (0.0503, 441, 1590),
        (0.0708, 407, 2730),
    ),
)


def chlorophyll(draw):
    """Between the two models, each band a quarter higher or lower: leaves differ by more than the models do."""
    some = lambda height: height * np.exp(0.25 * draw.normal())
    first, second = (sum(some(height) * band(*where) for height, *where in bands) for bands in CHLOROPHYLL)
    return second + draw.random() * (first - second)


def carotenoids(draw):
    """The three vibrational bands of lutein and carotene in leaves, cm2/ug."""
    off = draw.uniform(-4, 4)
    bands = (1, 488, 1300), (1.1, 457, 1500), (0.85, 430, 1700), (0.4, 400, 3500)
    return 0.09 * sum(height * band(centre + off, width) for height, centre, width in bands)


def anthocyanins(draw):
    return band(draw.uniform(525, 560), 3600, 0.1) + 0.2 * band(400, 5000)


def leaf(draw):
    """Green, yellow, red and dry: pigments in ug/cm2 in a leaf of one to three plates, or in thick parts of a plant."""
    kind = draw.choice(["green", "yellow", "red", "dry"], p=[0.6, 0.15, 0.1, 0.15])
    amounts = {"green": (8, 90), "red": (1, 40)}
    green = log_uniform(draw, *amounts.get(kind, (0.2, 8)))
    yellow = green * draw.uniform(0.12, 0.35) + (log_uniform(draw, 1, 15) if kind in ("yellow", "red") else 0)
    absorption = green * chlorophyll(draw) + yellow * carotenoids(draw) + 0.03
    if kind == "red" or draw.random() < 0.1:
        absorption = absorption + log_uniform(draw, 0.3, 6) * anthocyanins(draw)
    brown = log_uniform(draw, 0.5, 4) if kind == "dry" else log_uniform(draw, 0.02, 0.4)
    absorption = absorption + brown * np.exp(-(NM - 450) / draw.uniform(55, 110))
    if draw.random() < 0.3:
        return veiled(thick(absorption * draw.uniform(0.1, 1)), 0.05, draw)
    return veiled(plates(absorption, draw.uniform(1, 3)), 0.05, draw)


def flower(draw):
    """Anthocyanins, carotenoids, both, the blue of complexed delphinidin, or none."""
    kind = draw.choice(["red", "yellow", "both", "blue", "white"], p=[0.35, 0.25, 0.15, 0.15, 0.1])
    absorption = 0.02 + log_uniform(draw, 0.01, 0.3) * np.exp(-(NM - 400) / draw.uniform(20, 60))
    if kind in ("red", "both"):
        absorption = absorption + log_uniform(draw, 0.2, 12) * anthocyanins(draw)
    if kind in ("yellow", "both"):
        absorption = absorption + log_uniform(draw, 4, 240) * carotenoids(draw)
    if kind == "blue":
        delphinidin = band(draw.uniform(560, 585), 2600) + 0.9 * band(draw.uniform(610, 630), 1600)
        absorption = absorption + log_uniform(draw, 0.3, 8) * (delphinidin + 0.35 * band(draw.uniform(530, 545), 2600))
    if draw.random() < 0.4:
        absorption = absorption + log_uniform(draw, 0.2, 4) * chlorophyll(draw)
    scattering = draw.uniform(1.2, 4)
    return veiled(thin(absorption * 1.5 / scattering, scattering), 0.03, draw)


def earth(draw):
    """Soil, bark, wood, straw, fur, the skins of fruit: the exponential of humus, tannin and melanin, with iron oxides and what plants have."""
    ks = log_uniform(draw, 0.1, 12) * np.exp(-(NM - 400) / draw.uniform(50, 220)) + log_uniform(draw, 0.005, 0.6)
    if draw.random() < 0.6:
        iron = edge(draw.normal(530, 15), 22) + 0.08 * band(draw.normal(660, 10), 2200)
        ks = ks + log_uniform(draw, 0.03, 2) * iron
    if draw.random() < 0.25:
        ks = ks + log_uniform(draw, 0.4, 12) * chlorophyll(draw)
    if draw.random() < 0.2:
        ks = ks + log_uniform(draw, 0.05, 2) * anthocyanins(draw)
    if draw.random() < 0.2:
        ks = ks + log_uniform(draw, 0.4, 16) * carotenoids(draw)
    return veiled(thick(ks), 0.03, draw)


# ---- skin and hair


def blood(oxygenation):
    """Haemoglobin, 1/(mM cm): bands at the places and of the heights of S. Prahl's table."""
    with_oxygen = (500, 415, 1650), (53, 542, 1250), (55, 576.5, 700), (24, 560, 3500), (28, 350, 5000), (0.6, 920, 3000)
    without = (520, 432, 1500), (54, 555, 1700), (14, 590, 2200), (35, 400, 4500), (1.2, 758, 800)
    with_oxygen = 0.35 + sum(height * band(*where) for height, *where in with_oxygen)
    without = 3.2 * np.exp(-(np.maximum(NM, 600) - 600) / 45) + sum(height * band(*where) for height, *where in without)
    return oxygenation * with_oxygen + (1 - oxygenation) * without


def skin(draw):
    """Melanin above blood: absorption and scattering of S. L. Jacques, *Skin optics* (1998); 150 g/l of haemoglobin in blood."""
    melanin = (0.005 + 0.43 * draw.beta(0.9, 2.5)) * 6.6e11 * NM**-3.33
    epidermis = np.exp(-2 * melanin * draw.uniform(0.006, 0.012) * draw.uniform(0.6, 1.2))
    absorption = log_uniform(draw, 0.002, 0.08) * 2.303 * blood(draw.uniform(0.4, 0.95)) * 1000 * 150 / 64500
    absorption = absorption + 0.244 + 85.3 * np.exp(-(NM - 154) / 66.2) * draw.uniform(0.5, 2)
    absorption = absorption + draw.uniform(0, 0.6) * band(460, 4500)
    scattering = 2e5 * NM**-1.5 + 2e12 * NM**-4.0
    dermis = thick(2 * absorption / (0.75 * scattering) * draw.uniform(0.8, 1.3))
    return veiled(epidermis * dermis, 0.03, draw)


def hair(draw):
    ks = log_uniform(draw, 0.2, 40) * (NM / 550) ** -draw.uniform(1.5, 5) + log_uniform(draw, 0.02, 1.0)
    return veiled(thick(ks), 0.03, draw)


# ---- papers and prints


def paper(draw):
    """Bleached to kraft: the exponential of lignin, the edge of filler."""
    ks = ks_of(draw.uniform(0.5, 0.93)) + log_uniform(draw, 0.002, 0.9) * np.exp(-(NM - 420) / draw.uniform(40, 150))
    ks = ks + log_uniform(draw, 0.003, 0.3) * edge(draw.uniform(390, 410), draw.uniform(4, 12))
    return np.clip(thick(ks), 0, 0.97)


def printed(draw):
    """Halftones of process inks on paper or cloth; densities of solids 0.8 to 1.6, n of Yule and Nielsen 1.3 to 2.5."""
    sheet = paper(draw) if draw.random() < 0.5 else thick(white_cloth(draw))
    n = draw.uniform(1.3, 2.5)
    near = lambda centre, sd=4: centre + draw.normal(0, sd)
    cyan = band(near(625), 2300) + 0.75 * band(near(690, 6), 2000) + 0.3 * band(near(570), 3500) + 0.12 * band(400, 5000)
    magenta = 0.95 * band(near(570), 1700) + band(near(535), 2400) + 0.35 * band(near(490), 3500) + 0.2 * band(400, 5500)
    yellow = band(near(432, 6), 3600, 0.1) + 0.45 * band(near(470, 5), 2500) + 0.5 * band(395, 4000)
    black = 1 + 0.05 * (NM - 550) / 150 * draw.normal()
    inks = [ink * draw.uniform(*solid) for ink, solid in
            ((cyan, (0.8, 1.6)), (magenta, (0.9, 1.6)), (yellow, (0.9, 1.5)), (black, (1.2, 1.8)))]
    cover = draw.beta(0.7, 0.9, 4) * np.array([1, 1, 1, 0.6]) * draw.uniform(0.2, 1)
    if draw.random() < 0.25:
        cover[draw.integers(0, 3)] = 0
    if draw.random() < 0.5:
        cover[3] = 0
    root = 0
    for overprint in range(16):
        here = [(overprint >> ink) & 1 for ink in range(4)]
        share = np.prod([c if on else 1 - c for c, on in zip(cover, here, strict=True)])
        density = sum(ink for ink, on in zip(inks, here, strict=True) if on)
        root = root + share * (sheet * 10.0**-density) ** (1 / n)
    return veiled(root**n, 0.02, draw)


# Kind: how many spectra, in how many classes, its share beside Munsell's chips.
KINDS = {
    textile: (2000, 8, 0.20),
    paint: (1200, 6, 0.30),
    white: (400, 1, 0.12),
    leaf: (1200, 5, 0.18),
    flower: (600, 2, 0.05),
    earth: (900, 3, 0.60),
    skin: (500, 1, 0.18),
    hair: (300, 1, 0.12),
    paper: (600, 2, 0.12),
    printed: (1000, 4, 0.10),
}

# ---- classes

# As src/estimate/classes.rs: shrinkage of a class towards its kind, coordinates in which classes are told apart.
SHRINKAGE, SHRUNK_VARIANCE, COORDINATES, PASSES = 5, 0.1, 15, 40


def logit(reflectance):
    reflectance = np.clip(reflectance, MARGIN, 1 - MARGIN)
    return np.log(reflectance / (1 - reflectance))


def classes(logits, count, draw):
    """Class of each row: a Gaussian mixture by expectation maximisation, from k-means."""
    if count == 1:
        return np.zeros(len(logits), int)
    seen = logits[:, 4:65]
    axes = np.linalg.eigh(np.cov(seen.T, bias=True))[1][:, ::-1][:, :COORDINATES]
    points = (seen - seen.mean(0)) @ axes
    all_together = np.cov(points.T, bias=True)
    apart = np.abs(NM[4:65, None] - NM[None, 4:65]) * np.sqrt(5) / 60
    spread = axes.T @ (0.0625 * (1 + apart + apart**2 / 3) * np.exp(-apart)) @ axes
    centres = points[[draw.integers(len(points))]]
    while len(centres) < count:
        near = ((points[:, None] - centres) ** 2).sum(2).min(1)
        centres = np.vstack([centres, points[draw.choice(len(points), p=near / near.sum())]])
    for _ in range(10):
        label = ((points[:, None] - centres) ** 2).sum(2).argmin(1)
        centres = np.array([points[label == k].mean(0) if (label == k).any() else centres[k] for k in range(count)])
    member = np.eye(count)[label]
    for _ in range(PASSES):
        log = np.empty_like(member)
        for k, weight in enumerate(member.T):
            total = weight.sum() + 1e-9
            off = points - weight @ points / total
            own = (off * weight[:, None]).T @ off
            shrunk = (own + all_together * SHRINKAGE * SHRUNK_VARIANCE) / (total + SHRINKAGE) + spread
            factor = np.linalg.cholesky(shrunk)
            square = (np.linalg.solve(factor, off.T) ** 2).sum(0)
            log[:, k] = np.log(total) - np.log(np.diag(factor)).sum() - square / 2
        member = np.exp(log - log.max(1, keepdims=True))
        member /= member.sum(1, keepdims=True)
    return member.argmax(1)


def gaussian(logits, of_kind):
    """Mean and factors of a class, drawn towards its kind."""
    own = np.cov(logits.T, bias=True) * len(logits) + of_kind * SHRINKAGE * SHRUNK_VARIANCE
    return factored(logits.mean(0), own / (len(logits) + SHRINKAGE))


def factored(mean, covariance):
    """Mean and factors, 1 + RANK rows."""
    values, vectors = np.linalg.eigh(covariance)
    factors = (vectors * np.sqrt(np.maximum(values, 0)))[:, ::-1][:, :RANK].T
    # The sign of an eigenvector is nobody's choice.
    signs = np.sign(factors[np.arange(RANK), np.abs(factors).argmax(1)])
    return np.vstack([mean, factors * signs[:, None]])


def main():
    chips = logit(np.load(SHARE / "munsell1269.npy") / 50_000)
    kinds = [("munsell", chips, np.loadtxt(SHARE / "munsell1269-classes.txt", dtype=int), MUNSELL_SHARE)]
    total = sum(share for *_, share in KINDS.values())
    for n, (kind, (count, parts, share)) in enumerate(KINDS.items()):
        draw = np.random.default_rng([1, n])
        spectra = logit(np.array([kind(draw) for _ in range(count)]))
        kinds.append((kind.__name__, spectra, classes(spectra, parts, draw), (1 - MUNSELL_SHARE - ANY_SHARE) * share / total))
    rows, names = [], []
    for name, logits, label, share in kinds:
        of_kind = np.cov(logits.T, bias=True)
        for k in np.unique(label):
            rows.append(gaussian(logits[label == k], of_kind))
            names.append((name, share * np.mean(label == k)))
    together = np.vstack([logits for _, logits, *_ in kinds])
    mean = together.mean(0)
    rows.append(factored(mean, 1 + ANY_SD**2 * np.exp(-(((NM[:, None] - NM) / ANY_NM) ** 2))))
    names.append(("any", ANY_SHARE))
    rows.append(factored(mean, np.cov(together.T, bias=True)))
    total = sum(share**SHARE_POWER for _, share in names)
    names = [f"{name} {share**SHARE_POWER / total:.6f}\n" for name, share in names] + ["all 1\n"]
    np.save(SHARE / "prior.npy", np.array(rows, dtype="<f2"))
    (SHARE / "prior.txt").write_text("".join(names))


if __name__ == "__main__":
    main()

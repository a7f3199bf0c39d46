"""Spectral reflectance of folded sheets: measures photographs with the tools of vfold, and reads what they wrote.

    import vfold
    sheet = vfold.measure("sheet.dng", illuminant="sun:40deg")
    print(sheet.verdict, sheet.because)
    sheet.spectral_distribution().plot()        # a colour.SpectralDistribution

One file, nothing to build: put it beside a script, or its folder on PYTHONPATH. Needs Python 3.9, NumPy and the five
tools on PATH; colour-science only for `spectral_distribution`. Wavelengths are in nm, reflectances fractions of 1.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

if TYPE_CHECKING:
    import colour

__all__ = [
    "Error",
    "Sheet",
    "Spectrum",
    "Stream",
    "find",
    "measure",
    "read_npy",
    "read_spectra",
    "read_stream",
    "records",
]

PathLike = Union[str, "os.PathLike[str]"]
Regions = Union[PathLike, Mapping[str, Any]]

# what `measure` takes, by tool: each is a flag of that tool, with dashes for underscores
KNOWN = {
    "vkernel": ("angle_deg", "panel", "panel1_depth", "facets", "tilt_deg", "slant_deg", "sky", "bow_deg"),
    "vextract": (
        "camera", "illuminant", "sky_illuminant", "wavelengths_nm", "panel0", "panel1", "chart", "white_region",
        "margin", "exact_corners", "distortion", "transfer", "black_level", "white_level", "white", "undo", "exposure",
        "chart_reference", "chart_grid", "chart_cos", "white_reflectance", "white_cos", "overlay",
    ),
    "vestimate": ("prior", "noise_sd", "model_error", "fit", "illuminants", "known_fold"),
}  # fmt: skip
# what stands between the numbers of a list; a comma elsewhere
BETWEEN = {"panel": "x", "facets": "x", "chart_grid": "x", "wavelengths_nm": ":"}
# four corners each
CORNERS = ("panel0", "panel1", "chart", "white_region")


class Error(Exception):
    """A tool failed; the text is its own line.

    Attributes:
        tool: its name.
        status: its exit status, 1 for bad data, 2 for a wrong value.
    """

    def __init__(self, line: str, tool: str, status: int) -> None:
        super().__init__(line)
        self.tool, self.status = tool, status


@dataclass(frozen=True)
class Spectrum:
    """A spectrum with its error bars.

    Attributes:
        name: what it is called.
        wavelengths_nm: shape (W,), nm, increasing.
        reflectance: shape (W,), 0 to 1; of a fluorescent sheet it may be a total radiance factor above 1.
        reflectance_sd: its standard deviation, shape (W,); None if nobody knows it.
    """

    name: str
    wavelengths_nm: np.ndarray
    reflectance: np.ndarray
    reflectance_sd: Optional[np.ndarray] = None

    def spectral_distribution(self) -> colour.SpectralDistribution:
        """The spectrum as colour-science has it. Raises ImportError without colour-science."""
        import colour

        return colour.SpectralDistribution(self.reflectance, self.wavelengths_nm, name=self.name)


@dataclass(frozen=True)
class Sheet(Spectrum):
    """An estimate of vestimate.

    Attributes:
        verdict: "good", "doubtful" or "wrong"; None of a method that does not know how far off it is.
        because: why, in a sentence.
        remedy: what to do about it.
        truth: the true reflectance, shape (W,), if the record has it, on `wavelengths_nm`.
        record: all of the sample's record.
        scene: all of its scene's record.
        notes: what the tools said, a line each: assumptions and warnings. Only of `measure`.
    """

    verdict: Optional[str] = None
    because: str = ""
    remedy: str = ""
    truth: Optional[np.ndarray] = None
    record: Mapping[str, Any] = field(default_factory=dict, repr=False)
    scene: Mapping[str, Any] = field(default_factory=dict, repr=False)
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Stream:
    """What a file of records holds.

    Attributes:
        sheets: estimates, in the order of the file.
        failures: what went wrong with the other samples, by their ids.
        summary: the last record of vscore; None if there is none.
    """

    sheets: list[Sheet]
    failures: dict[str, str]
    summary: Optional[Mapping[str, Any]]


def measure(path: PathLike, *, regions: Optional[Regions] = None, **known: Any) -> Sheet:
    """Measures the sheet in one photograph.

    Args:
        path: the photograph.
        regions: corners that are known, as `find` or `vextract --pick` gives them: a dictionary, or a file of JSON.
            Without them, and without `panel0` and `panel1`, the fold is found.
        **known: what else is known, by the tools' flags (`KNOWN` lists them): `angle_deg=50`, `camera="nikon-d5100"`,
            `illuminant="sun:40deg"`, `panel0=[[332, 462], [345, 77], [122, 12], [104, 442]]` in px, shape (4, 2),
            `wavelengths_nm=(400, 700, 5)`, `fit=["angle", "tilt"]`, `known_fold="grey.ndjson=cc24:neutral5"`. None
            leaves a flag out, True gives it without a value.

    Raises:
        Error: a tool failed: there is no fold, or not surely, no camera is named, a file is missing.
        TypeError: a flag is none of the tools'.
    """
    flags = _flags(known)
    has_panels = any(known.get(panel) is not None for panel in ("panel0", "panel1"))
    if has_panels and known.get("angle_deg") is None:
        raise TypeError("panel0 and panel1 do not state the angle: add angle_deg, or give regions instead")
    if has_panels and regions is not None:
        raise TypeError("corners are stated twice, by regions and by panel0 or panel1: keep one")
    notes: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        placed: list[str] = []
        corners = Path(folder, "regions.json")
        # a tool's line names what the caller knows, and no file between the tools
        is_file = regions is not None and not isinstance(regions, Mapping)
        names = {str(corners): os.fspath(regions if is_file else path)}
        if not has_panels:
            corners.write_bytes(_as_json(find(path) if regions is None else regions))
            placed = ["--regions", str(corners)]
        scene = _run("vkernel", [*placed, *flags["vkernel"]], b"", notes, names)
        facets = _run("vextract", [_file(path), *placed, *flags["vextract"]], scene, notes, names)
        estimate = _run("vestimate", flags["vestimate"], facets, notes)
    (sheet,) = _stream(estimate.decode().splitlines(), tuple(notes)).sheets
    return sheet


def find(path: PathLike) -> dict[str, Any]:
    """Where fold and colour chart are in a photograph, as `vextract --find` prints it.

    Returns:
        `panel0`, `panel1` and, if there is one, `chart`: four corners each, [x, y] in px; `confidence`, the
        probability that the six corners of the fold are right; `angle_deg` and its standard deviation
        `angle_sd_deg`. Without a fold `found` is False, and `reason` says why.

    Raises:
        Error: the photograph cannot be read.
    """
    return json.loads(_run("vextract", ["--find", _file(path)], b"", []))


def records(path: PathLike) -> Iterator[dict[str, Any]]:
    """The records of a file that a tool wrote, a dictionary each; vfold-stream(5) describes them."""
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            yield json.loads(line)


def read_stream(path: PathLike) -> Stream:
    """Estimates of vestimate or vscore, from their records (NDJSON)."""
    with open(path, encoding="utf-8") as lines:
        return _stream(lines, ())


def read_spectra(path: PathLike) -> list[Spectrum]:
    """Spectra of a CSV file, such as `--spectra` writes: wavelengths in nm, then a column each and its `_sd`, if any.

    Raises:
        ValueError: the file is no such table.
    """
    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 2 or len(rows[0]) < 2:
        raise ValueError(f"{os.fspath(path)}: not a table of spectra: it needs a header, then a line for each wavelength")
    names = rows[0][1:]
    try:
        wavelengths_nm, *columns = np.array(rows[1:], dtype=float).T
    except ValueError as error:
        raise ValueError(f"{os.fspath(path)}: {error}") from None
    column = dict(zip(names, columns))
    sds = {name for name in names if name.endswith("_sd") and name[:-3] in column}
    spectra = (name for name in names if name not in sds)
    return [Spectrum(name, wavelengths_nm, column[name], column.get(f"{name}_sd")) for name in spectra]


def read_npy(path: PathLike) -> np.ndarray:
    """An array that `--save FIELD=FILE.npy` wrote, samples first: (S, W) of `estimate.reflectance`."""
    return np.load(path, allow_pickle=False)


def _stream(lines: Any, notes: tuple[str, ...]) -> Stream:
    scenes: dict[str, Mapping[str, Any]] = {}
    sheets, failures, summary = [], {}, None
    for line in lines:
        record = json.loads(line)
        if record["kind"] == "scene":
            scenes[record["id"]] = record
        elif record["kind"] == "summary":
            summary = record
        elif "error" in record:
            failures[record["id"]] = record["error"]
        elif "estimate" in record:
            sheets.append(_sheet(record, scenes.get(record["scene"], {}), notes))
    return Stream(sheets, failures, summary)


def _sheet(record: Mapping[str, Any], scene: Mapping[str, Any], notes: tuple[str, ...]) -> Sheet:
    estimate, truth = record["estimate"], record.get("truth")
    verdict = estimate.get("verdict", {})
    wavelengths_nm = np.array(estimate["wavelengths_nm"])
    if truth is not None:
        truth = np.interp(wavelengths_nm, truth["wavelengths_nm"], truth["reflectance"])
    sd = estimate.get("reflectance_sd")
    return Sheet(
        name=record["id"],
        wavelengths_nm=wavelengths_nm,
        reflectance=np.array(estimate["reflectance"]),
        reflectance_sd=None if sd is None else np.array(sd),
        verdict=verdict.get("level"),
        because=verdict.get("because", ""),
        remedy=verdict.get("remedy", ""),
        truth=truth,
        record=record,
        scene=scene,
        notes=notes,
    )


def _flags(known: Mapping[str, Any]) -> dict[str, list[str]]:
    """The command line of each tool."""
    unknown = sorted(set(known) - {name for names in KNOWN.values() for name in names})
    if unknown:
        names = ", ".join(sorted(name for names in KNOWN.values() for name in names))
        raise TypeError(f"measure() does not know {', '.join(unknown)}; it takes {names}")
    return {
        tool: [word for name in names if known.get(name) is not None for word in _words(name, known[name])]
        for tool, names in KNOWN.items()
    }


def _words(name: str, value: Any) -> list[str]:
    flag = "--" + name.replace("_", "-")
    if value is True or value is False:
        return [flag] if value else []
    if isinstance(value, (str, os.PathLike)):
        text = os.fspath(value)
    elif name in CORNERS:
        corners = np.asarray(value, dtype=float)
        if corners.shape != (4, 2):
            raise TypeError(f"{name}: four corners of two numbers are needed, not shape {corners.shape}")
        text = " ".join(f"{x!r},{y!r}" for x, y in corners.tolist())
    elif isinstance(value, (Sequence, np.ndarray)):
        text = BETWEEN.get(name, ",").join(str(part) for part in value)
    else:
        text = str(value)
    return [f"{flag}={text}"]


def _as_json(regions: Union[PathLike, Mapping[str, Any]]) -> bytes:
    return json.dumps(regions).encode() if isinstance(regions, Mapping) else Path(regions).read_bytes()


def _file(path: PathLike) -> str:
    """A file's name that no tool takes for a flag."""
    name = os.fspath(path)
    return f"./{name}" if name.startswith("-") else name


def _run(
    tool: str, arguments: Sequence[str], stdin: bytes, notes: list[str], names: Mapping[str, str] = {}
) -> bytes:
    """What a tool prints; what it says is added to `notes`, files called by their `names`."""
    try:
        done = subprocess.run([tool, *arguments], input=stdin, capture_output=True, check=False)
    except FileNotFoundError:
        line = f"{tool} is not on PATH; install the tools with share/install, or add their folder"
        raise Error(line, tool, 127) from None
    text = done.stderr.decode(errors="replace")
    for file, name in names.items():
        text = text.replace(file, name)
    said = text.splitlines()
    if done.returncode != 0:
        line = said[-1] if said else f"{tool} ended with status {done.returncode}"
        raise Error(line, tool, done.returncode)
    notes.extend(said)
    return done.stdout

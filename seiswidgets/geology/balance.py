"""Section balance: line lengths, areas of layers, heave and extension before and after restoring."""

from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass
from html import escape

import numpy as np
import shapely
from shapely import LineString, Polygon

from seiswidgets.errors import SettingError
from seiswidgets.geology import heave_closure
from seiswidgets.geology.bed_lines import BedExtent, bed_extent
from seiswidgets.geology.cutoffs import cutoffs_if_any
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.layers import layers_of
from seiswidgets.geology.picks import IGNORE, Horizon, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.stage import DECOMPACT
from seiswidgets.geology.tables import Table

INSET = 1e-3  # samples between the border of a layer and the points that are carried
MOST = 0.02  # of a length, an area or the section's height; a larger change is worth a finding
EDGE_POINTS = 101


@dataclass(frozen=True)
class BedBalance:
    """Extent of a horizon, None if it was removed with the rock, and the sum of its heaves, in metres."""

    horizon: str
    extent: BedExtent | None
    heave: float

    @property
    def change(self) -> float | None:
        """Relative change of the length."""
        return self.extent.change if self.extent else None

    @property
    def closed(self) -> float | None:
        """The part of the heave that was not made up by a change of length, in metres."""
        return self.heave - (self.extent.restored_length - self.extent.length) if self.extent else None

    @property
    def beta(self) -> float | None:
        """Present-day over restored width."""
        return self.extent.beta if self.extent else None

    @property
    def extension(self) -> float | None:
        """Present-day over restored width, less 1."""
        return self.extent.extension if self.extent else None


@dataclass(frozen=True)
class LayerBalance:
    """Area of a layer in square metres, present-day and restored; None if it was removed."""

    layer: str
    area: float
    restored_area: float | None

    @property
    def change(self) -> float | None:
        """Relative change of the area."""
        return None if self.restored_area is None else self.restored_area / self.area - 1


@dataclass(frozen=True)
class EdgeBalance:
    """Tilt in degrees and bend in metres of an edge of the section after restoring; None if it was removed."""

    edge: str
    tilt: float | None
    bend: float | None


@dataclass(frozen=True)
class Balance:
    """The balance of a restored section.

    Attributes
    ----------
    beds : tuple of BedBalance
        From the top down.
    layers : tuple of LayerBalance
        Between the horizons, from the top down.
    edges : tuple of EdgeBalance
        The left and the right edge, which are pin lines or loose lines.
    findings : tuple of Finding
        What does not balance.
    """

    beds: tuple[BedBalance, ...]
    layers: tuple[LayerBalance, ...]
    edges: tuple[EdgeBalance, ...]
    findings: tuple[Finding, ...]

    @property
    def tables(self) -> tuple[Table, Table, Table]:
        """Beds, layers and edges as tables."""
        names = ("length", "restored length", "width", "restored width", "heave")
        units = {"horizon": "", **dict.fromkeys(names, "m"), "heave closed": "m"}
        beds = Table(
            "Beds",
            {**units, "length change": "1", "extension": "1", "beta": "1"},
            tuple(
                (bed.horizon, *(astuple(bed.extent) if bed.extent else 4 * (None,)), bed.heave)
                + (bed.closed, bed.change, bed.extension, bed.beta)
                for bed in self.beds
            ),
        )
        areas = {"layer": "", "area": "m²", "restored area": "m²", "area change": "1"}
        layers = Table("Layers", areas, tuple((*astuple(layer), layer.change) for layer in self.layers))
        return beds, layers, Table("Edges", {"edge": "", "tilt": "°", "bend": "m"}, tuple(map(astuple, self.edges)))

    def __str__(self) -> str:
        return "\n\n".join([*map(str, self.tables), *(finding.text for finding in self.findings)])

    def _repr_html_(self) -> str:
        remarks = "".join(f"<p>{escape(finding.text)}</p>" for finding in self.findings)
        return "".join(table._repr_html_() for table in self.tables) + remarks


def balance(restored: Restoration, interpretation: Interpretation) -> Balance:
    """Compare lengths of horizons, areas of layers, and heave before and after restoring.

    In a section of plane strain without compaction beds keep their length and layers their area (Dahlstrom 1969). Heave
    that no change of width matches was taken up by strain of the beds. Decompaction changes areas, so that there are
    no findings about them after it.

    Parameters
    ----------
    restored : Restoration
        With at least one stage.
    interpretation : Interpretation
        The horizons that are not ignored, and the faults that they meet.

    Raises
    ------
    SettingError
        If there is no stage.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault(throw=100)
    >>> picks = case.interpretation
    >>> restored = sw.Restoration(case.section).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    >>> [round(bed.closed, 1) for bed in sw.balance(restored, picks).beds]
    [57.7, 57.7, 57.7]
    """
    if not restored.stages:
        raise SettingError("nothing has been restored yet, so there is nothing to balance; unfault or flatten first")
    horizons = sorted((one for one in interpretation.horizons if one.use != IGNORE), key=_mean_depth)
    beds = [_bed(restored, interpretation, horizon) for horizon in horizons]
    layers = list(_layers(restored, interpretation, horizons))
    edges = list(_edges(restored))
    expanded = any(stage.kind == DECOMPACT for stage in restored.stages)
    found = (
        *_of_beds(restored, beds),
        *([] if expanded else _of_layers(layers, len(horizons) + 1)),
        *_of_edges(restored, edges),
    )
    return Balance(tuple(beds), tuple(layers), tuple(edges), found)


def _mean_depth(horizon: Horizon) -> float:
    return float(np.mean(np.concatenate(horizon.pieces)[:, 1]))


def _bed(restored: Restoration, interpretation: Interpretation, horizon: Horizon) -> BedBalance:
    heave = _heave(interpretation, horizon) * float(restored.original.metres[0])
    return BedBalance(horizon.name, bed_extent(restored, interpretation.faults, horizon), heave)


def _heave(interpretation: Interpretation, horizon: Horizon) -> float:
    """The sum of a horizon's heaves, in the section's unit of x."""
    faults = [fault for fault in interpretation.faults if fault.use != IGNORE]
    return float(sum(place.heave for fault in faults for place in cutoffs_if_any(fault, horizon)))


def _layers(
    restored: Restoration, interpretation: Interpretation, horizons: Sequence[Horizon]
) -> Iterator[LayerBalance]:
    picks = Restoration(restored.original, bodies=restored.bodies).usable_picks
    pieces = {index: picks.bed_lines(horizon) for index, horizon in enumerate(horizons, 1)}
    faults = [LineString(picks.original.to_rock(one.points)) for one in interpretation.faults if one.constrains]
    layers = layers_of(picks.domain, pieces, faults, len(horizons) + 1)
    names = ["top", *(horizon.name for horizon in horizons), "bottom"]
    for index in range(len(horizons) + 1):
        faces = layers.faces[layers.layer_of_face == index]
        if len(faces):
            after = sum(_area_after(face, restored, INSET * picks.domain.sample) for face in faces)
            name = f"{names[index]} to {names[index + 1]}"
            yield LayerBalance(name, float(shapely.area(faces).sum()), after if np.isfinite(after) else None)


def _area_after(face: Polygon, restored: Restoration, inset: float) -> float:
    """Area of a face after all stages; NaN if a part of it was removed."""
    total = 0.0
    for part in shapely.get_parts(face.buffer(-inset, join_style="mitre")):
        for sign, ring in ((1, part.exterior), *((-1, hole) for hole in part.interiors)):
            points = shapely.get_coordinates(shapely.segmentize(ring, restored.stages[0].spacing / 8))
            for stage in restored.stages:
                points = stage.map.forward(points)
            total += sign * Polygon(points).area if np.isfinite(points).all() else np.nan
    return total


def _edges(restored: Restoration) -> Iterator[EdgeBalance]:
    x_min, x_max, z_min, z_max = restored.original.extent
    for name, x in (("left", x_min), ("right", x_max)):
        line = np.column_stack([np.full(EDGE_POINTS, x), np.linspace(z_min, z_max, EDGE_POINTS)])
        points = restored.original.to_rock(restored.to_restored(line))
        points = points[np.isfinite(points).all(axis=1)]
        if len(points) < 3:
            yield EdgeBalance(name, None, None)
            continue
        slope, first = np.polyfit(points[:, 1], points[:, 0], 1)
        bend = float(np.abs(points[:, 0] - first - slope * points[:, 1]).max())
        yield EdgeBalance(name, float(np.degrees(np.arctan(slope))), bend)


def _of_beds(restored: Restoration, beds: Sequence[BedBalance]) -> Iterator[Finding]:
    trace = restored.original.dx * float(restored.original.metres[0])
    for bed in beds:
        if bed.change is not None and abs(bed.change) > MOST:
            text = (
                f"horizon {bed.horizon} is {abs(bed.change):.1%} {'longer' if bed.change > 0 else 'shorter'} restored"
            )
            yield Finding("warning", "bed length", text, bed.horizon)
        if bed.closed is not None and heave_closure.is_open(bed.heave, bed.heave - bed.closed, trace):
            text = f"{bed.closed:.3g} of {bed.heave:.3g} m of the heave of horizon {bed.horizon} closes"
            yield Finding("warning", "heave", text, bed.horizon)


def _of_layers(layers: Sequence[LayerBalance], count: int) -> Iterator[Finding]:
    if len(layers) < count:
        text = "the horizons do not close all layers between them; draw them from border to border for their areas"
        yield Finding("note", "area", text)
    for layer in layers:
        if layer.change is not None and abs(layer.change) > MOST:
            change = f"{abs(layer.change):.1%} {'larger' if layer.change > 0 else 'smaller'}"
            text = f"the layer from {layer.layer} is {change} restored, so its area does not balance"
            yield Finding("warning", "area", text)


def _of_edges(restored: Restoration, edges: Sequence[EdgeBalance]) -> Iterator[Finding]:
    _, _, z_min, z_max = restored.original.extent
    height = (z_max - z_min) * float(restored.original.metres[1])
    for edge in edges:
        if edge.bend is not None and edge.bend > MOST * height:
            text = (
                f"the {edge.edge} edge of the section is bent by {edge.bend:.3g} m restored: the beds there slid past "
                "each other, or their lengths do not agree"
            )
            yield Finding("note", "loose line", text)

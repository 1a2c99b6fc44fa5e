"""What a view shows in the place of its stage, the basis function or the limit, and what its surface wears.

Values at vertices become colours on one scale for all panes, so that they can be compared.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import ceil
from typing import TypeAlias

import numpy as np

from app.draw import basis, limits, motion, ramps
from app.draw.isophotes import isophotes, reflections
from app.draw.picture import Colour, Diagram, Lines, Markers, Scene
from app.draw.theme import Theme
from app.state import State
from lessons.script import Look, View
from subdivision import Frame, Mesh, TopologyError, Trace
from subdivision.arrays import Floats, Indices
from subdivision.curvature import gauss_curvature, mean_curvature, vertex_normals
from subdivision.rows import Connectivity
from subdivision.words import phrase

SHOWS: Mapping[str, str] = {
    "": "Plain",
    "isophotes": "Isophotes",
    "reflections": "Reflection lines",
    "normals": "Normals",
    "mean curvature": "Mean curvature",
    "gauss curvature": "Gauss curvature",
}
"""What a surface shows, and what it is called."""

STRIPED = ("isophotes", "reflections")
"""They need no net beside them."""

CURVATURES = ("mean curvature", "gauss curvature")

BRISK = 14_000
"""Up to so many faces a surface follows the hand at once."""

BAND = 2.4
"""Width of a line of light in logical points."""

SMALL = 0.45
"""Size of markers on a surface that wears values, relative to what they are: values are told just where they are."""

QUILL, QUILLS = 0.9, 1500
"""Length of a normal, relative to the typical edge; more than so many vertices have only some of theirs shown."""

TONES = 64
"""A curve and its points wear so many colours at most."""

Wear: TypeAlias = Callable[[Floats], Floats]
"""The colours (n, 3) of places on a scale."""


@dataclass(frozen=True, eq=False)
class Shown:
    """A trace and a place in it; ``framed`` and ``look`` say what the camera sees.

    ``lifted`` is the control point whose basis function it is, -1: none; ``is_limit``: the last stage is the limit.
    ``remark`` says why what was asked for is not there; ``stands_for`` is the connectivity of the level in whose place
    a coarser one is shown.
    """

    trace: Trace
    at: float
    framed: Trace
    look: Look
    lifted: int = -1
    is_limit: bool = False
    remark: str = ""
    stands_for: Connectivity | None = None


@dataclass(frozen=True, eq=False)
class Values:
    """Numbers (n,) at the first points of a frame, what they are, and whether they have a sign.

    The first ``n_vertices`` of the points are vertices.
    """

    at: Floats
    n_vertices: int
    title: str
    is_signed: bool = False


def shown(state: State, view: View, *, is_hasty: bool = False) -> Shown:
    """What a view shows, as the options say; in haste a coarser level of what has many faces."""
    trace, at = state.trace(view), view.at(state.progress)
    found = Shown(trace, at, view.framed or view.trace, view.look or state.now.look)
    if is_hasty and (coarse := coarser(trace, at)) < at:
        found = replace(found, at=coarse, stands_for=trace.topology_at(ceil(at)))
    if state.options.basis:
        found = _lifted(state, view, found)
    if state.options.limit and found.trace.stages:
        limit, refusal = limits.limit_or_refusal(found.trace, found.at)
        if limit is not None:
            return replace(found, trace=limit, at=float(len(limit.stages)), is_limit=True)
        found = replace(found, remark=" ".join(filter(None, (found.remark, refusal))))
    return found


def coarser(trace: Trace, at: float) -> float:
    """The last place up to ``at`` where a level is whole and brisk, else the first one; ``at`` where all is brisk."""
    if trace.topology_at(ceil(at)).n_faces <= BRISK:
        return at
    whole = [k for k in range(1, int(at) + 1) if limits.is_whole(trace, k)]
    return float(max((k for k in whole if trace.topology_at(k).n_faces <= BRISK), default=min(whole, default=at)))


def _lifted(state: State, view: View, plain: Shown) -> Shown:
    vertex = held(state, view)
    vertex = vertex if vertex >= 0 else basis.middle(view.trace.control)
    try:
        graph = basis.graph(view.trace, vertex)
    except TopologyError as reason:
        return replace(plain, lifted=vertex, remark=str(reason))
    return replace(plain, trace=graph, framed=graph, look=basis.look_of(view.trace.control, plain.look), lifted=vertex)


def held(state: State, view: View) -> int:
    """The control point in focus, of this view's control object or one like it; -1: none."""
    spot, views = state.focus, state.now.views
    if spot is None or spot.stage != 0 or spot.pane >= len(views):
        return -1
    n = view.trace.control.topology.n_vertices
    return spot.point if spot.point < n == views[spot.pane].trace.control.topology.n_vertices else -1


def frame_of(what: Shown) -> Frame:
    """The instant that is shown."""
    return what.trace.frame(motion.eased(what.at))


def values_of(state: State, view: View, what: Shown, frame: Frame) -> Values | None:
    """The numbers that the surface, or the curve, wears: an influence before a curvature."""
    vertex = what.lifted if what.lifted >= 0 else held(state, view) if state.options.weights else -1
    if vertex >= 0 and (what.at > 0 or what.lifted >= 0):
        name = "Basis function" if what.lifted >= 0 else "Influence"
        column = influence(what.trace, vertex, motion.eased(what.at))
        return Values(
            column,
            frame.topology.n_vertices,
            phrase("{name} of v{vertex}", name=name, vertex=vertex),
            bool(column.min() < -1e-9),
        )
    kind = state.options.surface_shows
    if kind not in CURVATURES or not frame.topology.n_faces:
        return None
    mesh = Mesh(frame.topology, frame.points[: frame.topology.n_vertices])
    curvature = mean_curvature(mesh) if kind == "mean curvature" else gauss_curvature(mesh)
    return Values(curvature, frame.topology.n_vertices, SHOWS[kind], is_signed=True)


def influence(trace: Trace, vertex: int, at: float) -> Floats:
    """(n_points,): how much of a control point every point holds, also between two stages, where it goes as they go."""
    k = int(np.ceil(at))
    after = trace.influence(vertex, k)
    if k == at:
        return after
    before, start, carries = trace.influence(vertex, k - 1), after.copy(), trace.stages[k - 1].carries
    start[carries >= 0] = before[carries[carries >= 0]]
    t = at - (k - 1)
    return np.asarray((1 - t) * start + t * after)


def dressed(made: Scene, what: Shown, frame: Frame, state: State, view: View, theme: Theme) -> Scene:
    """With lines of light, normals, marks on the limit and the sentence; without values."""
    made = limits.marked(made, what.trace, theme) if what.is_limit else made
    kind = state.options.surface_shows
    lines: list[Lines] = []
    if view.isophotes or kind == "isophotes":
        lines += [isophotes(faces, theme.ink, BAND * theme.stroke) for faces in made.faces]
    elif kind == "reflections":
        lines += [reflections(faces, made.camera, theme.ink, BAND * theme.stroke) for faces in made.faces]
    elif kind == "normals" and made.faces:
        lines.append(_quills(frame, theme))
    return replace(made, lines=(*made.lines, *lines), remark=what.remark or _wanting(frame.topology, kind))


def _wanting(t: Connectivity, kind: str) -> str:
    """Why there is no surface."""
    if t.n_faces and t.hidden.all():
        return "All faces touch the boundary, and the boundary rule hides those."
    return "A curve has no surface to show this on." if kind and not t.n_faces else ""


def painted(
    contents: Sequence[Scene | Diagram], values: Sequence[Values | None], theme: Theme
) -> list[Scene | Diagram]:
    """Scenes in the colours of their values, all on one scale; the bar of that scale stands in the last of them."""
    there = [each for each in values if each is not None]
    if not there:
        return list(contents)
    is_signed = any(each.is_signed for each in there)
    low, high, is_beyond = ramps.ends(np.concatenate([each.at for each in there]), is_signed)
    bar = ramps.bar(there[0].title, (low, high), is_beyond, theme, is_signed)
    wear = partial(ramps.coloured, theme=theme, is_signed=is_signed)
    last = max(k for k, each in enumerate(values) if each is not None)
    found = list(contents)
    for k, (scene, each) in enumerate(zip(contents, values, strict=True)):
        if each is not None and isinstance(scene, Scene):
            at = ramps.places(each.at, (low, high))
            found[k] = replace(_coloured(scene, at, wear, each.n_vertices), bar=bar if k == last else None)
    return found


def _coloured(scene: Scene, at: Floats, wear: Wear, n_vertices: int) -> Scene:
    """A surface by its vertices; where there is none, a curve by its strokes and its points."""
    if scene.faces:
        colours = wear(at)
        faces = tuple(replace(each, colours=colours[: len(each.points)]) for each in scene.faces)
        return replace(scene, faces=faces, markers=tuple(_shrunk(each) for each in scene.markers))
    lines = [part for each in scene.lines for part in _binned(each, at, wear, is_curve=len(each.points) == n_vertices)]
    markers = [part for each in scene.markers for part in _dotted(each, at, wear)]
    return replace(scene, lines=tuple(lines), markers=tuple(markers))


def _binned(lines: Lines, at: Floats, wear: Wear, *, is_curve: bool) -> list[Lines]:
    """The strokes of a curve in groups of one colour each."""
    if not is_curve or lines.dashed:
        return [lines]
    groups = _groups(at[lines.pairs].mean(axis=1), wear)
    return [replace(lines, pairs=lines.pairs[rows], colour=colour) for rows, colour in groups]


def _dotted(markers: Markers, at: Floats, wear: Wear) -> list[Markers]:
    """The points that are there now, and have values, in groups of one colour each."""
    if markers.stage >= 0 or not len(markers.ids) or (markers.ids < 0).any():
        return [markers]
    is_limit = markers.name == limits.LIMIT_POINT  # these are numbered as in the level, but stand in order
    places = np.arange(len(markers.ids)) if is_limit else markers.ids
    if places.max() >= len(at):  # centroids lie on no surface
        return [markers]
    return [
        replace(markers, points=markers.points[rows], radius=markers.radius[rows], opacity=markers.opacity[rows],
                ids=markers.ids[rows], colour=colour, name="")
        for rows, colour in _groups(at[places], wear)
    ]  # fmt: skip


def _groups(at: Floats, wear: Wear) -> list[tuple[Indices, Colour]]:
    """Rows that are nearly at one place of the scale, the same ones in every theme, and their colour."""
    if not len(at):
        return []
    tones = np.nan_to_num(np.round(at * TONES), nan=-1.0)
    _, owner, counts = np.unique(tones, return_inverse=True, return_counts=True)
    colours = wear(np.bincount(owner, weights=at) / counts).tolist()
    rows = np.split(np.argsort(owner, kind="stable"), np.cumsum(counts)[:-1])
    return [(some, (r, g, b)) for some, (r, g, b) in zip(rows, colours, strict=True)]


def _shrunk(markers: Markers) -> Markers:
    is_current = markers.stage < 0 and markers.name != limits.LIMIT_POINT and bool((markers.ids >= 0).any())
    return replace(markers, radius=SMALL * markers.radius) if is_current else markers


def _quills(frame: Frame, theme: Theme) -> Lines:
    """A stroke along the normal of every vertex, of so many that they can be told apart."""
    t = frame.topology
    points = frame.points[: t.n_vertices]
    ways = vertex_normals(Mesh(t, points))
    edges = np.linalg.norm(points[t.ends[:, 0]] - points[t.ends[:, 1]], axis=1)
    picked = np.arange(0, t.n_vertices, -(-t.n_vertices // QUILLS))
    tips = points[picked] + QUILL * float(np.median(edges)) * max(1.0, (len(points) / 150) ** 0.25) * ways[picked]
    pairs = np.arange(2 * len(picked)).reshape(2, -1).T
    return Lines(np.concatenate([points[picked], tips]), pairs, theme.accent, 2.6 * theme.stroke)

"""What a lesson shows, written down: its stops, and between them some instants of every stage.

Nothing is decided here.  ``compose`` is asked for the picture at each instant, and what does not run straight from
one instant to another keeps the instants between; a player that interpolates shows what the program shows.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from app import asking
from app.draw.compose import compose, said
from app.draw.layout import overlay, pane_areas
from app.draw.motion import eased
from app.draw.picture import Camera, Colour, Diagram, Pane, Picture, Scene
from app.draw.primitives import Area, Mark, Plate, Stroke, Text, one_by_one
from app.draw.theme import THEMES
from app.page.tables import Tables
from app.state import State, Stop, at_stop, choose, start, stops
from lessons.questions import Weight, Where, Which
from subdivision.arrays import Floats
from subdivision.exact import spelled

WIDTH, HEIGHT = 1600.0, 900.0
"""Diagrams are laid out for a picture of so many pixels; the player scales their panes."""

SOON = 1e-6
INSTANTS = (SOON, 0.08, 0.17, 0.25, 0.33, 0.42, 0.5 - SOON, 0.5 + SOON, 0.58, 0.65, 0.72, 0.81, 0.9, 1 - SOON)
"""When a stage is looked at, in eased time: just within its ends, and round its middle, where roles change."""

EXACT: Mapping[str, float] = {
    "points": 1.01, "radius": 2e-3, "opacity": 4e-3, "width": 4e-3, "size": 4e-3, "flat": 0.06,
}  # fmt: skip
"""How far a track may be from straight: steps of the box, parts of the largest, or pixels."""

Value: TypeAlias = Any
"""What JSON can hold."""

Numbers: TypeAlias = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Part:
    """One thing on a picture: ``what`` it is stays while a stage plays, the numbers of its ``tracks`` change."""

    what: tuple[Value, ...]
    tracks: Mapping[str, Numbers]


@dataclass(frozen=True, eq=False)
class Record:
    """A lesson for the player: ``told`` can be written as JSON, ``tables`` hold what it calls by numbers.

    ``captions`` are those of each stop in the light and in the dark theme.
    """

    state: State
    told: Mapping[str, Value]
    tables: Tables
    captions: tuple[tuple[str, str], ...]


def record(state: State, progress: Callable[[float], None] = lambda done: None) -> Record:
    """The lesson of a state, with its options, from its first stop to its last; ``progress`` is told the part done."""
    light = start(state.lesson, replace(state.options, theme="light", presenting=False, blank=False))
    light = replace(light, edits=state.edits, lab=state.lab)
    tables = Tables(*_box(light))
    tables.dark[THEMES["light"].guess] = THEMES["dark"].guess
    places = stops(light.lesson)
    stills = [at_stop(light, stop) for stop in places]
    legs = [None]
    for before, stop in pairwise(places):
        legs.append(_leg(light, before, stop, tables))
        progress(len(legs) / (len(places) + 1))
    told = {
        "stops": [_still(there, tables) for there in stills],
        "legs": legs,
        "low": [float(f"{n:.9g}") for n in tables.low],
        "wide": [float(f"{n:.9g}") for n in tables.wide],
        **({"isStill": True} if state.options.reduced_motion else {}),
    }
    captions = tuple((said(there, there.now), said(_dark(there), there.now)) for there in stills)
    return Record(light, told, tables, captions)


def _box(state: State) -> tuple[Floats, Floats]:
    """Corner and sides of the box round all points of all traces."""
    views = [view for beat in state.lesson.beats for view in beat.views]
    views += [view.over for view in views if view.over is not None]
    clouds = [cloud for view in views for cloud in state.trace(view).points]
    low, high = np.min([c.min(axis=0) for c in clouds], axis=0), np.max([c.max(axis=0) for c in clouds], axis=0)
    margin = 0.02 * max(float((high - low).max()), 1e-9)
    return low - margin, high - low + 2 * margin


def _dark(state: State) -> State:
    return choose(state, theme="dark")


# -- instants ---------------------------------------------------------------------------------


def _still(state: State, tables: Tables) -> Value:
    """A stop: its panes, the legend, what stands in the corner."""
    picture = _seen(state, tables)
    panes = _panes(picture, tables)
    return {
        "beat": state.beat,
        **({"question": _question(state)} if asking.is_open(state) else {}),
        "corner": picture.corner,
        "legend": _legend(picture, tables),
        "panes": [
            {**_frame(pane, tables), "pieces": [_piece([(0.0, parts)], tables)]}
            for pane, parts in zip(picture.panes, panes, strict=True)
        ],
    }


def _question(state: State) -> Value:
    """What is asked at a stop, and the answer."""
    question, beat = state.now.asks, asking.answer(state)
    if isinstance(question, Where):
        return {
            "pane": question.pane,
            "truth": asking.place(state, question).tolist(),
            "edge": asking.edge(state, question),
        }
    if isinstance(question, Weight):
        return {"answers": list(map(spelled, question.answers)), "truth": question.truth(beat)}
    if isinstance(question, Which):
        numbers = [str(k) for k, _ in enumerate(question.answers, 1)]
        return {"answers": numbers, "truth": question.truth(beat), "pictures": True}
    raise ValueError("nothing is asked here")


def _leg(state: State, before: Stop, stop: Stop, tables: Tables) -> Value:
    """What plays on the way to a stop; None where it is a still of another beat."""
    beat = state.lesson.beats[stop.beat]
    begin = before.at if before.beat == stop.beat else beat.start
    if begin == stop.at:
        return None
    ends = [[view.at(beat.progress(at)) for at in (begin, stop.at)] for view in beat.views]
    moving = [(a, b) for a, b in ends if a != b]
    pictures = []
    for x in sorted({round(x, 12) for a, b in moving for x in _instants(a, b)}):
        there = replace(at_stop(state, stop), at=begin + x * (stop.at - begin))
        pictures.append((x, _seen(there, tables)))
    lists = [(x, _panes(picture, tables)) for x, picture in pictures]
    first = pictures[0][1]
    panes = []
    for k, pane in enumerate(first.panes):
        a, b = ends[k] if k < len(ends) else ends[0]
        samples = [(eased(a + x * (b - a)) if a != b else x, parts[k]) for x, parts in lists]
        readings = [tables.text(picture.panes[k].reading, True) for _, picture in pictures]
        shown = {"readings": [[e for e, _ in samples], readings]} if pane.reading else {}
        is_flat = isinstance(pane.content, Diagram)
        pieces = [_merged(samples, tables)] if is_flat else list(_pieces(samples, tables))
        panes.append({**_frame(pane, tables), **shown, "from": a, "to": b, "pieces": pieces})
    legends = [(x, _legend(picture, tables)) for x, picture in pictures]
    changes = [one for before, one in pairwise([(0.0, None), *legends]) if one[1] != before[1]]
    return {"stages": abs(stop.at - begin), "corner": first.corner, "legends": changes, "panes": panes}


def _legend(picture: Picture, tables: Tables) -> Value:
    return [[entry.shape.value, tables.colour(entry.colour), entry.text] for entry in picture.legend]


def _instants(a: float, b: float) -> Iterator[float]:
    """When to look at a pane that goes from stage position ``a`` to ``b``: parts of the way."""
    for k in range(int(np.floor(a)), int(np.ceil(b))):
        for u in INSTANTS:
            at = k + 0.5 - np.sin(np.arcsin(1 - 2 * u) / 3)  # where ``eased`` is ``k + u``
            if a < at < b:
                yield float((at - a) / (b - a))


def _seen(state: State, tables: Tables) -> Picture:
    """The picture of an instant; the dark theme is asked for colours that have no dark partner yet."""
    picture = compose(state)
    mine = list(_colours(picture))
    if any(colour not in tables.dark for colour in mine):
        for colour, partner in zip(mine, _colours(compose(_dark(state))), strict=True):
            tables.dark.setdefault(colour, partner)
    return picture


def _colours(picture: Picture) -> Iterator[Colour]:
    """Every colour of a picture, in an order that does not depend on the theme."""
    yield from (picture.background, picture.ink, picture.muted)
    yield from (entry.colour for entry in picture.legend)
    for pane in picture.panes:
        content = pane.content
        if isinstance(content, Scene):
            for group in (content.faces, content.lines, content.markers, content.labels):
                yield from (each.colour for each in group)
            yield from content.bar.colours if content.bar is not None else ()
        else:
            yield from (colour for box in content.boxes for colour in (box.fill, box.ink, box.stroke))
            yield from ((r, g, b) for squares in content.squares for r, g, b in squares.colours.tolist())
            yield from (each.colour for group in (content.links, content.notes, content.dots) for each in group)


def _frame(pane: Pane, tables: Tables) -> dict[str, Value]:
    """Where a pane is, what stands round it, and from where its scene is seen."""
    found: dict[str, Value] = {"rect": [round(n, 6) for n in pane.rect]}
    if pane.title:
        found["title"] = tables.text(pane.title, True)
    if pane.reading:
        found["reading"] = tables.text(pane.reading, True)
    if isinstance(pane.content, Scene):
        found["camera"] = _camera(pane.content.camera)
    return found


def _camera(camera: Camera) -> Value:
    vectors = {name: [float(f"{n:.7g}") for n in getattr(camera, name)] for name in ("position", "focal", "up")}
    return {**vectors, "angle": camera.angle, "scale": float(f"{camera.scale:.7g}"), "aspect": camera.aspect}


# -- parts ------------------------------------------------------------------------------------


def _panes(picture: Picture, tables: Tables) -> list[list[Part]]:
    """The parts of every pane."""
    flat = _flat(_bare(picture), tables)
    return [
        [*_scene(pane.content, tables), *_laid_over(flat[k])] if isinstance(pane.content, Scene) else flat[k]
        for k, pane in enumerate(picture.panes)
    ]


def _laid_over(flat: list[Part]) -> list[Part]:
    """What is flat in a scene's pane, such as a bar of colours; nothing where there is only the pane's area."""
    return flat if len(flat) > 1 else []


def _bare(picture: Picture) -> Picture:
    """The picture with no words but title and caption, and with nothing in its scenes that is in space."""
    panes = tuple(replace(pane, title="", reading="", content=_empty(pane.content)) for pane in picture.panes)
    return replace(picture, panes=panes, legend=(), corner="", formula="")


def _empty(content: Scene | Diagram) -> Scene | Diagram:
    if isinstance(content, Diagram):
        return content
    return Scene(content.camera, bar=content.bar, remark=content.remark)


def _scene(scene: Scene, tables: Tables) -> Iterator[Part]:
    what: tuple[Value, ...]
    for f in scene.faces:
        worn = -1 if f.colours is None else tables.bytes_of(f.colours)
        what = ("faces", tables.indices(f.sizes), tables.indices(f.corners), tables.colour(f.colour), worn)
        yield Part(what, {"points": tables.places(f.points), "opacity": np.array([f.opacity])})
    for k in scene.lines:
        used, pairs = np.unique(k.pairs, return_inverse=True)
        is_sparse = len(used) < 0.7 * len(k.points)
        points, pairs = (k.points[used], pairs) if is_sparse else (k.points, k.pairs)
        what = ("lines", tables.indices(np.asarray(pairs)), tables.colour(k.colour), k.dashed)
        sizes: dict[str, Numbers] = {"opacity": np.array([k.opacity]), "width": np.array([k.width])}
        yield Part(what, {"points": tables.places(points), **sizes})
    for m in scene.markers:
        numbers: dict[str, Numbers] = {"points": tables.places(m.points), "radius": m.radius, "opacity": m.opacity}
        yield Part(("markers", m.shape.value, tables.colour(m.colour), len(m.points)), numbers)
    for n in scene.labels:
        what = ("label", tables.text(n.text), tables.colour(n.colour), *n.away)
        sizes = {"opacity": np.array([n.opacity]), "size": np.array([n.size])}
        yield Part(what, {"points": tables.places(n.at), **sizes})


def _flat(picture: Picture, tables: Tables) -> dict[int, list[Part]]:
    """The strokes, plates, marks and words of all diagrams, by the number of their pane and measured from its corner.

    Layout writes a box and then its words, so that each is told from its like by the number of the box before it;
    what belongs to the whole picture comes last.
    """
    areas = pane_areas(picture, WIDTH, HEIGHT)
    laid = overlay(picture, WIDTH, HEIGHT)
    words = overlay(replace(picture, panes=()), WIDTH, HEIGHT)
    found: dict[int, list[Part]] = {k: [] for k in range(len(areas))}
    boxes = dict.fromkeys(found, 0)
    for each in one_by_one(laid[: len(laid) - len(words)]):
        middle = _middle(each)
        k = min(found, key=lambda k: _beyond(areas[k], middle))
        boxes[k] += isinstance(each, Plate)
        found[k].append(_primitive(each, areas[k], boxes[k], tables))
    return {k: [Part(("area", *areas[k][2:]), {}), *parts] for k, parts in found.items()}


def _middle(each: Text | Plate | Stroke | Mark) -> tuple[float, float]:
    match each:
        case Stroke():
            return (each.x0 + each.x1) / 2, (each.y0 + each.y1) / 2
        case Plate():
            return each.x + each.width / 2, each.y + each.height / 2
        case _:
            return each.x, each.y


def _beyond(area: Area, place: tuple[float, float]) -> float:
    """How far a place is outside an area."""
    x, y, w, h = area
    return max(x - place[0], place[0] - x - w, 0.0) + max(y - place[1], place[1] - y - h, 0.0)


def _primitive(each: Text | Plate | Stroke | Mark, area: Area, box: int, tables: Tables) -> Part:
    left, top = area[:2]
    what: tuple[Value, ...]
    numbers: tuple[float, ...]
    match each:
        case Stroke():
            what = ("stroke", 0, tables.colour(each.colour), each.dashed)
            numbers = (each.x0 - left, each.y0 - top, each.x1 - left, each.y1 - top, each.width)
        case Plate():
            what = ("plate", box, tables.colour(each.fill), tables.colour(each.stroke))
            numbers = (each.x - left, each.y - top, each.width, each.height, each.line, each.radius)
        case Mark():
            what = ("mark", box, each.shape.value, tables.colour(each.colour))
            numbers = (each.x - left, each.y - top, each.size)
        case Text():
            text = tables.text(each.text, each.bold)
            what = ("text", box, text, tables.colour(each.colour), tables.colour(each.halo), each.align)
            numbers = (each.x - left, each.y - top, each.size)
    return Part(what, {"flat": np.array(numbers), "opacity": np.array([each.opacity])})


# -- tracks -----------------------------------------------------------------------------------

Sample: TypeAlias = tuple[float, list[Part]]
"""The parts of a pane at an instant, in eased stages."""


def _pieces(samples: Sequence[Sample], tables: Tables) -> Iterator[Value]:
    """Stretches of time through which the same parts are there."""
    for _, alike in groupby(samples, key=lambda one: [(part.what, _lengths(part)) for part in one[1]]):
        yield _piece(list(alike), tables)


def _lengths(part: Part) -> list[int]:
    return [len(values) for values in part.tracks.values()]


def _piece(samples: Sequence[Sample], tables: Tables) -> Value:
    times = [round(e, 6) for e, _ in samples]
    parts = [[*what, _tracks(times, [p[k] for _, p in samples], tables)]
             for k, what in enumerate(part.what for part in samples[0][1])]  # fmt: skip
    return {"begins": times[0], "ends": times[-1], "parts": parts}


def _merged(samples: Sequence[Sample], tables: Tables) -> Value:
    """One stretch with all parts that are there at any of its instants, invisible while they are not."""
    named = [(e, dict(_named(parts))) for e, parts in samples]
    order = ("area", "stroke", "plate", "mark", "text")
    keys = sorted(dict.fromkeys(key for _, parts in named for key in parts), key=lambda key: order.index(key[0][0]))
    filled = [(e, [parts.get(key) or _absent(key, k, named) for key in keys]) for k, (e, parts) in enumerate(named)]
    return _piece(filled, tables)


Key: TypeAlias = tuple[tuple[Value, ...], int]


def _named(parts: Sequence[Part]) -> Iterator[tuple[Key, Part]]:
    """Each part under what it is, and how many of the same were before it."""
    seen: dict[tuple[Value, ...], int] = {}
    for part in parts:
        seen[part.what] = seen.get(part.what, -1) + 1
        yield (part.what, seen[part.what]), part


def _absent(key: Key, k: int, named: Sequence[tuple[float, Mapping[Key, Part]]]) -> Part:
    """A part where it is nearest in time, and invisible."""
    there = min((j for j, (_, parts) in enumerate(named) if key in parts), key=lambda j: abs(j - k))
    part = named[there][1][key]
    return Part(part.what, {**part.tracks, "opacity": np.zeros(1)} if part.tracks else {})


def _tracks(times: Sequence[float], parts: Sequence[Part], tables: Tables) -> dict[str, Value]:
    return {name: _track(name, times, [part.tracks[name] for part in parts], tables) for name in parts[0].tracks}


def _track(name: str, times: Sequence[float], values: Sequence[Numbers], tables: Tables) -> Value:
    """The number of an array, if it stays; else the instants between which it runs straight, and their arrays."""
    stack = np.stack([np.asarray(v, dtype=float).ravel() for v in values])
    scale = float(np.abs(stack).max(initial=0.0)) if name == "radius" else 1.0
    kept = _knots(np.array(times), stack, EXACT[name] * max(scale, 1e-12))
    arrays = [_kept(name, stack[k], tables) for k in kept]
    return arrays[0] if len(set(arrays)) == 1 else [[times[k] for k in kept], arrays]


def _kept(name: str, values: Floats, tables: Tables) -> int:
    if name == "points":
        return tables.array(values.astype("<u2"))
    digits = 2 if name == "flat" else 4
    return tables.array(_rounded(values, digits).astype("<f4") + np.float32(0))


def _rounded(values: Floats, digits: int) -> Floats:
    """Hundredths of a pixel, or so many digits of the largest."""
    largest = float(np.abs(values).max(initial=0.0))
    places = digits if largest > 0.1 or largest == 0 else digits - int(np.floor(np.log10(largest)))
    return np.asarray(np.round(values, places))


def _knots(times: Floats, stack: Floats, tolerance: float) -> list[int]:
    """The instants to keep so that straight runs between them miss none of the others by more than the tolerance."""
    if not stack.shape[1] or len(times) == 1:
        return [0]

    def between(a: int, b: int) -> list[int]:
        if b - a < 2:
            return []
        t = ((times[a + 1 : b] - times[a]) / max(times[b] - times[a], 1e-12))[:, None]
        off = np.abs((1 - t) * stack[a] + t * stack[b] - stack[a + 1 : b]).max(axis=1)
        k = a + 1 + int(off.argmax())
        return [*between(a, k), k, *between(k, b)] if off.max() > tolerance else []

    return [0, *between(0, len(times) - 1), len(times) - 1]

"""An extraordinary vertex as numbers: its local matrix, its characteristic map, its eigenvalues, and the counts.

Four flat panes beside the surface; everything on them is read from the rule that subdivides it.
"""

from functools import lru_cache

import numpy as np

from app.draw.picture import Box, Diagram, Link, Note, Pane
from app.draw.theme import Theme, mixed
from app.state import State, level_of, valence_of
from lessons.script import View
from subdivision import Mesh, Topology, TopologyError, Trace
from subdivision.exact import Exact, spelled
from subdivision.extraordinary import EQUAL, Analysis, Condition, analysis
from subdivision.isolation import Counts, counts
from subdivision.spectrum import NamedStencil, Ring
from subdivision.words import phrase, plural

SMALL = 7
"""Up to so many points the local matrix has its weights written in it; else marks, and a row of each kind in words."""

AXIS = 10.0
"""Cells from 0 to 1 on the number line of eigenvalues."""

LONG = 1.6
"""Cells that a value takes beside its mark."""

MOST_LEVELS = 7
"""Rows of the table of counts."""

ROW = 0.042
"""How high a line of words is, of the height there is."""

PALEST = 0.25
"""The lightest mark, relative to the heaviest."""


def spectrum(state: State, view: View, theme: Theme) -> tuple[Pane, ...]:
    """The panes for the vertex looked at, or the sentence why its scheme has none; and the counts of the mesh."""
    n = valence_of(state)
    table = _counts(view.trace, level_of(state), theme)
    try:
        found = analysis(view.trace.scheme, n)
    except TopologyError as refusal:
        words = _sentence(str(refusal), theme)
        counted = bool(_by_level(view.trace))  # polygons and nets have no vertices of any valence to count
        return (Pane(words, (0, 0, 1, 0.7)), Pane(table, (0, 0.7, 1, 0.3))) if counted else (Pane(words),)
    low = max(ROW * (len(_by_level(view.trace)[:MOST_LEVELS]) + 1.6), 0.2)
    middle = max(ROW * (n // 2 + 3), 0.26)
    high = 1 - middle - low
    return (
        Pane(_matrix(found.ring, theme), (0, 0, 0.64, high)),
        Pane(_map(found, theme), (0.64, 0, 0.36, high)),
        Pane(_eigenvalues(found, theme), (0, high, 1, middle)),
        Pane(table, (0, high + middle, 1, low)),
    )


def _sentence(words: str, theme: Theme) -> Diagram:
    return Diagram((-6, -2, 6, 2), notes=(Note(0, 0, words, theme.muted, "center"),))


# -- the local matrix ---------------------------------------------------------------------------


def _matrix(ring: Ring, theme: Theme) -> Diagram:
    return _weights(ring, theme) if len(ring.names) <= SMALL else _marks(ring, theme)


def _weights(ring: Ring, theme: Theme) -> Diagram:
    """A row for every new point, a column for every old one."""
    m, plain = len(ring.names), theme.background
    heads = [
        Box(x, y, (text,), plain, theme.muted, plain, 1.0, 1.0, group=1, line=0.0)
        for k, name in enumerate(ring.names)
        for x, y, text in ((k, -1.0, name), (-1.0, k, name))
    ]
    cells = [
        Box(j, i, _tersely(stencil.weight(name)), plain, theme.ink, theme.faint, 1.0, 1.0, group=1, line=1.2)
        for i, stencil in enumerate(ring.stencils)
        for j, name in enumerate(ring.names)
    ]
    title = Note(-1.5, -1.9, phrase("Local matrix, n = {n}", n=ring.valence), theme.muted)
    return Diagram((-1.5, -2.2, m - 0.5, m - 0.5), (*heads, *cells), (), (title,), largest=64.0, shape=(1.0, 2.4))


def _marks(ring: Ring, theme: Theme) -> Diagram:
    """Where the weights are, the darker the heavier, and one row of each kind in words; the others are copies."""
    m, heaviest = len(ring.names), float(np.abs(ring.matrix).max())
    frame = Box(m / 2, m / 2, ("",), theme.background, theme.ink, theme.muted, m + 1, m + 1, line=1.2)
    marks = [
        Box(j + 0.5, i + 0.5, ("",), fill, theme.ink, fill, 0.86, 0.86, line=0.0)
        for i, j in zip(*(place.tolist() for place in np.nonzero(ring.matrix)), strict=True)
        for fill in [_paler(theme, abs(float(ring.matrix[i, j])) / heaviest)]
    ]
    row = m / 6
    kinds = [in_words(s, ring.valence) for s in ring.stencils if s.point in ("V", "E1", "F1")]
    words = [Note(m / 2, m + (k + 0.75) * row, text, theme.ink, "center") for k, text in enumerate(kinds)]
    title = Note(-0.5, -0.7 * row, phrase("Local matrix, n = {n}", n=ring.valence), theme.muted)
    low = m + (len(kinds) + 0.25) * row
    return Diagram((-0.5, -1.1 * row, m + 0.5, low), (frame, *marks), (), (title, *words))


def _paler(theme: Theme, weight: float) -> tuple[float, float, float]:
    return mixed(theme.background, theme.ink, PALEST + (1 - PALEST) * weight)


def in_words(stencil: NamedStencil, n: int) -> str:
    """The row with points of one weight put together: ``F1 = 1/4 (V + E1 + F1 + E2)``."""
    groups: dict[str, list[str]] = {}
    for name, weight in stencil.terms:
        groups.setdefault(_spelled(weight), []).append(name)
    return f"{stencil.point} = " + " + ".join(f"{weight} {_together(names, n)}" for weight, names in groups.items())


def _together(names: list[str], n: int) -> str:
    for letter in "EF":
        every = [f"{letter}{k}" for k in range(1, n + 1)]
        if set(every) <= set(names):
            names = [*(name for name in names if name not in every), f"Σ{letter}"]
    return names[0] if len(names) == 1 else f"({' + '.join(names)})"


def _spelled(weight: Exact) -> str:
    return _tersely(weight)[0]


def _tersely(weight: Exact) -> tuple[str, ...]:
    """A fraction; else, or where it has no room, four decimals, or three."""
    words, decimals = spelled(weight), (said(float(weight)), said(float(weight), 3))
    return decimals if "." in words else (words, *decimals)


# -- the characteristic map ---------------------------------------------------------------------


def _map(found: Analysis, theme: Theme) -> Diagram:
    """The net that a step copies at lambda, heavy, over the surface it makes, fine."""
    fine, net = (_strokes(mesh) for mesh in (found.chart.sheet, found.chart.net))
    links = (
        *(Link(*ends, theme.net, 0.75, 1.4) for ends in fine),
        *(Link(*ends, theme.ink, 1.0, 3.2) for ends in net),
    )
    right, low = np.abs(np.array(net)).reshape(-1, 2).max(axis=0)
    between = 1.0 if found.ring.valence <= 6 else right  # the tips of more faces leave no room
    first = Note(1.05 * between, 0, "E1", theme.muted)
    left, end = -1.05 * right, max(right, between + 0.4)
    title = Note((left + end) / 2, -1.2 * low, "Characteristic map", theme.muted, "center")
    return Diagram((left, -1.36 * low, end, 1.05 * low), (), links, (title, first), largest=1000.0)


@lru_cache(maxsize=64)
def _strokes(mesh: Mesh) -> tuple[tuple[float, float, float, float], ...]:
    """The edges of the faces that are not hidden, y downwards."""
    t = mesh.surface
    shown = np.zeros(t.n_edges, dtype=np.bool_)
    shown[t.edge[~t.hidden[t.face]]] = True
    ends = mesh.points[t.ends[shown]][:, :, :2] * np.array([1.0, -1.0])
    return tuple((a, b, c, d) for a, b, c, d in ends.reshape(-1, 4).tolist())


# -- eigenvalues --------------------------------------------------------------------------------


def _eigenvalues(found: Analysis, theme: Theme) -> Diagram:
    """A number line for each mode, one under another; lambda and its square are lines across all of them."""
    modes = found.ring.valence // 2 + 1
    ring, square = found.subdominant, found.subdominant**2
    least = min(0.0, min(e.value for e in found.eigenvalues))
    left = AXIS * least
    links = (
        *(Link(left, k, AXIS, k, theme.faint, 1.0, 2.0) for k in range(modes)),
        *(Link(AXIS * x, -0.55, AXIS * x, modes - 0.45, theme.net, 0.8, 2.0) for x in (0.0, 1.0)),
        *(Link(AXIS * x, -0.55, AXIS * x, modes - 0.45, theme.selection, 1.0, 3.0) for x in (square, ring)),
        *(
            Link(AXIS * e.value, e.mode - 0.26, AXIS * e.value, e.mode + 0.26, theme.ink, 1.0, 8.0)
            for e in found.eigenvalues
        ),
    )
    blanks, words = _values(found, theme)
    heads = (
        Note(AXIS * square - 0.08, -1, f"λ² = {said(square)}", theme.selection, "right"),
        Note(AXIS * ring + 0.08, -1, f"λ = {said(ring)}", theme.selection),
        Note(AXIS, -1, "1", theme.muted, "center"),
    )
    told = tuple(Note(AXIS + 0.3, k, _verdict(c), theme.ink) for k, c in _by_mode(found).items() if k < modes)
    named = tuple(Note(left - 0.25, k, _mode(k), theme.muted, "right") for k in range(modes))
    return Diagram(
        (left - 2.8, -1.5, AXIS + 3.3, modes - 0.4), tuple(blanks), links,
        (*heads, *told, *named, *words),
        largest=64.0, shape=(0.2, 12.0),
    )  # fmt: skip


def _by_mode(found: Analysis) -> dict[int, Condition]:
    smooth, bowls, saddles = found.conditions
    return {0: bowls, 1: smooth, 2: saddles}


def _verdict(condition: Condition) -> str:
    if condition.name != "C¹":
        return condition.word
    return phrase("C¹ holds") if condition.holds else phrase("C¹ fails: {word}", word=condition.word)


def _mode(k: int) -> str:
    """What runs so often round the vertex."""
    return {0: phrase("0, bowls"), 1: phrase("±1, ring"), 2: phrase("±2, saddles")}.get(k, f"±{k}")


def _values(found: Analysis, theme: Theme) -> tuple[list[Box], list[Note]]:
    """At the right of each mark what it is, where that does not reach the next one; lines stop there."""
    plain, blanks, words = theme.background, list[Box](), list[Note]()
    for k, e in enumerate(found.eigenvalues):
        gaps = [AXIS * (o.value - e.value) for o in found.eigenvalues[:k] if o.mode == e.mode]
        if e.value < 1 - LONG / AXIS and not any(-EQUAL < gap < LONG for gap in gaps):
            x, wide = AXIS * e.value + 0.12, min([LONG, *(gap - 0.3 for gap in gaps if gap > 0)])
            blanks.append(Box(x + wide / 2, e.mode, ("",), plain, plain, plain, wide, 0.8, line=0.0))
            words.append(Note(x + 0.06, e.mode, said(e.value), theme.ink))
    return blanks, words


def said(value: float, places: int = 4) -> str:
    """A number in decimals, as tables have it: .2500; zero, however it was rounded, as 0."""
    return "0" if abs(value) <= EQUAL else f"{value:.{places}f}".replace("-", "−").replace("0.", ".", 1)


# -- counts -------------------------------------------------------------------------------------

COLUMNS = (
    (phrase("level"), 0.0),
    ("V", 1.6),
    ("E", 3.2),
    ("F", 4.8),
    ("χ", 5.8),
    (phrase("extraordinary"), 8.1),
    (phrase("apart"), 10.0),
)
"""What is counted, and where its figures end."""


def _counts(trace: Trace, level: int, theme: Theme) -> Diagram:
    """Level by level, as far as the trace goes; the level that is shown in ink."""
    rows = list(enumerate(_by_level(trace)))[:MOST_LEVELS]
    heads = [Note(x, 0, name, theme.muted, "right") for name, x in COLUMNS]
    cells = [
        Note(x, row, text, theme.ink if k == level else theme.muted, "right")
        for row, (k, c) in enumerate(rows, 1)
        for (_, x), text in zip(COLUMNS, _told(k, c), strict=True)
    ]
    line = Link(-1.1, 0.5, 10.0, 0.5, theme.faint, 1.0, 2.0)
    return Diagram((-1.2, -0.5, 10.1, len(rows) + 0.5), (), (line,), (*heads, *cells), largest=64.0, shape=(0.2, 12.0))


def _told(level: int, c: Counts) -> tuple[str, ...]:
    numbers = (c.vertices, c.edges, c.faces, c.euler, c.extraordinary)
    apart = "–" if c.apart is None else plural("{n:,} edge", "{n:,} edges", c.apart, n=c.apart)
    return (f"{level}", *(f"{number:,}".replace("-", "−") for number in numbers), apart)


@lru_cache(maxsize=16)
def _by_level(trace: Trace) -> tuple[Counts, ...]:
    """The counts of every level's mesh; none for polygons and nets."""
    ends = [trace.begins(level) for level in range(trace.levels[-1] + 2 if trace.levels else 1)]
    meshes = [trace.topology_at(k) for k in ends]
    return tuple(counts(t) for t in meshes if isinstance(t, Topology))

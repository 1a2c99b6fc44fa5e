"""From a state to a picture: every decision about what is shown is taken here.

Nothing is painted: the result is a display list, so that a test can read "four weight labels,
3/8 3/8 1/8 1/8" without a screen, and every painter paints the same.
"""

from contextlib import suppress
from dataclasses import replace
from functools import lru_cache, reduce
from itertools import accumulate, pairwise

from app import asking
from app.draw import asked, diagrams, distances, lattice, matrices, motion, spectrum, stencils, surface
from app.draw.framing import camera
from app.draw.limits import LIMIT_POINT
from app.draw.picture import Camera, Colour, Diagram, Entry, Pane, Picture, Scene, Shape
from app.draw.pointed import Pointed, row_of
from app.draw.scenes import CONTRIBUTOR, EXTRAORDINARY_NAME, scene
from app.draw.selected import is_pickable, selected
from app.draw.spoken import translated
from app.draw.theme import NAMES, Theme, enlarged, theme_of
from app.draw.turned import turned
from app.state import Spot, State, level_of
from app.words import speaking, tr
from lessons.questions import Which
from lessons.script import Beat, Kind, Look, View
from subdivision import Mesh, Polyline, Role, TopologyError, Trace
from subdivision.arrays import Floats
from subdivision.words import joined, phrase

WITH_MATRIX = 0.56
"""The part of the width that is left to the views beside the matrices."""

WITH_SPECTRUM = 0.38
"""The same beside an extraordinary vertex in numbers."""

WITH_ANSWERS = 0.72
"""The same beside answers to choose from."""

CROWD = 500
"""Beyond so many control points their markers follow the hand with fewer corners."""

WIDE = 2.4
"""Width to height of what the words leave of a picture."""

PYRAMID, ARRAY = 1.8, 1.4
"""How wide the diagrams of polygons and nets are beside a scene, relative to it."""


def compose(state: State, *, is_hasty: bool = False) -> Picture:
    """The picture of a state, in its language; in haste with coarser surfaces, for as long as the hand moves."""
    with speaking(state.options.language):
        return translated(_composed(state, is_hasty=is_hasty))


def is_heavy(state: State) -> bool:
    """Whether a picture made in haste is another one."""
    traces = ((state.trace(view), view.at(state.progress)) for view in state.now.views if view.kind is Kind.SCENE)
    return any(surface.coarser(trace, at) < at or _is_crowded(trace) for trace, at in traces)


def _is_crowded(trace: Trace) -> bool:
    """Whether there are many points to take hold of."""
    return trace.control.topology.n_vertices > CROWD


def _composed(state: State, *, is_hasty: bool) -> Picture:
    theme, beat = dressed(state), state.now
    rects = _rects(beat)
    found = [
        _content(state, view, theme, rect[2] * rect[3], is_hasty=is_hasty)
        for view, rect in zip(beat.views, rects, strict=True)
    ]
    contents = surface.painted([content for content, _ in found], [values for _, values in found], theme)
    panes = tuple(
        Pane(content, rect, view.title, _measured(state, view), _frame(state, k, theme))
        for k, (content, view, rect) in enumerate(zip(contents, beat.views, rects, strict=True))
    )
    if asides := _answers(state, theme):
        left = WITH_ANSWERS
    else:
        asides, left = _asides(state, theme), WITH_SPECTRUM if state.options.spectrum else WITH_MATRIX
    if asides:
        panes = (*(_within(pane, 0, left) for pane in panes), *(_within(pane, left, 1 - left) for pane in asides))
    return Picture(
        panes=panes,
        background=theme.background,
        ink=theme.ink,
        muted=theme.muted,
        legend=legend(panes, theme) if state.options.legend else (),
        title=state.lesson.title,
        caption=said(state, beat),
        formula=beat.formula,
        corner=_corner(state),
        stroke=theme.stroke,
        scale=theme.type,
        growth=theme.growth,
    )


def _asides(state: State, theme: Theme) -> tuple[Pane, ...]:
    """What stands beside the views, one under another: matrices of the step, vectors of a box spline, distances."""
    lead = _leading_scene(state)
    if state.options.spectrum and lead is not None:
        return spectrum.spectrum(state, lead, theme)
    shown = [_matrix(state, lead, theme)] if state.options.matrix and lead is not None else []
    if state.options.lattice and state.vectors:
        shown.append(lattice.lattice(state.vectors, theme))
    if state.options.distances and lead is not None:
        shown.append(distances.distances(state, lead, theme))
    return tuple(Pane(each, (0, k / len(shown), 1, 1 / len(shown))) for k, each in enumerate(shown))


def _answers(state: State, theme: Theme) -> tuple[Pane, ...]:
    """Beside a question: weights to choose from; beside its answer: what was chosen, and what is true."""
    if (choices := asked.weights(state, theme)) is not None:
        return (Pane(choices),)
    shown = list(asked.pictures(state))
    return tuple(
        Pane(
            _content(state, view, theme, (1 - WITH_ANSWERS) / len(shown))[0], (0, k / len(shown), 1, 1 / len(shown)),
            view.title, frame=theme.guess if is_chosen else None,
        )
        for k, (view, is_chosen) in enumerate(shown)
    )  # fmt: skip


def _frame(state: State, k: int, theme: Theme) -> Colour | None:
    """Round the picture that is chosen."""
    is_chosen = isinstance(state.now.asks, Which) and asking.chosen(state) == k
    return theme.guess if is_chosen else None


def _leading_scene(state: State) -> View | None:
    """The view whose matrices can be shown beside it."""
    return next((v for v in state.now.views if v.kind is Kind.SCENE and v.trace.stages), None)


def _within(pane: Pane, left: float, width: float) -> Pane:
    """A pane of the whole picture as one of a column of it."""
    x, y, w, h = pane.rect
    return replace(pane, rect=(left + width * x, y, width * w, h))


def _matrix(state: State, view: View, theme: Theme) -> Diagram:
    return matrices.matrices(view.trace, view.at(state.progress), theme, in_focus(state, view))


def dressed(state: State) -> Theme:
    """The theme the picture wears."""
    o = state.options
    return enlarged(theme_of(state.lesson, o.theme, o.as_caption), o.scale)


def said(state: State, beat: Beat) -> str:
    """The caption of a beat of the lesson, in the state's language; colours are called what they are."""
    with speaking(state.options.language):
        return tr(beat.text).format_map({role: tr(colour) for role, colour in dressed(state).words.items()})


def legend(panes: tuple[Pane, ...], theme: Theme) -> tuple[Entry, ...]:
    """One entry for each kind of point that is in the picture: the roles in order, then what is pointed out."""
    there = {m.name: m.shape for p in panes if isinstance(p.content, Scene) for m in p.content.markers if len(m.points)}
    points = [Entry(there[NAMES[r]], theme.roles[r], NAMES[r]) for r in Role if NAMES[r] in there]
    if theme.extraordinary is not None and EXTRAORDINARY_NAME in there:
        points.insert(1, Entry(Shape.SPHERE, theme.extraordinary, EXTRAORDINARY_NAME))
    if CONTRIBUTOR in there:
        points.append(Entry(Shape.SPHERE, theme.selection, CONTRIBUTOR))
    if any(p.content.pins for p in panes if isinstance(p.content, Scene)):
        points.append(Entry(Shape.AIM, theme.guess, asked.PREDICTION))
    if LIMIT_POINT in there:
        points.append(Entry(Shape.SPHERE, theme.accent, LIMIT_POINT))
    return (*points, *stencils.legend(panes, theme))


def pointed(state: State, view: View) -> Pointed | None:
    """The row to point out in a view: of the point in focus, else the lesson's own at the end of its beat."""
    if (found := in_focus(state, view)) is not None:
        with suppress(TopologyError):  # no limit to read: the panel beside the picture says why
            return row_of(state.trace(view), found, state.options.across)
    if view.stencil is not None and state.progress == 1 and not view.veiled:
        return Pointed(view.stencil, int(view.stop), view.span)
    return None


def in_focus(state: State, view: View) -> Spot | None:
    """The point in focus, if it is one of this view's, here or on the way here."""
    at, spot = view.at(state.progress), state.focus
    if spot is None or state.now.views[spot.pane].trace is not view.trace or at != int(at) or spot.stage > at:
        return None
    trace = view.trace
    n = trace.stages[spot.stage - 1].n_points if spot.stage else trace.control.topology.n_vertices
    return spot if spot.point < n else None


def lit(state: State, view: View) -> Spot | None:
    """The point whose boxes light up in a diagram: the one in focus, else the lesson's own at the end of its beat."""
    spot, views = state.focus, state.now.views
    if spot is not None and views[spot.pane].trace is view.trace:
        return spot
    for k, other in sorted(enumerate(views), key=lambda one: one[1] is not view):
        if other.trace is view.trace and other.stencil is not None and state.progress == 1 and not other.veiled:
            return Spot(k, int(other.stop), other.stencil.point)
    return None


def shown_mesh(state: State, view: View) -> Mesh:
    """What a view shows now, helpers left out, also between two stages."""
    frame = state.trace(view).frame(motion.eased(view.at(state.progress)))
    return Mesh(frame.topology, frame.points[: frame.topology.n_vertices])


def _content(
    state: State, view: View, theme: Theme, share: float, *, is_hasty: bool = False
) -> tuple[Scene | Diagram, surface.Values | None]:
    """What a pane shows that has a ``share`` of the picture, and the values that its colours will stand for."""
    trace, at, row = state.trace(view), view.at(state.progress), pointed(state, view)
    if view.kind is Kind.DIAGRAM:
        return diagrams.diagram(trace, at, theme, lit(state, view)), None
    if view.kind is Kind.STENCIL and view.stencil is not None:
        words = asked.veiled(state, view.stencil) if view.veiled else None
        return stencils.stencil(trace, Pointed(view.stencil, int(view.stop), view.span), theme, words), None
    # of the trace as the lesson has it: dragging a point moves no camera
    what = surface.shown(state, view, is_hasty=is_hasty)
    is_as_told = what.framed is (view.framed or view.trace)
    seen = _seen(what.framed, what.look, view if is_as_told else None)
    over = shown_mesh(state, view.over) if view.over is not None and is_as_told else None
    is_striped = view.isophotes or state.options.surface_shows in surface.STRIPED
    options = replace(state.options, net=False) if is_striped and trace.control.topology.n_faces else state.options
    row = row if is_as_told or row is None or row.place is None else None
    frame = surface.frame_of(what)
    made = scene(frame, what.trace, seen, options, theme, row, view.marks, over, share, what.stands_for)
    if state.picked is not None and is_pickable(state, view):
        made = selected(made, what.trace.control, state.picked, theme, is_control=what.at == 0)
    if is_as_told:
        made = asked.asked(made, state, view, theme)
    made = surface.dressed(made, what, frame, state, view, theme)
    seen = reduce(turned, (view.look or state.now.look).turned, made.camera)
    made = replace(made, camera=seen, is_hasty=is_hasty)
    return made, surface.values_of(state, view, what, frame)


@lru_cache(maxsize=16)
def _seen(trace: Trace, look: Look, view: View | None) -> Camera:
    """From where a trace is seen, and what the ``view``'s own stencil reads, if there is one."""
    return camera(trace, look, _contributors(view) if view is not None else None)


def _contributors(view: View) -> Floats | None:
    """Where the points are that the lesson's own stencil reads: the camera must see them."""
    if view.stencil is None:
        return None
    return view.trace.points[int(view.stop) - view.span][view.stencil.parents]


def _measured(state: State, view: View) -> str:
    shown = [view] if view.over is None else [view, view.over]
    reading = view.reading(*(shown_mesh(state, each) for each in shown)) if view.reading is not None else ""
    return joined("   ", [words for words in (reading, asking.measured(state, view)) if words])


def _rects(beat: Beat) -> tuple[tuple[float, float, float, float], ...]:
    """Up to three side by side, a diagram wider than a scene; more of them in rows, as large as they can be."""
    n = len(beat.views)
    if n <= 3:
        ends = list(accumulate(map(_share, beat.views), initial=0.0))
        return tuple((a / ends[-1], 0.0, (b - a) / ends[-1], 1.0) for a, b in pairwise(ends))
    aspect = max(camera(view.framed or view.trace, view.look or beat.look).aspect for view in beat.views)
    columns = max(range(1, n + 1), key=lambda c: min(1 / -(-n // c), WIDE / (c * aspect)))
    rows = -(-n // columns)
    return tuple(((k % columns) / columns, (k // columns) / rows, 1 / columns, 1 / rows) for k in range(n))


def _share(view: View) -> float:
    """How much of the width a view asks for."""
    if view.kind is not Kind.DIAGRAM:
        return 1.0
    return PYRAMID if isinstance(view.trace.control.topology, Polyline) else ARRAY


def _corner(state: State) -> str:
    """Knobs, level and counts; the counts only where all panes show the same control object at the same place."""
    turned = [
        joined(" ", (knob.label, str(value)))
        for knob, value in zip(state.lesson.knobs, state.lesson.values, strict=True)
    ]
    lead = state.now.lead
    is_one = all(v.trace is lead.trace and (v.start, v.stop) == (lead.start, lead.stop) for v in state.now.views)
    if lead.kind is Kind.STENCIL or not is_one:
        return joined("   ", turned)
    t = state.trace(lead).topology_at(int(lead.at(state.progress)))
    parts = [f"V {t.n_vertices}", f"E {t.n_edges}"] + ([f"F {t.n_faces}", f"χ {t.euler}"] if t.n_faces else [])
    return joined("   ", [*turned, phrase("level {level}", level=level_of(state)), "  ".join(parts)])

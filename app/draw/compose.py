"""From a state to a picture: every decision about what is shown is taken here.

Nothing is painted: the result is a display list, so that a test can read "four weight labels,
3/8 3/8 1/8 1/8" without a screen, and every painter paints the same.
"""

from app.draw import diagrams, motion
from app.draw.framing import camera
from app.draw.picture import Diagram, Entry, Pane, Picture, Scene, Shape
from app.draw.scenes import CONTRIBUTOR, scene
from app.draw.theme import NAMES, THEMES, Theme
from app.state import State, level_of
from lessons.script import Beat, Kind, View
from subdivision import Polyline, Role, Stencil, Step


def compose(state: State) -> Picture:
    """The picture of a state."""
    theme, beat = THEMES[state.options.theme], state.now
    panes = tuple(
        Pane(_content(state, view, theme), rect, view.title)
        for view, rect in zip(beat.views, _rects(beat), strict=True)
    )
    return Picture(
        panes=panes,
        background=theme.background,
        ink=theme.ink,
        muted=theme.muted,
        legend=legend(panes, theme) if state.options.legend else (),
        title=state.lesson.title,
        caption=beat.text,
        formula=beat.formula,
        corner=_counts(state),
        stroke=theme.stroke,
        scale=theme.type,
    )


def legend(panes: tuple[Pane, ...], theme: Theme) -> tuple[Entry, ...]:
    """One entry for each kind of point that is in the picture: the roles in order, then what is pointed out."""
    there = {m.name: m.shape for p in panes if isinstance(p.content, Scene) for m in p.content.markers if len(m.points)}
    points = [Entry(there[NAMES[r]], theme.roles[r], NAMES[r]) for r in Role if NAMES[r] in there]
    if CONTRIBUTOR in there:
        points.append(Entry(Shape.SPHERE, theme.selection, CONTRIBUTOR))
    return tuple(points)


def stencil_of(state: State, view: View) -> tuple[Stencil | None, int]:
    """The row to point out: of the point in focus, else the lesson's own at the end of its beat; and its span."""
    trace, at = state.trace(view), view.at(state.progress)
    k = int(at)
    if state.focus is not None and at == k and k > 0 and state.focus < trace.stages[k - 1].n_points:
        begin = trace.begins(trace.levels[k - 1])
        return Step(trace.stages[begin:k]).stencil(state.focus), k - begin
    if state.now.stencil is not None and state.progress == 1:
        return state.now.stencil, state.now.span
    return None, 1


def _content(state: State, view: View, theme: Theme) -> Scene | Diagram:
    trace, at = state.trace(view), view.at(state.progress)
    if view.kind is Kind.DIAGRAM:
        return diagrams.diagram(trace, at, theme)
    stencil, span = stencil_of(state, view)
    frame = trace.frame(motion.eased(at))
    seen = camera(view.trace, state.now.look)  # of the trace as the lesson has it: dragging a point moves no camera
    return scene(frame, trace, seen, state.options, theme, stencil, span)


def _rects(beat: Beat) -> tuple[tuple[float, float, float, float], ...]:
    """Side by side; a pyramid is wide, so it takes more than its half."""
    n = len(beat.views)
    if any(v.kind is Kind.DIAGRAM and isinstance(v.trace.control.topology, Polyline) for v in beat.views):
        return ((0.0, 0.0, 0.36, 1.0), (0.36, 0.0, 0.64, 1.0))[:n]
    columns = n if n <= 3 else (n + 1) // 2
    rows = -(-n // columns)
    return tuple(((k % columns) / columns, (k // columns) / rows, 1 / columns, 1 / rows) for k in range(n))


def _counts(state: State) -> str:
    view = state.now.lead
    t = state.trace(view).topology_at(int(view.at(state.progress)))
    parts = [f"V {t.n_vertices}", f"E {t.n_edges}"] + ([f"F {t.n_faces}", f"χ {t.euler}"] if t.n_faces else [])
    return f"level {level_of(state)}   " + "  ".join(parts)

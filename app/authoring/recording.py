"""A view as the lines of a lesson that show it again.

What a lesson says and shows is recorded: objects, schemes, stages, stencils, cameras, words.  What the user has
switched on besides stays the user's.  ``recorded`` proves itself: the new lesson is told before it is written, and
where its picture is another one, what differs is said.
"""

import ast
from collections.abc import Collection, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from app.authoring.pieces import RecordingError, added, assignments, number, plain, string, whole, wrapped
from app.authoring.rebuilt import EXACT, Source, quote_of, quoting, rebuilt
from app.draw.compose import compose
from app.draw.picture import Picture
from app.draw.pointed import row_of
from app.draw.seen import from_there
from app.state import State, at_stop, choose, edited, start, stops
from lessons.own import LessonError, load
from lessons.script import Beat, Kind, Lesson, View, look_at
from lessons.turn import REST
from subdivision import Mesh, Step, TopologyError, Trace, files
from subdivision.files.saving import save
from subdivision.words import phrase

HEAD = '''\
"""{title}: steps recorded from the window."""

from collections.abc import Iterator

from lessons.script import Beat, lesson


@lesson("{title}")
def {id}() -> Iterator[Beat]:
'''


@dataclass(frozen=True)
class Recorded:
    """A lesson's file with one more step: its new ``text``, the ``meshes`` beside it, and what ``differs``."""

    path: Path
    before: str
    text: str
    meshes: tuple[tuple[str, Mesh], ...]
    differs: str = ""

    def write(self) -> None:
        """Write it; meshes first, so that the lesson never misses one.

        Raises
        ------
        RecordingError
            If the file has changed since, or cannot be written.
        OSError, FileError
        """
        if _text_of(self.path) != self.before:
            raise RecordingError(phrase("{file} has changed meanwhile; record once more", file=self.path.name))
        for name, mesh in self.meshes:
            files.write(self.path.with_name(name), mesh)
        save(self.path, [self.text.encode()])


def recorded(state: State, path: Path, title: str, id_: str, taken: Collection[str] = ()) -> Recorded:
    """A view added to the lesson in a file, or to a new lesson if there is none yet; ``taken`` are ids it may not use.

    Raises
    ------
    RecordingError
        If it cannot be recorded, or the file not be added to.
    """
    before = _text_of(path)
    old = before or HEAD.format(title=title, id=id_)
    lines = _Lines(state, old, _free_stem(path))
    text = added(old, lines.body, lines.names, path.name)
    found = Recorded(path, before, text, lines.meshes)
    what = _difference(state, found, taken)
    return replace(found, differs=CALLED.get(what, ELSE) if what else lines.left_out)


def _text_of(path: Path) -> str:
    """What a file says; nothing where there is none."""
    try:
        return path.read_text(encoding="utf-8") if path.exists() else ""
    except (OSError, UnicodeDecodeError) as error:
        raise RecordingError(phrase("{file} cannot be read; choose another file", file=path.name)) from error


CALLED = {
    **dict.fromkeys(("camera", "position", "focal", "up", "scale", "aspect"), "from where it is seen"),
    **dict.fromkeys(("labels", "text"), "the weights at the points"),
    **dict.fromkeys(("legend", "colour"), "the colours"),
    "reading": "what is measured below a pane",
}
"""Parts of a picture as users know them."""

ELSE = "a part of the picture"


# -- the lines --------------------------------------------------------------------------------


class _Lines:
    """The assignments and the beat that show a state, the names they need, and the meshes."""

    def __init__(self, state: State, old: str, stem: str) -> None:
        if state.now.asks is not None:
            raise RecordingError("this is a question; answer it, then record what it comes to")
        self.names: set[tuple[str, str]] = set()
        self.meshes: tuple[tuple[str, Mesh], ...] = ()
        self.assigned: list[str] = []
        self.left_out = ""
        self._state, self._stem = state, stem
        self._known = assignments(old)
        self._used = {node.id for node in ast.walk(ast.parse(whole(old))) if isinstance(node, ast.Name)}
        self._traces: dict[Trace, str] = {}
        self._undragged: dict[Trace, str] = {}
        self.beat = self._beat()

    # -- traces

    def _named(self, view: View, pane: str) -> str:
        """The variable that holds a view's trace, with what was dragged."""
        if view.trace not in self._traces:
            stem = f"{self._stem}_{len(self.meshes) + 1}" if self.meshes else self._stem
            source = rebuilt(view.trace, self._state, stem)
            if source is None:
                raise RecordingError(
                    phrase("{pane} is made by the lesson's own lines; copy them from its file", pane=pane)
                )
            name = self._assign(source, "told")
            self._undragged[view.trace] = name
            if edited(view.trace, self._state.edits) is not view.trace:
                there = {v: to for v, to in self._state.edits if v < view.trace.control.topology.n_vertices}
                name = self._assign(Source(f"{name}.dragged({there})"), "dragged")
            self._traces[view.trace] = name
        return self._traces[view.trace]

    def _assign(self, source: Source, wished: str) -> str:
        self.names |= source.names
        if (known := self._known.get(ast.unparse(ast.parse(source.text)))) is not None:
            return known
        self.meshes += source.meshes
        name = next(n for n in (wished, *(f"{wished}_{k}" for k in range(2, 10_000))) if n not in self._used)
        self._used.add(name)
        self._known[ast.unparse(ast.parse(source.text))] = name
        self.assigned.append(f"{name} = {source.text}")
        return name

    @property
    def body(self) -> list[str]:
        """The lines of the lesson."""
        where = f"'{self._state.lesson.title}', step {_step_number(self._state)}"
        return [f"    # Recorded from {where}; change the words.",
                *(wrapped(f"    {line}", 8) for line in self.assigned), self.beat]  # fmt: skip

    # -- the beat

    def _beat(self) -> str:
        state, beat = self._state, self._state.now
        begin = _before(state)
        views = [self._view(view, k, begin) for k, view in enumerate(beat.views)]
        said = [string(beat.text)]
        if beat.look != look_at(beat.lead.trace) or state.turn != REST:
            said.append(f"look={self._look(beat)}")
        said += [f"{name}={string(getattr(beat, name))}" for name in ("formula", "notes") if getattr(beat, name)]
        self.names.add(("lessons.script", "side_by_side"))
        head = "    yield side_by_side("
        return wrapped(f"{head}{', '.join([said[0], *views, *said[1:]])})", len(head))

    def _look(self, seen: Any) -> str:
        """Where a camera stands, and how the hand has turned it from there."""
        look = seen if not isinstance(seen, Beat) else seen.look
        turns = (*look.turned, *([self._state.turn] if self._state.turn != REST else []))
        told = [f"{f.name}={getattr(look, f.name)!r}" for f in fields(look)
                if f.name != "turned" and getattr(look, f.name) != f.default]  # fmt: skip
        if turns:
            self.names.add(("lessons.turn", "Turn"))
            each = [plain("Turn", turn) for turn in turns]
            told.append(f"turned=({', '.join(each)},)")
        self.names.add(("lessons.script", "Look"))
        return f"Look({', '.join(told)})"

    def _view(self, view: View, pane: int, begin: float) -> str:
        state = self._state
        name = self._named(view, phrase("pane {number}", number=pane + 1))
        at = view.at(state.progress)
        told = [name, number(view.at(begin)), number(at)]
        if view.kind is not Kind.SCENE:
            self.names.add(("lessons.script", "Kind"))
            told.append(f"Kind.{view.kind.name}")
        told += [f"{f}={string(getattr(view, f))}" for f in ("title",) if view.title]
        told += self._stencil(view, name, at)
        told += [f"marks={view.marks!r}"] if view.marks else []
        if view.look is not None:
            told.append(f"look={self._look(view.look)}")
        if name != self._undragged[view.trace]:
            told.append(f"framed={self._undragged[view.trace]}")
        elif view.framed is not None:
            told.append(f"framed={self._named(replace(view, trace=view.framed), 'what the camera sees')}")
        if view.over is not None:
            over = self._named(view.over, phrase("what lies over pane {number}", number=pane + 1))
            told.append(f"over=View({over}, {number(view.over.at(begin))}, {number(view.over.at(state.progress))})")
        told += self._reading(view)
        told += ["isophotes=True"] if view.isophotes else []
        self.names.add(("lessons.script", "View"))
        return f"View({', '.join(told)})"

    def _stencil(self, view: View, name: str, at: float) -> list[str]:
        """The row that is pointed out: that of the point in focus, else the lesson's own at the end of its beat."""
        state, spot = self._state, self._state.focus
        if spot is not None and state.now.views[spot.pane].trace is view.trace and spot.stage == at > 0:
            try:
                row = row_of(state.trace(view), spot, state.options.across)
            except TopologyError:
                row = None
            if row is not None and row.place is None:
                return _row(name, view.trace, row.stage, row.span, spot.point, self.names)
        if view.stencil is not None and (state.progress == 1 or view.kind is Kind.STENCIL):
            stage, span = int(view.stop), view.span
            expression = _row(name, view.trace, stage, span, view.stencil.point, self.names)
            made = _step(view.trace, stage, span).stencil(view.stencil.point)
            if made.terms == view.stencil.terms:
                return expression
            self.names |= {("subdivision", "Stencil"), ("fractions", "Fraction")}
            return [f"stencil={view.stencil!r}", f"span={span}"]
        return []

    def _reading(self, view: View) -> list[str]:
        if view.reading is None:
            return []
        module, name = getattr(view.reading, "__module__", ""), getattr(view.reading, "__qualname__", "")
        if module == "lessons.measured" and name.isidentifier():
            self.names.add((module, name))
            return [f"reading={name}"]
        where = quote_of(view.trace, self._state)
        if where is not None and where.lesson == self._state.lesson.id:
            where = replace(where, beat=self._state.lesson.asking(False).beats.index(self._state.now),
                            pane=self._state.now.views.index(view))  # fmt: skip
            self.names.add(("lessons.recorded", "quoted"))
            return [f"reading={quoting(where)}.reading"]
        self.left_out = "what is measured below a pane"
        return []


def _step_number(state: State) -> int:
    return 1 + sum((s.beat, s.at) < (state.beat, state.at) for s in stops(state.lesson))


def _before(state: State) -> float:
    """The progress at which the stage began that ends where the state is; where it is, if none ends there."""
    beat, at = state.now, state.at
    if beat.is_still or at != int(at) or at == beat.start:
        return state.progress
    return beat.progress(max(at - 1, beat.start))


def _step(trace: Trace, stage: int, span: int) -> Step:
    return Step(trace.stages[stage - span : stage])


def _row(name: str, trace: Trace, stage: int, span: int, point: int, names: set[tuple[str, str]]) -> list[str]:
    if span == 1:
        made = f"{name}.stages[{stage - 1}]"
    elif stage == span == len(trace.stages):
        made = f"{name}.whole"
    elif stage == span:
        made = f"{name}.upto({stage})"
    else:
        names.add(("subdivision", "Step"))
        made = f"Step({name}.stages[{stage - span}:{stage}])"
    return [f"stencil={made}.stencil({point})", *([f"span={span}"] if span != 1 else [])]


def _free_stem(path: Path) -> str:
    """A name for a mesh beside a lesson that no file has."""
    stems = (path.stem, *(f"{path.stem}_{k}" for k in range(2, 10_000)))
    return next(stem for stem in stems if not path.with_name(f"{stem}.obj").exists())


# -- the proof --------------------------------------------------------------------------------


def _difference(state: State, found: Recorded, taken: Collection[str]) -> str:
    """What of the picture is another one in the recorded lesson; empty where it is the same.

    Raises
    ------
    RecordingError
        If the lesson cannot be told.
    """
    aside = [found.path.with_name(name) for name, _ in found.meshes]
    try:
        for name, mesh in found.meshes:
            files.write(found.path.with_name(name), mesh)
        told = load(found.path, taken, source=found.text.encode())[-1]
        there = shown(told, state)
        return difference(picture(state), picture(there))
    except (LessonError, OSError, files.FileError) as error:
        raise RecordingError(str(error)) from error
    finally:
        for path in aside:
            path.unlink(missing_ok=True)


def shown(lesson: Lesson, state: State) -> State:
    """The last step of a lesson, in the looks of a state."""
    return at_stop(start(lesson, replace(state.options, asking=False)), stops(lesson)[-1])


def picture(state: State) -> Picture:
    """What a state shows, without the names that belong to its lesson: its title, and what its knobs stand at."""
    plain = choose(replace(state, focus=state.focus, picked=None), asking=False)
    seen = from_there(compose(plain), plain.turn)
    return replace(seen, title="", corner="")


def difference(a: Any, b: Any, name: str = "") -> str:
    """The name of the first part in which two pictures differ; empty where none does."""
    if isinstance(a, str) or isinstance(b, str):
        return "" if a == b else name
    if type(a) is not type(b):
        return name or "kind"
    if isinstance(a, np.ndarray):
        return "" if a.shape == b.shape and np.allclose(a, b, rtol=EXACT, atol=EXACT) else name
    if is_dataclass(a):
        parts: Iterator[tuple[Any, Any, str]] = ((getattr(a, f.name), getattr(b, f.name), f.name) for f in fields(a))
        return next(filter(None, (difference(x, y, n) for x, y, n in parts)), "")
    if isinstance(a, tuple | list):
        if len(a) != len(b):
            return name
        return next(filter(None, (difference(x, y, name) for x, y in zip(a, b, strict=True))), "")
    return "" if a == b else name

"""Traces as the expressions that make them again, each proved by making it."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import product

import numpy as np

from app.sessions.keeping import is_same
from app.state import State
from lessons import built_in
from lessons.measured import without_helpers
from lessons.recorded import Quoted, bounded, origin
from lessons.script import fragment
from subdivision import Boundary, Grid, Mesh, Polyline, Scheme, Topology, TopologyError, Trace, schemes, shapes, trace
from subdivision.catalogue import FAMILIES, Value, scheme

WRITTEN_OUT = 24
"""Vertices of a mesh that stands in the lesson; of a larger one, the name of a file does."""

MOST_WRITTEN = 2000
"""Points of a polygon or a net, which no file can hold."""

EXACT = 1e-12
"""Points that were dragged are reckoned another way round, and are off by so little."""

DIRECT = {"lane-riesenfeld": "lane_riesenfeld", "tensor-product": "tensor_product", "box-spline": "box_spline",
          "triangle-pull": "triangle_pull", "quad-pull": "quad_pull"}  # fmt: skip
"""Families by the function that makes them."""


@dataclass(frozen=True)
class Source:
    """An expression, the names it needs as ``module: name``, and meshes that must lie in files beside it."""

    text: str
    names: frozenset[tuple[str, str]] = frozenset()
    meshes: tuple[tuple[str, Mesh], ...] = field(default=())

    def within(self, text: str, *names: tuple[str, str]) -> "Source":
        """A larger expression that holds this one at ``{}``."""
        return Source(text.replace("{}", self.text, 1), self.names | set(names), self.meshes)


def rebuilt(found: Trace, state: State, stem: str) -> Source | None:
    """What makes a trace of the state again; None if nothing is known that does.

    A trace of one of the program's lessons may be quoted; ``stem`` is the name of a mesh file, if one is needed.
    """
    made = _as_trace(found, state, stem)
    return made if made is not None and not made.meshes else _as_quoted(found, state) or made


# -- schemes and levels -----------------------------------------------------------------------


def _as_trace(found: Trace, state: State, stem: str) -> Source | None:
    levels = found.levels[-1] + 1 if found.levels else 0
    named = scheme_named(found.scheme, state)
    control = control_named(found.control, stem)
    if named is None or control is None:
        return None
    words, made = named
    for telling in dict.fromkeys((found.telling, *made.tellings)):
        if telling not in made.tellings:
            continue
        for join in (False, True):
            try:
                again = trace(made, found.control, telling, levels)
                again = without_helpers(again) if join else again
            except (TopologyError, ValueError, IndexError):
                continue
            if same_stages(again, found):
                is_usual = telling == next(iter(made.tellings))
                told = "" if is_usual else f', "{telling}"'
                deep = "" if levels == 1 else f", levels={levels}"
                source = Source(f"trace({words.text}, {control.text}{told}{deep})",
                                words.names | control.names | {("subdivision", "trace")}, control.meshes)  # fmt: skip
                return source.within("without_helpers({})", ("lessons.measured", "without_helpers")) if join else source
    return None


def same_stages(a: Trace, b: Trace) -> bool:
    """Whether two traces of one control object go through the same stages."""
    return (len(a.stages), a.levels) == (len(b.stages), b.levels) and all(
        s.name == t.name
        and np.array_equal(s.carries, t.carries)
        and np.array_equal(s.roles, t.roles)
        and is_same(Mesh(s.topology, p[: s.topology.n_vertices]), Mesh(t.topology, p[: t.topology.n_vertices]))
        and np.allclose(p, q, rtol=EXACT, atol=EXACT)
        for s, t, p, q in zip(a.stages, b.stages, a.points[1:], b.points[1:], strict=True)
    )


def scheme_named(wanted: Scheme, state: State) -> tuple[Source, Scheme] | None:
    """The name of a scheme, or the call that makes it."""
    for name in schemes.__all__:
        if getattr(schemes, name) is wanted:
            return Source(name, frozenset({("subdivision.schemes", name)})), wanted
    for family, values in _candidates(state):
        try:
            made = scheme(family, values)
        except (TopologyError, ValueError):
            continue
        if made.title == wanted.title:
            return _call(family, values), made
    return None


def _candidates(state: State) -> Iterator[tuple[str, tuple[Value, ...]]]:
    """Families with values: those of the laboratory, then all that can be chosen."""
    if state.lab is not None:
        yield from ((rule.family, rule.values) for rule in state.lab.rules)
        if state.lab.other is not None:
            yield state.lab.other.family, state.lab.other.values
    for family in FAMILIES.values():
        ranges: list[list[Value]] = []
        for parameter in family.parameters:
            if parameter.is_vectors:
                ranges.append([schemes.THREE_DIRECTION_QUARTIC, schemes.THREE_DIRECTION_LINEAR, schemes.ZWART_POWELL])
                continue
            steps = int((parameter.most - parameter.least) / parameter.step) + 1
            values = (parameter.least + k * parameter.step for k in range(steps))
            ranges.append([int(v) if isinstance(parameter.start, int) else v for v in values])
        yield from ((family.name, values) for values in product(*ranges))


def _call(family: str, values: tuple[Value, ...]) -> Source:
    names = {("fractions", "Fraction")} if "Fraction" in repr(values) else set()
    if family in DIRECT:
        listed = ", ".join(map(repr, values))
        return Source(f"{DIRECT[family]}({listed})", frozenset(names | {("subdivision.schemes", DIRECT[family])}))
    told = f'scheme("{family}", {values!r})' if values else f'scheme("{family}")'
    return Source(told, frozenset(names | {("subdivision.catalogue", "scheme")}))


# -- control objects --------------------------------------------------------------------------


def control_named(wanted: Mesh, stem: str) -> Source | None:
    """The shape of the house that a control object is, perhaps under a boundary rule; else its numbers, or a file."""
    for name, mesh in _shapes().items():
        source = Source(name, frozenset({("subdivision", "shapes")}))
        if is_same(mesh, wanted):
            return source
        if isinstance(wanted.topology, Topology) and np.array_equal(mesh.points, wanted.points):
            for rule in Boundary:
                if isinstance(mesh.topology, Topology) and is_same(bounded(mesh, rule), wanted):
                    return _under(source, rule)
    return _written(wanted, stem)


@cache
def _shapes() -> dict[str, Mesh]:
    """All shapes that need no numbers, by the call that makes them; the plainest call first."""
    calls = {f"shapes.{name.replace('-', '_')}()": name for name in shapes.SHAPES}
    found = {}
    for call, name in calls.items():
        plain = getattr(shapes, name.replace("-", "_"), None)
        mesh = shapes.SHAPES[name]()
        is_plain = plain is not None and _is_made(plain, mesh)
        found[call if is_plain else f'shapes.SHAPES["{name}"]()'] = mesh
    for name in ("face_and_ring", "two_triangles_and_ring"):
        found[f"shapes.{name}()"] = getattr(shapes, name)()
    for n in range(2, 9):
        found[f"shapes.polygon({n})"] = shapes.polygon(n)
    for n_s, n_t in product(range(2, 9), repeat=2):
        found[f"shapes.net({n_s}, {n_t})"] = shapes.net(n_s, n_t)
        found[f"shapes.net({n_s}, {n_t}, diagonal=True)"] = shapes.net(n_s, n_t, diagonal=True)
    return found


def _is_made(plain: object, mesh: Mesh) -> bool:
    try:
        return callable(plain) and is_same(plain(), mesh)
    except TypeError:
        return False


def _under(source: Source, rule: Boundary) -> Source:
    if rule is Boundary.HIDE:
        return source.within("fragment({})", ("lessons.script", "fragment"))
    return source.within(
        f"bounded({{}}, Boundary.{rule.name})", ("lessons.recorded", "bounded"), ("subdivision", "Boundary")
    )


def _written(wanted: Mesh, stem: str) -> Source | None:
    t, points = wanted.topology, [tuple(p) for p in wanted.points.tolist()]
    mesh = ("subdivision", "Mesh")
    if isinstance(t, Polyline) and len(points) <= MOST_WRITTEN:
        closed = ", closed=True" if t.closed else ""
        return Source(
            f"Mesh(Polyline({t.n_vertices}{closed}), {points})", frozenset({mesh, ("subdivision", "Polyline")})
        )
    if isinstance(t, Grid) and len(points) <= MOST_WRITTEN:
        flags = "".join(f", {name}=True" for name in ("wrap_s", "wrap_t", "diagonal") if getattr(t, name))
        made = f"Mesh(Grid({t.n_s}, {t.n_t}{flags}), {points})"
        return Source(made, frozenset({mesh, ("subdivision", "Grid")}))
    if not isinstance(t, Topology):
        return None
    if t.n_vertices <= WRITTEN_OUT and is_same(bare := Mesh(Topology.from_faces(t.loops()), wanted.points), wanted):
        assert bare is not None
        made = f"Mesh(Topology.from_faces({t.loops()}), {points})"
        return Source(made, frozenset({mesh, ("subdivision", "Topology")}))
    plain = Mesh(t.with_boundary(Boundary.LITERAL), wanted.points) if t.hidden.any() else wanted
    name = f"{stem}.obj"
    source = Source(
        f'mesh_beside(__file__, "{name}")', frozenset({("lessons.recorded", "mesh_beside")}), ((name, plain),)
    )
    return _under(source, Boundary.HIDE) if t.hidden.any() and is_same(fragment(plain), wanted) else source


# -- quoting ----------------------------------------------------------------------------------


def _as_quoted(found: Trace, state: State) -> Source | None:
    where = quote_of(found, state)
    if where is None:
        return None
    return Source(f"{quoting(where)}.trace", frozenset({("lessons.recorded", "quoted")}))


def quote_of(found: Trace, state: State) -> Quoted | None:
    """Where the program's own lessons show a trace."""
    told = state.lesson.asking(False)
    if told.id in {each.id for each in built_in()}:
        for k, beat in enumerate(told.beats):
            for pane, view in enumerate(beat.views):
                if view.trace is found:
                    return Quoted(told.id, k, pane, tuple(told.settings.items()))
    return origin(found)


def quoting(where: Quoted) -> str:
    """The call that quotes a view."""
    pane = f", pane={where.pane}" if where.pane else ""
    return f'quoted("{where.lesson}", beat={where.beat}{pane}{"".join(f", {n}={v}" for n, v in where.knobs)})'

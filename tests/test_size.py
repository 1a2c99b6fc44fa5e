"""How many faces there will be is known before they are made; what has no room is refused with the numbers."""

import numpy as np
import pytest

from app.laboratory.lab import Rule, _size
from subdivision import Grid, Mesh, Polyline, shapes, size, subdivide, trace
from subdivision.catalogue import FAMILIES
from subdivision.schemes import CATMULL_CLARK, DOO_SABIN, ZWART_POWELL
from subdivision.size import FEW, STAGED, SWIFT, TRACED, TooLarge, faces_after, require_room

CONTROLS = {
    **{name: make().topology for name, make in shapes.SHAPES.items()},
    "sheet": Grid(6, 7).mesh(),
    "triangles": Grid(6, 7, diagonal=True).mesh(),
    **{f"polygon of {n}{', closed' * closed}": Polyline(n, closed) for n in (5, 9, 60) for closed in (False, True)},
    **{
        f"net {n} by {m}, {s}, {t}, {d}": Grid(n, m, s, t, d)
        for n, m in ((9, 8), (45, 12))
        for s in (False, True) for t in (False, True) for d in (False, True)
    },
}  # fmt: skip
RULES = [*map(Rule, FAMILIES), Rule("box-spline", (ZWART_POWELL,)), Rule("lane-riesenfeld", (6,))]


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: f"{rule.family} {rule.parameters}")
def test_the_forecast_is_what_comes_out_for_every_scheme_that_takes_a_control_object(rule):
    taken = 0
    for t in CONTROLS.values():
        if not rule.scheme.accepts(t):
            continue
        made = t
        for level in range(1, 4 if t.n_vertices < 100 else 2):
            if not rule.scheme.accepts(made):
                break
            made = rule.scheme.step(made).topology
            count = made.n_vertices if isinstance(made, Polyline) else made.n_faces
            assert faces_after(rule.scheme, t, level) == count
            assert _size(Mesh(t, np.zeros((t.n_vertices, 3))), rule, level) == count
            taken += 1
    assert taken > 2


def test_what_has_no_room_is_refused_before_anything_is_made(monkeypatch):
    monkeypatch.setattr(size, "free_memory", lambda: 10**9)
    assert size.room(STAGED) == 800_000
    cube = shapes.cube()
    with pytest.raises(TooLarge, match=r"^40 levels would make 6,291,458 faces at level 10 already; .*at most 9, for "):
        subdivide(cube, DOO_SABIN, 40)
    with pytest.raises(TooLarge, match=r"^8 levels would make 393,216 faces; .*at most 7, for .* 300,000 faces"):
        subdivide(cube, CATMULL_CLARK, 8, most=300_000)
    with pytest.raises(TooLarge, match=r"at most 8, for there is room for 500,000 faces"):
        trace(CATMULL_CLARK, cube, levels=10**9)
    with pytest.raises(TooLarge, match=r"a level would make 24 faces, and there is room for 20; choose a smaller"):
        subdivide(cube, CATMULL_CLARK, 3, most=20)


def test_swift_schemes_go_deeper_in_the_same_memory(monkeypatch):
    monkeypatch.setattr(size, "free_memory", lambda: 10**9)
    t = shapes.cube().topology
    require_room(CATMULL_CLARK, t, 9, SWIFT)
    for each in (STAGED, TRACED):
        with pytest.raises(TooLarge):
            require_room(CATMULL_CLARK, t, 9, each)


def test_what_is_small_asks_no_machine(monkeypatch):
    monkeypatch.setattr(size, "free_memory", lambda: 0)
    fine = subdivide(shapes.cube(), CATMULL_CLARK, 5)
    assert fine.topology.n_faces < FEW
    with pytest.raises(TooLarge):
        subdivide(shapes.cube(), CATMULL_CLARK, 8)


def test_this_machine_tells_how_much_memory_is_free():
    assert 1 << 26 < size.free_memory() < 1 << 46

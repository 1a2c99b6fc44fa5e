"""Semi-sharp creases and corners, by the published rules written out vertex by vertex."""

from collections import defaultdict

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from subdivision import Scheme, Topology, shapes
from subdivision.arrays import Floats
from subdivision.refine import worn
from subdivision.schemes import CATMULL_CLARK, LECTURE, LOOP, LOOP_WARREN, QUAD_CENTROID

Creases = dict[frozenset[int], float]
Corners = dict[int, float]

INFINITE = 10.0


def less(sharpness: float) -> float:
    return sharpness if sharpness >= INFINITE else max(sharpness - 1, 0.0)


def by_the_book(
    points: Floats, faces: naive.Faces, scheme: str, creases: Creases, corners: Corners
) -> naive.Points:
    """Smooth, dart, crease or corner now and one level on; in between a mixture by the mean sharpness left."""
    smooth = naive.stencilled(points, faces, scheme)
    found, around = dict(smooth), defaultdict(list)
    for edge in naive.faces_at_edges(faces):
        sharpness = creases.get(edge, 0.0)
        middle = sum(points[v] for v in edge) / 2
        share = min(sharpness, 1.0)
        found[edge] = share * middle + (1 - share) * smooth[edge]
        for v in edge:
            around[v].append((next(iter(edge - {v})), sharpness))

    def ruled(v: int, edges: list[tuple[int, float]], corner: float) -> tuple[str, Floats]:
        sharp = [w for w, sharpness in edges if sharpness > 0]
        if corner > 0 or len(sharp) > 2:
            return "corner", points[v]
        if len(sharp) == 2:
            return "crease", 6 / 8 * points[v] + 1 / 8 * points[sharp[0]] + 1 / 8 * points[sharp[1]]
        return "smooth", smooth[v]

    for v, edges in around.items():
        corner = corners.get(v, 0.0)
        now, here = ruled(v, edges, corner)
        then, there = ruled(v, [(w, less(s)) for w, s in edges], less(corner))
        if now != then:
            fading = [s for s in [corner, *(s for _, s in edges)] if 0 < s <= 1]
            left = sum(fading) / len(fading)
            here = left * here + (1 - left) * there
        found[v] = here
    return found


MESHES = {
    **dict.fromkeys((QUAD_CENTROID.name, CATMULL_CLARK.name), shapes.cube().topology.loops()),
    **dict.fromkeys((s.name for s in LECTURE if s.name in naive.BETAS), shapes.bipyramid(5).topology.loops()),
}
sharpnesses = st.sampled_from([0.0, 0.25, 0.5, 1.0, 1.25, 1.75, 2.5, 3.0, 10.0])
schemes = pytest.mark.parametrize("scheme", LECTURE, ids=lambda s: s.name)


@schemes
@given(data=st.data())
def test_every_telling_follows_the_published_rules_for_any_sharpness(scheme: Scheme, data: st.DataObject) -> None:
    faces = MESHES[scheme.name]
    edges = sorted(naive.faces_at_edges(faces), key=sorted)
    drawn = data.draw(st.lists(sharpnesses, min_size=len(edges), max_size=len(edges)))
    creases = {edge: sharpness for edge, sharpness in zip(edges, drawn, strict=True) if sharpness}
    corners = data.draw(st.dictionaries(st.integers(0, 6), sharpnesses, max_size=2))
    t = Topology.from_faces(faces, creases={tuple(e): s for e, s in creases.items()}, corners=corners)  # type: ignore[misc]
    expected = by_the_book(np.eye(t.n_vertices), faces, scheme.name, creases, corners)
    for telling in scheme.tellings:
        rows = naive.named(t, scheme.step(t, telling).matrix.toarray())
        assert naive.difference(rows, expected) < 1e-12


@schemes
def test_sharpness_wears_off_by_one_a_level_along_the_children_of_an_edge(scheme: Scheme) -> None:
    faces = MESHES[scheme.name]
    a, b = faces[0][:2]
    t = Topology.from_faces(faces, creases={(a, b): 2.5, (b, faces[0][2]): 10}, corners={a: 1.5})
    fine = scheme.step(t).topology
    assert isinstance(fine, Topology)
    children = {frozenset(map(int, ends)): s for ends, s in zip(fine.ends, fine.edge_sharpness, strict=True) if s}
    middles = {name: k for k, name in enumerate(naive.named(t, np.zeros((fine.n_vertices, 1))))}
    first, second = middles[frozenset((a, b))], middles[frozenset((b, faces[0][2]))]
    expected = {(a, first): 1.5, (first, b): 1.5, (b, second): 10.0, (second, faces[0][2]): 10.0}
    assert children == {frozenset(pair): s for pair, s in expected.items()}
    assert {v: s for v, s in enumerate(fine.vertex_sharpness) if s} == {a: 0.5}


def test_worn_sharpness_is_one_less_never_negative_and_infinite_for_ever() -> None:
    assert worn(np.array([0, 0.5, 1, 2.25, 9.75, 10, 12])) == pytest.approx([0, 0, 0, 1.25, 8.75, 10, 12], abs=0)


@schemes
def test_an_infinitely_sharp_loop_is_the_cubic_curve_and_parts_the_two_sides(scheme: Scheme) -> None:
    mesh = shapes.cube() if scheme in (QUAD_CENTROID, CATMULL_CLARK) else shapes.octahedron()
    faces = mesh.topology.loops()
    above = [loop for loop in faces if mesh.points[loop, 2].mean() > 0] if len(faces) == 8 else faces[:1]
    rim = naive.boundary_edges(above)
    creased = Topology.from_faces(faces, creases={tuple(e): 10.0 for e in rim})  # type: ignore[misc]
    alone = Topology.from_faces(above, mesh.topology.n_vertices)
    whole, half = naive.named(creased, scheme.step(creased).matrix.toarray()), scheme.step(alone).matrix.toarray()
    for name, row in naive.named(alone, half).items():
        if isinstance(name, int) and name not in {v for loop in above for v in loop}:
            continue
        name = ("face", faces.index(above[name[1]])) if isinstance(name, tuple) else name
        assert np.abs(whole[name] - row).max() < 1e-12


def test_loop_with_another_beta_differs_at_smooth_vertices_only() -> None:
    t = shapes.bipyramid(8).topology
    creased = Topology.from_faces(t.loops(), creases={(8, 0): 3.0, (8, 4): 3.0})
    a, b = (scheme.step(creased).matrix.toarray() for scheme in (LOOP, LOOP_WARREN))
    assert set(np.flatnonzero(np.abs(a - b).max(axis=1) > 1e-12)) == {*range(8), 9}

"""Editing a control object: it stays a manifold, its counts are bookkept, what can be undone comes back; else a no."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from subdivision import Boundary, Grid, Mesh, Polyline, Topology, TopologyError, editing, schemes, shapes, subdivide

MESHES = ("cube", "plus-sign", "torus", "quad-fan", "quad-sheet", "octahedron", "triangle-fan", "triangle-sheet")

CHANGES = {
    "delete": lambda mesh, e, f: editing.delete_faces(mesh, [f]),
    "fill": lambda mesh, e, f: editing.fill_hole(mesh, e),
    "flip": lambda mesh, e, f: editing.flip_edge(mesh, e),
    "triangulate": lambda mesh, e, f: editing.triangulate(mesh),
    "turn over": lambda mesh, e, f: editing.turn_over(mesh),
    "crease": lambda mesh, e, f: editing.sharpen_edges(mesh, [e], 2.5),
    "pin": lambda mesh, e, f: editing.sharpen_vertices(mesh, [mesh.topology.ends[e, 0]], 3.0),
}


def turned(loop):
    """A face from its smallest corner on."""
    k = loop.index(min(loop))
    return [*loop[k:], *loop[:k]]


def faces(mesh):
    return sorted(turned(loop) for loop in mesh.surface.loops())


def creases(mesh):
    t = mesh.surface
    sharp = np.flatnonzero((t.edge_sharpness > 0) & ~t.boundary)
    return {frozenset(t.ends[e].tolist()): float(t.edge_sharpness[e]) for e in sharp}


def edge(mesh, a, b):
    (found,) = np.flatnonzero((np.sort(mesh.topology.ends, axis=1) == sorted((a, b))).all(axis=1))
    return int(found)


def require_manifold(mesh):
    """Its faces, read afresh by the one function that checks them, make the same connectivity."""
    t = mesh.surface
    afresh = Topology.from_faces(t.loops(), t.n_vertices)
    assert np.array_equal(afresh.twin, t.twin)
    assert np.array_equal(afresh.edge, t.edge)
    assert (t.valence > 0).all()
    assert len(mesh.points) == t.n_vertices


# -- random sequences -------------------------------------------------------------------------


@settings(deadline=None)
@given(data=some.data())
def test_whatever_is_edited_in_a_row_stays_a_manifold_and_every_step_counts_as_it_must(data):
    mesh = shapes.SHAPES[data.draw(some.sampled_from(MESHES))]()
    for _ in range(data.draw(some.integers(1, 8))):
        t = mesh.surface
        kind = data.draw(some.sampled_from(sorted(CHANGES)))
        e = data.draw(some.integers(0, t.n_edges - 1))
        f = data.draw(some.integers(0, t.n_faces - 1))
        try:
            after = CHANGES[kind](mesh, e, f)
        except TopologyError:
            continue
        require_manifold(after)
        new = after.surface
        counts = np.array([new.n_vertices - t.n_vertices, new.n_edges - t.n_edges, new.n_faces - t.n_faces])
        if kind == "delete":
            mine = t.edge[t.face == f]
            lost = int((np.bincount(t.origin) == 1)[t.origin[t.face == f]].sum())
            assert counts.tolist() == [-lost, -int(t.boundary[mine].sum()), -1]
        elif kind == "triangulate":
            extra = int((t.face_sizes - 3).sum())
            assert counts.tolist() == [0, extra, extra]
            assert new.is_triangular
        else:
            assert counts.tolist() == [0, 0, int(kind == "fill")]
        mesh = after


@settings(deadline=None)
@given(name=some.sampled_from(["cube", "plus-sign", "torus", "octahedron", "quad-sheet"]), data=some.data())
def test_a_face_that_is_deleted_and_filled_is_the_same_face(name, data):
    mesh = shapes.SHAPES[name]()
    t = mesh.surface
    inner = [f for f in range(t.n_faces) if not t.on_boundary[t.origin[t.face == f]].any()]
    f = data.draw(some.sampled_from(inner))
    loop = t.loops()[f]
    holed = editing.delete_faces(mesh, [f])
    assert holed.surface.euler == t.euler - 1
    assert holed.surface.boundary.sum() == t.boundary.sum() + len(loop)
    filled = editing.fill_hole(holed, edge(holed, *loop[:2]))
    assert faces(filled) == faces(mesh)
    assert turned(filled.surface.loops()[-1]) == turned(loop)
    assert np.array_equal(filled.points, mesh.points)
    assert creases(filled) == {}


@settings(deadline=None)
@given(name=some.sampled_from(["octahedron", "icosahedron", "triangle-torus", "triangle-fan", "triangle-sheet"]),
       data=some.data())  # fmt: skip
def test_an_edge_flipped_twice_is_the_edge_it_was(name, data):
    mesh = editing.sharpen_vertices(shapes.SHAPES[name](), [0], 1.5)
    e = data.draw(some.integers(0, mesh.surface.n_edges - 1))
    try:
        once = editing.flip_edge(mesh, e)
    except TopologyError:
        return
    ends = {frozenset(pair) for pair in once.surface.ends.tolist()}
    (new,) = ends - {frozenset(pair) for pair in mesh.surface.ends.tolist()}
    twice = editing.flip_edge(once, edge(once, *new))
    assert faces(once) != faces(mesh)
    assert faces(twice) == faces(mesh)
    assert twice.surface.vertex_sharpness[0] == 1.5


@pytest.mark.parametrize("name", MESHES)
def test_turned_over_twice_is_untouched_and_once_turns_every_normal(name):
    mesh = shapes.SHAPES[name]()
    over = editing.turn_over(mesh)
    assert faces(over) == sorted(turned([*reversed(loop)]) for loop in mesh.surface.loops())
    assert editing.turn_over(over).surface.loops() == mesh.surface.loops()


# -- sharpness --------------------------------------------------------------------------------


def test_a_crease_along_a_face_of_the_cube_keeps_that_square_s_outline_in_the_limit():
    cube = shapes.cube()
    rim = [edge(cube, a, b) for a, b in pairwise([4, 6, 7, 5, 4])]
    creased = editing.sharpen_vertices(editing.sharpen_edges(cube, rim, 10), [4, 5, 6, 7], 10)
    fine = subdivide(creased, schemes.CATMULL_CLARK, 4)
    sharp = fine.surface.ends[fine.surface.edge_sharpness > 0]
    assert np.abs(fine.points[sharp.ravel()][:, 0] - 1).max() < 1e-12  # in the plane of the face
    assert np.abs(np.abs(fine.points[sharp.ravel()][:, 1:]).max(axis=1) - 1).max() < 1e-12  # on its outline
    smooth = subdivide(cube, schemes.CATMULL_CLARK, 4)
    assert smooth.points[:, 0].max() < 0.9


def test_sharpness_goes_with_the_vertices_of_its_edge_through_all_other_changes():
    sharp = editing.sharpen_edges(shapes.cube(), [0, 5], 3.5)
    kept = creases(sharp)
    assert set(kept.values()) == {3.5}
    for change in (editing.triangulate, editing.turn_over):
        assert creases(change(sharp)) == kept
    t = sharp.surface
    untouched = next(f for f in range(6) if not np.isin([0, 5], t.edge[t.face == f]).any())
    assert creases(editing.delete_faces(sharp, [untouched])) == kept


def test_sharpness_0_smooths_again():
    cube = shapes.cube()
    back = editing.sharpen_edges(editing.sharpen_edges(cube, [3], 4), [3], 0)
    assert np.array_equal(back.surface.edge_sharpness, cube.surface.edge_sharpness)


# -- cutting ----------------------------------------------------------------------------------


def test_quads_are_cut_along_their_shorter_diagonal():
    points = np.array([(0.0, 0, 0), (3, 0, 0), (4, 1, 0), (1, 1, 0)])
    cut = editing.triangulate(Mesh(Topology.from_faces([[0, 1, 2, 3]]), points))
    assert {1, 3} in [set(pair) for pair in cut.surface.ends.tolist()]


def test_no_diagonal_is_used_twice():
    mesh = shapes.quad_bipyramid(3)  # both diagonals of its quads are shared, or nearly
    cut = editing.triangulate(editing.delete_faces(mesh, [0]))
    require_manifold(cut)


def test_a_hole_between_many_corners_is_filled_and_cut():
    filled = editing.fill_hole(shapes.quad_sheet(), edge(shapes.quad_sheet(), 0, 1))
    assert filled.surface.face_sizes[-1] == 16
    assert filled.surface.euler == 2
    assert np.isfinite(subdivide(editing.triangulate(filled), schemes.LOOP, 3).points).all()


# -- polygons and nets ------------------------------------------------------------------------


@settings(deadline=None)
@given(n=some.integers(3, 9), closed=some.booleans(), data=some.data())
def test_an_inserted_point_removed_leaves_the_polygon_as_it_was(n, closed, data):
    polygon = Mesh(Polyline(n, closed), np.random.default_rng(n).normal(size=(n, 3)))
    after = data.draw(some.integers(-1, n - 1))
    more = editing.insert_point(polygon, after, (1.0, 2.0, 3.0))
    assert more.points[after + 1].tolist() == [1, 2, 3]
    less = editing.remove_points(more, [after + 1])
    assert less.topology == polygon.topology
    assert np.array_equal(less.points, polygon.points)


def test_a_polygon_closes_and_opens():
    polygon = shapes.polygon()
    closed = editing.set_closed(polygon, True)
    assert closed.topology == Polyline(5, closed=True)
    assert editing.set_closed(closed, False).topology == polygon.topology


@settings(deadline=None)
@given(some.integers(3, 7), some.integers(3, 7), some.booleans(), some.booleans(), some.integers(1, 3))
def test_a_net_made_finer_keeps_its_points_and_comes_back(n_s, n_t, wrap_s, wrap_t, k):
    t = Grid(n_s, n_t, wrap_s, wrap_t)
    net = Mesh(t, np.random.default_rng(0).normal(size=(t.n_vertices, 3)))
    fine = editing.resize(net, n_s * k if wrap_s else (n_s - 1) * k + 1, n_t * k if wrap_t else (n_t - 1) * k + 1)
    kept = fine.points.reshape(*fine.topology.shape, 3)[::k, ::k]
    assert np.abs(kept.reshape(-1, 3) - net.points).max() < 1e-12
    assert np.abs(editing.resize(fine, n_s, n_t).points - net.points).max() < 1e-12


def test_a_flat_net_of_any_size_stays_where_it_was():
    s, t = np.meshgrid(np.linspace(0, 3, 4), np.linspace(0, 2, 3), indexing="ij")
    net = Mesh(Grid(4, 3), np.stack([s, t, 2 * s - t], axis=2).reshape(-1, 3))
    other = editing.resize(net, 6, 7)
    assert np.abs(other.points[:, 2] - (2 * other.points[:, 0] - other.points[:, 1])).max() < 1e-12
    assert np.ptp(other.points, axis=0).tolist() == np.ptp(net.points, axis=0).tolist()


def test_opposite_sides_of_a_net_are_joined_and_parted():
    net = shapes.net()
    ring = editing.set_wrap(net, True, False)
    assert ring.topology == Grid(5, 5, wrap_s=True)
    assert ring.topology.n_faces == 20
    assert editing.set_wrap(ring, False, False).topology == net.topology


# -- fans -------------------------------------------------------------------------------------


@pytest.mark.parametrize("fan", [shapes.quad_fan, shapes.triangle_fan])
def test_a_fan_is_known_by_its_faces_and_takes_any_valence(fan):
    for n in (3, 5, 8):
        for rings in (1, 2, 3):
            assert editing.fan_of(fan(n, rings)) == (n, rings)
            other = editing.refan(fan(n, rings), 7, 2)
            assert other.surface.valence[0] == 7
            assert other.surface.loops() == fan(7, 2).surface.loops()
    assert editing.fan_of(editing.delete_faces(fan(6, 2), [0])) is None
    assert all(editing.fan_of(shapes.SHAPES[name]()) is None for name in ("cube", "octahedron", "torus", "polygon"))


# -- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize(("wish", "sentence"), [
    (lambda: editing.delete_faces(shapes.tetrahedron(), range(4)), "without face 3 no face would be left; keep one"),
    (lambda: editing.delete_faces(shapes.quad_sheet(2), [0, 3]), "at vertex 4 .* delete one of the fans"),
    (lambda: editing.delete_faces(shapes.plus_sign(), []), "no face is chosen"),
    (lambda: editing.delete_faces(shapes.cube(), [6]), "there is no face 6; choose one from 0 to 5"),
    (lambda: editing.fill_hole(shapes.cube(), 0), "vertices 0 and 1 has faces on both sides; choose one along"),
    (lambda: editing.flip_edge(shapes.cube(), 0), "has 4 corners; triangulate the mesh first"),
    (lambda: editing.flip_edge(shapes.tetrahedron(), 0), "have an edge already.* choose another edge"),
    (lambda: editing.flip_edge(shapes.triangle_fan(5), edge(shapes.triangle_fan(5), 1, 2)), "has one face only"),
    (lambda: editing.sharpen_edges(shapes.quad_sheet(), [0], 2), "vertices 0 and 1 is on the boundary"),
    (lambda: editing.sharpen_edges(shapes.cube(), [0], 11), "sharpness 11 is not between 0"),
    (lambda: editing.sharpen_vertices(shapes.cube(), [8], 1), "there is no vertex 8"),
    (lambda: editing.remove_points(shapes.closed_polygon(3), [1]), "2 would be left.* a closed polygon needs 3"),
    (lambda: editing.remove_points(shapes.polygon(2), [0]), "1 would be left, and an open polygon needs 2"),
    (lambda: editing.set_closed(shapes.polygon(2), True), "needs 3 points, not 2; insert one first"),
    (lambda: editing.insert_point(shapes.polygon(), 5, (0, 0, 0)), "there is no point 5 to follow"),
    (lambda: editing.resize(shapes.net(), 1, 5), "2 points or more in direction s, not 1"),
    (lambda: editing.set_wrap(editing.resize(shapes.net(), 2, 5), True, False), "wrapped, needs 3 points"),
    (lambda: editing.refan(shapes.cube(), 5, 1), "this is no fan"),
    (lambda: editing.refan(shapes.quad_fan(), 2, 1), "a fan needs three faces"),
    (lambda: editing.triangulate(shapes.net()), "has no faces of its own to edit; take a mesh"),
    (lambda: editing.resize(shapes.cube(), 3, 3), "this is no net"),
    (lambda: editing.insert_point(shapes.cube(), 0, (0, 0, 0)), "this is no polygon"),
])  # fmt: skip
def test_what_would_break_it_is_refused_with_the_place_and_the_mend(wish, sentence):
    with pytest.raises(TopologyError, match=sentence):
        wish()


def test_the_boundary_rule_of_a_view_does_not_stay_on_an_edited_mesh():
    hidden = Mesh(shapes.quad_sheet().surface.with_boundary(Boundary.HIDE), shapes.quad_sheet().points)
    assert not editing.delete_faces(hidden, [5]).surface.hidden.any()

"""What is drawn in haste: the far side of a closed surface is left out, which nobody can see.  And nudged pictures."""

from dataclasses import replace

import numpy as np
import pytest
import pyvista
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from app.draw import vtk
from app.draw.geometry import _parts
from app.draw.picture import Camera, Faces, Markers, Scene, Shape
from subdivision import Mesh, shapes, trace
from subdivision.schemes import QUAD_CENTROID, TRIANGLE_CENTROID

GREY = (0.7, 0.72, 0.75)
UP = np.array([0.0, 0.0, 1.0])
OBLIQUE = Camera(np.array([4.0, -6.0, 3.0]), np.zeros(3), UP)
PARALLEL = replace(OBLIQUE, scale=2.0)
INSIDE = Camera(np.array([0.1, -0.1, 0.0]), np.array([4.0, -6.0, 3.0]), UP)
CLOSED = {"cube": (QUAD_CENTROID, shapes.cube), "torus": (QUAD_CENTROID, shapes.torus),
          "icosahedron": (TRIANGLE_CENTROID, shapes.icosahedron),
          "torus of triangles": (TRIANGLE_CENTROID, shapes.triangle_torus)}  # fmt: skip


@pytest.fixture(scope="module")
def plotter():
    plotter = pyvista.Plotter(off_screen=True, lighting="none", border=False, window_size=(300, 240))
    plotter.render_window.SetMultiSamples(0)  # as in the window while something moves
    yield plotter
    plotter.close()


def surface(mesh: Mesh) -> Faces:
    return Faces(mesh.points, mesh.topology.face_sizes, mesh.topology.origin, GREY)


def reversed_(faces: Faces) -> Faces:
    """The same with its front where its back was; all its polygons are of one size."""
    return replace(faces, corners=faces.corners.reshape(len(faces.sizes), -1)[:, ::-1].ravel())


def both(a: Faces, b: Faces) -> Faces:
    """The two as one surface."""
    return replace(a, points=np.vstack([a.points, b.points]), sizes=np.concatenate([a.sizes, b.sizes]),
                   corners=np.concatenate([a.corners, b.corners + len(a.points)]))  # fmt: skip


def drawn(plotter, camera: Camera, *faces: Faces) -> tuple[np.ndarray, list[bool]]:
    """The last of pictures drawn with the same actors, and whether the far side is left out of it."""
    painter = vtk.ScenePainter(plotter)
    painter.hasten(True)
    for each in faces:  # pushed back, a far side would shine through at the rim, where the near one is steep
        scene = Scene(camera, (each,))
        painter.paint(scene, 240)
        painter._faces[0].mapper.SetResolveCoincidentTopologyToOff()
        painter.look(camera)
        painter.clip(scene)
        plotter.render_window.Render()
    seen = np.array(plotter.screenshot(return_img=True))
    culled = bool(painter._faces[0].actor.GetProperty().GetBackfaceCulling())
    painter.close()
    painter.renderer.RemoveAllViewProps()
    return seen, culled


@pytest.mark.parametrize("camera", [OBLIQUE, PARALLEL], ids=["perspective", "parallel"])
@pytest.mark.parametrize("shape", CLOSED)
def test_a_closed_surface_looks_as_with_its_far_side_while_it_moves(plotter, monkeypatch, shape, camera):
    scheme, control = CLOSED[shape]
    told = trace(scheme, control(), levels=3)
    frames = [told.frame(at) for at in (0.0, 0.4, 2.5, 4.7, len(told.stages))]
    moving = [surface(Mesh(f.topology, f.points[: f.topology.n_vertices])) for f in frames]
    found = [drawn(plotter, camera, *moving[: k + 1]) for k in range(len(moving))]
    monkeypatch.setattr(vtk, "shells", lambda faces: None)
    whole = [drawn(plotter, camera, *moving[: k + 1]) for k in range(len(moving))]
    assert [culled for _, culled in found] == [True] * 5
    assert [culled for _, culled in whole] == [False] * 5
    for (quick, _), (full, _) in zip(found, whole, strict=True):
        assert len(np.unique(quick)) > 3
        assert (quick != full).any(axis=2).sum() <= 3  # where the two sides meet in one pixel of the rim


def test_what_could_show_its_far_side_keeps_it(plotter):
    cube = surface(shapes.cube())
    beside = replace(cube, points=cube.points + np.array([0.0, 3.0, 0.0]))
    turned_over = replace(cube, points=cube.points * [1.0, 1.0, -1.0])
    kept = {
        "open": (OBLIQUE, surface(shapes.quad_sheet())),
        "with a hole": (OBLIQUE, replace(cube, sizes=cube.sizes[:-1], corners=cube.corners[:-4])),
        "inside out": (OBLIQUE, reversed_(cube)),
        "one of two inside out": (OBLIQUE, both(cube, reversed_(replace(beside, points=0.9 * beside.points)))),
        "sides at odds": (OBLIQUE, replace(cube, corners=np.r_[cube.corners[:4][::-1], cube.corners[4:]])),
        "translucent": (OBLIQUE, replace(cube, opacity=0.5)),
        "seen from within": (INSIDE, cube),
    }
    for what, (camera, faces) in kept.items():
        assert not drawn(plotter, camera, faces)[1], what
    assert drawn(plotter, OBLIQUE, both(cube, beside))[1]
    assert not drawn(plotter, OBLIQUE, cube, turned_over)[1]  # with the same corners as before


def test_at_rest_nothing_is_left_out(plotter):
    painter = vtk.ScenePainter(plotter)
    painter.hasten(True)
    painter.paint(Scene(OBLIQUE, (surface(shapes.cube()),)), 240)
    painter.look(OBLIQUE)
    look = painter._faces[0].actor.GetProperty()
    assert look.GetBackfaceCulling()
    painter.hasten(False)
    assert not look.GetBackfaceCulling()
    painter.close()
    painter.renderer.RemoveAllViewProps()


@pytest.mark.parametrize("links", [0, 40, 90, 400])
def test_parts_are_those_of_the_graph(links):
    ends, others = np.random.default_rng(links).integers(0, 100, (2, links))
    graph = coo_array((np.ones(links), (ends, others)), (100, 100))
    count, wanted = connected_components(graph, directed=False)
    found = _parts(100, ends, others)
    assert len(np.unique(found)) == count == len(np.unique(np.stack([found, wanted]), axis=1).T)


@pytest.mark.parametrize("samples", [0, 8])
def test_translucent_surfaces_are_seen_with_any_number_of_samples(plotter, samples):
    camera = Camera(np.array([0.0, 0.0, 5.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    red = Faces(np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]), np.array([4]), np.arange(4), (1, 0, 0))
    painter, middles = vtk.ScenePainter(plotter), []
    painter.background((1.0, 1.0, 1.0))
    for opacity in (0.0, 0.5, 1.0):
        scene = Scene(camera, (replace(red, opacity=opacity),))
        painter.paint(scene, 240)
        painter.look(camera)
        painter.clip(scene)
        plotter.render_window.SetMultiSamples(samples)
        painter.hasten(False)
        plotter.render_window.Render()
        middles.append(np.array(plotter.screenshot(return_img=True))[120, 150].astype(int))
    plotter.render_window.SetMultiSamples(0)
    painter.close()
    painter.renderer.RemoveAllViewProps()
    assert np.abs(2 * middles[1] - middles[0] - middles[2]).max() <= 2
    assert np.abs(middles[2] - middles[0]).max() > 200


@pytest.mark.parametrize("window", [(0.0, 0.0, 1.0), (0.3, -0.2, 0.5)], ids=["whole", "through the magnifier"])
@pytest.mark.parametrize("camera", [OBLIQUE, PARALLEL], ids=["perspective", "parallel"])
def test_a_nudged_picture_is_the_same_so_many_pixels_further(plotter, camera, window):
    painter, scene = vtk.ScenePainter(plotter), Scene(camera, (surface(shapes.cube()),))
    painter.paint(scene, 240)
    painter.look(camera, window)
    painter.clip(scene)
    pictures = []
    for right, up in ((0, 0), (7, 0), (0, 5), (0, 0)):
        painter.nudge(right, up)
        plotter.render_window.Render()
        pictures.append(np.array(plotter.screenshot(return_img=True)).astype(int))
    painter.close()
    painter.renderer.RemoveAllViewProps()
    still, right, up, again = pictures
    np.testing.assert_array_equal(again, still)
    for moved, other in ((right[:, 7:], still[:, :-7]), (up[:-5], still[5:])):
        assert np.ptp(moved) > 50
        assert np.mean(np.abs(moved - other) > 2) < 1e-3  # but where a pixel's middle is on a rim
    assert np.mean(np.abs(right - still) > 2) > 1e-3


@pytest.mark.parametrize("shape", [Shape.SPHERE, Shape.HALO])
@pytest.mark.parametrize("camera", [OBLIQUE, PARALLEL], ids=["perspective", "parallel"])
def test_a_ball_that_moves_is_as_round_as_its_corners_let_it_be(plotter, camera, shape):
    places = np.stack(np.meshgrid(*3 * [[-1.5, 0.0, 1.5]]), axis=-1).reshape(-1, 3)
    n, pictures = len(places), []
    balls = Markers(places, shape, (0.8, 0.3, 0.1), np.full(n, 0.2), np.ones(n), np.full(n, -1))
    for is_hasty in (False, True):
        painter = vtk.ScenePainter(plotter)
        painter.background((1.0, 1.0, 1.0))
        painter.hasten(is_hasty)
        for seen in (replace(camera, position=-camera.position), camera):
            painter.paint(Scene(seen, markers=(balls,)), 240)
            painter.look(seen)
            painter.clip(Scene(seen, markers=(balls,)))
            plotter.render_window.Render()
        pictures.append((np.array(plotter.screenshot(return_img=True)) < 250).any(axis=2))
        painter.close()
        painter.renderer.RemoveAllViewProps()
    still, moving = pictures
    assert still.sum() > 3000
    assert (still ^ moving).sum() < 0.1 * still.sum()

"""What surfaces wear: influence, basis functions, curvature, lines of light; limits, and how fast levels go there."""

from dataclasses import replace

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw import basis, distances, ramps, surface
from app.draw.compose import compose
from app.draw.isophotes import isophotes, reflections
from app.draw.layout import overlay, pane_areas
from app.draw.limits import LIMIT_POINT
from app.draw.picture import Diagram, Scene
from app.draw.primitives import LEAST, Text
from app.draw.raster import image
from app.draw.theme import THEMES
from app.draw.vector import svg
from app.laboratory import bench
from app.sessions.keeping import kept, restored
from subdivision import Boundary, shapes, trace
from subdivision.curvature import mean_curvature
from subdivision.limit import limit_points
from subdivision.schemes import CATMULL_CLARK, QUAD_CENTROID

OPENED = bench.enter(st.start(lessons.find("14")))


def lab(shape, levels=2, **options):
    return st.choose(st.last(bench.set_levels(bench.take(OPENED, shape), levels)), **options)


def told(state):
    return state.trace(state.now.lead)


def scene(state, pane=0):
    found = compose(state).panes[pane].content
    assert isinstance(found, Scene)
    return found


def held(state, vertex):
    return st.look(state, st.Spot(0, 0, vertex))


def worn(values, scale, *, is_signed=False):
    return ramps.coloured(ramps.places(values, scale), THEMES["light"], is_signed)


# -- influence and basis functions --------------------------------------------------------------


@pytest.mark.parametrize("at", [1.0, 2.5, 3.0, 5.25, 6.0])
def test_influence_is_the_column_of_the_product_and_moves_as_the_points_move(at):
    state = held(lab("cube"), 5)
    lifted = told(state).with_control(replace(told(state).control, points=np.eye(8)[:, [5, 5, 5]]))
    assert np.abs(surface.influence(told(state), 5, at) - lifted.frame(at).points[:, 0]).max() < 1e-12


def test_the_colours_of_a_surface_are_those_of_the_influence_and_the_bar_says_its_most():
    state = held(lab("cube"), 5)
    column = told(state).whole.matrix.toarray()[:, 5]
    made = scene(state)
    wanted = worn(column, (0.0, column.max()))
    assert np.abs(made.faces[0].colours - wanted).max() < 1e-12
    assert made.bar.title == "Influence of v5"
    assert [text for _, text in made.bar.ticks] == ["0", f"{column.max() / 2:.2g}", f"{column.max():.2g}"]


def test_without_a_control_point_in_focus_nothing_is_coloured():
    made = scene(lab("cube"))
    assert made.bar is None
    assert made.faces[0].colours is None
    later = st.look(lab("cube"), st.Spot(0, 6, 5))
    assert scene(later).bar is None


def test_a_curve_wears_the_influence_on_its_points_and_strokes():
    state = held(lab("polygon", control=True), 2)
    column = told(state).whole.matrix.toarray()[:, 2]
    made, shown = scene(state), {}
    for markers in made.markers:
        if markers.stage < 0:
            shown |= {int(k): markers.colour for k in markers.ids}
    wanted = worn(column, (0.0, column.max()))
    assert max(np.abs(np.array(shown[k]) - wanted[k]).max() for k in shown) < 1 / 64
    assert len({each.colour for each in made.lines}) > 4
    assert [entry.text for entry in compose(state).legend] == ["original"]


@pytest.mark.parametrize("shape", ["polygon", "closed-polygon", "hook", "net", "three-direction-net", "quad-sheet"])
@pytest.mark.parametrize("vertex", [0, 3])
def test_the_heights_of_a_basis_function_are_the_column_of_its_control_point(shape, vertex):
    state = held(lab(shape), vertex)
    what = surface.shown(st.choose(state, basis=True), state.now.lead)
    column = told(state).whole.matrix.toarray()[:, vertex]
    assert np.abs(basis.heights(what.trace, what.trace.points[-1]) - column).max() < 1e-12
    control = basis.heights(what.trace, what.trace.control.points)
    assert control[vertex] == 1
    assert np.abs(np.delete(control, vertex)).max() == 0


@pytest.mark.parametrize("shape", ["cube", "torus-net", "cylinder-net"])
def test_what_lies_over_no_plane_says_so_and_shows_the_basis_function_as_colour(shape):
    state = lab(shape, 1, basis=True)
    assert scene(state).remark == basis.CLOSED
    assert scene(state).bar.title.startswith("Basis function of v")
    assert np.array_equal(scene(state).faces[0].points, scene(st.choose(state, basis=False)).faces[0].points)


def test_the_camera_of_a_graph_stays_from_stage_to_stage():
    state = lab("net", basis=True)
    first = scene(st.first(state)).camera
    assert np.array_equal(first.position, scene(state).camera.position)


def test_a_control_point_stays_in_focus_from_stage_to_stage_while_control_points_are_shown():
    state = st.first(lab("net"))
    assert st.skip(held(state, 3), 1).focus is None
    for options in ({"basis": True}, {"control": True}):
        assert st.skip(held(st.choose(state, **options), 3), 1).focus == st.Spot(0, 0, 3)
    other = st.open_lesson(held(st.choose(state, basis=True), 3), lessons.find("8"))
    assert other.focus is None


# -- curvature and lines of light ---------------------------------------------------------------


def test_curvature_is_on_a_scale_with_zero_in_its_middle_and_one_for_all_panes():
    state = st.last(bench.compare(lab("cube", surface_shows="mean curvature")))
    contents = [pane.content for pane in compose(state).panes]
    assert [content.bar is None for content in contents] == [True, False]
    each = [mean_curvature(state.trace(view).mesh_at(len(view.trace.stages))) for view in state.now.views]
    low, high, _ = ramps.ends(np.concatenate(each), is_signed=True)
    assert low == -high
    for content, values in zip(contents, each, strict=True):
        wanted = worn(values, (low, high), is_signed=True)
        assert np.array_equal(content.faces[0].colours, wanted)


def test_where_there_is_no_curvature_the_surface_is_bare():
    made = scene(lab("quad-sheet", surface_shows="gauss curvature"))
    rim = told(lab("quad-sheet")).topology_at(6).on_boundary
    assert (made.faces[0].colours[rim] == THEMES["light"].surface).all()


@pytest.mark.parametrize("theme", THEMES)
def test_a_ramp_without_a_sign_is_ordered_by_lightness_and_one_with_a_sign_is_lightest_in_its_middle(theme):
    def lightness(signed):
        colours = ramps.ramp(THEMES[theme], signed)
        linear = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
        return np.cbrt(linear @ [0.2126, 0.7152, 0.0722])

    steps = np.diff(lightness(False))
    assert (np.sign(steps) == np.sign(steps[0])).all()
    assert np.abs(steps).max() < 2.5 * np.abs(steps).min()
    signed = lightness(True)
    assert (np.diff(signed[:16]) > 0).all()
    assert (np.diff(signed[17:]) < 0).all()


def test_normals_are_strokes_from_the_vertices_and_lines_of_light_lie_on_the_surface():
    plain = scene(lab("cube"))
    quills = scene(lab("cube", surface_shows="normals")).lines[-1]
    assert len(quills.pairs) == len(plain.faces[0].points)
    outward = quills.points[quills.pairs[:, 1]] - quills.points[quills.pairs[:, 0]]
    assert ((outward * quills.points[quills.pairs[:, 0]]).sum(axis=1) > 0).all()
    for kind in surface.STRIPED:
        assert len(scene(lab("cube", surface_shows=kind)).lines[-1].pairs) > 100


def test_lines_of_light_on_a_ball_turn_as_its_normals_say():
    mesh = shapes.icosahedron()
    fine = trace(CATMULL_CLARK, mesh, levels=4).mesh_at(4 * len(CATMULL_CLARK.step(mesh.topology).stages))
    ball = replace(fine, points=fine.points / np.linalg.norm(fine.points, axis=1, keepdims=True))
    made = scene(lab("cube"))
    faces = replace(made.faces[0], points=ball.points, sizes=fine.topology.face_sizes, corners=fine.topology.origin)
    back = (made.camera.position - made.camera.focal) / np.linalg.norm(made.camera.position - made.camera.focal)
    right = np.cross(made.camera.up, back)
    right /= np.linalg.norm(right)
    points = reflections(faces, made.camera, (0.0, 0.0, 0.0), 1.0).points
    seen = 2 * (points @ back)[:, None] * points - back
    way = np.degrees(np.arctan2(seen @ right, seen @ back)) / 15
    far = np.hypot(seen @ right, seen @ back) > 0.3
    assert np.abs(way - np.round(way))[far].max() < 0.1
    assert len(isophotes(faces, (0.0, 0.0, 0.0), 1.0).pairs) > 500


def test_a_curve_says_that_it_has_no_surface():
    assert "no surface" in scene(lab("polygon", surface_shows="isophotes")).remark


# -- limits -------------------------------------------------------------------------------------


def test_every_vertex_of_the_level_stands_at_its_limit_and_is_marked():
    state = lab("cube", limit=True)
    mesh = told(state).mesh_at(6)
    made = scene(state)
    wanted = limit_points(mesh, QUAD_CENTROID)
    assert np.abs(made.faces[0].points - wanted).max() < 1e-12
    marks = [m for m in made.markers if m.name == LIMIT_POINT]
    assert np.abs(marks[0].points - wanted).max() < 1e-12
    assert any(entry.text == LIMIT_POINT for entry in compose(state).legend)


def test_the_points_of_an_open_net_keep_their_numbers_on_the_limit():
    state = lab("net", limit=True)
    marks = next(m for m in scene(state).markers if m.name == LIMIT_POINT)
    at = next(k for k in range(len(marks.ids)) if marks.ids[k] != k)
    picked = st.look(st.choose(state, across="limit"), st.Spot(0, len(told(state).stages), int(marks.ids[at])))
    chosen = next(m for m in scene(picked).markers if m.name == "pointed out")
    assert np.abs(chosen.points[0] - marks.points[at]).max() < 1e-12


def test_the_limits_of_an_open_curve_wear_their_own_influence():
    state = held(lab("polygon", control=True, limit=True), 2)
    what = surface.shown(state, state.now.lead)
    column = what.trace.influence(2, len(what.trace.stages))
    wanted = worn(column, (0.0, column.max()))
    k, points = len(what.trace.stages) - 1, what.trace.points[-1]
    assert len(points) < len(what.trace.points[k])
    for markers in (m for m in scene(state).markers if m.stage < 0):
        for at in markers.points:
            row = int(np.argmin(np.linalg.norm(points - at, axis=1)))
            assert np.abs(np.array(markers.colour) - wanted[row]).max() < 1 / 64


def test_where_there_is_no_limit_a_sentence_says_why():
    literal = bench.choose_boundary(lab("quad-sheet"), 0, Boundary.LITERAL)
    assert "no limit rule" in scene(st.choose(st.last(literal), limit=True)).remark
    under_way = st.at_stop(lab("cube", limit=True), st.Stop(1, 1.0))
    assert scene(under_way).remark == "A limit is that of a whole level, and this one is under way."
    assert scene(lab("cube", limit=True)).remark == ""


def test_dragging_and_limits_go_together():
    state = st.drag(lab("cube", limit=True), 5, (2.0, 1.0, 1.0))
    assert np.abs(scene(state).faces[0].points - limit_points(told(state).mesh_at(6), QUAD_CENTROID)).max() < 1e-12


# -- distances ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("scheme", "angles"), [
    (QUAD_CENTROID, (95.4, 49.7, 23.1, 10.5, 4.8)), (CATMULL_CLARK, (95.4, 66.8, 42.6, 25.8, 15.3)),
])  # fmt: skip
def test_the_probe_at_a_pole_of_valence_5_shows_the_angles_of_the_lecture(scheme, angles):
    mesh = shapes.SHAPES["quad-bipyramid"]()
    fine = trace(scheme, mesh, levels=4)
    pole = int(np.flatnonzero(mesh.topology.valence == 5)[0])
    course = distances.spread(fine, pole, 0)
    assert np.abs(np.array(course.values) - angles).max() < 0.05


def test_on_a_regular_torus_the_distance_to_the_limit_falls_fourfold_a_level():
    state = lab("triangle-torus", 3)
    course = distances.to_limit(told(state))
    mesh = told(state).mesh_at(0)
    away = np.linalg.norm(limit_points(mesh, told(state).scheme) - mesh.points, axis=1).max()
    assert abs(course.values[0] - away) < 1e-12
    assert abs(course.rate - 4) < 1e-9


@pytest.mark.parametrize("values", [(), (0.3,), (0.0, 0.2), (0.2, 0.0), (1e-14, 0.2)])
def test_a_course_from_nothing_or_to_nothing_has_no_rate_and_is_plotted(values, monkeypatch):
    monkeypatch.setattr(distances, "to_limit", lambda _: distances.Course("Distance", values))
    assert distances.Course("Distance", values).rate is None
    shown = compose(lab("cube", distances=True)).panes[-1].content
    assert not any(" a level" in note.text for note in shown.notes if note.y < distances.TALL)


def test_the_plots_have_a_dot_for_every_level_and_say_their_rate():
    shown = compose(lab("triangle-torus", 3, distances=True)).panes[-1].content
    assert isinstance(shown, Diagram)
    assert len(shown.boxes) == 8
    assert any(note.text == "falls by 4.00 a level" for note in shown.notes)


def test_the_plots_say_why_when_there_is_nothing_to_plot():
    literal = bench.choose_boundary(lab("quad-sheet", distances=True), 0, Boundary.LITERAL)
    shown = compose(st.last(literal)).panes[-1].content
    assert any("no limit rule" in note.text for note in shown.notes)


# -- the picture --------------------------------------------------------------------------------


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("panes", [1, 3])
def test_bar_and_sentence_are_inside_their_pane_and_large_enough(theme, panes):
    state = lab("cube", surface_shows="gauss curvature", theme=theme, basis=True)
    for _ in range(panes - 1):
        state = st.last(bench.compare(state))
    for shown in (state, st.choose(state, basis=False)):
        picture = compose(shown)
        width, height = 1920, 1080
        x, y, w, h = pane_areas(picture, width, height)[-1]
        bar = picture.panes[-1].content.bar
        said = {bar.title, *(text for _, text in bar.ticks)}
        texts = [t for t in overlay(picture, width, height) if isinstance(t, Text) and t.text in said]
        assert len(texts) >= 3
        for text in texts:
            assert text.size >= LEAST * height / 1000 - 1e-9
            assert y <= text.y <= y + h
            assert x <= text.x <= x + w


def test_both_painters_show_the_colours():
    plain, shown = lab("cube", net=False), lab("cube", net=False, surface_shows="mean curvature")
    small = 240, 160
    before, after = image(compose(plain), *small), image(compose(shown), *small)
    assert np.abs(before.astype(int) - after).max() > 60
    fills = {part.split('"')[0] for part in svg(compose(shown), *small).split('fill="')[1:]}
    assert len(fills) > 10 + len({part.split('"')[0] for part in svg(compose(plain), *small).split('fill="')[1:]}) / 4


def test_what_a_surface_shows_is_kept_in_a_session():
    state = lab("net", basis=True, limit=True, distances=True, surface_shows="reflections")
    assert restored(kept(state)).options == state.options


@pytest.mark.parametrize("lesson", lessons.all_lessons(), ids=lambda lesson: lesson.id)
def test_every_lesson_can_wear_everything(lesson):
    everything = [
        {"basis": True, "limit": True, "distances": True},
        {"limit": True, "surface_shows": "mean curvature"},
        {"surface_shows": "reflections"},
        {"surface_shows": "normals", "control": True},
    ]
    for options in everything:
        state = st.look(st.choose(st.last(st.start(lesson)), **options), st.Spot(0, 0, 0))
        assert overlay(compose(state), 640, 360)

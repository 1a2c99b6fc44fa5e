"""The layout of words, and what the painters make of a picture."""

import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest

import lessons
from app.draw import formulas, raster
from app.draw.compose import compose, said
from app.draw.depth import depth_of
from app.draw.geometry import dashes, facets, normals
from app.draw.labels import Kept, placed
from app.draw.layout import fitted, overlay, pane_areas
from app.draw.letters import END, _shaped, letters
from app.draw.picture import Box, Camera, Diagram, Faces, Label, Lines, Markers, Pane, Picture, Scene, Shape
from app.draw.primitives import LEAST, Mark, Plate, Text
from app.draw.raster import image
from app.draw.solid import CUBE, OCTAHEDRON
from app.draw.type import extent, measure, outline, runs, wrapped
from app.draw.vector import svg
from app.state import Options, at_stop, start, stops
from tests.type import met

SIZES = [(1280, 720), (1920, 1080), (3840, 2160), (800, 600)]
BLACK, WHITE, RED, GREEN = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
AHEAD = Camera(np.array([0.0, 0.0, 5.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]), scale=1.0)
PERSPECTIVE = replace(AHEAD, scale=0.0)


@pytest.fixture(autouse=True, scope="module")
def studio():
    """The off-screen window goes before the display does."""
    yield
    raster.close()


def pictures(theme="light", **options):
    for lesson in lessons.all_lessons():
        for stop in stops(lesson):
            yield compose(at_stop(start(lesson, Options(theme=theme, **options)), stop))


def of(*contents, **words):
    n = len(contents)
    panes = tuple(Pane(c, (k / n, 0.0, 1 / n, 1.0)) for k, c in enumerate(contents))
    return Picture(panes, WHITE, BLACK, BLACK, **words)


def markers(points, shape=Shape.SPHERE, colour=RED, radius=0.1, opacity=1.0):
    points = np.array(points, dtype=float)
    n = len(points)
    return Markers(points, shape, colour, np.full(n, radius), np.full(n, opacity), np.arange(n))


def square(z=0.0, colour=GREEN, half=0.5):
    points = half * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float) + [0, 0, z]
    return Faces(points, np.array([4]), np.arange(4), colour)


def overlap(a, b, slack=0.5):
    return (
        min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0]) > slack
        and min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1]) > slack
    )


# -- type -------------------------------------------------------------------------------------


def test_figures_have_one_width():
    assert {measure(figure * 3, 100)[0] for figure in "0123456789"} == {measure("000", 100)[0]}


@pytest.mark.parametrize("language", ["en", "de"])
def test_letters_stand_where_the_shaper_sets_the_whole_caption(language):
    for lesson in lessons.all_lessons():
        state = start(lesson, Options(language=language))
        for text in (run.text for beat in lesson.beats for run in runs(said(state, beat)) if not run.is_math):
            assert letters(text, bold=False) == list(_shaped(f"{text}{END}", bold=False)), text


def test_letters_that_join_or_run_leftwards_are_left_to_the_shaper():
    for text in ("e\u0301a", "\u05e9\u05dc\u05d5\u05dd", "1920x108", "3/(8n) "):
        assert letters(text, bold=True) == list(_shaped(f"{text}{END}", bold=True))


@pytest.mark.skipif(
    formulas.TABLE.read_text(encoding="utf-8").partition("\n")[0] != f"matplotlib {matplotlib.__version__}",
    reason="the table is of another version of mathtext, which may have set them otherwise",
)
def test_the_formulas_set_beforehand_are_those_of_the_lessons_as_mathtext_sets_them():
    before = {text: json.loads(box) for text, box in formulas.prepared().items()}
    assert json.loads(json.dumps(met())) == before, "the lessons' formulas have changed: make type"


def test_a_table_of_another_mathtext_is_not_used(tmp_path, monkeypatch):
    (tmp_path / "old.tsv").write_text("matplotlib 1.0\nV\t[1, 1, 0, [], []]\n")
    monkeypatch.setattr(formulas, "TABLE", tmp_path / "old.tsv")
    assert formulas.prepared.__wrapped__() == {}


def test_widths_of_words_add_up_with_their_spaces():
    assert measure("one two", 10)[0] == pytest.approx(measure("one ", 10)[0] + measure("two", 10)[0], abs=0.1)


def test_type_scales():
    for a, b in zip(measure("Words $x^2$", 10), measure("Words $x^2$", 30), strict=True):
        assert b == pytest.approx(3 * a)


def test_mathematics_is_set_between_words():
    kinds = [run.is_math for run in runs("Move $V$ to $Q$.")]
    assert kinds == [False, True, False, True, False]
    vertices, codes = outline("Move $V$", 20)
    assert len(vertices) == len(codes) > 50


def test_a_dollar_alone_is_a_word():
    assert [run.is_math for run in runs("5 $")] == [False]


def test_lines_fit_and_a_formula_is_not_broken():
    text = "Every vertex moves to $a + b + c + d$ and then on to the centroid of the centroids"
    lines = wrapped(text, 20, 300)
    assert len(lines) > 1
    assert all(measure(line, 20)[0] <= 300 for line in lines)
    assert " ".join(lines) == text
    assert any("$a + b + c + d$" in line for line in lines)


def test_nothing_is_written_in_no_lines():
    assert wrapped(" ", 20, 300) == ()


# -- layout -----------------------------------------------------------------------------------


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("theme", ["light", "projector"])
def test_words_are_inside_and_apart_and_large_enough(size, theme):
    width, height = size
    for picture in pictures(theme):
        plain = replace(picture, panes=tuple(p for p in picture.panes if isinstance(p.content, Scene)))
        texts = [p for p in overlay(plain, width, height) if isinstance(p, Text)]
        boxes = [extent(t) for t in texts]
        assert all(t.size >= LEAST * height / 1000 - 1e-9 for t in texts)
        for x, y, w, h in boxes:
            assert x >= 0, texts
            assert y >= 0, texts
            assert x + w <= width
            assert y + h <= height
        clash = [(a, b) for k, a in enumerate(boxes) for b in boxes[:k] if overlap(a, b)]
        assert not clash, [t.text for t in texts]


@pytest.mark.parametrize("size", SIZES)
def test_panes_touch_no_words(size):
    width, height = size
    for picture in pictures():
        areas = pane_areas(picture, width, height)
        around = overlay(replace(picture, panes=()), width, height)
        boxes = [extent(p) for p in around if isinstance(p, Text)]
        assert not [(a, b) for a in areas for b in boxes if overlap(a, b, slack=0.3 * 0.036 * height)]
        assert sum(w * h for _, _, w, h in areas) > 0.6 * width * height


def test_the_caption_can_be_read_from_the_back_row():
    picture = of(Scene(AHEAD), caption="Every vertex moves.")
    caption = next(p for p in overlay(picture, 1280, 720) if isinstance(p, Text))
    assert caption.size >= 720 / 36


def test_panes_keep_their_place_whether_the_caption_has_one_line_or_two():
    long = "Every vertex moves to the centroid of the centroids of the faces around it, and nothing else moves at all"
    areas = [pane_areas(of(Scene(AHEAD), caption=words), 1280, 720) for words in ("Short.", long)]
    assert areas[0] == areas[1]
    assert len(overlay(of(Scene(AHEAD), caption=long), 1280, 720)) == 2


def test_without_words_the_panes_grow():
    picture = of(Scene(AHEAD), caption="Words.", formula="$x$")
    assert pane_areas(picture, 1280, 720, words=False)[0][3] > pane_areas(picture, 1280, 720)[0][3]
    assert not overlay(picture, 1280, 720, words=False)


def test_a_legend_too_long_for_one_row_takes_more():
    picture = next(p for p in pictures() if len(p.legend) > 2)
    many = replace(picture, panes=(), legend=picture.legend * 6)
    marks = [p for p in overlay(many, 1280, 720) if isinstance(p, Mark)]
    assert len(marks) == len(many.legend)
    assert len({round(m.y) for m in marks}) > 1
    assert all(0 < m.x < 1280 for m in marks)


@pytest.mark.parametrize("size", SIZES)
def test_labels_hide_no_marker_and_no_other_label(size):
    rng = np.random.default_rng(5)
    points = rng.uniform(-0.8, 0.8, (40, 3))
    labels = tuple(Label(p, f"v{k}", BLACK) for k, p in enumerate(points))
    scene = Scene(AHEAD, markers=(markers(points, radius=0.03),), labels=labels)
    area = (0.0, 0.0, *map(float, size))
    found = [p for p in placed(scene, AHEAD, area, size[1], of(scene)) if isinstance(p, Text)]
    assert {t.text for t in found} == {k.text for k in labels}
    boxes = [extent(t) for t in found]
    assert not [1 for k, a in enumerate(boxes) for b in boxes[:k] if overlap(a, b)]
    for x, y, _ in AHEAD.project(points, *size):
        r = 0.03 * size[1] / 2
        for left, top, w, h in boxes:
            near = np.clip(x, left, left + w), np.clip(y, top, top + h)
            assert np.hypot(near[0] - x, near[1] - y) >= r - 0.5


def test_kept_labels_go_along_with_their_points_and_new_ones_are_placed():
    points = np.random.default_rng(5).uniform(-0.8, 0.8, (40, 3)) * [1, 1, 0]
    area = (0.0, 0.0, 1000.0, 1000.0)

    def shown(by: float, kept: Kept, n: int = 40) -> dict[str, tuple[float, float]]:
        moved = points[:n] + np.array([by, 0, 0])
        labels = tuple(Label(p, f"v{k}", BLACK) for k, p in enumerate(moved))
        scene = Scene(AHEAD, markers=(markers(moved, radius=0.03),), labels=labels)
        return {t.text: (t.x, t.y) for t in placed(scene, AHEAD, area, 1000, of(scene), kept) if isinstance(t, Text)}

    kept = Kept()
    before, after = shown(0.0, kept), shown(0.05, kept)
    right = AHEAD.project(np.array([[0.05, 0, 0], [0, 0, 0]]), 1000, 1000)
    assert {name: (x + right[0, 0] - right[1, 0], y) for name, (x, y) in before.items()} == {
        name: pytest.approx(at) for name, at in after.items()
    }
    kept = Kept()
    assert set(shown(0.0, kept, 20)) < set(shown(0.0, kept)) == set(before)
    assert shown(0.0, kept) == before


def test_a_label_of_a_point_out_of_sight_is_left_out():
    scene = Scene(AHEAD, labels=(Label(np.array([9.0, 0.0, 0.0]), "far", BLACK),))
    assert not placed(scene, AHEAD, (0.0, 0.0, 800.0, 600.0), 600, of(scene))


def test_a_live_camera_moves_the_labels():
    scene = Scene(AHEAD, labels=(Label(np.array([0.5, 0.0, 0.0]), "p", BLACK),))
    turned = replace(AHEAD, position=np.array([0.0, 0.0, -5.0]))
    first, second = (overlay(of(scene), 800, 600, cameras=[c])[0].x for c in (AHEAD, turned))
    assert first > 400 > second


def test_boxes_of_a_diagram_stand_in_their_pane_with_their_words_inside():
    boxes = tuple(Box(k, j, (f"$P_{k}$",), WHITE, BLACK, BLACK) for k in range(4) for j in range(3))
    found = overlay(of(Scene(AHEAD), Diagram((-0.5, -0.5, 3.5, 2.5), boxes)), 1280, 720)
    plates, texts = ([p for p in found if isinstance(p, kind)] for kind in (Plate, Text))
    assert len(plates) == len(texts) == 12
    for plate, text in zip(plates, texts, strict=True):
        x, y, w, h = extent(text)
        assert 640 <= plate.x <= x
        assert x + w <= plate.x + plate.width
        assert plate.y <= y + 0.3 * h
        assert plate.x + plate.width <= 1280


def test_a_narrow_pane_still_shows_everything():
    wide, narrow = (0.0, 0.0, 1000.0, 600.0), (0.0, 0.0, 300.0, 600.0)
    for camera in (AHEAD, replace(AHEAD, scale=0.0)):
        assert fitted(camera, wide) == camera or fitted(camera, wide).scale == camera.scale
        shown = fitted(camera, narrow).project(np.array([[1.0, 0, 0]]), 300, 600)[0, 0]
        assert shown < 300


# -- geometry ---------------------------------------------------------------------------------


@pytest.mark.parametrize("solid", [CUBE, OCTAHEDRON])
def test_marker_sides_look_outwards(solid):
    start_ = np.cumsum(solid.sizes) - solid.sizes
    middles = np.add.reduceat(solid.points[solid.corners], start_) / solid.sizes[:, None]
    assert ((normals(solid) * middles).sum(axis=1) > 0).all()


def test_triangles_cover_polygons_of_any_size():
    angles = np.arange(5) * 2 * np.pi / 5
    pentagon = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(5)])
    concave = np.array([[0, 0, 1], [2, 0, 1], [2, 2, 1], [0.9, 0.1, 1], [0, 2, 1]])  # its middle sees not every side
    triangle = np.array([[0, 0, 2], [1, 0, 2], [0, 1, 2]])
    points = np.vstack([pentagon, concave, triangle]).astype(float)
    cut = facets(Faces(points, np.array([5, 5, 3]), np.arange(13), RED))
    a, b, c = (cut.points[cut.triangles[:, k]] for k in range(3))
    doubled = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    for z, area in ((0, 2.5 * np.sin(2 * np.pi / 5)), (1, 2.1), (2, 0.5)):
        assert doubled[a[:, 2] == z].sum() / 2 == pytest.approx(area)


def test_a_bent_quad_has_one_normal():
    points = np.array([[0, 0, 0], [1, 0, 0.3], [1, 1, 0], [0, 1, 0.3]], dtype=float)
    cut = facets(Faces(points, np.array([4]), np.arange(4), RED))
    assert len(cut.triangles) == 4
    assert np.ptp(cut.normals, axis=0).max() == 0


def test_dashes_begin_and_end_with_a_dash():
    lines = Lines(np.array([[0.0, 0, 0], [1, 0, 0], [1, 0.02, 0]]), np.array([[0, 1], [1, 2]]), RED, 1.0, dashed=True)
    cut = dashes(lines, 0.1)
    x = cut.points[cut.pairs][:-1, :, 0]
    assert x[0, 0] == 0
    assert x[-1, 1] == pytest.approx(1)
    assert np.allclose(x[:, 1] - x[:, 0], x[0, 1])  # all as long as each other ...
    assert np.allclose(x[1:, 0] - x[:-1, 1], x[0, 1])  # ... and as the gaps
    assert np.array_equal(cut.points[-2:], lines.points[1:])  # too short to be cut


def test_the_nearer_triangle_hides_the_other():
    near = np.array([[0, 0, 1], [10, 0, 1], [0, 10, 1]], dtype=float)
    depth = depth_of(np.stack([near + np.array([0, 0, 1]), near]), 12, 12)
    assert depth.owner[2, 2] == 1
    places = np.array([[2.5, 2.5, 1.5], [2.5, 2.5, 0.5], [11.5, 11.5, 9.0]])
    assert depth.shows(places, 0.0).tolist() == [False, True, True]


# -- vector -----------------------------------------------------------------------------------


def test_every_picture_is_well_formed_svg_and_the_same_twice():
    for picture in list(pictures())[::5]:
        text = svg(picture, 1280, 720)
        assert text == svg(picture, 1280, 720)
        root = ElementTree.fromstring(text)
        words = "".join(t.text for t in root.iter("{http://www.w3.org/2000/svg}text"))
        assert picture.title.split()[0] in words
        assert "<image" not in text


def test_svg_leaves_out_what_is_wholly_hidden_and_keeps_hidden_points_faint():
    scene = Scene(AHEAD, faces=(square(0), square(-1, RED, 0.4)), markers=(markers([[0, 0, -2], [0, 0, 0]]),))
    text = svg(of(scene), 600, 600)
    assert text.count("<polygon") == 1
    assert len(re.findall(r'<g transform="[^"]+" opacity="0.17">', text)) == 1


def test_svg_cuts_strokes_where_a_surface_hides_them():
    line = Lines(np.array([[-1.0, 0, -1], [1, 0, -1]]), np.array([[0, 1]]), RED, 2.0)
    text = svg(of(Scene(AHEAD, faces=(square(),), lines=(line,))), 600, 600, transparent=True)
    path = re.search(r'<path d="([^"]+)" fill="none" stroke="#ff0000"', text)
    assert path
    assert path[1].count("M") == 2


@pytest.mark.parametrize("shape", list(Shape))
def test_every_shape_can_be_projected(shape):
    text = svg(of(Scene(AHEAD, markers=(markers([[0, 0, 0]], shape),))), 600, 600)
    ElementTree.fromstring(text)


# -- raster (off the screen) --------------------------------------------------------------------


def part(pixels, colour):
    """How much of a picture has about this colour."""
    return (np.abs(pixels[..., :3].astype(int) - np.round(255 * np.array(colour))).max(axis=2) < 90).mean()


def test_a_scene_is_where_its_camera_says():
    pixels = image(of(Scene(AHEAD, markers=(markers([[0.5, 0.5, 0]], radius=0.2),))), 600, 600)
    y, x = (np.abs(pixels[..., 1].astype(int) - 255) > 60).nonzero()
    left, top, w, h = pane_areas(of(Scene(AHEAD)), 600, 600)[0]
    flat = fitted(AHEAD, (left, top, w, h)).project(np.array([[0.5, 0.5, 0]]), w, h)[0]
    assert np.mean(x) == pytest.approx(flat[0] + left, abs=3)
    assert np.mean(y) == pytest.approx(flat[1] + top, abs=3)


@pytest.mark.parametrize("shape", list(Shape))
def test_every_shape_is_seen(shape):
    pixels = image(of(Scene(AHEAD, markers=(markers([[0, 0, 0]], shape, radius=0.3),))), 300, 300)
    assert 0.01 < part(pixels, RED) < 0.3


@pytest.mark.parametrize(("camera", "near"), [(AHEAD, 0.0), (PERSPECTIVE, 0.0), (PERSPECTIVE, 4.0)])
def test_a_hidden_marker_is_faint_and_not_gone_however_near_other_things_are(camera, near):
    front = image(of(Scene(camera, faces=(square(),))), 300, 300)
    points = markers([[0, 0, -1], [0.15, 0, near]], colour=BLACK)
    faint = image(of(Scene(camera, faces=(square(),), markers=(points,))), 300, 300)
    changed = np.abs(faint[150, 150].astype(int) - front[150, 150]).max()
    assert 15 < changed < 90


def test_markers_lie_on_a_surface_whole():
    flat = image(of(Scene(AHEAD, markers=(markers([[0, 0, 0]]),))), 300, 300)
    tilted = replace(AHEAD, position=np.array([0.0, -4.5, 2.0]))
    on = image(of(Scene(tilted, faces=(square(),), markers=(markers([[0, 0, 0]]),))), 300, 300)
    assert part(on, RED) == pytest.approx(part(flat, RED), rel=0.12)


@pytest.mark.parametrize("is_frame", [False, True])
def test_translucent_strokes_are_smooth(is_frame):
    line = Lines(np.array([[-0.6, -0.4, 0], [0.6, 0.5, 0]]), np.array([[0, 1]]), BLACK, 40.0, 0.5)
    shades = np.unique(image(of(Scene(AHEAD, lines=(line,))), 300, 300, is_frame=is_frame)[..., 0])
    assert shades.max() == 255
    assert len(shades) >= 5  # beside the stroke, on it, and between
    assert np.diff(shades.astype(int)).max() < 40


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_rims_are_smooth_of_what_is_translucent_too(opacity, monkeypatch):
    leaning = np.array([[-0.5, -0.5, 0], [0.5, -0.4, 0], [0.4, 0.5, 0], [-0.6, 0.4, 0]])
    picture = of(Scene(AHEAD, (replace(square(), points=leaning, opacity=opacity),)))
    still = image(picture, 300, 300)
    inside, outside = still[150, 150].astype(int), still[20, 20].astype(int)
    share = (still[..., 0] - outside[0]) / (inside[0] - outside[0])
    shades = {round(8 * s) for s in share.ravel().tolist()}
    assert shades == set(range(9))  # every number of the samples of a pixel
    assert np.abs(8 * share - np.round(8 * share)).max() < 0.2
    monkeypatch.setattr(raster, "MANY", 0)
    for other in (image(picture, 300, 300), image(picture, 300, 300, is_frame=True)):  # all samples at once, if it can
        assert np.abs(other.astype(int) - still).mean() < 0.5


def test_painting_again_leaves_nothing_behind():
    empty = image(of(Scene(AHEAD)), 300, 300)
    image(of(Scene(AHEAD, (square(),), markers=(markers([[0, 0, 0]], opacity=0.5),))), 300, 300)
    assert np.array_equal(empty, image(of(Scene(AHEAD)), 300, 300))


def test_strokes_scale_with_the_picture():
    line = Lines(np.array([[-1.0, 0, 0], [1, 0, 0]]), np.array([[0, 1]]), BLACK, 10.0)
    thick = [
        (image(of(Scene(AHEAD, lines=(line,))), n, n)[:, n // 2, 0] < 128).sum() for n in (300, 900)
    ]  # fmt: skip
    assert thick == [pytest.approx(3, abs=1), pytest.approx(9, abs=1)]


def test_a_transparent_picture_is_clear_where_nothing_is():
    picture = of(Scene(AHEAD, faces=(square(),)))
    pixels = image(picture, 300, 300, transparent=True)
    assert pixels[2, 2, 3] == 0
    assert pixels[150, 150, 3] == 255
    assert pixels[150, 150, 1] > 120


def camera_of(renderer) -> Camera:
    """Where a renderer is seen from."""
    there = renderer.GetActiveCamera()
    return Camera(
        np.array(there.GetPosition()), np.array(there.GetFocalPoint()), np.array(there.GetViewUp()),
        float(there.GetViewAngle()), float(there.GetParallelScale()) if there.GetParallelProjection() else 0.0,
    )  # fmt: skip


def test_a_camera_survives_the_renderer():
    import pyvista

    from app.draw.vtk import ScenePainter

    plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), window_size=(200, 100))
    painter = ScenePainter(plotter, (0, 1))
    for camera in (AHEAD, replace(AHEAD, scale=0.0, angle=22.0)):
        painter.look(camera)
        back = camera_of(painter.renderer)
        for name in ("position", "focal", "up"):
            assert np.allclose(getattr(back, name), getattr(camera, name))
        assert back.scale == camera.scale
        assert camera.scale or back.angle == pytest.approx(camera.angle)
    painter.close()
    plotter.close()


def test_actors_are_made_once():
    import pyvista

    from app.draw.vtk import ScenePainter

    plotter = pyvista.Plotter(off_screen=True, window_size=(100, 100))
    painter = ScenePainter(plotter)
    scene = Scene(AHEAD, (square(),), markers=(markers([[0, 0, 0]]),))
    painter.paint(scene, 100)
    before = painter.renderer.GetViewProps().GetNumberOfItems()
    for _ in range(3):
        painter.paint(Scene(AHEAD, (square(0.1),), markers=(markers([[0, 0, 0.1], [0.2, 0, 0]]),)), 100)
    assert painter.renderer.GetViewProps().GetNumberOfItems() == before
    painter.close()
    plotter.close()

"""Boxes say rows of the matrix, can be read, keep apart, and light up with what they are made of."""

import os
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import reduce
from itertools import pairwise, product
from math import lcm
from pathlib import Path

import numpy as np
import pytest

import lessons
from app.draw.compose import compose
from app.draw.diagrams import BLANK, DIM, GLOW, LINE, NONE, diagram, lights
from app.draw.layout import overlay, part_at
from app.draw.markup import code
from app.draw.picture import Box, Diagram, Pane, Picture
from app.draw.primitives import LEAST, Plate, Primitive, Stroke, Text
from app.draw.theme import THEMES
from app.draw.type import extent
from app.state import Options, Spot, State, at_stop, look, seek, segments, start, stops
from lessons.script import Kind, Lesson, View
from subdivision import Grid, Trace, shapes, trace
from subdivision.schemes import lane_riesenfeld, tensor_product

GOLDEN = Path(__file__).parent / "golden" / "diagrams"
SIZES = [(1280, 720), (1920, 1080)]
NUMBERS = ("01", "02", "03", "04", "05", "06", "07", "16", "18")

each_figure = pytest.mark.parametrize("number", NUMBERS)


def turned(number: str) -> Iterator[Lesson]:
    """A lesson with its knobs at all their values."""
    lesson = lessons.find(f"figure_{number}")
    names = [knob.name for knob in lesson.knobs]
    for values in product(*(range(knob.least, knob.most + 1) for knob in lesson.knobs)):
        yield lesson.turned(**dict(zip(names, values, strict=True)))


def rests(number: str, **options) -> Iterator[State]:
    for lesson in turned(number):
        for stop in stops(lesson):
            yield at_stop(start(lesson, Options(**options)), stop)


def diagrams_of(state: State) -> list[tuple[int, View, Diagram]]:
    """Number, view and content of the panes that are diagrams."""
    panes = enumerate(zip(state.now.views, compose(state).panes, strict=True))
    return [(k, view, pane.content) for k, (view, pane) in panes if view.kind is Kind.DIAGRAM]


def alone(content: Diagram) -> Picture:
    return Picture((Pane(content),), (1.0, 1.0, 1.0), (0.0, 0.0, 0.0), (0.5, 0.5, 0.5))


def product_of(told: Trace, first: int, last: int) -> np.ndarray:
    """Stages ``first`` to ``last`` as a dense matrix; the identity if there are none."""
    matrices = [stage.matrix.toarray() for stage in told.stages[first:last]]
    n = told.stages[first - 1].n_points if first else told.control.topology.n_vertices
    return reduce(lambda done, stage: stage @ done, matrices, np.eye(n))


# -- what boxes say ---------------------------------------------------------------------------


def summed(text: str, net: Grid | None) -> dict[int, float]:
    """``$3P_{0}{+}P_{1}$`` as point -> count."""
    found = re.findall(r"(\d*)P_\{(\d+)\}", text)
    return {int(p) if net is None else int(p[0]) * net.n_t + int(p[1]): int(c or 1) for c, p in found}


def tabled(text: str) -> list[list[int]]:
    """The table of a box, line by line, zero where nothing contributes."""
    return [[0 if w == NONE else int(w) for w in line.replace(BLANK, " ").split()] for line in text.splitlines()]


def says(text: str, counts: dict[int, float], net: Grid | None) -> bool:
    """Whether a text of a box means these counts."""
    if "P" in text:
        return summed(text, net) == counts
    if net is None:
        return [int(n) for n in text.split()] == [counts[p] for p in sorted(counts)]
    block = np.zeros(net.shape)
    for p, count in counts.items():
        block[divmod(p, net.n_t)] = count
    inside = block[block.any(axis=1)][:, block.any(axis=0)]
    return tabled(text) in (inside.T[::-1].tolist(), [sorted(set(counts.values()), reverse=True)])


@each_figure
def test_every_text_of_a_box_is_its_row_of_the_matrix(number: str):
    for state in rests(number):
        for _, view, content in diagrams_of(state):
            control = view.trace.control.topology
            net = control if isinstance(control, Grid) else None
            for box in content.boxes:
                whole = product_of(view.trace, 0, box.stage)
                below = lcm(*(float(w).as_integer_ratio()[1] for w in whole.ravel()))
                row = whole[box.point]
                counts = {int(p): below * row[p] for p in np.flatnonzero(row)}
                assert all(says(text, counts, net) for text in box.texts), (box.texts, counts)
                if below > 1:
                    assert [n for n in content.notes if n.text.split()[-1 if net is None else 3] == f"1/{below}"]


def test_a_table_has_the_shape_of_the_control_points_that_contribute_t_upwards():
    told = trace(tensor_product(3, 3), shapes.net(4, 4))
    boxes = diagram(told, len(told.stages), THEMES["light"]).boxes
    assert tabled(boxes[6].texts[2]) == [[1, 6, 1], [6, 36, 6], [1, 6, 1]]
    first_round = diagram(trace(tensor_product(3, 3), shapes.net(4, 4), "two rounds"), 2, THEMES["light"])
    assert tabled(first_round.boxes[0].texts[2]) == [[3, 1], [9, 3]]
    assert first_round.boxes[0].texts[0] == "$9P_{00}{+}3P_{10}$\n${+}3P_{01}{+}P_{11}$"


def test_the_rows_of_a_pyramid_choose_their_words_by_themselves_and_an_array_is_one():
    pyramid = diagram(trace(lane_riesenfeld(3), shapes.polygon(4)), 4, THEMES["light"])
    array = diagram(trace(tensor_product(1, 1), shapes.net(3, 3)), 4, THEMES["light"])
    assert {box.stage - 1 for box in pyramid.boxes} == {box.group for box in pyramid.boxes} == {0, 1, 2, 3}
    assert {box.group for box in array.boxes} == {0}


def test_two_rounds_of_centroids_are_the_biquadratic_and_then_the_bicubic_step():
    told = trace(tensor_product(3, 3), shapes.net(5, 6), "two rounds")
    assert [stage.name for stage in told.stages] == ["topology", "first round", "second round"]
    for k, degree in ((1, 1), (2, 2), (3, 3)):
        other = tensor_product(degree, degree).step(told.control.topology).matrix
        assert abs(told.upto(k).matrix - other).max() < 1e-12


# -- that boxes can be read -------------------------------------------------------------------


@each_figure
@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("size", SIZES)
def test_every_box_says_something_inside_itself_and_nothing_is_smaller_than_a_forty_fifth(number, theme, size):
    for state in rests(number, theme=theme):
        picture = compose(state)
        found = overlay(picture, *size)
        assert min(p.size for p in found if isinstance(p, Text)) >= LEAST * size[1] / 1000 - 1e-9
        for box, words in boxed(found):
            assert words, state.now.text
            for text in words:
                x, _, w, _ = extent(text)
                assert box.x < x
                assert x + w < box.x + box.width
                assert box.y < text.y - 0.7 * text.size
                assert text.y < box.y + box.height


def boxed(found: tuple[Primitive, ...]) -> list[tuple[Plate, list[Text]]]:
    """Every box and the words that follow it."""
    places = [k for k, p in enumerate(found) if isinstance(p, Plate)]
    found_boxes = []
    for k, after in pairwise([*places, len(found)]):
        box, texts = found[k], [p for p in found[k + 1 : after] if isinstance(p, Text)]
        assert isinstance(box, Plate)
        found_boxes.append((box, [t for t in texts if abs(t.x - box.x - box.width / 2) < 1e-6]))
    return found_boxes


@each_figure
def test_no_two_boxes_overlap_at_rest(number: str):
    for state in rests(number):
        for _, _, content in diagrams_of(state):
            x, y, w, h = np.array([(b.x, b.y, b.width, b.height) for b in content.boxes]).T
            clear = np.maximum(abs(x[:, None] - x) - (w[:, None] + w) / 2, abs(y[:, None] - y) - (h[:, None] + h) / 2)
            assert clear[~np.eye(len(x), dtype=bool)].min() > 0
            left, top, right, bottom = content.cells
            assert left <= (x - w / 2).min()
            assert (x + w / 2).max() <= right
            assert top <= (y - h / 2).min()
            assert (y + h / 2).max() <= bottom


def test_boxes_with_no_room_for_their_words_say_less_and_then_nothing():
    told = trace(tensor_product(3, 3), shapes.net(4, 4))
    content = replace(diagram(told, len(told.stages), THEMES["light"]), notes=())
    longest = []
    for width in (1600, 700, 400, 200):
        texts = [p for p in overlay(alone(content), width, 1000) if isinstance(p, Text)]
        assert all(t.size >= LEAST - 1e-9 for t in texts)
        longest.append(max((len(t.text) for t in texts), default=0))
    assert longest[0] > longest[1] > longest[-1] == 0


def test_boxes_fill_in_step_with_the_stage():
    lesson = lessons.find("figure_05")
    segment = next(s for s in segments(lesson) if s.name == "average s")
    for part in (0.2, 0.5, 0.8):
        state = seek(start(lesson), segment.begin + part)
        (_, still, before), (_, playing, after) = diagrams_of(state)
        assert still.at(part) == 1 < playing.at(part) < 2
        assert all(box.opacity == 1 for box in before.boxes)
        assert min(box.opacity for box in after.boxes) < 1
        changed = sum(any("{+}" in text for text in box.texts) for box in after.boxes)
        assert 0 <= changed <= 12
    assert changed > 0


@each_figure
def test_the_weights_of_every_box_add_up_to_one_also_between_two_stages(number: str):
    for lesson in turned(number):
        for segment in segments(lesson):
            between = seek(start(lesson), segment.begin + 0.4 * (segment.end - segment.begin))
            for _, view, content in diagrams_of(between):
                control = view.trace.control.topology
                net = control if isinstance(control, Grid) else None
                below = [int(n.text.partition("1/")[2].partition(" ")[0] or 1) for n in content.notes] or [1]
                assert all(sum(summed(b.texts[0], net).values()) == below[b.group] for b in content.boxes)


# -- lights -----------------------------------------------------------------------------------


def lit(content: Diagram) -> dict[tuple[int, int], float]:
    """Stage and point of the boxes that are lit, and how brightly."""
    glow = {(b.stage, b.point): (b.line - LINE) / GLOW for b in content.boxes}
    return {which: pytest.approx(bright) for which, bright in glow.items() if bright > 0}


def ancestors(told: Trace, stage: int, point: int, shown: Diagram) -> dict[tuple[int, int], float]:
    """The boxes shown that a point is made of, by nonzero entries of products of matrices."""
    found = {(stage, point): 1.0}
    for k in range(stage):
        row = product_of(told, k, stage)[point]
        found |= {(k, int(p)): 1.0 if k == stage - 1 else DIM for p in np.flatnonzero(row)}
    boxes = {(b.stage, b.point) for b in shown.boxes}
    return {which: bright for which, bright in found.items() if which in boxes}


@pytest.mark.parametrize(("number", "knobs"), [("01", {"degree": 4}), ("04", {"m": 2, "n": 2}), ("05", {}), ("18", {})])
def test_hovering_a_box_lights_exactly_it_and_what_it_is_made_of_in_every_pane_of_its_trace(number: str, knobs):
    lesson = lessons.find(f"figure_{number}").turned(**knobs)
    for stop in stops(lesson):
        state = at_stop(start(lesson), stop)
        for k, view, content in diagrams_of(state):
            for box in content.boxes[:: max(len(content.boxes) // 12, 1)]:
                pointing = look(state, Spot(k, box.stage, box.point))
                for _, other, shown in diagrams_of(pointing):
                    expected = ancestors(view.trace, box.stage, box.point, shown)
                    assert lit(shown) == (expected if other.trace is view.trace else {})


def test_a_box_and_its_two_parents_are_bright_and_the_strokes_between_them_are():
    told = trace(lane_riesenfeld(3), shapes.polygon(4))
    theme = THEMES["light"]
    shown = diagram(told, 4, theme, Spot(0, 4, 2))
    bright = [b for b in shown.boxes if b.stroke == theme.selection]
    assert [(b.stage, b.point) for b in bright] == [(3, 2), (3, 3), (4, 2)]
    assert len([k for k in shown.links if k.colour == theme.selection]) == 2
    assert len([k for k in shown.links if LINE < k.width < LINE + GLOW]) == 4 + 6
    assert lights(told, Spot(0, 0, 1)) == {(0, 1): 1.0}
    assert lights(told, Spot(0, 4, 99)) == lights(told, None) == {}


def test_pointing_at_a_point_in_space_lights_its_box():
    lesson = lessons.find("figure_05")
    state = at_stop(start(lesson), stops(lesson)[1])
    (_, _, shown), *_ = diagrams_of(look(state, Spot(0, 1, 7)))
    assert lit(shown) == {(1, 7): 1.0}


@each_figure
def test_a_row_the_lesson_points_out_lights_at_the_end_of_its_beat_in_all_its_diagrams(number: str):
    lesson = lessons.find(f"figure_{number}")
    found = 0
    for stop in stops(lesson):
        state = at_stop(start(lesson), stop)
        rows = {v.stencil.point: int(v.stop) for v in state.now.views if v.stencil is not None}
        for _, view, shown in diagrams_of(state):
            expected = [ancestors(view.trace, stage, point, shown) for point, stage in rows.items()]
            assert lit(shown) == (expected[0] if expected else {})
            found += bool(expected)
    assert found or not any(v.stencil for beat in lesson.beats for v in beat.views)


@pytest.mark.parametrize("number", ["01", "05", "18"])
def test_the_mouse_finds_the_box_that_is_drawn_under_it(number: str):
    lesson = lessons.find(f"figure_{number}")
    state = at_stop(start(lesson), stops(lesson)[-1])
    picture = compose(state)
    plates = [p for p in overlay(picture, 1280, 720) if isinstance(p, Plate)]
    boxes: list[tuple[int, Box]] = [(k, b) for k, _, shown in diagrams_of(state) for b in shown.boxes]
    for plate, (pane, box) in zip(plates, boxes, strict=True):
        for across, down in ((0.5, 0.5), (0.05, 0.95)):
            at = plate.x + across * plate.width, plate.y + down * plate.height
            assert part_at(picture, 1280, 720, *at) == (pane, box)


# -- pictures as they were --------------------------------------------------------------------


def flat(content: Diagram) -> str:
    """The strokes, boxes and words of a diagram on 1280 by 720 pixels, a line each, to whole pixels."""
    lines = []
    for p in overlay(alone(content), 1280, 720):
        if isinstance(p, Text):
            lines.append(f"text {p.x:.0f} {p.y:.0f} {p.size:.0f} {p.align} {p.text}")
        elif isinstance(p, Plate) and p.stroke is not None:
            lines.append(f"box {p.x:.0f} {p.y:.0f} {p.width:.0f} {p.height:.0f} line {p.line:.1f} {code(p.stroke)}")
        elif isinstance(p, Stroke):
            lines.append(f"stroke {p.x0:.0f} {p.y0:.0f} {p.x1:.0f} {p.y1:.0f} width {p.width:.1f}")
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("number", "stop", "pane"), [("01", -1, 1), ("02", 2, 1), ("05", -1, 1), ("07", -2, 1), ("18", -1, 2)]
)
def test_diagrams_look_as_they_did(number: str, stop: int, pane: int):
    """After a change on purpose look at the figures; then REGENERATE=1 pytest tests/test_diagrams.py -k as_they_did."""
    lesson = lessons.find(f"figure_{number}")
    content = compose(at_stop(start(lesson), stops(lesson)[stop])).panes[pane].content
    assert isinstance(content, Diagram)
    golden, now = GOLDEN / f"{lesson.id}.txt", flat(content)
    if os.environ.get("REGENERATE"):
        golden.parent.mkdir(exist_ok=True)
        golden.write_text(now, encoding="utf-8")
    assert now == golden.read_text(encoding="utf-8")

"""Extraordinary points: how far a vertex may be pulled, what becomes of the surface, and how it is told."""

from dataclasses import fields
from fractions import Fraction
from itertools import pairwise
from math import cos, pi

import numpy as np
import pytest
from test_spectrum import TABLE, ring_matrix
from test_spectrum import quad_lambda as published_lambda

import lessons
from app import state as st
from app.draw.compose import compose
from app.draw.picture import Diagram, Scene
from app.draw.spectrum import in_words, said
from app.laboratory import bench
from app.sessions.keeping import kept, restored
from subdivision import Mesh, TopologyError, shapes, subdivide
from subdivision.catalogue import FAMILIES, scheme
from subdivision.characteristic import characteristic_map
from subdivision.extraordinary import PULL_RULES, QUAD_PULLS, TRIANGLE_PULLS, analysis, pull_rule
from subdivision.isolation import apart, counts
from subdivision.limit import limit, normals, tangents
from subdivision.schemes import (
    CATMULL_CLARK,
    DOO_SABIN,
    LOOP,
    LOOP_WARREN,
    QUAD_CENTROID,
    TRIANGLE_CENTROID,
    quad_pull,
    triangle_pull,
)
from subdivision.smoothness import quad_lambda, quad_pulls, triangle_lambda, triangle_pulls
from subdivision.spectrum import beta_min, fan, ring

VALENCES = list(st.VALENCES)
PULLS = [Fraction(k, 16) for k in range(33)]
valences = pytest.mark.parametrize("n", VALENCES)
families = pytest.mark.parametrize("family", PULL_RULES)
START = st.start(lessons.find("14"))


# -- the two families ---------------------------------------------------------------------------


@pytest.mark.parametrize(("shape", "plain", "family"), [
    ("plus-sign", QUAD_CENTROID, "quad-pull"), ("bipyramid", TRIANGLE_CENTROID, "triangle-pull"),
])  # fmt: skip
def test_all_the_way_is_the_lectures_own_scheme(shape, plain, family):
    mesh = shapes.SHAPES[shape]()
    assert np.abs(subdivide(mesh, plain, 2).points - subdivide(mesh, scheme(family), 2).points).max() < 1e-12


@pytest.mark.parametrize(("shape", "published", "family"), [
    ("cube", CATMULL_CLARK, quad_pull(Fraction(4, 3))), ("octahedron", LOOP, triangle_pull(Fraction(31, 24))),
    ("tetrahedron", LOOP_WARREN, triangle_pull(Fraction(3, 2))), ("tetrahedron", LOOP, triangle_pull(Fraction(3, 2))),
])  # fmt: skip
def test_published_schemes_are_a_pull_where_all_extraordinary_vertices_are_alike(shape, published, family):
    mesh = shapes.SHAPES[shape]()
    assert np.abs(subdivide(mesh, published, 3).points - subdivide(mesh, family, 3).points).max() < 1e-12


@families
def test_tellings_multiply_to_the_same_exact_matrix_and_regular_vertices_ignore_the_pull(family):
    rule = PULL_RULES[family]
    mesh = shapes.SHAPES["plus-sign" if rule.regular == 4 else "bipyramid"]()
    for way in (Fraction(0), Fraction(5, 16), Fraction(2)):
        one, other = (scheme(family, (way,)).step(mesh.topology, telling) for telling in scheme(family).tellings)
        assert np.abs((one.matrix - other.matrix).toarray()).max() < 1e-15
        for v in range(mesh.topology.n_vertices):
            assert dict(one.stencil(v).terms) == dict(other.stencil(v).terms)
            assert all(isinstance(weight, Fraction) for _, weight in one.stencil(v).terms)
        regular = (ring(s, rule.regular).matrix for s in (scheme(family, (way,)), rule.all_the_way))
        assert np.array_equal(*regular)


@families
@pytest.mark.parametrize("n", [3, 5, 8])
def test_limits_are_fixed_by_a_step_and_tangents_shrink_by_lambda_where_there_is_a_plane(family, n):
    rule = PULL_RULES[family]
    t = fan(n, 4 if rule.regular == 4 else 3)
    for way in PULLS[::4]:
        s = scheme(family, (way,))
        local = ring(s, n)
        row = limit(s, t).assemble().toarray()[0]
        assert np.abs(row @ local.matrix - row).max() < 1e-12
        for direction in tangents(s, t):
            row = direction.assemble().toarray()[0]
            assert row.any() == (way in rule.smooth(n))
            assert np.abs(row @ local.matrix - local.subdominant * row).max() < 1e-12 * (1 + np.abs(row).max())


def test_the_normals_at_a_tip_are_none_and_elsewhere_they_are():
    cube = shapes.cube()
    assert not normals(cube, quad_pull(Fraction(1, 2)))[0].any()
    assert normals(cube, quad_pull(Fraction(5, 8)))[0].any()


# -- how far a vertex may be pulled ---------------------------------------------------------------


@families
@valences
def test_a_pull_is_smooth_exactly_between_the_closed_ends(family, n):
    rule = PULL_RULES[family]
    if n == rule.regular:
        return
    for way in PULLS:
        found = ring(scheme(family, (way,)), n)
        assert found.is_smooth == (way in rule.smooth(n)) == analysis(found.scheme, n).is_smooth


@families
@pytest.mark.parametrize("n", [n for n in VALENCES if n not in (4, 6)])
def test_at_either_end_a_bowl_shrinks_as_the_ring_and_at_the_bounded_pull_as_its_square(family, n):
    rule = PULL_RULES[family]

    def shrinks(way: float) -> np.ndarray:
        return ring(scheme(family, (Fraction(way),)), n).eigenvalues(0)[1:]

    size = ring(rule.all_the_way, n).subdominant
    for end in (rule.smooth(n).least, rule.smooth(n).most):
        assert np.abs(shrinks(float(end))).max() == pytest.approx(size, abs=1e-12)
    assert np.abs(shrinks(float(rule.bounded(n)))).max() == pytest.approx(size**2, abs=1e-12)


@valences
def test_the_ends_are_the_lectures_for_triangles_and_lambda_is_the_published_one(n):
    c = cos(2 * pi / n)
    ends = triangle_pulls(n)
    assert float(ends.least) == pytest.approx(float(beta_min(n)) * 8 * n / 3, abs=1e-12)
    assert float(ends.most) == pytest.approx((8 + 2 * c) / 3, abs=1e-12)
    assert float(quad_lambda(n)) == pytest.approx(published_lambda(n), abs=1e-15)
    assert float(triangle_lambda(n)) == pytest.approx(3 / 8 + c / 4, abs=1e-15)
    assert float(ends.most) > 2 < float(quad_pulls(n).most)  # beyond the slider


@valences
def test_loops_pull_is_the_bounded_one_and_the_named_pulls_are_the_published_schemes(n):
    assert float(TRIANGLE_PULLS.pull_of(LOOP, n)) == pytest.approx(float(TRIANGLE_PULLS.bounded(n)), abs=1e-12)
    assert {each.name: each.pull for each in QUAD_PULLS.specials(n)}["Catmull-Clark"] == Fraction(4, n)
    for rule in PULL_RULES.values():
        for published in rule.published.values():
            way = rule.pull_of(published, n)
            if isinstance(way, Fraction) and n != rule.regular:
                same = ring(scheme(rule.family, (way,)), n).matrix
                assert np.abs(same - ring_matrix(published, n)).max() < 1e-12
    with pytest.raises(TopologyError, match="not told by how far"):
        QUAD_PULLS.pull_of(LOOP, n)


# -- what becomes of the surface ------------------------------------------------------------------


@pytest.mark.parametrize("n", TABLE)
def test_the_analysis_has_the_numbers_of_the_table(n):
    quads, triangles = analysis(CATMULL_CLARK, n), analysis(LOOP, n)
    assert (quads.subdominant, quads.ring.cup) == pytest.approx(TABLE[n][:2], abs=6e-6)
    assert (triangles.subdominant, triangles.ring.cup) == pytest.approx((TABLE[n][4], TABLE[n][6]), abs=6e-6)
    for found in (quads, triangles):
        counted = [e.value for e in found.eigenvalues for _ in range(e.times)]
        assert sorted(counted) == pytest.approx(sorted(found.ring.spectrum), abs=1e-9)
        assert sum(counted) == pytest.approx(np.trace(found.ring.matrix), abs=1e-12)


@pytest.mark.parametrize(("published", "n", "words"), [
    (TRIANGLE_CENTROID, 3, ("a tip", "no curvature", "none")),
    (LOOP, 3, ("a tangent plane", "bounded", "none")),
    (QUAD_CENTROID, 3, ("a tangent plane", "pinched", "none")),
    (QUAD_CENTROID, 5, ("a tangent plane", "flat spot", "pinched")),
    (CATMULL_CLARK, 5, ("a tangent plane", "pinched", "pinched")),
    (TRIANGLE_CENTROID, 4, ("a tangent plane", "pinched", "flat spot")),
    (LOOP, 6, ("a tangent plane", "bounded", "bounded")),
    (CATMULL_CLARK, 4, ("a tangent plane", "bounded", "bounded")),
])  # fmt: skip
def test_conditions_are_told_in_the_lectures_words(published, n, words):
    found = analysis(published, n)
    assert tuple(c.word for c in found.conditions) == words
    assert found.is_smooth == (words[0] != "a tip")
    assert found.conditions[1].holds == (words[1] in ("bounded", "flat spot"))


@valences
@pytest.mark.parametrize("published", [QUAD_CENTROID, TRIANGLE_CENTROID, LOOP], ids=lambda s: s.name)
def test_two_rings_of_the_characteristic_map_are_copied_at_lambda_and_neither_fold_nor_overlap(published, n):
    chart = characteristic_map(published, n)
    size = ring(published, n).subdominant
    finer = subdivide(chart.net, published, 1).points
    for copied in size * chart.net.points:
        assert np.abs(finer - copied).max(axis=1).min() < 1e-12
    assert chart.is_regular
    assert chart.is_one_to_one


def test_a_fold_is_seen():
    chart = characteristic_map(CATMULL_CLARK, 5)
    t, points = chart.sheet.topology, chart.sheet.points.copy()
    assert not type(chart)(chart.net, Mesh(t, points * [1, -1, 1]), chart.upright).is_one_to_one
    assert not type(chart)(chart.net, chart.sheet, -chart.upright).is_regular


# -- what a level counts --------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["cube", "plus-sign", "octahedron", "bipyramid", "duck", "torus"])
def test_extraordinary_vertices_stay_as_many_and_twice_as_far_apart(name):
    mesh = shapes.SHAPES[name]()
    s = QUAD_CENTROID if mesh.topology.is_quadrilateral else TRIANGLE_CENTROID
    levels = [counts(subdivide(mesh, s, k).topology) for k in range(4)]
    assert {c.euler for c in levels} == {levels[0].euler}
    assert {c.extraordinary for c in levels} == {levels[0].extraordinary}
    for before, after in pairwise(levels):
        assert after.apart == (None if before.apart is None else 2 * before.apart)


def test_the_distance_is_the_one_found_by_walking_from_every_extraordinary_vertex():
    t = subdivide(shapes.SHAPES["mug"](), CATMULL_CLARK, 1).topology
    beside = [set() for _ in range(t.n_vertices)]
    for a, b in t.ends.tolist():
        beside[a].add(b)
        beside[b].add(a)
    special = set(np.flatnonzero(t.extraordinary).tolist())
    least = None
    for v in special:
        seen, rim, far = {v}, {v}, 0
        while rim and not (rim & special - {v}):
            rim = {w for u in rim for w in beside[u]} - seen
            seen |= rim
            far += 1
        least = far if rim and (least is None or far < least) else least
    assert apart(t) == least


# -- transitions ----------------------------------------------------------------------------------


def lab(shape, family=None):
    state = bench.take(bench.enter(START), shape)
    return st.last(bench.choose_family(state, 0, family) if family else state)


def points(state):
    return state.now.lead.trace.points[-1]


@pytest.mark.parametrize(("shape", "family", "way"), [
    ("cube", "catmull-clark", Fraction(4, 3)), ("octahedron", "loop", Fraction(31, 24)),
    ("octahedron", "triangle-centroid", 1), ("tetrahedron", "loop-warren", Fraction(3, 2)),
])  # fmt: skip
def test_to_vary_the_vertex_rule_changes_nothing_at_first_and_then_the_surface_follows(shape, family, way):
    before = lab(shape, family)
    varied = bench.vary_vertex_rule(before)
    assert varied.lab.rules[0].values == (way,)
    assert np.abs(points(varied) - points(before)).max() < 1e-12
    assert st.level_of(varied) == st.level_of(before)
    pulled = bench.pull(varied, Fraction(1, 4))
    direct = subdivide(pulled.lab.control, scheme(pulled.lab.rules[0].family, (Fraction(1, 4),)), pulled.lab.levels)
    assert np.abs(points(pulled)[: len(direct.points)] - direct.points).max() < 1e-12
    assert st.level_of(pulled) == st.level_of(before)


def test_a_pull_that_is_no_fraction_is_taken_to_the_nearest_step():
    way, = bench.vary_vertex_rule(lab("icosahedron", "loop")).lab.rules[0].values
    assert abs(float(way) - float(TRIANGLE_PULLS.pull_of(LOOP, 5))) <= 1 / 32
    assert way.denominator in (1, 2, 4, 8, 16)


def test_what_has_no_pull_says_so_and_changes_nothing():
    with pytest.raises(TopologyError, match="no pull"):
        bench.pull(lab("cube"), Fraction(1))
    with pytest.raises(TopologyError, match="not told by how far"):
        bench.vary_vertex_rule(lab("cube", "doo-sabin"))
    assert pull_rule(DOO_SABIN) is None


def test_a_step_of_the_parameter_leads_from_between_to_the_next_whole_step():
    pull = FAMILIES["quad-pull"].parameters[0]
    assert [pull.next(Fraction(4, 3), by) for by in (1, -1)] == [Fraction(11, 8), Fraction(21, 16)]
    assert [pull.next(Fraction(1), by) for by in (1, -1, 40, -40)] == [Fraction(17, 16), Fraction(15, 16), 2, 0]


def test_the_valence_is_the_objects_own_then_the_one_chosen_then_that_of_the_vertex_pointed_at():
    state = lab("bipyramid")
    own = st.valence_of(state)
    t = state.lab.control.topology
    assert own in t.valence[t.extraordinary]
    assert st.valence_of(lab("torus")) == 4
    chosen = st.turn_valence(state, 3)
    assert st.valence_of(chosen) == own + 3
    v = int(t.valence.argmax())
    at = len(state.now.lead.trace.stages)
    pointing = st.look(chosen, st.Spot(0, at, v))
    assert st.valence_of(pointing) == t.valence[v]
    varied = bench.pull(bench.vary_vertex_rule(pointing), Fraction(1, 2))
    assert st.valence_of(varied) == t.valence[v]
    assert st.turn_valence(pointing, 1).focus is None
    assert [st.valence_of(st.turn_valence(state, by)) for by in (-99, 99)] == [3, 12]


def test_what_is_analysed_and_the_pull_are_kept():
    state = st.choose(bench.pull(bench.vary_vertex_rule(lab("cube")), Fraction(4, 3)), spectrum=True, valence=7)
    again = restored(kept(state))
    assert [getattr(again.options, f.name) for f in fields(st.Options)] == [
        getattr(state.options, f.name) for f in fields(st.Options)
    ]
    assert again.lab.rules == state.lab.rules


# -- pictures -------------------------------------------------------------------------------------


def panes(state):
    return [p.content for p in compose(state).panes if isinstance(p.content, Diagram)]


def test_eigenvalues_and_matrices_are_not_beside_the_picture_at_once():
    state = st.toggle(st.toggle(lab("cube"), "matrix"), "spectrum")
    assert (state.options.matrix, state.options.spectrum) == (False, True)
    assert st.toggle(state, "matrix").options.spectrum is False
    assert len(panes(state)) == 4


@families
@valences
def test_the_panes_show_the_numbers_of_the_engine(family, n):
    state = lab("cube" if family == "quad-pull" else "octahedron", family)
    state = bench.pull(st.choose(state, spectrum=True, valence=n), Fraction(7, 16))
    found = analysis(state.lab.rules[0].scheme, n)
    matrix, chart, values, table = panes(state)
    written = [note.text for note in values.notes]
    assert f"λ = {said(found.subdominant)}" in written
    assert f"λ² = {said(found.subdominant**2)}" in written
    assert ("C¹ holds" in written) == found.is_smooth
    places = sorted(k.x0 / 10 for k in values.links if k.width == 8)
    assert places == pytest.approx(sorted(e.value for e in found.eigenvalues), abs=1e-12)
    small = len(found.ring.names) <= 7
    cells = [box.texts[0] for box in matrix.boxes if box.texts[0]]
    expected = [str(s.weight(name)) for s in found.ring.stencils for name in found.ring.names]
    assert cells[2 * len(found.ring.names) :] == (expected if small else [])
    if not small:
        assert len(matrix.boxes) == 1 + np.count_nonzero(found.ring.matrix)
        assert in_words(found.ring.stencils[0], n) in [note.text for note in matrix.notes]
    heavy = [k for k in chart.links if k.width > 3]
    assert any(max(abs(k.x1 - 1), abs(k.y1)) < 1e-12 or max(abs(k.x0 - 1), abs(k.y0)) < 1e-12 for k in heavy)
    counted = [counts(state.now.lead.trace.topology_at(state.now.lead.trace.begins(k))) for k in range(3)]
    texts = [note.text for note in table.notes]
    for c in counted:
        assert f"{c.vertices}" in texts
        assert f"{c.apart} edge{'s' * (c.apart > 1)}" in texts


def test_schemes_without_a_ring_are_told_in_a_sentence():
    sentence, table = panes(st.choose(lab("cube", "doo-sabin"), spectrum=True))
    assert "Doo-Sabin" in sentence.notes[0].text
    assert table.notes
    (sentence,) = panes(st.choose(lab("hook"), spectrum=True))
    assert "no vertices of any valence" in sentence.notes[0].text


@pytest.mark.parametrize("name", ["cube", "octahedron", "plus-sign"])
def test_on_many_points_only_extraordinary_vertices_have_their_valence_written_at_every_level(name):
    state = st.choose(bench.set_levels(lab(name), 3), valences=True)
    for level in (2, 3):
        trace = state.now.lead.trace
        there = st.seek(state, next(s.end for s in st.segments(state.lesson) if s.level == level and s.ends_level))
        t = trace.topology_at(trace.begins(level))
        scenes = [p.content for p in compose(there).panes if isinstance(p.content, Scene)]
        texts = sorted(label.text for label in scenes[0].labels)
        assert texts == sorted(f"n={v}" for v in t.valence[t.extraordinary])

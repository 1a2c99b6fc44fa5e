"""Curvature of polygons: against the sphere, the torus and the plane; and what Gauss and Bonnet say of the sum."""

from dataclasses import replace

import numpy as np
import pytest

from subdivision import Mesh, shapes, trace
from subdivision.curvature import angle_defects, areas, gauss_curvature, mean_curvature, vertex_normals
from subdivision.rows import Grid
from subdivision.schemes import CATMULL_CLARK, LOOP

CLOSED = ("cube", "plus-sign", "torus", "duck", "mug", "tetrahedron", "icosahedron", "triangle-torus", "torus-net")
OPEN = ("quad-sheet", "triangle-fan", "net", "three-direction-net", "cylinder-net")


def fine(mesh, scheme, levels=4):
    told = trace(scheme, mesh, levels=levels)
    return told.mesh_at(len(told.stages))


def on_sphere(mesh, radius):
    """The mesh with its vertices moved straight onto a sphere."""
    return replace(mesh, points=radius * mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True))


def torus(n, big=2.0, small=0.7):
    """A torus net, its mean and its Gauss curvature, from the formulas of differential geometry."""
    u, v = (a.ravel() for a in np.meshgrid(*2 * [2 * np.pi * np.arange(n) / n], indexing="ij"))
    out = big + small * np.cos(v)
    points = np.stack([out * np.cos(u), out * np.sin(u), small * np.sin(v)], axis=1)
    gauss = np.cos(v) / (small * out)
    return Mesh(Grid(n, n, True, True), points), (big + 2 * small * np.cos(v)) / (2 * small * out), gauss


@pytest.mark.parametrize("name", [*CLOSED, *OPEN])
def test_the_angle_defects_sum_to_two_pi_chi(name):
    mesh = shapes.SHAPES[name]()
    bent = replace(mesh, points=mesh.points + 0.1 * np.sin(7 * mesh.points[:, ::-1]))
    assert abs(angle_defects(bent).sum() - 2 * np.pi * mesh.topology.euler) < 1e-9


@pytest.mark.parametrize(("mesh", "scheme"), [(shapes.cube(), CATMULL_CLARK), (shapes.icosahedron(), LOOP)])
def test_a_sphere_of_radius_2_has_mean_curvature_a_half_and_gauss_curvature_a_quarter(mesh, scheme):
    ball = on_sphere(fine(mesh, scheme), 2.0)
    assert np.abs(mean_curvature(ball) - 0.5).max() < 0.01
    assert abs(np.average(gauss_curvature(ball), weights=areas(ball)) - 0.25) < 1e-3
    assert np.abs(vertex_normals(ball) - ball.points / 2).max() < 0.01


def test_on_a_torus_the_error_falls_fourfold_when_the_net_is_twice_as_fine():
    errors = []
    for n in (24, 48, 96):
        mesh, mean, gauss = torus(n)
        errors.append((np.abs(mean_curvature(mesh) - mean).max(), np.abs(gauss_curvature(mesh) - gauss).max()))
    (a, b), (c, d), (e, f) = errors
    assert max(e, f) < 0.02
    assert min(a / c, c / e, b / d, d / f) > 3.5


def test_a_plane_has_no_curvature_inside_and_none_is_told_on_its_rim():
    sheet = shapes.SHAPES["quad-sheet"]()
    flat = replace(sheet, points=sheet.points * [1.0, 1.0, 0.0])
    rim = flat.surface.on_boundary
    for found in (mean_curvature(flat), gauss_curvature(flat)):
        assert np.isnan(found[rim]).all()
        assert np.abs(found[~rim]).max() < 1e-12


def test_turned_inside_out_the_mean_curvature_changes_its_sign_and_gauss_keeps_his():
    mesh, _, _ = torus(24)
    mirrored = replace(mesh, points=mesh.points * [1.0, 1.0, -1.0])
    assert np.abs(mean_curvature(mirrored) + mean_curvature(mesh)).max() < 1e-9
    assert np.abs(gauss_curvature(mirrored) - gauss_curvature(mesh)).max() < 1e-9


@pytest.mark.parametrize("name", ["tetrahedron", "icosahedron", "triangle-torus"])
def test_the_areas_of_the_vertices_sum_to_that_of_the_surface(name):
    mesh = shapes.SHAPES[name]()
    t, p = mesh.topology, mesh.points
    a, b, c = p[t.origin.reshape(-1, 3)].transpose(1, 0, 2)
    assert abs(areas(mesh).sum() - np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2) < 1e-12

"""Markers in VTK: one shape at many points, drawn by the graphics card from one small solid."""

from collections.abc import Callable, Sequence
from functools import cache, partial
from threading import get_ident
from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkGlyph3DMapper

from app.draw import vtk_arrays
from app.draw.geometry import facets
from app.draw.picture import Faces, Markers, Shape
from app.draw.solid import BEAD, CUBE, HALO_RADIUS, HIDDEN, MARKER_LIGHT, OCTAHEDRON, RING, RING_AXIS, across
from subdivision.arrays import Floats, Indices

LIFT = 3.0
"""How far markers are brought forward in the z-buffer, in radii of the largest."""


FINE, COARSE, HASTY = 32, 12, 4
"""Corners to the outline of a ball: where markers are few and large, where they are many and small, and where those
must follow the hand."""

QUICK, FEWEST, FAINTEST = 0.35, 6, 5
"""The part of these corners that there is while a processor draws what moves; at least so many; and so many at most
where markers are hidden."""

CAP, RIM = (50.0, 100.0), (38.0, 58.0, 78.0, 104.0)
"""Where the rings of corners of half a ball are, and of its rim, in degrees from its middle: the last a little beyond
the half, as most balls are not in the middle of the picture."""

CUT = 0.98
"""How large their outlines are, as flat triangles cut something off."""


def resolution(n: int, *, is_hasty: bool = False) -> int:
    """Corners to the outline of each of ``n`` markers: the graphics card's work grows slower than their number."""
    return int(np.clip(200 / np.sqrt(max(n, 1)), HASTY if is_hasty else COARSE, FINE))


class Glyphs:
    """All markers of one shape that are solid, or all that are translucent."""

    def __init__(self, shape: Shape, *, solid: bool) -> None:
        self.shape = shape
        self.data = vtkPolyData()
        self._caps = [_Cap()] if shape in (Shape.SPHERE, Shape.HALO) else []
        self._caps += [_Cap(HALO_RADIUS, rim=True)] if shape is Shape.HALO else []
        self.drawn = [_Instances(self.data, partial(_glyph, shape), translucent=not solid)]
        self.drawn += [_Instances(self.data, partial(_sphere, HALO_RADIUS), rim=True)] if shape is Shape.HALO else []
        self.faint = _Instances(self.data, partial(_glyph, shape), colour="faint", translucent=True)
        self._largest = 0.0
        self._corners, self._is_quick = FINE, False
        self._axes: Floats | None = None

    def join(self, renderer: Any, over: Any) -> None:
        for instances in self.drawn:
            renderer.AddViewProp(instances.actor)
        over.AddViewProp(self.faint.actor)

    def lift(self, depth: float, perspective: float) -> None:
        """Bring all forward by a little more than their size.

        ``depth`` is what a unit of space is in the z-buffer, at distance 1 in a perspective view;
        ``perspective`` is 0 in a parallel view, else 1.
        """
        for instances in self.drawn:
            if instances.actor.GetVisibility():
                instances.uniforms.SetUniformf("lift", LIFT * self._largest * depth)
                instances.uniforms.SetUniformf("perspective", perspective)

    def hasten(self, is_hasty: bool) -> None:
        """Draw each marker from fewer triangles."""
        self._is_quick = is_hasty
        self._model()

    def face(self, axes: Floats) -> None:
        """These are right, up and towards the eye, (3, 3)."""
        if axes is not self._axes:
            self._axes = axes
            self._model()

    def _model(self) -> None:
        if not self.faint.actor.GetVisibility():
            return  # there are none
        part = QUICK if self._is_quick else 1.0
        corners = min(self._corners, max(round(part * self._corners), FEWEST))
        if self._is_quick and self._axes is not None and self._caps:
            for instances, cap in zip(self.drawn, self._caps, strict=True):
                instances.show(cap.turned(corners, self._axes))
        else:
            for instances in self.drawn:
                instances.model(corners)
        self.faint.model(min(corners, FAINTEST if self._is_quick else COARSE))

    def show(self, markers: Sequence[Markers], *, solid: bool, is_hasty: bool = False) -> None:
        if not markers and not self.faint.actor.GetVisibility():
            return
        which = [(m.opacity >= 0.999) == solid for m in markers]
        n = sum(int(w.sum()) for w in which)
        for instances in (*self.drawn, self.faint):
            instances.actor.SetVisibility(n > 0)
        if n:
            points = [m.points[w] for m, w in zip(markers, which, strict=True)]
            radius = [m.radius[w] for m, w in zip(markers, which, strict=True)]
            colour = [vtk_arrays.rgba(m.colour, m.opacity[w]) for m, w in zip(markers, which, strict=True)]
            self._largest = max(float(r.max()) for r in radius if len(r))
            self._corners = resolution(n, is_hasty=is_hasty)
            self._model()
            self._fill(np.vstack(points), np.concatenate(radius), np.vstack(colour))

    def _fill(self, points: Floats, radius: Floats, colour: Floats) -> None:
        self.data.SetPoints(vtk_arrays.points(points))
        arrays = {
            "radius": vtk_arrays.array(radius),
            "colour": vtk_arrays.colours(colour),
            "faint": vtk_arrays.colours(colour * [1, 1, 1, HIDDEN]),
        }
        for name, array in arrays.items():
            array.SetName(name)
            self.data.GetPointData().AddArray(array)
        self.data.Modified()


class _Instances:
    """One shape at the points of some data, with the sizes and the ``colour`` these have there."""

    def __init__(
        self,
        data: Any,
        source: Callable[[int, int], Any],
        *,
        colour: str = "colour",
        translucent: bool = False,
        rim: bool = False,
    ) -> None:
        self.mapper, self.actor = vtkGlyph3DMapper(), vtkActor()
        self.mapper.SetInputData(data)
        self.source, self._shown = source, None
        self.model(FINE)
        self.mapper.SetScaleModeToScaleByMagnitude()
        self.mapper.SetScaleArray("radius")
        self.mapper.SetScalarModeToUsePointFieldData()
        self.mapper.SelectColorArray(colour)
        self.mapper.SetColorModeToDirectScalars()
        self.mapper.OrientOff()
        self.actor.SetMapper(self.mapper)
        self.actor.VisibilityOff()
        if translucent or rim:
            self.actor.ForceTranslucentOn()
        else:
            self.actor.ForceOpaqueOn()
        finish(self.actor, ambient=MARKER_LIGHT[0], diffuse=MARKER_LIGHT[1], specular=0.2)
        self.actor.GetProperty().BackfaceCullingOn()  # else the far side shines through the translucent ones
        if rim:
            _only_rim(self.actor)
        self.uniforms = _lifted(self.actor)

    def model(self, corners: int) -> None:
        """Draw each marker with so many corners to its outline."""
        self.show(self.source(corners, get_ident()))  # threads share no object of VTK's

    def show(self, solid: Any) -> None:
        """Draw each marker as this."""
        if solid is not self._shown:  # VTK would prepare the same one again
            self._shown = solid
            self.mapper.SetSourceData(solid)


class _Cap:
    """Of a ball the part that is seen, or of that the ``rim``: the same outline from a third of the triangles."""

    def __init__(self, radius: float = 1.0, *, rim: bool = False) -> None:
        self.data = vtkPolyData()
        self._radius, self._is_rim = radius, rim
        self._corners = 0
        self._axes: Floats | None = None

    def turned(self, corners: int, axes: Floats) -> Any:
        """With so many corners to its outline; ``axes`` are right, up and towards the eye."""
        normals, triangles = _cap(corners, rim=self._is_rim)
        if axes is not self._axes or corners != self._corners:
            turned = normals @ axes
            self.data.SetPoints(vtk_arrays.points(self._radius / CUT * turned))
            self.data.GetPointData().SetNormals(vtk_arrays.array(turned))
            self._axes = axes
        if corners != self._corners:
            self.data.SetPolys(vtk_arrays.cells(triangles))
            self._corners = corners
        return self.data


def finish(actor: Any, *, ambient: float, diffuse: float, specular: float) -> None:
    """How an actor answers light."""
    look = actor.GetProperty()
    look.SetInterpolationToPhong()
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)
    look.SetSpecularPower(24)


# -- marker shapes, each about as heavy as a ball of radius 1 -----------------------------------


@cache
def _glyph(shape: Shape, corners: int, thread: int) -> Any:
    """As ``thread`` has it."""
    if shape is Shape.DIAMOND:
        return _flat(OCTAHEDRON)
    if shape is Shape.CUBE:
        return _flat(CUBE)
    if shape is Shape.BEAD:
        both = vtkAppendPolyData()
        both.AddInputData(_sphere(BEAD, corners, thread))
        both.AddInputData(_torus(*RING, corners))
        both.Update()
        return both.GetOutput()
    return _sphere(1.0, corners, thread)


@cache
def _sphere(radius: float, corners: int, thread: int) -> Any:
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(corners)
    source.SetPhiResolution(2 * corners // 3)
    source.Update()
    return source.GetOutput()


@cache
def _cap(corners: int, *, rim: bool) -> tuple[Floats, Indices]:
    """Points of a ball of radius 1 about the last axis, which are its normals too, and the triangles between them.

    They are its middle and rings of corners; a ``rim`` is only what is between the rings.
    """
    polar, k = np.radians(RIM if rim else CAP), np.arange(corners)
    turns = 2 * np.pi * (k + 0.5 * np.arange(len(polar))[:, None]) / corners
    height, across = np.cos(polar)[:, None], np.sin(polar)[:, None]
    rings = np.stack(np.broadcast_arrays(across * np.cos(turns), across * np.sin(turns), height), axis=2)
    found = [] if rim else [np.stack([np.zeros_like(k), 1 + k, 1 + np.roll(k, -1)], axis=1)]
    for ring in range(len(polar) - 1):
        inner = 1 + ring * corners + k
        outer, ahead, beyond = inner + corners, np.roll(inner, -1), np.roll(inner, -1) + corners
        found += [np.stack([inner, outer, ahead], axis=1), np.stack([ahead, outer, beyond], axis=1)]
    return np.vstack([[0.0, 0.0, 1.0], rings.reshape(-1, 3)]), np.concatenate(found)


def _torus(radius: float, thickness: float, corners: int) -> Any:
    axis = RING_AXIS / np.linalg.norm(RING_AXIS)
    u, v = across(axis)
    n, m = 4 * corners // 3, max(corners // 3, 4)
    turns = np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m
    s, t = (x.ravel()[:, None] for x in np.meshgrid(*turns, indexing="ij"))
    out = np.cos(s) * u + np.sin(s) * v
    normal = np.cos(t) * out + np.sin(t) * axis
    k = np.arange(n * m).reshape(n, m)
    a, b, c, d = (x.ravel() for x in (k, np.roll(k, -1, 0), np.roll(k, (-1, -1), (0, 1)), np.roll(k, -1, 1)))
    return _poly(radius * out + thickness * normal, normal, np.vstack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def _flat(solid: Faces) -> Any:
    """A solid with flat sides."""
    cut = facets(solid)
    return _poly(cut.points, cut.normals, cut.triangles)


def _poly(points: Floats, normals: Floats, triangles: Indices) -> Any:
    data = vtkPolyData()
    data.SetPoints(vtk_arrays.points(points))
    data.GetPointData().SetNormals(vtk_arrays.array(normals))
    data.SetPolys(vtk_arrays.cells(triangles))
    return data


def _only_rim(actor: Any) -> None:
    """Of a sphere keep what is seen nearly edge on: a ring that faces the eye from everywhere."""
    actor.GetShaderProperty().AddFragmentShaderReplacement(
        "//VTK::Light::Impl", True,
        "//VTK::Light::Impl\n"
        "  vec3 toEye = mix(vec3(0.0, 0.0, 1.0), normalize(-vertexVCVSOutput.xyz), perspective);\n"
        "  float facing = abs(dot(normalize(normalVCVSOutput), toEye));\n"
        "  float rim = 1.0 - smoothstep(0.48, 0.56, facing);\n"
        "  if (rim < 0.02) discard;\n"
        "  fragOutput0 = vec4(ambientColor / max(ambientIntensity, 1e-3), opacity * rim * 0.85);\n",
        False,
    )  # fmt: skip


def _lifted(actor: Any) -> Any:
    """Draw an actor a little nearer than it is, so that the surface it lies on does not cut it in halves.

    What is twice as far has a fourth of the z-buffer for itself; ``gl_FragCoord.w`` is one over the distance.
    """
    look = actor.GetShaderProperty()
    look.AddFragmentShaderReplacement(
        "//VTK::Depth::Impl", True,
        "//VTK::Depth::Impl\n"
        "  gl_FragDepth = max(gl_FragCoord.z - lift * gl_FragCoord.w * gl_FragCoord.w, 0.0);\n",
        False,
    )  # fmt: skip
    uniforms = look.GetFragmentCustomUniforms()
    uniforms.SetUniformf("lift", 0.0)
    uniforms.SetUniformf("perspective", 0.0)
    return uniforms

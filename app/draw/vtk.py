"""A scene in any pyvista plotter, on the screen or off it: actors are made once and then only change.

No camera is reset and nothing is rendered here: one redraw a frame is the caller's.
Opaque markers are drawn a second time, faintly and over everything, so that a hidden point is
never quite gone; a second renderer does it, one layer above and with the same camera.
"""

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the classes below need its overrides)
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkGlyph3DMapper, vtkLight, vtkPolyDataMapper, vtkRenderer

from app.draw.geometry import dashes, facets
from app.draw.picture import Camera, Colour, Faces, Lines, Markers, Scene, Shape
from app.draw.primitives import Area
from app.draw.solid import (
    BEAD,
    CUBE,
    HALO_RADIUS,
    HIDDEN,
    LIGHTS,
    MARKER_LIGHT,
    OCTAHEDRON,
    RING,
    RING_AXIS,
    SURFACE_LIGHT,
    across,
    dash_of,
)  # fmt: skip
from subdivision.arrays import Floats, Indices

LIFT = 1.8
"""How far markers are brought forward in the z-buffer, in radii of the largest."""

SAMPLES = 8
"""Multisampling of stills."""


class ScenePainter:
    """Keeps one renderer of a plotter showing a scene.

    ``index`` is the renderer's number, or its row and column.
    """

    def __init__(self, plotter: Any, index: int | tuple[int, int] = 0) -> None:
        renderers = plotter.renderers
        number = index if isinstance(index, int) else int(renderers.loc_to_index(index))
        self.renderer = renderers[number]
        self.renderer.camera_set = True  # else pyvista moves the camera before its first picture
        self._window = plotter.render_window
        self._over = _layer_above(self.renderer, self._window)
        self._faces: list[_Surface] = []
        self._lines: list[_Strokes] = []
        self._markers = {(shape, solid): _Glyphs(shape, solid=solid) for shape in Shape for solid in (True, False)}
        for glyphs in self._markers.values():
            glyphs.join(self.renderer, self._over)
        for renderer in (self.renderer, self._over):
            _light(renderer)

    def paint(self, scene: Scene, height: float) -> None:
        """Show ``scene``; ``height`` in pixels is the whole picture's, so that strokes scale with it."""
        point = height / 1000
        self.renderer.SetUseDepthPeeling(any(f.opacity < 1 for f in scene.faces))
        for faces, surface in _pooled(scene.faces, self._faces, _Surface, self.renderer):
            surface.show(faces)
        for lines, strokes in _pooled(scene.lines, self._lines, _Strokes, self.renderer):
            strokes.show(dashes(lines, dash_of(scene.camera)) if lines.dashed else lines, lines.width * point)
        for (shape, solid), glyphs in self._markers.items():
            glyphs.show([m for m in scene.markers if m.shape is shape], solid=solid)
        self.clip(scene)

    def look(self, camera: Camera) -> None:
        """Stand where ``camera`` stands."""
        there = self.renderer.GetActiveCamera()
        there.SetPosition(*camera.position)
        there.SetFocalPoint(*camera.focal)
        there.SetViewUp(*camera.up)
        there.SetViewAngle(camera.angle)
        there.SetParallelProjection(camera.scale > 0)
        if camera.scale:
            there.SetParallelScale(camera.scale)
        self._over.SetActiveCamera(there)

    def clip(self, scene: Scene) -> None:
        """Near and far planes just round what is there."""
        points = [p.points for group in (scene.faces, scene.lines, scene.markers) for p in group if len(p.points)]
        if points:
            margin = 2.5 * max((float(m.radius.max()) for m in scene.markers if len(m.radius)), default=0.0)
            low = np.min([p.min(axis=0) for p in points], axis=0) - margin
            high = np.max([p.max(axis=0) for p in points], axis=0) + margin
            for renderer in (self.renderer, self._over):
                renderer.ResetCameraClippingRange(low[0], high[0], low[1], high[1], low[2], high[2])
            camera = self.renderer.GetActiveCamera()
            near, far = camera.GetClippingRange()
            for glyphs in self._markers.values():
                glyphs.lift(1 / (far - near), 1.0 - camera.GetParallelProjection())

    def place(self, area: Area, width: float, height: float) -> None:
        """Fill the pane ``area`` of a window of ``width`` by ``height`` pixels."""
        x, y, w, h = area
        for renderer in (self.renderer, self._over):
            renderer.SetViewport(x / width, 1 - (y + h) / height, (x + w) / width, 1 - y / height)
            renderer.DrawOn()

    def hide(self) -> None:
        """Show nothing, not even a background, until the painter is placed again."""
        for renderer in (self.renderer, self._over):
            renderer.SetViewport(0, 0, 0, 0)
            renderer.DrawOff()

    def background(self, colour: Colour) -> None:
        self.renderer.SetBackground(*colour)
        self.renderer.GradientBackgroundOff()

    def close(self) -> None:
        """Take the layer above out of the window; to be called before the plotter is closed."""
        self._window.RemoveRenderer(self._over)
        self._over.RemoveAllViewProps()


def camera_of(renderer: Any) -> Camera:
    """Where a renderer is seen from now, for instance after the user has turned it."""
    there = renderer.GetActiveCamera()
    return Camera(
        np.array(there.GetPosition()), np.array(there.GetFocalPoint()), np.array(there.GetViewUp()),
        float(there.GetViewAngle()), float(there.GetParallelScale()) if there.GetParallelProjection() else 0.0,
    )  # fmt: skip


# -- what is in a renderer --------------------------------------------------------------------


class _Surface:
    """Polygons: quiet, lit on both sides, and pushed back a little so that edges lie on them."""

    def __init__(self, renderer: Any) -> None:
        self.data, self.mapper, self.actor = vtkPolyData(), vtkPolyDataMapper(), vtkActor()
        self.mapper.SetInputData(self.data)
        self.mapper.ScalarVisibilityOff()
        self.mapper.SetResolveCoincidentTopologyToPolygonOffset()
        self.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 4.0)
        self.actor.SetMapper(self.mapper)
        _finish(self.actor, ambient=SURFACE_LIGHT[0], diffuse=SURFACE_LIGHT[1], specular=0.0)
        renderer.AddViewProp(self.actor)

    def show(self, faces: Faces) -> None:
        cut = facets(faces)
        self.data.SetPoints(_points(cut.points))
        self.data.GetPointData().SetNormals(_array(cut.normals))
        self.data.SetPolys(_cells(cut.triangles))
        self.actor.GetProperty().SetColor(*faces.colour)
        self.actor.GetProperty().SetOpacity(faces.opacity)


class _Strokes:
    """Straight lines of one width and colour, without light."""

    def __init__(self, renderer: Any) -> None:
        self.data, self.mapper, self.actor = vtkPolyData(), vtkPolyDataMapper(), vtkActor()
        self.mapper.SetInputData(self.data)
        self.mapper.ScalarVisibilityOff()
        self.actor.SetMapper(self.mapper)
        self.actor.GetProperty().LightingOff()
        renderer.AddViewProp(self.actor)

    def show(self, lines: Lines, pixels: float) -> None:
        self.data.SetPoints(_points(lines.points))
        self.data.SetLines(_cells(lines.pairs))
        look = self.actor.GetProperty()
        look.SetColor(*lines.colour)
        look.SetOpacity(lines.opacity)
        look.SetLineWidth(max(pixels, 1.0))


class _Glyphs:
    """All markers of one shape that are solid, or all that are translucent."""

    def __init__(self, shape: Shape, *, solid: bool) -> None:
        self.shape = shape
        self.drawn = [_Instances(_glyph(shape), translucent=not solid)]
        self.drawn += [_Instances(_sphere(HALO_RADIUS, 56), rim=True)] if shape is Shape.HALO else []
        self.faint = _Instances(_glyph(shape), translucent=True)
        self._largest = 0.0

    def join(self, renderer: Any, over: Any) -> None:
        for instances in self.drawn:
            renderer.AddViewProp(instances.actor)
        over.AddViewProp(self.faint.actor)

    def lift(self, depth: float, perspective: float) -> None:
        """Bring all forward by a little more than their size.

        ``depth`` is what a unit of space is in the z-buffer; ``perspective`` is 0 in a parallel view, else 1.
        """
        for instances in self.drawn:
            instances.uniforms.SetUniformf("lift", LIFT * self._largest * depth)
            instances.uniforms.SetUniformf("perspective", perspective)

    def show(self, markers: Sequence[Markers], *, solid: bool) -> None:
        which = [(m.opacity >= 0.999) == solid for m in markers]
        points = [m.points[w] for m, w in zip(markers, which, strict=True)]
        radius = [m.radius[w] for m, w in zip(markers, which, strict=True)]
        colour = [_rgba(m.colour, m.opacity[w]) for m, w in zip(markers, which, strict=True)]
        some = sum(map(len, points)) > 0
        self._largest = max((float(r.max()) for r in radius if len(r)), default=0.0)
        for instances in (*self.drawn, self.faint):
            instances.actor.SetVisibility(some)
            if some:
                faint = HIDDEN if instances is self.faint else 1.0
                instances.show(np.vstack(points), np.concatenate(radius), np.vstack(colour) * [1, 1, 1, faint])


class _Instances:
    """One shape at many points, each with its size and colour."""

    def __init__(self, source: Any, *, translucent: bool = False, rim: bool = False) -> None:
        self.data, self.mapper, self.actor = vtkPolyData(), vtkGlyph3DMapper(), vtkActor()
        self.mapper.SetInputData(self.data)
        self.mapper.SetSourceData(source)
        self.mapper.SetScaleModeToScaleByMagnitude()
        self.mapper.SetScaleArray("radius")
        self.mapper.SetScalarModeToUsePointFieldData()
        self.mapper.SelectColorArray("colour")
        self.mapper.SetColorModeToDirectScalars()
        self.mapper.OrientOff()
        self.actor.SetMapper(self.mapper)
        self.actor.VisibilityOff()
        if translucent or rim:
            self.actor.ForceTranslucentOn()
        else:
            self.actor.ForceOpaqueOn()
        _finish(self.actor, ambient=MARKER_LIGHT[0], diffuse=MARKER_LIGHT[1], specular=0.2)
        self.actor.GetProperty().BackfaceCullingOn()  # else the far side shines through the translucent ones
        if rim:
            _only_rim(self.actor)
        self.uniforms = _lifted(self.actor)

    def show(self, points: Floats, radius: Floats, colour: Floats) -> None:
        self.data.SetPoints(_points(points))
        for name, array in (("radius", _array(radius)), ("colour", _bytes(colour))):
            array.SetName(name)
            self.data.GetPointData().AddArray(array)
        self.data.Modified()


def _pooled(wanted: Sequence[Any], pool: list[Any], make: Any, renderer: Any) -> list[tuple[Any, Any]]:
    """Every wanted part with an actor of its own; actors are made when they are first needed and hidden when not."""
    pool.extend(make(renderer) for _ in range(len(wanted) - len(pool)))
    for k, item in enumerate(pool):
        item.actor.SetVisibility(k < len(wanted))
    return list(zip(wanted, pool, strict=False))


def _layer_above(renderer: Any, window: Any) -> Any:
    over = vtkRenderer()
    over.SetLayer(1)
    over.InteractiveOff()
    over.SetActiveCamera(renderer.GetActiveCamera())
    over.SetViewport(renderer.GetViewport())
    window.SetNumberOfLayers(max(2, window.GetNumberOfLayers()))
    window.AddRenderer(over)
    return over


def _light(renderer: Any) -> None:
    """A soft light over the left shoulder and a weak one from the right below; both go with the camera."""
    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    for position, intensity in LIGHTS:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(intensity)
        renderer.AddLight(light)


def _finish(actor: Any, *, ambient: float, diffuse: float, specular: float) -> None:
    look = actor.GetProperty()
    look.SetInterpolationToPhong()
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)
    look.SetSpecularPower(24)


# -- marker shapes, each about as heavy as a ball of radius 1 -----------------------------------


@cache
def _glyph(shape: Shape) -> Any:
    if shape is Shape.DIAMOND:
        return _flat(OCTAHEDRON)
    if shape is Shape.CUBE:
        return _flat(CUBE)
    if shape is Shape.BEAD:
        both = vtkAppendPolyData()
        both.AddInputData(_sphere(BEAD))
        both.AddInputData(_torus(*RING))
        both.Update()
        return both.GetOutput()
    return _sphere(1.0)


def _sphere(radius: float, resolution: int = 28) -> Any:
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(2 * resolution // 3)
    source.Update()
    return source.GetOutput()


def _torus(radius: float, thickness: float) -> Any:
    axis = RING_AXIS / np.linalg.norm(RING_AXIS)
    u, v = across(axis)
    n, m = 40, 10
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
    data.SetPoints(_points(points))
    data.GetPointData().SetNormals(_array(normals))
    data.SetPolys(_cells(triangles))
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
    """Draw an actor a little nearer than it is, so that the surface it lies on does not cut it in halves."""
    look = actor.GetShaderProperty()
    look.AddFragmentShaderReplacement(
        "//VTK::Depth::Impl", True, "//VTK::Depth::Impl\n  gl_FragDepth = max(gl_FragCoord.z - lift, 0.0);\n", False
    )
    uniforms = look.GetFragmentCustomUniforms()
    uniforms.SetUniformf("lift", 0.0)
    uniforms.SetUniformf("perspective", 0.0)
    return uniforms


# -- numpy to VTK, copied so that nothing dangles ----------------------------------------------

_to_vtk: Any = numpy_support.numpy_to_vtk
_to_ids: Any = numpy_support.numpy_to_vtkIdTypeArray


def _array(values: Floats) -> Any:
    return _to_vtk(np.ascontiguousarray(values, dtype=np.float32), deep=True)


def _bytes(colour: Floats) -> Any:
    return _to_vtk(np.ascontiguousarray(np.round(np.clip(colour, 0, 1) * 255), dtype=np.uint8), deep=True)


def _points(points: Floats) -> Any:
    held = vtkPoints()
    held.SetData(_array(points))
    return held


def _cells(rows: Indices) -> Any:
    """Lines or triangles of (n, 2) or (n, 3) point numbers."""
    n, size = rows.shape
    cells = vtkCellArray()
    cells.SetData(
        _to_ids(np.arange(0, (n + 1) * size, size, dtype=np.int64), deep=True),
        _to_ids(np.ascontiguousarray(rows, dtype=np.int64).ravel(), deep=True),
    )
    return cells


def _rgba(colour: Colour, opacity: Floats) -> Floats:
    return np.column_stack([np.tile(colour, (len(opacity), 1)), opacity])

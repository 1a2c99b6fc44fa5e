"""A scene in any pyvista plotter, on the screen or off it: actors are made once and then only change.

No camera is reset and nothing is rendered here: one redraw a frame is the caller's.
Opaque markers are drawn a second time, faintly and over everything, so that a hidden point is
never quite gone; a second renderer does it, one layer above and with the same camera.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the classes below need its overrides)
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

from app.draw import vtk_arrays
from app.draw.geometry import dashes, facets, is_outward, shells, worn
from app.draw.glow import glow
from app.draw.glyphs import Glyphs, finish
from app.draw.picture import Camera, Colour, Faces, Lines, Scene, Shape
from app.draw.primitives import Area
from app.draw.regular import Facets
from app.draw.solid import (
    LIGHTS,
    SURFACE_LIGHT,
    dash_of,
)  # fmt: skip
from subdivision.arrays import Floats, Indices

NEAR = 0.05
"""A surface that begins so far from the camera, compared with where it ends, is in front of all that is cut off."""

LIT = 2000
"""Points of a surface up to which light at its corners is sooner worked out here than by who draws it."""


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
        self._is_hasty = self._is_translucent = False
        self._middle = 0.0, 0.0
        self._faces: list[_Surface] = []
        self._lines: list[_Strokes] = []
        self._markers = {(shape, solid): Glyphs(shape, solid=solid) for shape in Shape for solid in (True, False)}
        for glyphs in self._markers.values():
            glyphs.join(self.renderer, self._over)
        for renderer in (self.renderer, self._over):
            _light(renderer)
            renderer.SetClippingRangeExpansion(0.01)  # VTK's own half brings the near plane to the eye

    def paint(self, scene: Scene, height: float) -> None:
        """Show ``scene``; ``height`` in pixels is the whole picture's, so that strokes scale with it."""
        point = height / 1000
        if self._is_translucent and not scene.is_translucent:
            for renderer in (self.renderer, self._over):
                renderer.ReleaseGraphicsResources(self._window)  # blending keeps a dozen pictures as large as this one
        self._is_translucent = scene.is_translucent
        self._blend()
        for faces, surface in _pooled(scene.faces, self._faces, _Surface, self.renderer):
            surface.hasten(self._is_hasty)
            surface.show(faces, is_hasty=scene.is_hasty)
        for lines, strokes in _pooled(scene.lines, self._lines, _Strokes, self.renderer):
            strokes.show(dashes(lines, dash_of(scene.camera)) if lines.dashed else lines, lines.width * point)
        wanted = {shape: [m for m in scene.markers if m.shape is shape] for shape in {m.shape for m in scene.markers}}
        for (shape, solid), glyphs in self._markers.items():
            glyphs.show(wanted.get(shape, ()), solid=solid, is_hasty=scene.is_hasty)

    def look(self, camera: Camera, window: tuple[float, float, float] = (0.0, 0.0, 1.0)) -> None:
        """Stand where ``camera`` stands.

        Through a ``window`` only a part of the view is seen, of that part of its height; the window's middle is
        right and up from the view's, in halves of the window.
        """
        right, above, part = window
        there = self.renderer.GetActiveCamera()
        self._middle = right, above
        there.SetWindowCenter(right, above)
        there.SetPosition(*camera.position)
        there.SetFocalPoint(*camera.focal)
        there.SetViewUp(*camera.up)
        there.SetViewAngle(np.degrees(2 * np.arctan(part * np.tan(np.radians(camera.angle) / 2))))
        there.SetParallelProjection(camera.scale > 0)
        if camera.scale:
            there.SetParallelScale(part * camera.scale)
        self._over.SetActiveCamera(there)
        for surface in self._faces:
            surface.light(camera)
        for glyphs in self._markers.values():
            glyphs.face(camera.axes)

    def nudge(self, right: float, up: float) -> None:
        """Everything is so many pixels further right and up than it is where the camera stands."""
        wide, tall = (max(side, 1) for side in self.renderer.GetSize())
        across, above = self._middle
        self.renderer.GetActiveCamera().SetWindowCenter(across - 2 * right / wide, above - 2 * up / tall)

    def clip(self, scene: Scene) -> None:
        """Near and far planes just round what is there."""
        points = [p.points for group in (scene.faces, scene.lines, scene.markers) for p in group if len(p.points)]
        if points:
            margin = 2.5 * max((float(m.radius.max()) for m in scene.markers if len(m.radius)), default=0.0)
            every = np.concatenate(points)
            low, high = every.min(axis=0) - margin, every.max(axis=0) + margin
            for renderer in (self.renderer, self._over):
                renderer.ResetCameraClippingRange(low[0], high[0], low[1], high[1], low[2], high[2])
            camera = self.renderer.GetActiveCamera()
            near, far = camera.GetClippingRange()
            parallel = camera.GetParallelProjection()
            for glyphs in self._markers.values():
                glyphs.lift((1.0 if parallel else near * far) / (far - near), 1.0 - parallel)

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

    def hasten(self, is_hasty: bool) -> None:
        """Draw quickly what moves.

        Markers have fewer triangles, light on small surfaces is worked out at corners only, and of closed ones the far
        side is left out.
        """
        self._is_hasty = is_hasty
        self._blend()
        for glyphs in self._markers.values():
            glyphs.hasten(is_hasty)
        for surface in self._faces:
            surface.hasten(is_hasty)

    def _blend(self) -> None:
        """Blend translucent surfaces from the back to the front, or, as VTK must with several samples, by weight.

        What else is translucent is drawn as it comes: by weight it would be jagged, and take long.
        """
        is_single = self._window.GetMultiSamples() == 0
        self.renderer.SetUseDepthPeeling(self._is_translucent and is_single)
        for renderer in (self.renderer, self._over):
            renderer.SetUseOIT(self._is_translucent and not is_single)

    def background(self, colour: Colour) -> None:
        self.renderer.SetBackground(*colour)
        self.renderer.GradientBackgroundOff()

    def close(self) -> None:
        """Take the layer above out of the window; to be called before the plotter is closed."""
        self._window.RemoveRenderer(self._over)
        self._over.RemoveAllViewProps()


# -- what is in a renderer --------------------------------------------------------------------


class _Surface:
    """Polygons: quiet, lit on both sides, and pushed back a little so that edges lie on them."""

    def __init__(self, renderer: Any) -> None:
        self.data, self.mapper, self.actor = vtkPolyData(), vtkPolyDataMapper(), vtkActor()
        self.mapper.SetInputData(self.data)
        self.mapper.SetColorModeToDirectScalars()
        self.mapper.SetResolveCoincidentTopologyToPolygonOffset()
        self.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 4.0)
        self.actor.SetMapper(self.mapper)
        self._shown: Facets | None = None
        self._cut: Indices | None = None
        self._faces: Faces | None = None
        self._known: Faces | None = None
        self._shells: Indices | None = None
        self._is_outward: bool | None = None
        self._colours: Floats | None = None
        self._camera: Camera | None = None
        self._is_hasty = False
        finish(self.actor, ambient=SURFACE_LIGHT[0], diffuse=SURFACE_LIGHT[1], specular=0.0)
        renderer.AddViewProp(self.actor)

    def show(self, faces: Faces, *, is_hasty: bool) -> None:
        cut = facets(faces, is_hasty=is_hasty)
        if cut is not self._shown:
            self._shown, self._is_outward = cut, None
            self.data.SetPoints(vtk_arrays.points(cut.points))
            self.data.GetPointData().SetNormals(vtk_arrays.array(cut.normals))
        if cut.triangles is not self._cut:
            self._cut = cut.triangles
            self.data.SetPolys(vtk_arrays.cells(cut.triangles))
        self._faces = faces
        self._colours = worn(faces, cut)
        self.actor.GetProperty().SetColor(*faces.colour)
        self.actor.GetProperty().SetOpacity(faces.opacity)
        if not self._is_hasty:
            self._dress()

    def hasten(self, is_hasty: bool) -> None:
        """Work out the light at corners only, and leave out sides that nobody can see."""
        if is_hasty != self._is_hasty:
            self._is_hasty = is_hasty
            self._dress()

    def light(self, camera: Camera) -> None:
        """The surface is seen by this camera."""
        self._camera = camera
        if self._is_hasty:
            self._dress()

    def _dress(self) -> None:
        look, colours, is_lit = self.actor.GetProperty(), self._colours, True
        if self._is_hasty and self._camera is not None and self._shown is not None and len(self._shown.points) <= LIT:
            plain = np.array(look.GetColor()) if colours is None else colours
            colours, is_lit = plain * glow(self._shown, self._camera)[:, None], False
        ambient, diffuse = SURFACE_LIGHT if is_lit else (0.0, 1.0)
        look.SetBackfaceCulling(self._is_hasty and self._hides_its_back())
        look.SetLighting(is_lit)
        look.SetAmbient(ambient)
        look.SetDiffuse(diffuse)
        self.mapper.SetScalarVisibility(colours is not None)
        self.data.GetPointData().SetScalars(None if colours is None else vtk_arrays.colours(colours))

    def _hides_its_back(self) -> bool:
        """Whether it is a closed surface seen from outside, and nothing shines through."""
        faces, cut, camera = self._faces, self._shown, self._camera
        if faces is None or cut is None or camera is None or faces.opacity < 1:
            return False
        if self._known is None or not _are_alike(faces, self._known):
            self._known, self._shells, self._is_outward = faces, shells(faces), None
        if self._shells is None:
            return False
        if self._is_outward is None:
            self._is_outward = is_outward(cut, self._shells)
        depth = (camera.position - cut.points) @ camera.axes[2]
        return self._is_outward and bool(camera.scale > 0 or depth.min() > NEAR * depth.max())


def _are_alike(faces: Faces, others: Faces) -> bool:
    """Whether they have the same polygons, wherever these are."""
    pairs = (faces.corners, others.corners), (faces.sizes, others.sizes)
    return len(faces.points) == len(others.points) and all(a is b or np.array_equal(a, b) for a, b in pairs)


class _Strokes:
    """Straight lines of one width and colour, without light."""

    def __init__(self, renderer: Any) -> None:
        self.data, self.mapper, self.actor = vtkPolyData(), vtkPolyDataMapper(), vtkActor()
        self.mapper.SetInputData(self.data)
        self.mapper.ScalarVisibilityOff()
        self.actor.SetMapper(self.mapper)
        self.actor.GetProperty().LightingOff()
        self._points: Floats | None = None
        self._pairs: Indices | None = None
        renderer.AddViewProp(self.actor)

    def show(self, lines: Lines, pixels: float) -> None:
        points, pairs = _needed(lines)
        if self._points is None or not np.array_equal(self._points, points):
            self._points = points
            self.data.SetPoints(vtk_arrays.points(points))
        if self._pairs is None or not np.array_equal(self._pairs, pairs):
            self._pairs = pairs
            self.data.SetLines(vtk_arrays.cells(pairs))
        look = self.actor.GetProperty()
        look.SetColor(*lines.colour)
        look.SetOpacity(lines.opacity)
        look.SetLineWidth(max(pixels, 1.0))


def _needed(lines: Lines) -> tuple[Floats, Indices]:
    """Points and pairs; where few strokes have many points, only those that they need."""
    if 4 * len(lines.pairs) > len(lines.points):
        return lines.points, lines.pairs
    used, pairs = np.unique(lines.pairs, return_inverse=True)
    return lines.points[used], pairs.reshape(-1, 2)


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

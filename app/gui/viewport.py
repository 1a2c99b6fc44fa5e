"""The picture in the window: panes in space painted by VTK, everything flat painted over them by Qt.

It contains a ``QtInteractor`` and sees all its input first.  VTK gets none of it: the hand turns a
``Turn``, a value, so no hot key can fire and all panes stay linked.
"""

from typing import Any

from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QWidget

from app.asking import is_open, predict
from app.draw.compose import is_heavy
from app.draw.fading import faded
from app.draw.labels import Kept
from app.draw.layout import fitted, overlay, pane_areas, part_at
from app.draw.picture import Box, Camera, Colour, Picture, Scene
from app.draw.primitives import Area
from app.draw.seen import from_there
from app.draw.selected import is_pickable
from app.draw.turned import turned
from app.gui.flat import Flat
from app.gui.grip import AXES, Grip
from app.gui.lens import MAGNIFICATION, WHOLE, enlarged, window, within
from app.gui.look import colour
from app.gui.narration import Narration
from app.gui.opengl import is_software
from app.gui.pointer import Pointer
from app.gui.pointing import nearest, part
from app.gui.predicting import predicted
from app.gui.session import Session
from app.laboratory import bench
from app.laboratory.editing import extended
from app.state import Picked, Spot, State, drag, is_dragged_only, is_turned_only, look, pick, put_back, turn_view
from app.words import tr
from lessons.turn import REST, Turn

PANES = 6
"""How many panes the viewport has renderers for."""

CALM = 160
"""Milliseconds without change after which a software-drawn picture is smoothed."""

STILL = 100
"""Milliseconds without a move after which a surface too heavy to follow the hand is drawn in full."""

PAUSE = 500
"""Milliseconds without the wheel after which zooming on is another change."""

SAMPLES = 8
"""How many a graphics card takes of each pixel; a processor that does its work half of them."""

TRACK = 4.0
"""Pixels: a press that moves less is a click."""


class Viewport(QWidget):
    """Shows ``faded(state)``; the mouse turns it and points at its points."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.setAccessibleName(tr("Picture"))
        self.setMinimumSize(320, 240)
        self._session = session
        self._state = session.state
        self._made: Picture = faded(session.state)
        self._press: QPointF | None = None
        self._last = QPointF()
        self._kept = Kept()
        self._cleared: Colour | None = None
        self._is_drag = self._is_pinned = False
        self._grip: Grip | None = None
        self._axis: int | None = None
        self._target = QPointF()
        self._lens: QPointF | None = None
        self._plotter: Any = None
        self._painters: list[Any] = []
        self._is_soft = is_software()
        self.canvas: Any = QWidget(self) if self._is_soft else QOpenGLWidget(self)
        self._flat = Flat(self, self._draw)
        self._is_stale = self._is_hasty = False
        self._drawn_at: tuple[int, bool] | None = None
        self.narration = Narration(session, self)
        self.pointer = Pointer(self)
        self._calm = QTimer(self, singleShot=True, interval=CALM)
        self._calm.timeout.connect(self._smooth)
        self._still = QTimer(self, singleShot=True, interval=STILL)
        self._still.timeout.connect(self._show_in_full)
        self._pause = QTimer(self, singleShot=True, interval=PAUSE)
        self._pause.timeout.connect(session.let_go)
        self._later = QTimer(self, singleShot=True, interval=0)
        self._later.timeout.connect(self._catch_up)
        self._pull = QTimer(self, singleShot=True, interval=0)  # one move a picture, however many the mouse sends
        self._pull.timeout.connect(self._pulled)

    # -- life -----------------------------------------------------------------------------------

    def start(self) -> None:
        """Bring up VTK: before the window is shown, so that its first picture is whole."""
        from pyvistaqt import QtInteractor

        from app.draw.vtk import ScenePainter
        from app.gui.canvas import Canvas

        self._plotter = QtInteractor(
            None if self._is_soft else self,
            auto_update=False, multi_samples=0 if self._is_soft else SAMPLES, shape=(1, PANES + 1), border=False,
            lighting="none",
        )  # fmt: skip
        self._plotter.setAcceptDrops(False)
        self._painters = [ScenePainter(self._plotter, 1 + k) for k in range(PANES)]
        self._plotter.renderers[0].SetViewport(0, 0, 1, 1)  # clears what no pane covers
        self._put_up(Canvas(self, self._plotter, self._nudge, self._flat.renew) if self._is_soft else self._plotter)
        self.show_state(self._state)

    def _put_up(self, canvas: QWidget) -> None:
        """Show the picture in space here from now on, and take its input."""
        waiting, self.canvas = self.canvas, canvas
        canvas.setAccessibleName(tr("Picture"))
        canvas.installEventFilter(self)
        canvas.setGeometry(self.rect())
        canvas.show()
        canvas.lower()
        waiting.hide()
        waiting.deleteLater()

    def close_vtk(self) -> None:
        """Give everything back, in the order VTK needs."""
        self.stay()
        if self._plotter is not None:
            self.canvas.removeEventFilter(self)
            for each in self._painters:
                each.close()
            self._painters = []
            self._plotter.close()
            if self._plotter.isValid():  # it would keep the address of a surface, and what comes there be taken for one
                self._plotter.context().aboutToBeDestroyed.emit()
            self._plotter.deleteLater()
            self._plotter = None

    def stay(self) -> None:
        """Let the picture become no better than it is."""
        self._calm.stop()
        self._still.stop()
        if self._is_soft and self._plotter is not None:
            self.canvas.stop()

    # -- showing --------------------------------------------------------------------------------

    def show_state(self, state: State) -> None:
        before, self._state = self._state, state
        self.pointer.obey(state.options)
        if state.focus is None:
            self._is_pinned = False
        if state.lesson is not before.lesson and self._plotter is not None:
            self.setUpdatesEnabled(False)
            self._later.start()
        elif self._later.isActive():
            return  # this state is shown then
        elif is_turned_only(before, state):
            self._look_again()
        else:
            self._show(is_hasty=is_dragged_only(before, state) and is_heavy(state))

    def _show(self, *, is_hasty: bool) -> None:
        self._compose(is_hasty=is_hasty)
        self.narration.show_state(self._state)
        self._arrange()
        self._paint_scenes()

    def _catch_up(self) -> None:
        """Show the state of the moment: a lesson's first one has a turn of the event loop of its own."""
        self._later.stop()
        try:
            self._show(is_hasty=False)
        finally:
            self.setUpdatesEnabled(True)

    @property
    def _picture(self) -> Picture:
        """The picture of the state."""
        if self._later.isActive():
            self._catch_up()
        return self._made

    def _compose(self, *, is_hasty: bool) -> None:
        """The picture of the state; one made in haste lasts until the hand rests."""
        self._made, self._is_hasty = faded(self._state, is_hasty=is_hasty), is_hasty
        if is_hasty:
            self._still.start()
        else:
            self._still.stop()

    def _show_in_full(self) -> None:
        """The hand rests."""
        if self._is_hasty:
            self._compose(is_hasty=False)
            self._paint_scenes()

    def reset_camera(self) -> None:
        """Stand where the lesson stands."""
        self._session.let_go()
        self._turned(REST)
        self._session.let_go()

    @property
    def is_magnified(self) -> bool:
        """Whether the magnifier is over the picture."""
        return self._lens is not None

    def toggle_magnifier(self) -> None:
        """Everything larger about the mouse, or as it was; what is under the mouse stays there."""
        self._lens = None if self.is_magnified else self.pointer.at or QPointF(self.width() / 2, self._tall() / 2)
        self._paint_scenes()

    def areas(self) -> list[Area]:
        """Where the panes are, in pixels of this widget."""
        return pane_areas(self._picture, self.width(), self._tall(), words=False)

    def cameras(self) -> list[Camera | None]:
        """From where each pane is seen now."""
        return [
            turned(fitted(pane.content.camera, area), self._state.turn) if isinstance(pane.content, Scene) else None
            for pane, area in zip(self._picture.panes, self.areas(), strict=True)
        ]

    def picture(self) -> Picture:
        """The picture as it is seen now: from where the hand has turned it."""
        return from_there(self._picture, self._state.turn)

    def room(self) -> tuple[float, float]:
        """Width and height of the picture, the caption left out."""
        return float(self.width()), self._tall()

    def _tall(self) -> float:
        return float(max(self.height() - self.narration.height(), 1))

    def _arrange(self) -> None:
        tall = self.narration.height_for(self.width(), self.window().height())
        self.narration.setGeometry(0, self.height() - tall, self.width(), tall)
        self._flat.setGeometry(self.rect())
        self.pointer.setGeometry(self.rect())
        self.canvas.setGeometry(self.rect())

    def _paint_scenes(self) -> None:
        if self._plotter is not None:
            self._paint_panes()
        self._redraw()

    def _paint_panes(self) -> None:
        if self._cleared != self._picture.background:
            self._cleared = self._picture.background
            self._plotter.set_background(self._cleared)
        shown = self._shown()
        height = self._tall() * self.devicePixelRatioF() * (MAGNIFICATION if self.is_magnified else 1.0)
        for painter, (content, area, camera) in zip(self._painters, shown, strict=False):
            painter.paint(content, height)
            painter.background(self._picture.background)
            self._aim(painter, content, area, camera)
        for painter in self._painters[len(shown) :]:
            painter.hide()

    def _shown(self) -> list[tuple[Scene, Area, Camera]]:
        """The scenes, where they are, and from where they are seen."""
        panes = zip(self._picture.panes, self.areas(), self.cameras(), strict=True)
        return [
            (pane.content, area, camera)
            for pane, area, camera in panes
            if isinstance(pane.content, Scene) and camera is not None
        ]

    def _aim(self, painter: Any, content: Scene, area: Area, camera: Camera) -> None:
        """Look at a scene in its place, through the magnifier if it is there."""
        seen: Area | None = area
        through = WHOLE
        if self._lens is not None:
            large = enlarged(area, self._lens.x(), self._lens.y())
            seen = within(large, self.width(), self._tall())
            through = window(large, seen) if seen is not None else WHOLE
        if seen is None:
            painter.hide()
            return
        painter.place(seen, self.width(), self.height())
        painter.look(camera, through)
        painter.clip(content)

    def _turned(self, turn: Turn) -> None:
        self._session.do(turn_view, turn)

    def _look_again(self) -> None:
        """The same scenes from where the hand has turned them."""
        for painter, (content, area, camera) in zip(self._painters, self._shown(), strict=False):
            self._aim(painter, content, area, camera)
        self._redraw()

    def _redraw(self) -> None:
        """One redraw; without smoothing while things change, where a picture takes long."""
        if self._plotter is not None:
            if self._is_soft:
                self._draw_at(samples=0, is_hasty=True)
                self._calm.start()
            self._refresh()
            if self._is_soft:
                self.canvas.begin()
        is_between = self._state.is_playing and self._state.at != int(self._state.at)
        self._kept = self._kept if is_between else Kept()
        flat = overlay(self._picture, self.width(), self._tall(), cameras=self.cameras(), words=False, kept=self._kept)
        self._flat.lay(flat, self._lens, is_blank=self._state.options.blank, is_hasty=is_between)

    def _refresh(self) -> None:
        """What is in space has changed."""
        if self._is_soft:
            self.canvas.refresh(self._tall())
        else:
            self._is_stale = True

    def _draw(self) -> None:
        """What is in space, if it has changed."""
        if self._is_stale and self._plotter is not None:
            self._is_stale = False
            if self._plotter.isValid():
                self._plotter.makeCurrent()
                self._plotter.paintGL()
                self._plotter.doneCurrent()
            else:
                self._plotter.update()

    def _smooth(self) -> None:
        if self._plotter is None or self._state.is_playing or self._is_drag:
            return
        if not self._is_soft:
            self._draw_at(samples=SAMPLES, is_hasty=False)
            self._plotter.update()
        elif self.canvas.isVisible() and self.canvas.is_quick:
            self._draw_at(samples=0, is_hasty=False)
            self.canvas.smooth()
        else:
            self._draw_at(samples=SAMPLES // 2, is_hasty=False)
            self.canvas.refresh(self._tall())

    @property
    def samples(self) -> int:
        """How many samples each pixel of the picture in space has."""
        return int(self.canvas.samples if self._is_soft else self._plotter.render_window.GetMultiSamples())

    def _nudge(self, right: float, up: float) -> None:
        for painter in self._painters:
            painter.nudge(right, up)

    def _draw_at(self, *, samples: int, is_hasty: bool) -> None:
        """How well the picture is drawn from now on."""
        if self._drawn_at != (samples, is_hasty):
            self._drawn_at = samples, is_hasty
            self._plotter.render_window.SetMultiSamples(samples)
            for painter in self._painters:
                painter.hasten(is_hasty)

    # -- the hand -------------------------------------------------------------------------------

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """All input of the VTK widget: ours, or nobody's."""
        kind = event.type()
        if isinstance(event, QKeyEvent):
            if event.key() in AXES and not event.isAutoRepeat():
                self._axis = AXES[Qt.Key(event.key())] if kind == QEvent.Type.KeyPress else None
            event.ignore()
            return kind != QEvent.Type.ShortcutOverride
        if isinstance(event, QWheelEvent):
            self._wheel(event)
            return True
        if isinstance(event, QMouseEvent):
            self._pointed(event.position())
            handle = {
                QEvent.Type.MouseButtonPress: self._pressed,
                QEvent.Type.MouseMove: self._moved,
                QEvent.Type.MouseButtonRelease: self._released,
                QEvent.Type.MouseButtonDblClick: self._double_clicked,
            }.get(kind)
            if handle is not None:
                handle(event)
            return True
        if kind == QEvent.Type.Leave:
            self.pointer.left()
        if kind == QEvent.Type.Leave and not (self._is_pinned or self._state.options.basis):
            self._session.do(look, None)
        return kind in (QEvent.Type.Enter, QEvent.Type.Leave, QEvent.Type.Gesture)

    def _pointed(self, here: QPointF) -> None:
        """The mouse is somewhere: the light and the magnifier go along."""
        self.pointer.moved(here)
        if self._lens is not None and here != self._lens:
            self._lens = here
            self._look_again()

    def _pressed(self, event: QMouseEvent) -> None:
        self._press = self._last = event.position()
        self._is_drag = False
        self._grip = self._gripped(event) if event.button() == Qt.MouseButton.LeftButton else None
        self.canvas.setFocus(Qt.FocusReason.MouseFocusReason)

    def _gripped(self, event: QMouseEvent) -> Grip | None:
        """The control point under the mouse, in the hand."""
        spot, camera = self.spot_at(event.position()), self.cameras()[self._pane(event.position())[0]]
        if spot is None or spot.stage != 0 or camera is None or self._state.options.basis:
            return None
        points = self._state.trace(self._state.now.views[spot.pane]).control.points
        return Grip(spot.point, points[spot.point], event.position(), camera, self.areas()[spot.pane])

    def _pulled(self) -> None:
        if self._grip is not None:
            self._session.do(drag, self._grip.vertex, self._grip.moved(self._target, self._axis))

    def _moved(self, event: QMouseEvent) -> None:
        here = event.position()
        if self._press is None:
            if not (self._is_pinned or self._state.options.basis):  # a graph would rise under the mouse, away from it
                self._session.do(look, self.spot_at(here))
            return
        self._is_drag = self._is_drag or (here - self._press).manhattanLength() > TRACK
        if self._is_drag and self._grip is not None:
            self._target = here
            self._pull.start()
        elif self._is_drag:
            step = (here - self._last) / self._pane(self._press)[1][3]
            self._turned(self._dragged(event)(step.x(), step.y()))
            self._last = here

    def _dragged(self, event: QMouseEvent) -> Any:
        """Rotating or panning, by what is under the hand, the button and the shift key."""
        content = self._picture.panes[self._pane(self._press)[0]].content
        is_flat = not isinstance(content, Scene) or content.camera.scale > 0
        is_left = bool(event.buttons() & Qt.MouseButton.LeftButton)
        shifted = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        turn = self._state.turn
        return turn.panned if is_flat or shifted or not is_left else turn.rotated

    def _released(self, event: QMouseEvent) -> None:
        if self._press is not None and not self._is_drag and event.button() == Qt.MouseButton.LeftButton:
            if is_open(self._state):
                self._predict(event.position())
            else:
                spot = self.spot_at(event.position())
                self._is_pinned = spot is not None
                self._session.do(look, spot)
                self._pick(event, spot)
        if self._grip is not None and self._is_drag:
            self._pull.stop()
            self._target = event.position()
            self._pulled()
        if self._is_drag:
            self._session.let_go()
            self._show_in_full()
        self._press, self._is_drag, self._grip = None, False, None
        self._calm.start()

    def _predict(self, here: QPointF) -> None:
        """A click at a question is a prediction."""
        found = part_at(self._picture, self.width(), self._tall(), here.x(), here.y(), words=False)
        box = found[1] if found is not None and isinstance(found[1], Box) else None
        prediction = predicted(self._state, here, self.areas(), self.cameras(), box)
        if prediction is not None:
            self._session.do(predict, prediction)

    def _pick(self, event: QMouseEvent, spot: Spot | None) -> None:
        """Choose what was clicked to be edited, in the laboratory; with Shift, besides what is chosen."""
        if not bench.is_open(self._state) or self._state.is_playing:
            return
        found = self.part_at(event.position(), spot)
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            found = extended(self._state.picked, found) if found is not None else self._state.picked
        self._session.do(pick, found)

    def part_at(self, at: QPointF, spot: Spot | None) -> Picked | None:
        """The part of the control object at a place: the point there, else an edge, else a face."""
        if spot is not None:
            return Picked("vertex", (spot.point,)) if spot.stage == 0 else None
        k, area = self._pane(at)
        camera, views = self.cameras()[k], self._state.now.views
        if camera is None or k >= len(views) or not is_pickable(self._state, views[k]):
            return None
        view = views[k]
        control, is_solid = self._state.trace(view).control, self._state.options.surface
        return part(control, camera, area, at.x(), at.y(), is_solid=is_solid)

    def _double_clicked(self, event: QMouseEvent) -> None:
        if is_open(self._state):
            self._pressed(event)  # two clicks in a row are two predictions
            return
        spot = self.spot_at(event.position())
        if spot is None:
            self.reset_camera()
        elif spot.stage == 0:
            self._session.do(put_back, spot.point)

    def _wheel(self, event: QWheelEvent) -> None:
        self._pause.start()
        _, (x, y, w, h) = self._pane(event.position())
        here = event.position()
        factor = 1.0015 ** (event.angleDelta().y() or event.pixelDelta().y() * 4)
        self._turned(self._state.turn.zoomed(factor, (here.x() - x - w / 2) / h, (here.y() - y - h / 2) / h))

    def _pane(self, at: QPointF | None) -> tuple[int, Area]:
        """The pane under the mouse, else the first."""
        areas = self.areas()
        for k, (x, y, w, h) in enumerate(areas):
            if at is not None and x <= at.x() < x + w and y <= at.y() < y + h:
                return k, (x, y, w, h)
        return 0, areas[0]

    def spot_at(self, at: QPointF) -> Spot | None:
        """The point that is meant by a place on the screen: the nearest in space, in front first; a box, or a disc."""
        state = self._state
        if state.is_playing or is_open(state) or self._is_hasty:
            return None
        if found := part_at(self._picture, self.width(), self._tall(), at.x(), at.y(), words=False):
            k, part = found
            k = k if k < len(state.now.views) else 0  # the matrices are those of the leading view
            return Spot(k, part.stage, part.point) if part.point >= 0 else None
        k, area = self._pane(at)
        content, camera = self._picture.panes[k].content, self.cameras()[k]
        if camera is None or not isinstance(content, Scene) or k >= len(state.now.views):
            return None  # nor is there a view behind a picture that was chosen, beside the true one
        if (found_point := nearest(content, camera, area, at.x(), at.y())) is None:
            return None
        stage, point = found_point
        now = state.now.views[k].at(state.progress)
        if stage < 0 and now != int(now):
            return None  # on its way between two stages a point has no row
        return Spot(k, stage if stage >= 0 else int(now), point)

    # -- Qt's own -------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()
        self._paint_scenes()

    def paintEvent(self, event: QPaintEvent) -> None:
        QPainter(self).fillRect(self.rect(), colour(self._picture.background))

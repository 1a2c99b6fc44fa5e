"""Brings up the process in the order Qt and VTK need, and sees to it that no traceback reaches the user."""

import ctypes
import faulthandler
import gc
import logging
import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import (
    QMessageLogContext,
    QSettings,
    QTimer,
    QtMsgType,
    qInstallMessageHandler,
    qVersion,
)
from PySide6.QtGui import QGuiApplication, QSurfaceFormat
from PySide6.QtWidgets import QApplication

from app.asking import toggle_asking
from app.authoring import shelf
from app.draw.theme import THEMES
from app.gui import look, lost
from app.gui.ahead import Ahead
from app.gui.autosave import Autosave, folder
from app.gui.fault import Faults
from app.gui.look import system_theme
from app.gui.opengl import has_opengl, opengl
from app.gui.session import Session
from app.gui.window import NAME, Window
from app.log import LOG, keep_log
from app.state import Options, State, choose, open_lesson, start
from app.words import LANGUAGES, SYSTEM, speak, system_language
from lessons import all_lessons
from lessons.script import Lesson

M_ARENA_MAX = -8
"""From ``malloc.h``: how many such places there may be."""

NO_SCREEN = (
    "there is no screen to open the window on (DISPLAY and WAYLAND_DISPLAY lead nowhere). "
    "'subdivision-studio figures' draws the lessons to files without one."
)
NO_OPENGL = (
    "the window needs OpenGL 3.2, and this screen does not offer it. Update the graphics driver, or install Mesa "
    "(Debian: sudo apt-get install libgl1-mesa-dri). 'subdivision-studio figures' draws without it."
)


def run(
    lesson: Lesson | None = None,
    step: int | None = None,
    theme: str = "",
    as_caption: bool = False,
    opening: Callable[[State], State] = lambda state: state,
    path: Path | None = None,
    own: Path | None = None,
    is_trusted: bool = False,
    language: str = "",
) -> int:
    """Open the window at a lesson and a step (from 1), and stay until it is closed; the exit status.

    ``theme`` and ``language`` overrule those that the window remembers.  ``opening`` leads from there to what is
    to be open; ``path`` is the file it was in, if it was.  ``own`` is a folder of lessons to open, which ``is_trusted``
    to run or is asked for; else it is the one that was open last.
    """
    if not has_screen():
        return _refuse(NO_SCREEN)
    app = application()
    if not has_opengl():
        return _refuse(NO_OPENGL)
    log = keep_log()
    settings = settings_file()
    speak(language or settings_language(settings))
    state = first_state(lesson, step, theme or settings_theme(settings), as_caption)
    state = state if settings.value("asking", "on") == "off" else toggle_asking(state)
    state = opening(choose(state, reduced_motion=settings.value("reduced_motion", "off") == "on"))
    state = choose(state, scale=settings_scale(settings))
    window = Window(Session(state), settings)
    faults = catch_everything(window, log)
    autosave = Autosave(window.session, folder())
    autosave.failed.connect(window.say)
    window.viewport.start()
    window.show()
    if path is not None:
        window.opened(path)
    window.offer_to_restore(autosave)
    QTimer.singleShot(0, lambda: window.authoring.begin(shelf.usual_place(), own, is_trusted))
    ahead = Ahead(window.session, window.viewport)
    QTimer.singleShot(0, ahead.begin)
    QTimer.singleShot(0, gc.enable)  # from now on garbage is looked for, but not in what the start has made
    signal.signal(signal.SIGINT, lambda *_: window.close())
    pulse = QTimer(interval=200)  # lets Python see Ctrl-C
    pulse.timeout.connect(lambda: None)
    pulse.start()
    hear_qt(autosave.keep_now)
    QTimer.singleShot(0, lambda: lost.watch(autosave.keep_now))  # after Qt and VTK, who would take its place
    status = int(app.exec())
    ahead.stop()
    autosave.end()
    faults.leave()
    return status


def application() -> QApplication:
    """The one application, in the house style."""
    existing = QApplication.instance()
    if isinstance(existing, QApplication):
        return existing
    prepare()
    _share_memory()
    app = QApplication(sys.argv[:1])
    app.setApplicationName(NAME)
    app.setDesktopFileName("subdivision-studio")
    app.setStyle(look.Style())
    app.setWindowIcon(look.studio_icon())
    look.load_fonts()
    app.setFont(look.type_face(14))
    return app


def prepare() -> None:
    """What must be said before there is an application: how OpenGL is to be."""
    wanted = QSurfaceFormat()
    wanted.setRenderableType(QSurfaceFormat.RenderableType.OpenGL)
    wanted.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    wanted.setVersion(3, 2)
    wanted.setSwapBehavior(QSurfaceFormat.SwapBehavior.DoubleBuffer)
    wanted.setDepthBufferSize(8)
    wanted.setAlphaBufferSize(8)
    wanted.setStencilBufferSize(0)
    wanted.setSamples(0)  # VTK smooths in buffers of its own
    QSurfaceFormat.setDefaultFormat(wanted)
    # No AA_ShareOpenGLContexts: no widget moves to another window, and pyvistaqt would set off a warning with it.


def _share_memory() -> None:
    """Let all threads take memory from one place: where each has its own, glibc keeps there what its largest work took.

    Elsewhere nothing is to be said.
    """
    with suppress(OSError, AttributeError):
        ctypes.CDLL("libc.so.6").mallopt(M_ARENA_MAX, 1)


def first_state(lesson: Lesson | None, step: int | None, theme: str, as_caption: bool) -> State:
    """Where the window opens: at a lesson and a step; else at the cube, if it is there."""
    cube = next((each for each in all_lessons() if each.id == "figure_14_cube"), all_lessons()[0])
    state = start(lesson or cube, Options(theme=theme, as_caption=as_caption))
    return open_lesson(state, state.lesson, step - 1) if step else state


def settings_theme(settings: QSettings) -> str:
    """The theme that the window remembers."""
    chosen = str(settings.value("theme", "light"))
    theme = system_theme() if chosen == "system" else chosen
    return theme if theme in THEMES else "light"


def settings_language(settings: QSettings) -> str:
    """The language that the window remembers; at first the system's."""
    chosen = str(settings.value("language", SYSTEM))
    return chosen if chosen in LANGUAGES else system_language()


def settings_scale(settings: QSettings) -> float:
    """The interface scale that the window remembers."""
    kept = str(settings.value("scale", "100"))
    return next((scale for scale in look.SCALES if f"{scale:.0%}" == f"{kept}%"), 1.0)


# -- screens ----------------------------------------------------------------------------------


def has_screen() -> bool:
    """Whether Qt would find a screen: where it finds none it aborts the process, so it is not let try."""
    if os.environ.get("QT_QPA_PLATFORM", "xcb").split(":")[0].split(";")[0] not in ("xcb", "wayland", "wayland-egl"):
        return True
    if not sys.platform.startswith("linux"):
        return True
    return _has_wayland() or _has_x11()


def _has_wayland() -> bool:
    name = os.environ.get("WAYLAND_DISPLAY")
    return bool(name) and (Path(os.environ.get("XDG_RUNTIME_DIR", "/")) / str(name)).exists()


def _has_x11() -> bool:
    if not os.environ.get("DISPLAY"):
        return False
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        return True
    xcb.xcb_connect.restype = ctypes.c_void_p
    connection = ctypes.c_void_p(xcb.xcb_connect(None, None))
    is_there = not xcb.xcb_connection_has_error(connection)
    if not is_there:
        xcb.xcb_disconnect(connection)
    return is_there  # and stays connected: a screen that all have left may begin anew, and refuse who comes meanwhile


def _refuse(sentence: str) -> int:
    print(f"subdivision-studio: {sentence}", file=sys.stderr)
    return 1


# -- settings, log, faults --------------------------------------------------------------------


def settings_file() -> QSettings:
    """Where the window remembers its size, its panels and its theme."""
    return QSettings(QSettings.Format.IniFormat, QSettings.Scope.UserScope, "Subdivision Studio", "window")


def catch_everything(window: Window, log: Path) -> Faults:
    """Faults become a dialog with a report, and a traceback in the log; what ends the process leaves one there too."""
    with suppress(OSError):
        faulthandler.enable(log.with_name("crash.log").open("a"))
    more = {"Qt": qVersion(), "Windows by": QGuiApplication.platformName(), "OpenGL": opengl()[1]}
    faults = Faults(window, log, more)
    faults.listen()
    return faults


def hear_qt(last: Callable[[], None]) -> None:
    """What Qt has to say goes to the log; when it says that the screen is lost, ``last`` is done and all ends."""

    def heard(kind: QtMsgType, context: QMessageLogContext, message: str) -> None:
        bad = kind in (QtMsgType.QtWarningMsg, QtMsgType.QtCriticalMsg, QtMsgType.QtFatalMsg)
        LOG.log(logging.WARNING if bad else logging.DEBUG, "Qt: %s", message)
        if lost.is_lost(message):
            lost.end(last)

    qInstallMessageHandler(heard)

"""The picture as it is seen now, in a file or on the clipboard."""

import sys
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QSize, QThreadPool
from PySide6.QtGui import QImage

from app.draw.picture import Picture
from subdivision.files.saving import save as write
from subdivision.words import phrase

WIDTH = 1920
"""Pixels: a saved picture is at least so wide, and at least twice as fine as on the screen."""

SUFFIXES = (".png", ".svg", ".pdf")


class SavingError(Exception):
    """Why a picture was not saved, in a sentence for the user."""


@cache
def darkroom() -> QThreadPool:
    """Where pictures are drawn: the off-screen window belongs to one thread, and not to that of the window."""
    found = QThreadPool()
    found.setMaxThreadCount(1)
    found.setExpiryTimeout(-1)
    return found


def save(picture: Picture, path: Path, seen: QSize) -> Path:
    """Write a picture ``seen`` at a size; the suffix chooses, PNG where there is none.

    Raises
    ------
    SavingError
        If it cannot be written there.
    """
    path = path if path.suffix else path.with_suffix(".png")
    if path.suffix.lower() not in SUFFIXES:
        raise SavingError(
            phrase(
                "Pictures end in {names} or {last}, not in {suffix}: choose another name.",
                names=", ".join(SUFFIXES[:-1]),
                last=SUFFIXES[-1],
                suffix=path.suffix,
            )
        )
    try:
        write(path, [_WRITERS[path.suffix.lower()](picture, seen)])
    except OSError as fault:
        raise SavingError(
            phrase("{path} could not be written ({reason}): choose another folder.", path=path, reason=fault.strerror)
        ) from fault
    return path


def _png(picture: Picture, seen: QSize) -> bytes:
    held = QBuffer()
    held.open(QIODevice.OpenModeFlag.WriteOnly)
    image(picture, seen).save(held, "PNG")  # type: ignore[call-overload]
    return bytes(held.data().data())


def _svg(picture: Picture, seen: QSize) -> bytes:
    from app.draw.vector import svg

    return svg(picture, *_size(seen)).encode()


def _pdf(picture: Picture, seen: QSize) -> bytes:
    from app.draw.pdf import pdf

    return pdf(picture, *_size(seen))


_WRITERS: Mapping[str, Callable[[Picture, QSize], bytes]] = {".png": _png, ".svg": _svg, ".pdf": _pdf}


def image(picture: Picture, seen: QSize) -> QImage:
    """The picture at a size for slides, with its caption."""
    from app.draw import raster

    pixels = raster.image(picture, *_size(seen))
    raster.shrink()
    height, width = pixels.shape[:2]
    return QImage(pixels.tobytes(), width, height, 4 * width, QImage.Format.Format_RGBA8888).copy()


def close() -> None:
    """Give the off-screen window back, if there is one, before the display goes; what is being drawn is drawn first."""
    if "app.draw.raster" in sys.modules:
        darkroom().start(sys.modules["app.draw.raster"].close)
        darkroom().waitForDone()


def _size(seen: QSize) -> tuple[int, int]:
    scale = max(2.0, WIDTH / max(seen.width(), 1))
    return round(scale * seen.width()), round(scale * seen.height())

"""The picture as it is seen now, in a file or on the clipboard: how fine it is, and where it goes."""

from pathlib import Path

from PySide6.QtCore import QSize
from PySide6.QtGui import QImage

from app.draw.darkroom import Order
from app.draw.picture import Picture
from subdivision.files.saving import save as write
from subdivision.words import phrase

WIDTH = 1920
"""Pixels: a saved picture is at least so wide, and at least twice as fine as on the screen."""

SUFFIXES = (".png", ".svg", ".pdf")


class SavingError(Exception):
    """Why a picture was not saved, in a sentence for the user."""


def ordered(picture: Picture, kind: str, seen: QSize) -> Order:
    """A picture ``seen`` at a size, to be drawn at a size for slides, with its caption."""
    scale = max(2.0, WIDTH / max(seen.width(), 1))
    return Order(kind, picture, round(scale * seen.width()), round(scale * seen.height()))


def named(path: Path) -> Path:
    """Where a picture goes; the suffix chooses its kind, PNG where there is none.

    Raises
    ------
    SavingError
        If there is no such kind.
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
    return path


def save(path: Path, data: bytes) -> Path:
    """Write a picture that is drawn.

    Raises
    ------
    SavingError
        If it cannot be written there.
    """
    try:
        write(path, [data])
    except OSError as fault:
        raise SavingError(
            phrase("{path} could not be written ({reason}): choose another folder.", path=path, reason=fault.strerror)
        ) from fault
    return path


def image(order: Order, pixels: bytes) -> QImage:
    """A picture that is drawn as pixels."""
    return QImage(pixels, order.width, order.height, 4 * order.width, QImage.Format.Format_RGBA8888).copy()

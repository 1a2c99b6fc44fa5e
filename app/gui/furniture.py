"""Furniture changed for new: what hands over, and where the keyboard was."""

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QAbstractScrollArea, QApplication, QWidget

Seat: TypeAlias = tuple[str, type[QWidget], int]
"""Where a widget is: the name of the piece it is in, its type, and which of that type it is there."""


def seat_of(pieces: Mapping[str, QWidget], widget: QWidget | None) -> Seat | None:
    """Where a widget is among the pieces; None: in none of them."""
    for name, piece in pieces.items():
        if widget is not None and (piece is widget or piece.isAncestorOf(widget)):
            return name, type(widget), _alike(piece, type(widget)).index(widget)
    return None


def at(pieces: Mapping[str, QWidget], seat: Seat) -> QWidget | None:
    """The widget that has taken a seat; None: there is none any more."""
    name, kind, number = seat
    alike = _alike(pieces[name], kind)
    return alike[number] if number < len(alike) else None


def _alike(piece: QWidget, kind: type[QWidget]) -> list[QWidget]:
    return [each for each in (piece, *piece.findChildren(QWidget)) if type(each) is kind]


def sit_down(pieces: Mapping[str, QWidget], seat: Seat | None) -> None:
    """Give the keyboard to whoever has the seat now."""
    if seat is not None and (widget := at(pieces, seat)) is not None:
        widget.setFocus(Qt.FocusReason.OtherFocusReason)


def scrolled(area: QAbstractScrollArea) -> float:
    """How far a list or a panel is scrolled, from 0 to 1."""
    bar = area.verticalScrollBar()
    return bar.value() / max(bar.maximum(), 1)


def scroll(area: QAbstractScrollArea, part: float) -> None:
    """Scroll a list or a panel so far, as soon as it has been laid out."""
    bar = area.verticalScrollBar()
    QTimer.singleShot(0, bar, lambda: bar.setValue(round(part * bar.maximum())))


def enter_what_is_typed() -> None:
    """A number that is being typed counts before its box goes."""
    if (focus := QApplication.focusWidget()) is not None:
        focus.clearFocus()


def throw_away(old: Iterable[QWidget]) -> None:
    """Take pieces out of the window for good."""
    for each in old:
        each.hide()
        each.setParent(None)
        each.deleteLater()

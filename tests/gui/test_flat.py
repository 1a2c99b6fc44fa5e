"""The flat sheet over the panes: much is painted over turns of the event loop, and looks the same in the end."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage, QPainter, QPixmap
from PySide6.QtWidgets import QApplication, QWidget

from app.draw.primitives import Plate, Primitive, Stroke, Text
from app.gui import flat
from app.gui.brush import paint, type_

INK, PAPER = (0.1, 0.2, 0.3), (1.0, 0.9, 0.8)


def crowd(shift: float = 0.0) -> list[Primitive]:
    """Many words with halos, plates and strokes that lie over each other."""
    found: list[Primitive] = []
    for k in range(60):
        x, y = 10.3 + 47.7 * (k % 8) + shift, 31.4 + 37.1 * (k // 8) + shift
        found += [Plate(x, y, 60, 30, PAPER, INK, 1.3, 4), Stroke(x, y, x + 90, y + 40, INK, 2.2)]
        found.append(Text(x, y, f"$v_{{{k}}}$ {k}/64", 19.7, INK, halo=PAPER))
    return found


def painted_at_once(size, shown) -> QImage:
    sheet = QPixmap(size)
    sheet.fill(Qt.GlobalColor.transparent)
    with QPainter(sheet) as painter:
        paint(painter, shown, type_)
    return sheet.toImage()


@pytest.fixture
def sheet(qtbot, monkeypatch):
    monkeypatch.setattr(flat, "SLICE", 1e-4)  # many turns, however fast the machine is
    holder = QWidget()
    qtbot.addWidget(holder)
    holder.resize(480, 360)
    made = flat.Flat(holder, lambda: None)
    made.resize(holder.size())
    with qtbot.waitExposed(holder):
        holder.show()
    yield made
    holder.close()


def looks(sheet) -> QImage:
    return sheet.grab().toImage().convertToFormat(QImage.Format.Format_ARGB32_Premultiplied)


def on_paper(image: QImage, like: QImage, sheet) -> QImage:
    """What a sheet looks like that shows this."""
    under = QPixmap(image.size())
    under.fill(sheet.palette().color(sheet.backgroundRole()))
    with QPainter(under) as painter:
        painter.drawImage(0, 0, image)
    return under.toImage().convertToFormat(like.format())


def test_much_is_painted_over_turns_and_in_the_end_as_if_at_once(sheet, qtbot):
    before, after = crowd(), crowd(3.6)
    sheet.lay(before)
    sheet.grab()
    assert not sheet.is_done, "too little to take turns: the test says nothing"
    qtbot.waitUntil(lambda: sheet.is_done)
    assert looks(sheet) == on_paper(painted_at_once(sheet.size(), before), looks(sheet), sheet)
    sheet.lay(after, is_hasty=True)
    sheet.lay([replace(after[2], text="new"), *after[3:]], is_hasty=True)
    sheet.lay(after)
    qtbot.waitUntil(lambda: sheet.is_done)
    assert looks(sheet) == on_paper(painted_at_once(sheet.size(), after), looks(sheet), sheet)


def test_changes_while_it_is_painted_are_not_lost(sheet, qtbot):
    shown = crowd()
    for k in range(8):
        shown[21 * k + 2] = replace(shown[21 * k + 2], text=f"now {k}")
        sheet.lay(list(shown))
        sheet.grab()
        for _ in range(5 * k):  # now in the middle of painting in haste, now of painting with care
            QApplication.processEvents()
        assert not sheet.is_done
    qtbot.waitUntil(lambda: sheet.is_done)
    assert looks(sheet) == on_paper(painted_at_once(sheet.size(), shown), looks(sheet), sheet)
    sheet.resize(470, 350)
    qtbot.waitUntil(lambda: sheet.is_done)
    assert looks(sheet) == on_paper(painted_at_once(sheet.size(), shown), looks(sheet), sheet)

"""Help: the manual is opened, read, searched and taken away, and the lesson behind it stays where it is."""

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtTest import QTest

import lessons

pytestmark = pytest.mark.window
Key = Qt.Key


@pytest.fixture
def manual(qtbot, window):
    QTest.keyClick(window.windowHandle(), Key.Key_F1)
    qtbot.waitUntil(lambda: any(each.id == "sources" for each in window.manual.chapters), timeout=60_000)
    yield window.manual
    window.manual.close()


def test_it_tells_a_lesson_and_leads_from_a_scheme_to_its_paper(manual):
    manual.go(lessons.find("14").id)
    assert manual.list.currentItem().text() == lessons.find("14").section
    manual.go("schemes")
    manual.follow(QUrl("#CC78"))
    assert manual.list.currentItem().text() == "Sources"
    assert "Catmull" in manual.text.toPlainText()


def test_the_search_lists_where_words_are_and_walks_through_them(qtbot, manual):
    qtbot.keyClicks(manual.search, "magnifier")
    titles = [manual.list.item(k).text() for k in range(manual.list.count())]
    assert "Presenting" in titles
    assert "Sources" not in titles
    assert manual.text.textCursor().selectedText().casefold() == "magnifier"
    visited = set()
    for _ in range(3 * len(titles)):
        visited.add(manual.list.currentRow())
        qtbot.keyClick(manual.search, Key.Key_Return)
        assert manual.text.textCursor().selectedText().casefold() == "magnifier"
    assert visited == set(range(len(titles)))


def test_keys_that_scroll_and_type_leave_the_lesson_alone(qtbot, window, manual):
    before = window.session.state
    manual.text.setFocus()
    for key in (Key.Key_PageDown, Key.Key_Space, Key.Key_B, Key.Key_Home):
        QTest.keyClick(manual.windowHandle(), key)
    assert window.session.state is before
    QTest.keyClick(manual.windowHandle(), Key.Key_Escape)
    assert manual.isHidden()


def test_it_is_saved_as_one_page(window, manual, tmp_path):
    manual.save_to(tmp_path / "manual.html")
    assert (tmp_path / "manual.html").read_text(encoding="utf-8").count("<h1>") == len(manual.chapters)
    manual.save_to(tmp_path / "nowhere" / "manual.html")
    assert "nowhere" in window.banner.words.text()

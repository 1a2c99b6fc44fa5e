"""The window's looks from a theme: palette, style sheet, typeface and icons."""

import re
from collections.abc import Generator
from functools import lru_cache

from PySide6.QtCore import QByteArray, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontDatabase, QGuiApplication, QIcon, QPainter, QPalette, QPen, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QApplication, QMenu, QProxyStyle, QStyle, QStyleOption, QWidget

from app import ASSETS
from app.draw.picture import Colour
from app.draw.theme import THEMES, Theme, mixed

FAMILY = "Inter"
GRID = 8
"""All distances in the window are multiples of it (or of its half), in pixels at 100 %."""

SCALES = (0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5)
"""How large the window can be."""

ICONS = 64
"""So many drawn icons are kept: those of all themes at one scale."""

TWO_COLUMNS = 1.5
"""Up to this scale a menu that is too long for the screen has a second column; beyond it scrolls."""

_scale = 1.0


def rescale(scale: float) -> None:
    """From now on everything in the window is so many times as large as at 100 %."""
    global _scale
    _scale = scale


def fine(pixels: float) -> float:
    """So many pixels of 100 % at the scale of the window: for strokes, and for what is painted."""
    return pixels * _scale


def px(pixels: float) -> int:
    """The same in whole pixels: for widgets and the space between them.  Something never becomes nothing."""
    return max(round(fine(pixels)), 1) if pixels else 0


def sized(sheet: str) -> str:
    """A style sheet whose pixels are those of 100 %, at the scale of the window."""
    return re.sub(r"\b(\d+)px", lambda found: f"{px(int(found[1]))}px", sheet)


def colour(value: Colour, opacity: float = 1.0) -> QColor:
    """Qt's colour."""
    return QColor.fromRgbF(*value, opacity)


def line_of(theme: Theme) -> Colour:
    """Hairlines between parts of the window."""
    return mixed(theme.panel, theme.ink, 0.16)


def tint_of(theme: Theme) -> Colour:
    """What lies under the mouse."""
    return mixed(theme.panel, theme.ink, 0.08)


def chosen_of(theme: Theme) -> Colour:
    """What is chosen."""
    return mixed(theme.panel, theme.accent, 0.20)


def type_face(pixels: float, weight: QFont.Weight = QFont.Weight.Normal) -> QFont:
    """The house typeface, with figures of equal width; ``pixels`` high at 100 %."""
    font = QFont(FAMILY)
    font.setPixelSize(px(pixels))
    font.setWeight(weight)
    font.setFeature(QFont.Tag.fromString("tnum"), 1)
    return font


def load_fonts() -> None:
    """Make the shipped typeface known to Qt."""
    for file in sorted((ASSETS / "fonts").glob("*.otf")):
        QFontDatabase.addApplicationFont(str(file))


ROUND = Qt.PenCapStyle.RoundCap
MENU_MARKS = {
    QStyle.PrimitiveElement.PE_IndicatorMenuCheckMark: ((-4, 0), (-1, 3), (4, -3)),
    QStyle.PrimitiveElement.PE_IndicatorArrowRight: ((-2, -4), (2, 0), (-2, 4)),
}
"""The strokes of ticks and arrows, in pixels at 100 % from their middle."""


class Style(QProxyStyle):
    """Fusion with its own measures (indicators, arrows, small icons) at the scale of the window."""

    def __init__(self) -> None:
        super().__init__("Fusion")
        self._is_within = False

    def pixelMetric(
        self, metric: QStyle.PixelMetric, option: QStyleOption | None = None, widget: QWidget | None = None
    ) -> int:
        if not isinstance(widget, QWidget):  # one that is being made may still bear the name of what was there before
            widget = None
        if self._is_within or _scale == 1.0:  # one measure asks for another
            return super().pixelMetric(metric, option, widget)
        self._is_within = True
        try:
            usual = super().pixelMetric(metric, option, widget)
        finally:
            self._is_within = False
        return px(usual) if usual > 0 else usual

    def drawPrimitive(
        self,
        element: QStyle.PrimitiveElement,
        option: QStyleOption,
        painter: QPainter,
        widget: QWidget | None = None,
    ) -> None:
        """Fusion's ticks and arrows in menus have one size for all: ours are as large as the type."""
        if (corners := MENU_MARKS.get(element)) is None or not isinstance(widget, QMenu):
            super().drawPrimitive(element, option, painter, widget)
            return
        middle = QRectF(option.rect).center()  # type: ignore[attr-defined]
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(widget.palette().windowText().color(), fine(1.6), Qt.PenStyle.SolidLine, ROUND))
        painter.drawPolyline([middle + QPointF(fine(x), fine(y)) for x, y in corners])
        painter.restore()


def dressing(app: QApplication, theme: Theme) -> Generator[None, None, None]:
    """Give the whole program the colours of a theme, step by step: Qt goes through every widget each time."""
    if is_other := (wanted := sheet(theme)) != app.styleSheet():
        app.setStyleSheet("")  # one sheet for another takes twice as long as none and then the other
        yield
    app.setFont(type_face(14))
    app.setPalette(palette(theme))
    yield
    if is_other:
        app.setStyleSheet(wanted)


def palette(theme: Theme) -> QPalette:
    """The theme in Qt's words."""
    found = QPalette()
    role = QPalette.ColorRole
    colours = {
        role.Window: theme.panel, role.WindowText: theme.ink, role.Base: theme.background, role.Text: theme.ink,
        role.AlternateBase: theme.panel, role.Button: theme.panel, role.ButtonText: theme.ink,
        role.ToolTipBase: theme.ink, role.ToolTipText: theme.background, role.PlaceholderText: theme.muted,
        role.Highlight: theme.accent, role.HighlightedText: theme.background, role.Link: theme.accent,
        role.BrightText: theme.selection, role.Accent: theme.accent,
    }  # fmt: skip
    for which, value in colours.items():
        found.setColor(which, colour(value))
    for which in (role.WindowText, role.Text, role.ButtonText):
        found.setColor(QPalette.ColorGroup.Disabled, which, colour(mixed(theme.panel, theme.ink, 0.45)))
    return found


SHEET = """
QMenuBar { background: $panel; padding: 2px 4px; border: none; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: $tint; }
QMenu { background: $background; border: 1px solid $line; padding: 4px; menu-scrollable: $scrolls; }
QMenu::item { padding: 6px 28px 6px 28px; border-radius: 4px; }
QMenu::item:selected { background: $chosen; color: $ink; }
QMenu::item:disabled { color: $faded; }
QMenu::separator { height: 1px; background: $line; margin: 4px 8px; }
QMenu::indicator { width: 16px; height: 16px; left: 6px; }
QToolButton { border: none; border-radius: 6px; padding: 4px; background: transparent; }
QToolButton:hover { background: $tint; }
QToolButton:pressed, QToolButton:checked { background: $chosen; }
QToolButton:focus { outline: none; border: 2px solid $accent; padding: 2px; }
QToolButton::menu-indicator { image: none; }
QPushButton { border: 1px solid $line; border-radius: 6px; padding: 4px 16px; background: $background; }
QPushButton:hover { background: $tint; }
QPushButton:checked { background: $chosen; }
QPushButton:focus { border: 2px solid $accent; padding: 3px 15px; }
QLineEdit { border: 1px solid $line; border-radius: 6px; padding: 5px 8px; background: $background; }
QLineEdit:focus { border: 2px solid $accent; padding: 4px 7px; }
QDoubleSpinBox { border: 1px solid $line; border-radius: 6px; padding: 3px 4px; background: $background; }
QAbstractSpinBox QLineEdit, QAbstractSpinBox QLineEdit:focus { border: none; padding: 0; background: transparent; }
QDoubleSpinBox::up-button, QDoubleSpinBox::down-button { width: 0; border: none; }
QDoubleSpinBox:focus { border: 2px solid $accent; padding: 2px 3px; }
QComboBox { border: 1px solid $line; border-radius: 6px; padding: 4px 8px; background: $background; }
QComboBox:hover { background: $tint; }
QComboBox:focus { border: 2px solid $accent; padding: 3px 7px; }
QComboBox::drop-down { border: none; width: 8px; }
QComboBox QAbstractItemView { border: 1px solid $line; background: $background; selection-background-color: $chosen;
    selection-color: $ink; }
QListView { border: none; background: transparent; outline: none; }
QScrollArea { border: none; background: transparent; }
QScrollBar:vertical { width: 8px; background: transparent; margin: 0; }
QScrollBar::handle:vertical { background: $line; border-radius: 4px; min-height: 32px; }
QScrollBar:horizontal { height: 8px; background: transparent; margin: 0; }
QScrollBar::handle:horizontal { background: $line; border-radius: 4px; min-width: 32px; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QSplitter::handle { background: $line; }
QToolTip { background: $ink; color: $background; border: none; padding: 4px 8px; }
QProgressBar { border: none; border-radius: 2px; background: $line; max-height: 4px; }
QProgressBar::chunk { background: $accent; border-radius: 2px; }
"""


def sheet(theme: Theme) -> str:
    """What the palette cannot say: space, hairlines, round corners."""
    words = {
        "$background": theme.background, "$panel": theme.panel, "$ink": theme.ink, "$accent": theme.accent,
        "$tint": tint_of(theme), "$line": line_of(theme), "$chosen": chosen_of(theme),
        "$faded": mixed(theme.panel, theme.ink, 0.45),
    }  # fmt: skip
    text = sized(SHEET).replace("$scrolls", str(int(_scale > TWO_COLUMNS)))
    for word, value in words.items():
        text = text.replace(word, colour(value).name())
    return text


def icon(name: str, theme_name: str) -> QIcon:
    """One of ``assets/icons`` in the ink of a theme, in the sizes that screens ask for."""
    sizes = {round(finely * px(size)) for size in (16, 20) for finely in (1, 1.5, 2, 3)}
    return _icon(name, theme_name, tuple(sorted(sizes)))


@lru_cache(maxsize=ICONS)
def _icon(name: str, theme_name: str, sizes: tuple[int, ...]) -> QIcon:
    theme = THEMES[theme_name]
    found = QIcon()
    faded = mixed(theme.panel, theme.ink, 0.35)
    for ink, mode in ((theme.ink, QIcon.Mode.Normal), (faded, QIcon.Mode.Disabled)):
        drawing = (ASSETS / "icons" / f"{name}.svg").read_text().replace("currentColor", colour(ink).name())
        read = QSvgRenderer(QByteArray(drawing.encode()))
        for size in sizes:
            found.addPixmap(drawn(read, size), mode)
    return found


def drawn(svg: QSvgRenderer, size: int) -> QPixmap:
    """An SVG as a square picture of ``size`` pixels."""
    pixmap = QPixmap(QSize(size, size))
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    svg.render(painter, QRectF(0, 0, size, size))
    painter.end()
    return pixmap.copy()  # without all that Qt keeps with what has been painted on


def studio_icon() -> QIcon:
    """The program's own icon."""
    found, read = QIcon(), QSvgRenderer(QByteArray((ASSETS / "icons" / "studio.svg").read_bytes()))
    for size in (16, 32, 48, 128, 256):
        found.addPixmap(drawn(read, size))
    return found


def system_theme() -> str:
    """The theme the desktop asks for."""
    return "dark" if QGuiApplication.styleHints().colorScheme() == Qt.ColorScheme.Dark else "light"

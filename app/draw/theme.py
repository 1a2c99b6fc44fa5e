"""Colours and strokes: one house palette, safe for colour-blind eyes [OI08]_, in three themes.

A colour means one thing in every lesson: original black (white on dark), edge point orange,
face point vermilion, centroid green, moved point blue, selection purple.  Every two of them differ by 10 or
more (CIEDE2000 [SWD05]_) in every theme, also as protanopes, deuteranopes and tritanopes see them [MOF09]_.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from app.draw.picture import Colour, Shape
from lessons.script import EXTRAORDINARY, Lesson, Meaning
from subdivision import Role


def mixed(a: Colour, b: Colour, t: float) -> Colour:
    """``t`` of the way from ``a`` to ``b``."""
    red, green, blue = (x + t * (y - x) for x, y in zip(a, b, strict=True))
    return red, green, blue


def rgb(code: str) -> Colour:
    """``#RRGGBB`` as numbers in 0..1."""
    r, g, b = (int(code[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return r, g, b


ORANGE, VERMILION, GREEN, BLUE, PURPLE = map(rgb, ("#E69F00", "#D55E00", "#009E73", "#0072B2", "#CC79A7"))

SHAPES: Mapping[Role, Shape] = {
    Role.ORIGINAL: Shape.SPHERE,
    Role.EDGE: Shape.DIAMOND,
    Role.FACE: Shape.CUBE,
    Role.CENTROID: Shape.BEAD,
    Role.MOVED: Shape.HALO,
}

NAMES: Mapping[Role, str] = {
    Role.ORIGINAL: "original",
    Role.EDGE: "edge point",
    Role.FACE: "face point",
    Role.CENTROID: "centroid",
    Role.MOVED: "moved",
}

WORDS: Mapping[str, str] = {
    "original": "black", "edge": "orange", "face": "red", "centroid": "green", "moved": "blue",
    EXTRAORDINARY: "black",
}  # fmt: skip
"""What captions call the colours, by the names of the roles."""

SIZES: Mapping[Role, float] = {
    Role.ORIGINAL: 1.0,
    Role.EDGE: 1.15,
    Role.FACE: 0.95,
    Role.CENTROID: 0.62,
    Role.MOVED: 1.0,
}
"""Marker radius relative to an original's, so that all look equally heavy."""


@dataclass(frozen=True)
class Theme:
    """What every painter needs to know about looks."""

    name: str
    background: Colour
    panel: Colour
    ink: Colour
    muted: Colour
    accent: Colour
    surface: Colour
    edge: Colour
    net: Colour
    faint: Colour
    selection: Colour
    guess: Colour
    """What was predicted."""
    roles: Mapping[Role, Colour]
    stroke: float = 1.0
    type: float = 1.0
    points: float = 1.0
    growth: float = 1.0
    """The part of the size of type that is given up where there is no room for it."""
    words: Mapping[str, str] = field(default_factory=lambda: dict(WORDS))
    extraordinary: Colour | None = None
    """Extraordinary vertices among the originals, where they have a colour of their own."""


LIGHT = Theme(
    name="light",
    background=rgb("#FAF8F5"),
    panel=rgb("#F2EFEA"),
    ink=rgb("#1B1B1B"),
    muted=rgb("#5F5B55"),
    accent=BLUE,
    surface=rgb("#E4DED4"),
    edge=rgb("#6F6961"),
    net=rgb("#8A837A"),
    faint=rgb("#C9C3B9"),
    selection=rgb("#A8467C"),
    guess=rgb("#5B0F8B"),
    roles={
        Role.ORIGINAL: rgb("#111111"),
        Role.EDGE: ORANGE,
        Role.FACE: VERMILION,
        Role.CENTROID: GREEN,
        Role.MOVED: BLUE,
    },
)

DARK = Theme(
    name="dark",
    background=rgb("#17191D"),
    panel=rgb("#202328"),
    ink=rgb("#F2F2F0"),
    muted=rgb("#A9ABB0"),
    accent=rgb("#5CA3ED"),
    surface=rgb("#4A4F58"),
    edge=rgb("#A3A9B3"),
    net=rgb("#8B919B"),
    faint=rgb("#4B5058"),
    selection=PURPLE,
    guess=rgb("#9A4DFF"),
    roles={
        Role.ORIGINAL: rgb("#FFFFFF"), Role.EDGE: ORANGE, Role.FACE: rgb("#E65F37"),
        Role.CENTROID: rgb("#25D699"), Role.MOVED: rgb("#5CA3ED"),
    },
    words={**WORDS, "original": "white", EXTRAORDINARY: "white"},
)  # fmt: skip

PROJECTOR = Theme(
    name="projector",
    background=rgb("#FFFFFF"),
    panel=rgb("#FFFFFF"),
    ink=rgb("#000000"),
    muted=rgb("#3A3A3A"),
    accent=BLUE,
    surface=rgb("#E8E8E8"),
    edge=rgb("#222222"),
    net=rgb("#444444"),
    faint=rgb("#BBBBBB"),
    selection=rgb("#9B3A70"),
    guess=rgb("#4B0082"),
    roles=LIGHT.roles,
    stroke=1.5,
    type=1.15,
)

THEMES: Mapping[str, Theme] = {t.name: t for t in (LIGHT, DARK, PROJECTOR)}

YELLOW = rgb("#EFC000")


def theme_of(lesson: Lesson, name: str, as_caption: bool) -> Theme:
    """A theme by name; ``as_caption`` gives the lesson the colours that the lecture's own caption names."""
    theme = THEMES[name]
    if not as_caption:
        return theme
    black, green, blue = (theme.roles[r] for r in (Role.ORIGINAL, Role.CENTROID, Role.MOVED))
    named = {"black": black, "yellow": YELLOW, "green": green, "blue": blue}
    words = {_word(what): theme.words["original"] if w == "black" else w for what, w in lesson.colours.items()}
    roles = {role: named[lesson.colours[role]] for role in theme.roles if role in lesson.colours}
    special = named.get(lesson.colours.get(EXTRAORDINARY, ""))
    return replace(theme, roles={**theme.roles, **roles}, words={**theme.words, **words}, extraordinary=special)


def enlarged(theme: Theme, scale: float) -> Theme:
    """A theme at a scale: type grows with it; points less, and strokes least, for they would blacken a fine mesh.

    Nothing is smaller than it can be read.
    """
    growth = max(scale, 1.0)
    stroke, type_ = theme.stroke * growth ** (1 / 3), theme.type * growth
    return replace(theme, stroke=stroke, points=growth**0.5, type=type_, growth=growth)


def _word(what: Meaning) -> str:
    return what.name.lower() if isinstance(what, Role) else what

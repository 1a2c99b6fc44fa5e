"""Colours that everybody can tell apart: differences as colour-blind eyes see them, and contrast of type.

Dichromats are simulated with the matrices of [MOF09]_ for full severity, on linear sRGB; differences are CIEDE2000
[SWD05]_, of which 1 is just noticeable; contrast is that of WCAG 2.
"""

from itertools import combinations

import numpy as np
import pytest

import lessons
from app.draw.theme import THEMES, YELLOW, Theme, rgb, theme_of
from lessons.script import EXTRAORDINARY
from subdivision import Role

APART = 10.0
"""Between any two colours that mean something, and between each of them and what is behind it."""

QUIET = 4.0
"""Between a surface and the background: a large field, and edges draw its outline besides."""

READABLE = 4.5
"""Contrast of type: level AA of WCAG 2."""

EYES = {
    "normal": np.eye(3),
    "protanope": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deuteranope": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritanope": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}

XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
"""Linear sRGB to CIE XYZ, white D65."""

OWN_COLOURS = [lesson for lesson in lessons.all_lessons() if lesson.colours]


def linear(colour):
    """Without the gamma of sRGB."""
    c = np.asarray(colour, dtype=float)
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def luminance(colour):
    return float(XYZ[1] @ linear(colour))


def contrast(one, other):
    """1 to 21, as WCAG 2 defines it."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def lab(colour, eyes=EYES["normal"]):
    """CIE L*a*b* of a colour as some eyes see it."""
    t = XYZ @ np.clip(eyes @ linear(colour), 0, 1) / XYZ.sum(axis=1)
    x, y, z = np.where(t > (6 / 29) ** 3, np.cbrt(t), t * (29 / 6) ** 2 / 3 + 4 / 29)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def cosine(degrees):
    return np.cos(np.radians(degrees))


def difference(one, other):
    """CIEDE2000 of two colours in L*a*b*."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    stretch = 1.5 - 0.5 * saturated((np.hypot(a1, b1) + np.hypot(a2, b2)) / 2)
    c1, c2 = np.hypot(stretch * a1, b1), np.hypot(stretch * a2, b2)
    h1, h2 = (np.degrees(np.arctan2(b, stretch * a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    turn = (h2 - h1 + 180) % 360 - 180 if c1 * c2 else 0.0
    light, c, h = (l1 + l2) / 2, (c1 + c2) / 2, h1 + turn / 2 if c1 * c2 else h1 + h2
    t = 1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) - 0.20 * cosine(4 * h - 63)
    lightness = (l2 - l1) / (1 + 0.015 * (light - 50) ** 2 / np.sqrt(20 + (light - 50) ** 2))
    chroma = (c2 - c1) / (1 + 0.045 * c)
    hue = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)) / (1 + 0.015 * c * t)
    bent = -2 * saturated(c) * np.sin(np.radians(60 * np.exp(-(((h % 360 - 275) / 25) ** 2))))
    return float(np.sqrt(lightness**2 + chroma**2 + hue**2 + bent * chroma * hue))


def saturated(c):
    return np.sqrt(c**7 / (c**7 + 25.0**7))


def meanings(theme: Theme):
    """The colours that mean something, by name."""
    extraordinary = {} if theme.extraordinary is None else {EXTRAORDINARY: theme.extraordinary}
    roles = {role.name: colour for role, colour in theme.roles.items()}
    return {**roles, **extraordinary, "selection": theme.selection, "guess": theme.guess}


def too_near(colours, bound):
    """Pairs of names whose colours some eyes can hardly tell apart; one colour under two names is meant to be one."""
    pairs = [(a, b) for a, b in combinations(colours, 2) if colours[a] != colours[b]]
    seen = {who: {name: lab(colour, eyes) for name, colour in colours.items()} for who, eyes in EYES.items()}
    return [(a, b, who) for who, lab_of in seen.items() for a, b in pairs if difference(lab_of[a], lab_of[b]) < bound]


@pytest.mark.parametrize(
    ("one", "other", "published"),
    [
        ((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
        ((50, -1.3802, -84.2814), (50, 0, -82.7485), 1.0000),
        ((50, 0, 0), (50, -1, 2), 2.3669),
        ((50, 2.49, -0.001), (50, -2.49, 0.0009), 7.1792),
        ((50, 2.5, 0), (73, 25, -18), 27.1492),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
        ((22.7233, 20.0904, -46.694), (23.0331, 14.973, -42.5619), 2.0373),
        ((2.0776, 0.0795, -1.135), (0.9033, -0.0636, -0.5514), 0.9082),
    ],
)
def test_the_difference_is_the_published_one(one, other, published):
    assert difference(one, other) == pytest.approx(published, abs=5e-5)
    assert difference(other, one) == pytest.approx(published, abs=5e-5)


@pytest.mark.parametrize("eyes", EYES)
def test_grey_is_grey_to_every_eye(eyes):
    assert EYES[eyes].sum(axis=1) == pytest.approx(1, abs=2e-6)


def test_the_simulation_knows_what_dichromats_confuse():
    red, green = rgb("#B84A2A"), rgb("#6B7A2A")
    seen = {who: difference(lab(red, eyes), lab(green, eyes)) for who, eyes in EYES.items()}
    assert seen["normal"] > 40
    assert seen["deuteranope"] < 15
    assert seen["tritanope"] > 30


@pytest.mark.parametrize("name", THEMES)
def test_every_eye_tells_the_meanings_apart(name):
    theme = THEMES[name]
    for behind in (theme.background, theme.surface):
        assert not too_near({**meanings(theme), "behind": behind}, APART)
    assert not too_near({"surface": theme.surface, "background": theme.background}, QUIET)


@pytest.mark.parametrize("name", THEMES)
@pytest.mark.parametrize("lesson", OWN_COLOURS, ids=lambda each: each.id)
def test_every_eye_tells_the_lectures_own_colours_apart(lesson, name):
    theme = theme_of(lesson, name, as_caption=True)
    assert YELLOW in theme.roles.values()
    for behind in (theme.background, theme.surface):
        assert not too_near({**meanings(theme), "behind": behind}, APART)


def test_roles_of_one_colour_are_those_the_lecture_gives_one_name():
    for lesson in OWN_COLOURS:
        roles = theme_of(lesson, "light", as_caption=True).roles
        one = {(a, b) for a, b in combinations(Role, 2) if roles[a] == roles[b]}
        named = {role: lesson.colours.get(role, "black" if role is Role.ORIGINAL else role) for role in Role}
        assert one == {(a, b) for a, b in combinations(Role, 2) if named[a] == named[b]}


@pytest.mark.parametrize("name", THEMES)
@pytest.mark.parametrize("ink", ["ink", "muted", "accent"])
@pytest.mark.parametrize("ground", ["background", "panel"])
def test_type_can_be_read(name, ink, ground):
    assert contrast(getattr(THEMES[name], ink), getattr(THEMES[name], ground)) >= READABLE


def test_contrast_is_that_of_black_and_white():
    assert contrast((0, 0, 0), (1, 1, 1)) == pytest.approx(21)
    assert contrast(rgb("#767676"), (1, 1, 1)) == pytest.approx(4.54, abs=0.005)

"""Colours for numbers: ordered by lightness, and safe for colour-blind eyes."""

import numpy as np

from app.draw.picture import Bar, Colour
from app.draw.theme import Theme
from subdivision.arrays import Floats

STEPS = 33
"""How many colours a bar has."""

SIGNED = "BrBG_r"
"""ColorBrewer's brown and teal with a pale middle, as matplotlib has it."""

CLEAR = 0.9
"""How far a ramp with two hues is used on either side: its very ends are nearly black."""

OUTLIERS = 90.0
"""Per cent of the values that the ends of a scale with a sign hold; what is beyond wears the colours of the ends."""


def ramp(theme: Theme, is_signed: bool) -> Floats:
    """(STEPS, 3): from the least to the most; without a sign, from the bare surface to the colour of what is chosen."""
    t = np.linspace(0, 1, STEPS)
    if is_signed:
        from matplotlib import colormaps  # here, so that the command line answers without it

        return np.array(colormaps[SIGNED](0.5 + CLEAR * (t - 0.5)))[:, :3]
    return np.asarray((1 - t)[:, None] * np.array(theme.surface) + t[:, None] * np.array(theme.selection))


def ends(values: Floats, is_signed: bool) -> tuple[float, float, bool]:
    """The least and the most of a scale, and whether some values are beyond; with a sign, 0 is in its middle."""
    there = values[np.isfinite(values)]
    if not there.size:
        return (-1.0 if is_signed else 0.0), 1.0, False
    if not is_signed:
        return 0.0, max(float(there.max()), 1e-12), False
    most = float(np.percentile(np.abs(there), OUTLIERS))
    furthest = float(np.abs(there).max())
    most = max(most if furthest > 1.2 * most else furthest, 1e-12)
    return -most, most, furthest > 1.0001 * most


def places(values: Floats, scale: tuple[float, float]) -> Floats:
    """(n,): where values are on their scale, 0..1; NaN where there is none."""
    low, high = scale
    return np.asarray(np.clip((np.where(np.isfinite(values), values, np.nan) - low) / (high - low), 0.0, 1.0))


def coloured(places: Floats, theme: Theme, is_signed: bool) -> Floats:
    """(n, 3): the colour of every place on a scale; where there is none, that of the bare surface."""
    colours = ramp(theme, is_signed)
    found = np.stack([np.interp(places, np.linspace(0, 1, STEPS), column) for column in colours.T], axis=1)
    return np.where(np.isfinite(places)[:, None], found, theme.surface)


def bar(title: str, scale: tuple[float, float], is_beyond: bool, theme: Theme, is_signed: bool) -> Bar:
    """What says which colour is which number."""
    low, high = scale
    ticks = [(0.0, _number(low, "≤ " * is_beyond)), (0.5, "0" if is_signed else _number((low + high) / 2)),
             (1.0, _number(high, "≥ " * is_beyond))]  # fmt: skip
    colours: tuple[Colour, ...] = tuple((r, g, b) for r, g, b in ramp(theme, is_signed).tolist())
    return Bar(title, colours, tuple(ticks))


def _number(value: float, before: str = "") -> str:
    text = "0" if value == 0 else f"{value:.2g}" if 1e-3 <= abs(value) < 1e4 else f"{value:.1e}"
    whole = f"{value:,.0f}" if 100 <= abs(value) < 1e4 else text
    return before + whole.replace("-", "−")

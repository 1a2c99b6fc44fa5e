"""A lesson played, as an animated GIF: eased stages, and a rest at every stop long enough to read it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from io import BytesIO
from itertools import pairwise

import numpy as np
from PIL import Image

from app.draw.compose import compose
from app.draw.picture import Picture
from app.draw.raster import Pixels, image
from app.state import State, first, forward, settle

RATE = 15
"""Pictures a second."""

STAGE = 1.0
"""Seconds for one stage."""

REST, READING = 1.2, 0.045
"""Seconds of rest at a stop, and as many more for each letter of the caption."""

COLOURS = 255


@dataclass(frozen=True, eq=False)
class Shot:
    """One picture and how many seconds it stays."""

    state: State
    seconds: float


def shots(state: State) -> Iterator[Shot]:
    """The state's lesson from its first stop to its last."""
    state = first(state)
    yield Shot(state, _rest(state))
    while True:
        there = forward(state)
        if (there.beat, there.at) == (state.beat, state.at) and there.goal is None:
            return
        if there.goal is not None:
            n = max(round(RATE * STAGE), 2)
            begin, end = there.at, there.goal.at
            yield from (Shot(replace(there, at=begin + (end - begin) * k / n), STAGE / n) for k in range(1, n))
        state = settle(there)
        yield Shot(state, _rest(state))


def gif(
    state: State,
    width: int,
    height: int,
    *,
    look: Callable[[Picture], Picture] = lambda picture: picture,
    transparent: bool = False,
    progress: Callable[[float], None] = lambda done: None,
) -> bytes:
    """The bytes of the file.  ``look`` changes every picture, for instance its background."""
    played = list(shots(state))
    palette = _palette([image(look(compose(s.state)), width, height) for s in _telling(played)])
    frames = []
    for k, shot in enumerate(played):
        frames.append(_indexed(image(look(compose(shot.state)), width, height, transparent=transparent), palette))
        progress((k + 1) / len(played))
    out = BytesIO()
    frames[0].save(
        out, "GIF", save_all=True, append_images=frames[1:], loop=0, optimize=False, disposal=2 if transparent else 1,
        duration=[round(100 * s.seconds) * 10 for s in played], **({"transparency": COLOURS} if transparent else {}),
    )  # fmt: skip
    return out.getvalue()


def _rest(state: State) -> float:
    return REST + READING * len(state.now.text)


def _telling(played: list[Shot]) -> list[Shot]:
    """The stops, and the middles between them: together they hold every colour."""
    stops = [k for k, s in enumerate(played) if s.seconds > 0.5]
    middles = [(a + b) // 2 for a, b in pairwise(stops) if b - a > 1]
    chosen = sorted({*stops, *middles})
    return [played[k] for k in chosen[:: max(len(chosen) // 12, 1)]]


def _palette(pictures: list[Pixels]) -> Image.Image:
    """One palette for all frames, so that nothing flickers."""
    strip = np.concatenate([p[::2, ::2, :3] for p in pictures])
    return Image.fromarray(strip).quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)


def _indexed(pixels: Pixels, palette: Image.Image) -> Image.Image:
    """Nearest colours and no dither: its noise would be most of the file."""
    found = Image.fromarray(np.ascontiguousarray(pixels[..., :3])).quantize(palette=palette, dither=Image.Dither.NONE)
    clear = pixels[..., 3] < 128
    if clear.any():
        numbers = np.asarray(found).copy()
        numbers[clear] = COLOURS
        held = Image.frombytes("P", found.size, numbers.tobytes())
        held.putpalette(found.getpalette() or [])
        return held
    return found

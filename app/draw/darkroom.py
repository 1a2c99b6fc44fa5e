"""A process in which pictures are drawn, one after the other, so that nobody else waits for them.

VTK keeps Python to itself while it draws, and shapes by the hundred thousand take Python seconds: in another thread of
the window's process both hold the window up.  A process that does ``main`` hears orders on its input and answers each
on its output, until the input ends; both are pickles, for here a program speaks to itself.
"""

import os
import pickle
import sys
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from io import BytesIO
from typing import BinaryIO

from app.draw.picture import Picture

PROTOCOL = 5
"""Of pickles: arrays are written as they lie in the memory."""

GENTLY = 10
"""How much less urgent than the window this is, where processes are ranked."""


@dataclass(frozen=True, eq=False)
class Order:
    """A picture to draw as a ``kind`` of ``KINDS``, at a size in pixels."""

    kind: str
    picture: Picture
    width: int
    height: int


@dataclass(frozen=True)
class Failure:
    """Why there is no picture: too little memory, or ``traceback``."""

    is_memory: bool
    traceback: str


def drawn(order: Order) -> bytes:
    """The picture as the bytes of a file; its pixels row by row, if that is the kind."""
    return KINDS[order.kind](order.picture, order.width, order.height)


def _pixels(picture: Picture, width: int, height: int) -> bytes:
    from app.draw import raster

    try:
        return raster.image(picture, width, height).tobytes()
    finally:
        raster.shrink()


def _png(picture: Picture, width: int, height: int) -> bytes:
    from PIL import Image

    out = BytesIO()
    Image.frombytes("RGBA", (width, height), _pixels(picture, width, height)).convert("RGB").save(out, "PNG")
    return out.getvalue()


def _svg(picture: Picture, width: int, height: int) -> bytes:
    from app.draw.vector import svg

    return svg(picture, width, height).encode()


def _pdf(picture: Picture, width: int, height: int) -> bytes:
    from app.draw.pdf import pdf

    return pdf(picture, width, height)


KINDS: Mapping[str, Callable[[Picture, int, int], bytes]] = {
    "png": _png, "svg": _svg, "pdf": _pdf, "pixels": _pixels,
}  # fmt: skip


def serve(orders: BinaryIO, answers: BinaryIO) -> None:
    """Answer every order with bytes or a failure, until there are no more orders."""
    with suppress(EOFError):
        while True:
            pickle.dump(_answer(pickle.load(orders)), answers, PROTOCOL)
            answers.flush()


def _answer(order: Order) -> bytes | Failure:
    try:
        return drawn(order)
    except Exception as fault:
        return Failure(isinstance(fault, MemoryError), traceback.format_exc())


def main() -> None:
    """Serve whoever has started this process; what takes longest to load is there when the first order comes."""
    from app.draw import pdf, raster, vector  # noqa: F401

    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    if hasattr(os, "nice"):
        os.nice(GENTLY)
    with suppress(BrokenPipeError, KeyboardInterrupt):  # the window is gone
        serve(sys.stdin.buffer, answers)

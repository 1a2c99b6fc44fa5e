"""Steps on sheets of A4: the picture, beside it the caption, the formula and the notes."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from app.draw.pdf import Paper
from app.draw.picture import Colour, Picture
from app.draw.primitives import Primitive, Stroke, Text
from app.draw.seen import seen
from app.draw.type import measure, wrapped
from app.state import State, choose
from app.words import tr

A4 = (595.0, 842.0)
MARGIN, GAP, HEAD = 42.0, 14.0, 44.0
"""Points."""

ROWS = 4
WIDE = 294.0
"""The width of a picture; its height is 9 to 16."""

LAID_OUT = 1100
"""The width in pixels that a picture is laid out for; the fewer, the larger its type on paper."""

TYPE = 1.45
"""Type in pictures is so much larger than on a slide."""

CAPTION, FORMULA, NOTES, TITLE, NUMBER = 10.5, 10.5, 8.5, 15.0, 8.5
LINE = 1.32
SMALLEST = 6.0

INK: Colour = (0.08, 0.08, 0.1)
MUTED: Colour = (0.38, 0.38, 0.42)
RULE: Colour = (0.8, 0.8, 0.82)


def handout(
    told: Sequence[Sequence[State]], size: tuple[int, int], background: str, progress: Callable[[float], None]
) -> bytes:
    """The bytes of a PDF for paper, so always dark on white; every lesson begins a sheet."""
    paper = Paper(tr(told[0][0].lesson.title if len(told) == 1 else "Subdivision Curves and Surfaces"))
    count, sheet = sum(len(steps) for steps in told), 0
    done = 0
    for steps in told:
        for k, step in enumerate(steps):
            if k % ROWS == 0:
                sheet += 1
                paper.turn(*A4)
                paper.paint(_furniture(tr(step.lesson.title), sheet))
            row = _Row(step, k + 1, is_last=k + 1 == len(steps) or steps[k + 1].beat != step.beat)
            row.paint(paper, HEAD + MARGIN + (k % ROWS) * TALL)
            done += 1
            progress(done / count)
    return paper.done()


TALL = (A4[1] - HEAD - 2 * MARGIN) / ROWS
"""The height of a row."""


def _furniture(title: str, sheet: int) -> list[Primitive]:
    width, height = A4
    return [
        Text(MARGIN, MARGIN + TITLE, title, TITLE, INK, bold=True),
        Stroke(MARGIN, MARGIN + 1.75 * TITLE, width - MARGIN, MARGIN + 1.75 * TITLE, RULE, 0.75),
        Text(width - MARGIN, height - 0.6 * MARGIN, f"{sheet}", NUMBER, MUTED, "right"),
    ]


@dataclass(frozen=True)
class _Row:
    """A step; its notes stand where its beat ends."""

    step: State
    number: int
    is_last: bool

    def paint(self, paper: Paper, top: float) -> None:
        tall = WIDE * 9 / 16
        picture = _for_paper(seen(choose(self.step, theme="projector")))
        paper.picture(picture, (MARGIN, top, WIDE, tall), LAID_OUT, words=False)
        paper.paint([*_frame(MARGIN, top, WIDE, tall), *self._words(picture, top)])

    def _words(self, picture: Picture, top: float) -> Iterator[Primitive]:
        left = MARGIN + WIDE + GAP
        room = A4[0] - MARGIN - left
        yield Text(left, top + NUMBER, f"{self.number}", NUMBER, MUTED, bold=True)
        y = top + 1.6 * NUMBER
        for text, size, colour in self._parts(picture):
            lines = _fitted(text, size, room, top + TALL - GAP - y)
            for line, fitted in lines:
                _, up, down = measure(line, fitted)
                aside = max((LINE * fitted - up - down) / 2, 0.08 * fitted)
                yield Text(left, y + aside + up, line, fitted, colour)
                y += up + down + 2 * aside
            y += 0.45 * CAPTION

    def _parts(self, picture: Picture) -> Iterator[tuple[str, float, Colour]]:
        yield picture.caption, CAPTION, INK
        if picture.formula:
            formula = picture.formula.replace(r"\frac", r"\dfrac")
            yield formula, FORMULA, INK
        if self.is_last and self.step.now.notes:
            yield tr(self.step.now.notes), NOTES, MUTED


def _for_paper(picture: Picture) -> Picture:
    return replace(picture, title="", background=(1.0, 1.0, 1.0), scale=TYPE)


def _frame(x: float, y: float, w: float, h: float) -> list[Primitive]:
    corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
    return [Stroke(*a, *b, RULE, 0.5) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


def _fitted(text: str, size: float, room: float, tall: float) -> list[tuple[str, float]]:
    """The lines of a text and their size: smaller where there is too little room, but never too small to be read."""
    lines = wrapped(text, size, room)
    wide = max((measure(line, size)[0] for line in lines), default=0.0)
    if size > SMALLEST and (wide > room or len(lines) * LINE * size > tall):
        return _fitted(text, size - 0.25, room, tall)
    return [(line, size) for line in lines]

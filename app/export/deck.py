"""Steps as a PowerPoint deck: one a slide, its words as words, the notes for the speaker."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from io import BytesIO
from typing import Any

import numpy as np

from app.draw.layout import LINE, spoken
from app.draw.markup import code
from app.draw.picture import Colour, Picture
from app.draw.primitives import ANCHOR, Text
from app.draw.seen import seen
from app.draw.type import FAMILY, extent, runs
from app.figures import stood_on
from app.state import State
from app.words import tr

TALL = 7.5
"""Inches: the height of a slide; its width is as the pictures'."""

TITLE_ONLY = 5
"""The layout of the package's own template that has a title and nothing else."""

ABOVE = 0.97
"""From the top of a box of text to its first baseline, relative to the size of Inter."""

WIDER, SPARE = 0.18, 0.3
"""How much wider than in Inter a line is in the widest of usual typefaces, and how much more room its box has."""

LONGEST = 255
"""Characters of a property of a file, in this format."""

FINE = 3.0
"""Formulas have so many pixels for one of the picture's."""


def deck(
    told: Sequence[Sequence[State]], size: tuple[int, int], background: str, progress: Callable[[float], None]
) -> bytes:
    """The bytes of the file; ``told`` has the steps of every lesson."""
    from pptx import Presentation

    steps = [step for lesson in told for step in lesson]
    made = Presentation()
    unit = TALL / size[1]
    made.slide_width, made.slide_height = (_emu(n, unit) for n in size)
    title = tr(steps[0].lesson.title if len(told) == 1 else "Subdivision Curves and Surfaces")
    made.core_properties.title = title[:LONGEST]
    made.core_properties.author = "Subdivision Studio"
    for k, step in enumerate(steps, 1):
        _slide(made, stood_on(seen(step), background), tr(step.now.notes), size, unit)
        progress(k / len(steps))
    out = BytesIO()
    made.save(out)
    return out.getvalue()


def _slide(made: Any, picture: Picture, notes: str, size: tuple[int, int], unit: float) -> None:
    slide = made.slides.add_slide(made.slide_layouts[TITLE_ONLY])
    slide.background.fill.solid()
    slide.background.fill.fore_color.rgb = _rgb(picture.background)
    words, top, bottom = spoken(picture, *size)
    _view(slide, picture, size, round(top), round(bottom), unit)
    texts = [each for each in words if isinstance(each, Text)]
    title = [each for each in texts if each.bold]
    _words(slide.shapes.title, title, unit)
    others = [each for each in texts if not each.bold]
    plain = [each for each in others if not any(run.is_math for run in runs(each.text))]
    if counts := [each for each in plain if each.text == picture.corner]:
        _words(slide.shapes.add_textbox(0, 0, 0, 0), counts, unit)
    if caption := [each for each in plain if each not in counts]:
        is_beside = any(each.align == "left" for each in others if each not in plain)
        held = [_fitting(each, caption, size[0], is_beside=is_beside) for each in caption]
        _words(slide.shapes.add_textbox(0, 0, 0, 0), held, unit)
    for each in others:
        if each not in plain:
            _formula(slide, each, unit)
    if notes:
        slide.notes_slide.notes_text_frame.text = notes.replace("$", "")


def _fitting(line: Text, lines: Sequence[Text], width: float, *, is_beside: bool) -> Text:
    """A line of the caption, held at its end if a formula follows; smaller if another typeface would not fit the slide.

    Lines that are held at their end all end where the longest does.
    """
    boxes = [extent(each) for each in lines]
    end, wide = max(box[0] + box[2] for box in boxes), max(box[2] for box in boxes)
    size = line.size * min(1.0, (end if is_beside else width) / ((1 + WIDER) * wide))
    return replace(line, x=end, align="right", size=size) if is_beside else replace(line, size=size)


def _view(slide: Any, picture: Picture, size: tuple[int, int], top: int, bottom: int, unit: float) -> None:
    """What is between the title and the caption."""
    from app.draw.raster import image

    pixels = image(picture, *size)[top:bottom, :, :3]
    shape = slide.shapes.add_picture(_png(pixels), 0, _emu(top, unit), _emu(size[0], unit), _emu(bottom - top, unit))
    _describe(shape, picture.caption)


def _words(shape: Any, lines: Sequence[Text], unit: float) -> None:
    """Lines of type in a box that never breaks them again, whatever typeface they are shown in."""
    from pptx.enum.text import MSO_ANCHOR, MSO_AUTO_SIZE, PP_ALIGN
    from pptx.util import Pt

    head = lines[0]
    boxes = [extent(each) for each in lines]
    left, wide = min(box[0] for box in boxes), max(box[2] for box in boxes)
    shape.left, shape.width = _emu(left - ANCHOR[head.align] * SPARE * wide, unit), _emu((1 + SPARE) * wide, unit)
    shape.top, shape.height = _emu(head.y - ABOVE * head.size, unit), _emu(len(lines) * LINE * head.size, unit)
    frame = shape.text_frame
    frame.word_wrap, frame.auto_size, frame.vertical_anchor = False, MSO_AUTO_SIZE.NONE, MSO_ANCHOR.TOP
    frame.margin_left = frame.margin_right = frame.margin_top = frame.margin_bottom = 0
    paragraph = frame.paragraphs[0]
    paragraph.text = "\v".join(each.text for each in lines)
    paragraph.alignment = {"left": PP_ALIGN.LEFT, "center": PP_ALIGN.CENTER, "right": PP_ALIGN.RIGHT}[head.align]
    paragraph.line_spacing = 1.0 if len(lines) == 1 else Pt(LINE * head.size * unit * 72)
    for run in paragraph.runs:
        run.font.name, run.font.size, run.font.bold = FAMILY, Pt(head.size * unit * 72), head.bold
        run.font.color.rgb = _rgb(head.colour)


def _formula(slide: Any, text: Text, unit: float) -> None:
    """Mathematics as a picture that says its source to those who cannot see it."""
    from app.draw.raster import painted

    x, y, w, h = extent(text)
    x, y, w, h = x - 2, y - 2, w + 4, h + 4
    shape = slide.shapes.add_picture(_png(painted([text], (x, y, w, h), FINE)), *(_emu(n, unit) for n in (x, y, w, h)))
    _describe(shape, text.text)


def _describe(shape: Any, text: str) -> None:
    shape._element.nvPicPr.cNvPr.set("descr", text.replace("$", ""))


def _png(pixels: Any) -> BytesIO:
    from PIL import Image

    out = BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(out, "PNG")
    out.seek(0)
    return out


def _rgb(colour: Colour) -> Any:
    from pptx.dml.color import RGBColor

    made: Any = RGBColor
    return made.from_string(code(colour)[1:].upper())


def _emu(pixels: float, unit: float) -> Any:
    from pptx.util import Inches

    return Inches(pixels * unit)

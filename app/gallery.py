"""The whole lecture on one sheet: as a page of HTML beside its figures, and as one picture."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape
from io import BytesIO
from itertools import groupby
from pathlib import Path
from typing import Any

from app.draw.compose import compose, said
from app.draw.markup import code, number
from app.draw.theme import THEMES, Theme
from app.figures import file_name, looks, poster, render, write
from app.state import Options, State, Stop, at_stop, start, stops
from app.words import language, tr
from lessons.script import Lesson
from subdivision.words import phrase, plural

TITLE = "Subdivision Curves and Surfaces"
NOTES = phrase("Notes")

EM = 100.0
"""Outlines on the page are written in hundredths of the type's size."""


@dataclass(frozen=True)
class Drawn:
    """How the figures beside the page were drawn."""

    formats: tuple[str, ...]
    size: tuple[int, int]
    background: str = ""
    theme: str = ""
    steps: bool = False
    as_caption: bool = False
    scale: float = 1.0

    @property
    def seen(self) -> tuple[str, str]:
        """The format that the page shows, and the one that it leads to."""
        shown = next(kind for kind in ("png", "svg", "gif") if kind in self.formats)
        return shown, "svg" if "svg" in self.formats else shown

    @property
    def has_steps(self) -> bool:
        return self.steps and self.seen[0] != "gif"

    @property
    def options(self) -> Options:
        return Options(theme=looks(self.theme, self.background)[0], as_caption=self.as_caption, scale=self.scale)


def draw(lessons: Sequence[Lesson], folder: Path, drawn: Drawn) -> Iterator[Path]:
    """Write the figures of lessons, then the page that shows them; each path when its file is there."""
    for each in lessons:
        yield from render(
            each, folder, drawn.formats, drawn.size, drawn.background, drawn.steps,
            theme=drawn.theme, as_caption=drawn.as_caption, scale=drawn.scale,
        )  # fmt: skip
    yield write(folder / "index.html", page(lessons, drawn).encode())


def draw_sheet(lessons: Sequence[Lesson], path: Path, drawn: Drawn) -> Path:
    """Write the one picture of lessons."""
    return write(path, sheet(lessons, drawn.options))


# -- the page ---------------------------------------------------------------------------------


def page(lessons: Sequence[Lesson], drawn: Drawn) -> str:
    """``index.html`` for the folder with the figures of some lessons: valid by itself, without a script."""
    sections = [(name, list(those)) for name, those in groupby(lessons, key=lambda each: each.section)]
    n = len(lessons)
    made = plural(
        "{n} lesson, drawn by Subdivision Studio. A picture leads to its full size.",
        "{n} lessons, drawn by Subdivision Studio. A picture leads to its full size.",
        n, n=n,
    )  # fmt: skip
    links = "".join(f'<li><a href="#{_anchor(name)}">{escape(tr(name))}</a></li>' for name, _ in sections)
    parts = [
        f'<!DOCTYPE html>\n<html lang="{language()}">\n<head>\n<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta name="color-scheme" content="light dark">',
        f"<title>{escape(tr(TITLE))}</title>",
        f"<style>{_style(drawn)}</style>\n</head>",
        f"<body{' class=steps' if drawn.has_steps else ''}>",
        f"<header>\n<h1>{escape(tr(TITLE))}</h1>",
        f"<p>{escape(tr(made))}</p>",
        f'<nav aria-label="{escape(tr(phrase("Sections")))}"><ul>{links}</ul></nav>\n</header>\n<main>',
    ]
    for name, those in sections:
        parts.append(f'<section id="{_anchor(name)}">\n<h2>{escape(tr(name))}</h2>\n<div class="sheet">')
        parts.extend(_card(each, drawn) for each in those)
        parts.append("</div>\n</section>")
    return "\n".join([*parts, "</main>\n</body>\n</html>\n"])


def _card(lesson: Lesson, drawn: Drawn) -> str:
    """A lesson: its picture, its title, what is said; with steps all of them."""
    places, chosen = stops(lesson), poster(lesson)
    state = at_stop(start(lesson, drawn.options), chosen)
    figure, _, title = tr(lesson.title).partition("  ")
    heading = f"<span>{escape(figure)}</span> {escape(title)}" if title else escape(figure)
    turned = ", ".join(f"{tr(knob.label)} {value}" for knob, value in zip(lesson.knobs, lesson.values, strict=True))
    parts = [
        f'<article id="{lesson.id}">',
        _picture(state, drawn, places.index(chosen) + 1 if drawn.has_steps else 0),
        f"<div>\n<h3>{heading}</h3>",
        f'<p class="turned">{escape(turned)}</p>' if turned else "",
        f"<p>{_words(said(state, state.now))}</p>",
        _formula(state.now.formula),
        _aside("Not in the lecture", lesson.ours),
        "" if drawn.has_steps else _notes(lesson, places),
        "</div>",
        "".join(_steps(state, places, drawn)) if drawn.has_steps else "",
        "</article>",
    ]
    return "\n".join(part for part in parts if part)


def _steps(state: State, places: Sequence[Stop], drawn: Drawn) -> Iterator[str]:
    """Every step in a list; its notes where its beat ends."""
    yield "<ol>"
    for k, stop in enumerate(places, 1):
        here = at_stop(state, stop)
        ends = k == len(places) or places[k].beat != stop.beat
        yield f"<li>\n{_picture(here, drawn, k)}\n<p>{_numbered(k, said(here, here.now))}</p>\n"
        yield f"{_formula(here.now.formula)}{_aside(NOTES, here.now.notes if ends else '')}</li>\n"
    yield "</ol>"


def _picture(state: State, drawn: Drawn, step: int) -> str:
    """The image, and a link to what is sharp at any size, if there is such a file."""
    shown, full = (file_name(state.lesson, kind, 0 if kind == "gif" else step) for kind in drawn.seen)
    width, height = drawn.size
    told = said(state, state.now).replace("$", "")
    return (
        f'<a href="{escape(full)}"><img src="{escape(shown)}" alt="{escape(told)}" loading="lazy"'
        f' width="{width}" height="{height}"></a>'
    )


def _notes(lesson: Lesson, places: Sequence[Stop]) -> str:
    """The lecturer's notes, to be unfolded, each with the number of its step."""
    last = {stop.beat: k for k, stop in enumerate(places, 1)}
    told = [f"<p>{_numbered(last[b], tr(beat.notes))}</p>" for b, beat in enumerate(lesson.beats) if beat.notes]
    return f"<details>\n<summary>{escape(tr(NOTES))}</summary>\n{''.join(told)}\n</details>" if told else ""


def _numbered(step: int, text: str) -> str:
    return f"<span>{step}</span> {_words(text)}"


def _aside(name: str, text: str) -> str:
    return f'<p class="aside"><b>{escape(tr(name))}</b> {_words(tr(text))}</p>' if text else ""


def _formula(text: str) -> str:
    return f'<p class="formula">{_words(text)}</p>' if text else ""


def _words(text: str) -> str:
    """Words as text; what stands between dollars as an outline that has the colour of the words round it."""
    from app.draw.type import runs

    return "".join(_mathematics(run.text) if run.is_math else escape(run.text) for run in runs(text))


def _mathematics(formula: str) -> str:
    """A formula as high as the type it stands in asks for, on its line."""
    from app.draw.type import measure
    from app.draw.vector import traced

    text = f"${formula}$"
    width, ascent, descent = measure(text, EM)
    box = f"0 0 {number(width)} {number(ascent + descent)}"
    high, wide, below = (number(length / EM) for length in (ascent + descent, width, descent))
    return (
        f'<svg class="math" viewBox="{box}" role="img" aria-label="{escape(formula)}"'
        f' style="width:{wide}em;height:{high}em;vertical-align:-{below}em">'
        f'<path d="{traced(text, EM, 0.0, ascent)}"/></svg>'
    )


def _anchor(section: str) -> str:
    """``4.2 Triangles: stencils`` as a name to link to."""
    return "section-" + "-".join("".join(c if c.isalnum() else " " for c in section.lower()).split())


def _style(drawn: Drawn) -> str:
    light, dark = ({role: code(colour) for role, colour in _paints(name)} for name in ("light", "dark"))
    own = THEMES[drawn.options.theme].background
    plate = {"white": "#ffffff", "black": "#000000"}.get(looks(drawn.theme, drawn.background)[1], code(own))
    return STYLE % {"light": _variables(light), "dark": _variables(dark), "plate": plate}


def _paints(name: str) -> Iterator[tuple[str, Any]]:
    theme = THEMES[name]
    for role in ("background", "panel", "ink", "muted", "accent", "faint"):
        yield role, getattr(theme, role)


def _variables(paints: dict[str, str]) -> str:
    return ";".join(f"--{role}:{paint}" for role, paint in paints.items())


# -- one picture ------------------------------------------------------------------------------


def sheet(lessons: Sequence[Lesson], options: Options) -> bytes:
    """All lessons as tiles, each with its title below it; the bytes of a PNG file of few colours."""
    from PIL import Image, ImageDraw

    theme = THEMES[options.theme]
    columns = min(COLUMNS, len(lessons))
    across, down = TILE[0] + GAP, TILE[1] + LINE + GAP
    rows = -(-len(lessons) // columns)
    whole = Image.new("RGB", (GAP + columns * across, GAP + rows * down), code(theme.panel))
    pen = ImageDraw.Draw(whole)
    for k, each in enumerate(lessons):
        x, y = GAP + k % columns * across, GAP + k // columns * down
        whole.paste(tile(at_stop(start(each, options), poster(each)), TILE), (x, y))
        _label(pen, tr(each.title), (x, y + TILE[1] + LINE // 2), theme)
    return few_colours(whole)


def few_colours(image: Any) -> bytes:
    """A picture as a small PNG file."""
    from PIL import Image

    out = BytesIO()
    few = image.quantize(COLOURS, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)  # rare colours stay
    few.save(out, "PNG", optimize=True)
    return out.getvalue()


COLUMNS, TILE, GAP, LINE, TYPE = 6, (320, 180), 20, 26, 17
"""Tiles in a row; their size, the room between them, the height of a title and of its type, in pixels."""

FINER, COLOURS = 2, 255
"""Tiles are drawn finer and made smaller: smooth."""


def tile(state: State, size: tuple[int, int]) -> Any:
    """The panes alone, with strokes for their size in pixels."""
    from PIL import Image

    from app.draw.raster import image

    picture = compose(replace(state, options=replace(state.options, legend=False)))
    panes = tuple(replace(pane, title="", reading="") for pane in picture.panes)
    bare = replace(picture, panes=panes, title="", corner="", stroke=2 * picture.stroke)
    pixels = image(bare, FINER * size[0], FINER * size[1], words=False)
    return Image.fromarray(pixels).convert("RGB").resize(size, Image.Resampling.LANCZOS)


def _label(pen: Any, title: str, at: tuple[int, int], theme: Theme) -> None:
    """A figure's number, and its name in as many letters as have room."""
    from PIL import ImageFont

    from app.draw.letters import BOLD, REGULAR

    first, _, rest = title.removeprefix(tr("Figure ")).rpartition("  ")
    bold, plain = (ImageFont.truetype(str(file), TYPE) for file in (BOLD, REGULAR))
    x = at[0]
    if first:
        pen.text((x, at[1]), first, font=bold, fill=code(theme.ink), anchor="lm")
        x += round(bold.getlength(first)) + 8
    while plain.getlength(rest) > at[0] + TILE[0] - x:
        rest = rest[:-2].rstrip() + "…"
    pen.text((x, at[1]), rest, font=plain, fill=code(theme.muted), anchor="lm")


STYLE = """
:root{%(light)s;color-scheme:light dark}
@media (prefers-color-scheme:dark){:root{%(dark)s}}
*{box-sizing:border-box}
body{margin:0 auto;padding:clamp(1rem,3vw,3rem);max-width:110rem;background:var(--background);color:var(--ink);
font:1rem/1.5 Inter,system-ui,"Helvetica Neue",Arial,sans-serif}
h1{margin:0;font-size:clamp(1.7rem,4vw,2.6rem);line-height:1.15;letter-spacing:-.02em}
header p{margin:.4rem 0 1.2rem;color:var(--muted)}
nav ul{display:flex;flex-wrap:wrap;gap:.3rem 1.4rem;margin:0;padding:0;list-style:none}
a{color:var(--accent)}
nav a{text-decoration:none}
nav a:hover{text-decoration:underline}
h2{margin:3rem 0 1.2rem;padding-top:.7rem;border-top:1px solid var(--faint);font-size:1.35rem}
.sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%%,25rem),1fr));gap:2.4rem 1.8rem}
article{min-width:0;break-inside:avoid}
article>a,li>a{display:block}
img{display:block;width:100%%;height:auto;background:%(plate)s;border:1px solid var(--faint);border-radius:.5rem}
a:hover img,a:focus-visible img{border-color:var(--accent)}
h3{margin:.8rem 0 .2rem;font-size:1.1rem;line-height:1.3}
h3 span,p span{margin-right:.35em;color:var(--muted);font-weight:500}
li p{margin-top:.5rem}
p{margin:.2rem 0;overflow-wrap:anywhere}
.turned{color:var(--muted);font-size:.875rem}
.formula{margin:.6rem 0;font-size:1.1rem;overflow-x:auto}
.math{fill:currentColor;overflow:visible}
.aside,details{margin-top:.5rem;color:var(--muted);font-size:.9375rem}
.aside b,summary{font-weight:600;color:var(--ink)}
summary{cursor:pointer}
.steps .sheet{grid-template-columns:1fr}
@media (min-width:60rem){.steps article{display:grid;grid-template-columns:3fr 2fr;column-gap:1.8rem}
.steps ol{grid-column:1/-1}}
ol{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%%,18rem),1fr));gap:1.4rem 1.2rem;margin:1.2rem 0;
padding:0;list-style:none}
li{min-width:0;break-inside:avoid;font-size:.9375rem}
@media print{:root{%(light)s;--background:#fff;color-scheme:light;font-size:8pt}
body{padding:0;max-width:none}
nav{display:none}
details::details-content{content-visibility:visible}
h2{margin-top:1.2rem;break-after:avoid}
.sheet{grid-template-columns:1fr 1fr;gap:1rem}
ol{grid-template-columns:repeat(3,1fr)}}
"""

"""The page of a lesson: one file of HTML that carries its words, its style, its script and its record.

Its policy allows this one style and this one script, by their hashes, and nothing from elsewhere.  All text is
escaped; the record is base64, in which no markup can be written.  The same lesson gives the same bytes.
"""

import base64
import json
import struct
import zlib
from collections.abc import Iterator, Mapping
from functools import cache
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from app import ASSETS
from app.draw import pins, solid
from app.draw.flat import FLAT, Disc, Polygon, Ring
from app.draw.layout import PANE_TITLE
from app.draw.markup import code, number
from app.draw.picture import Faces
from app.draw.projection import SLACK
from app.draw.regular import CREASED, SMOOTH
from app.draw.theme import THEMES
from app.draw.type import measure, runs
from app.draw.vector import traced
from app.page.record import Record
from app.page.tables import EM
from app.words import language, tr
from subdivision.words import phrase

HERE = Path(__file__).parent
SCRIPTS = ("space.js", "surface.js", "flat.js", "scene.js", "record.js", "picture.js", "player.js", "asking.js",
           "page.js")  # fmt: skip

BUTTONS = (
    ("first", "First step", ("first",)),
    ("back", "Step back", ("back",)),
    ("play", "Play or pause", ("play", "pause")),
    ("forward", "Step forward", ("forward",)),
    ("last", "Last step", ("last",)),
)  # fmt: skip
"""Id, what it does, and its icons."""

KEYS = (
    (phrase("Space"), "play, pause"), ("→ ← or Page Down, Page Up", "a step forward, back"),
    ("Home, End", "first, last step"), ("Shift + arrows, or drag", phrase("turn")),
    ("Shift + drag, or two fingers", phrase("move")), ("+ − or the wheel", phrase("zoom")),
    ("R, or double click", "as it was"),
)  # fmt: skip


def page(recorded: Record) -> bytes:
    """The bytes of the file."""
    lesson = recorded.state.lesson
    style, script = _style(), _script()
    title = " ".join(tr(lesson.title).split())
    policy = (
        f"default-src 'none'; script-src '{_hash(script)}'; style-src '{_hash(style)}'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
    parts = [
        f'<!DOCTYPE html>\n<html lang="{language()}">\n<head>\n<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta name="color-scheme" content="light dark">',
        '<meta name="generator" content="Subdivision Studio">',
        f"<title>{escape(title)}</title>",
        f"<style>{style}</style>\n</head>\n<body>",
        *_player(tr(lesson.title), len(recorded.captions)),
        *_below(recorded),
        f'<script type="application/octet-stream" id="lesson">{_packed(recorded)}</script>',
        f"<script>{script}</script>\n</body>\n</html>\n",
    ]
    return "\n".join(parts).encode()


TOLD = {
    "click": "Click in the picture where you think it goes.",
    "away": "Your prediction is {distance} of an edge away.",
    "right": "You said {yours}, and it is true.",
    "wrong": "You said {yours}; {truth} is true.",
}
"""What the script says of predictions."""


# -- words ------------------------------------------------------------------------------------


def _player(title: str, steps: int) -> Iterator[str]:
    """The picture, and what is round it: filled by the script."""
    yield '<main class="player">'
    yield f'<header><h1>{escape(title).replace("  ", "&ensp;")}</h1><p id="corner"></p></header>'
    yield f'<div id="stage" tabindex="0" role="group" aria-label="{_said("Picture: drag to turn it")}">'
    yield '<canvas id="picture" role="img"></canvas></div>'
    yield f'<ul id="legend" aria-label="{_said("What the points are")}"></ul>'
    told = "".join(f' data-{name}="{_said(sentence)}"' for name, sentence in TOLD.items())
    yield f'<div id="words" aria-live="polite"{told}>'
    yield f"<noscript>{_said('The picture needs JavaScript; the steps are below.')}</noscript></div>"
    yield f'<nav aria-label="{_said("Steps")}" data-step="{_said("Step {number} of {total}")}">'
    for id_, name, icons in BUTTONS:
        drawn = "".join(_icon(icon) for icon in icons)
        yield f'<button id="{id_}" type="button" title="{_said(name)}" aria-label="{_said(name)}">{drawn}</button>'
    yield f'<input id="slider" type="range" min="1" max="{steps}" value="1" aria-label="{_said("Step")}">'
    yield '<span id="count"></span>'
    yield f'<button id="reset" type="button" title="{_said("The view as it was")}">{_said("Reset view")}</button>'
    yield f'<button id="theme" type="button">{_said("Light or dark")}</button>'
    yield "</nav>\n</main>"


def _icon(name: str) -> str:
    drawn = (ASSETS / "icons" / f"{name}.svg").read_text(encoding="utf-8").strip()
    names = {"play": "go", "pause": "pause"}
    return drawn.replace("<svg ", f'<svg class="{names.get(name, "step")}" aria-hidden="true" ', 1)


def _below(recorded: Record) -> Iterator[str]:
    """Every step in words, with formulas and notes; then what is ours, and the keys."""
    stops, beats = recorded.told["stops"], recorded.state.lesson.beats
    yield f'<div class="below">\n<h2 class="printless">{_said("All steps")}</h2>\n<ol id="steps">'
    for k, (light, dark) in enumerate(recorded.captions):
        beat = beats[stops[k]["beat"]]
        going = escape(tr(phrase("Go to step {number}", number=k + 1)))
        ends = k + 1 == len(stops) or stops[k + 1]["beat"] != stops[k]["beat"]
        yield f'<li><a class="printless" href="#step={k + 1}" aria-label="{going}">{_said("Show")}</a>'
        yield f'<p class="caption">{_themed(light, dark)}</p>'
        yield f'<p class="formula">{_words(_tall(beat.formula))}</p>' if beat.formula else ""
        yield f'<p class="notes">{_words(tr(beat.notes))}</p>' if beat.notes and ends else ""
        yield "</li>"
    yield "</ol>"
    if recorded.state.lesson.ours:
        yield f"<h2>{_said('Not in the lecture')}</h2>\n<p>{_words(tr(recorded.state.lesson.ours))}</p>"
    keys = "; ".join(f"<kbd>{_said(key)}</kbd> {_said(does)}" for key, does in KEYS)
    yield f"<footer><p>{keys}.</p><p>{_said('Made by Subdivision Studio.')}</p></footer>\n</div>"


def _said(text: str) -> str:
    """Words of the page in its language."""
    return escape(tr(text))


def _themed(light: str, dark: str) -> str:
    """A caption, which may call colours otherwise in the dark."""
    if light == dark:
        return _words(light)
    return f'<span class="by-day">{_words(light)}</span><span class="by-night">{_words(dark)}</span>'


def _words(text: str) -> str:
    """Words as text; what stands between dollars as an outline on their line."""
    return "".join(_mathematics(run.text) if run.is_math else escape(run.text) for run in runs(text))


def _tall(formula: str) -> str:
    """A formula on a line of its own has room for fractions."""
    return formula.replace(r"\frac", r"\dfrac")


def _mathematics(formula: str) -> str:
    """A formula as high as what stands above its line; what is below hangs over."""
    text = f"${formula}$"
    width, ascent, _ = measure(text, EM)
    return (
        f'<svg class="math" role="img" aria-label="{escape(formula)}" viewBox="0 0 {number(width)} {number(ascent)}"'
        f' width="{number(width / EM)}em" height="{number(ascent / EM)}em">'
        f'<path d="{traced(text, EM, 0.0, ascent)}"/></svg>'
    )


# -- style and script -------------------------------------------------------------------------


def _style() -> str:
    """The colours of both themes, and the rules; which theme holds is the system's choice until the reader chooses."""
    light, dark = (_variables(name) for name in ("light", "dark"))
    day, night = ".by-day{display:inline}.by-night{display:none}", ".by-day{display:none}.by-night{display:inline}"
    return "\n".join([
        f":root{{{light}}}",
        f"@media (prefers-color-scheme:dark){{:root{{{dark}}}{night}}}",
        f"@media not all and (prefers-color-scheme:dark){{{day}}}",
        _nested("light", light, day), _nested("dark", dark, night),
        f"@media print{{:root,:root[data-theme]{{{light};--background:#fff}}{_nested('dark', '', day)}{day}}}",
        (HERE / "page.css").read_text(encoding="utf-8"),
    ])  # fmt: skip


def _nested(name: str, variables: str, rules: str) -> str:
    """Colours and rules for a theme that the reader has chosen."""
    chosen = f":root[data-theme={name}]"
    each = "".join(f"{chosen} {rule}}}" for rule in rules.split("}") if rule)
    return f"{chosen}{{{variables}}}{each}"


def _variables(name: str) -> str:
    theme = THEMES[name]
    roles = ("background", "panel", "ink", "muted", "accent", "faint")
    return ";".join([*(f"--{role}:{code(getattr(theme, role))}" for role in roles), f"color-scheme:{name}"])


@cache
def _script() -> str:
    """All scripts as one, in a scope of its own."""
    parts = [(HERE / name).read_text(encoding="utf-8") for name in SCRIPTS]
    return "\n".join(['(() => {\n"use strict";', *parts, "})();"])


def _hash(text: str) -> str:
    return f"sha256-{base64.b64encode(sha256(text.encode()).digest()).decode()}"


# -- the record -------------------------------------------------------------------------------


def _packed(recorded: Record) -> str:
    """A table in JSON and the arrays it calls by number, deflated, in base64."""
    tables = recorded.tables
    told = {
        **recorded.told,
        "captions": [light.replace("$", "") for light, _ in recorded.captions],
        "looks": looks(recorded),
        "palette": tables.palette,
        "texts": tables.texts,
        "arrays": [[block[:2].decode(), (len(block) - 2) // int(block[1:2])] for block in tables.blocks],
    }
    written = json.dumps(told, ensure_ascii=False, separators=(",", ":")).encode()
    whole = b"".join([struct.pack("<I", len(written)), written, *(block[2:] for block in tables.blocks)])
    return base64.b64encode(zlib.compress(whole, 9)).decode()


def looks(recorded: Record) -> Mapping[str, Any]:
    """How things look, for the script: the very numbers with which the program paints."""
    theme = THEMES["light"]
    return {
        "lights": [[_listed(np.array(way) / np.linalg.norm(way)), intensity] for way, intensity in solid.LIGHTS],
        "surface": solid.SURFACE_LIGHT, "marker": solid.MARKER_LIGHT, "hidden": solid.HIDDEN,
        "creased": _listed(np.array([CREASED, SMOOTH])), "slack": SLACK, "dash": solid.DASH,
        "bead": solid.BEAD, "ring": solid.RING, "axis": _listed(solid.RING_AXIS),
        "halo": [solid.HALO_RADIUS, solid.HALO_INSIDE],
        "diamond": _solid(solid.OCTAHEDRON), "cube": _solid(solid.CUBE),
        "flat": {shape.value: [_part(part) for part in parts] for shape, parts in FLAT.items()},
        "type": PANE_TITLE, "em": EM,
        **{name: recorded.tables.colour(getattr(theme, name)) for name in ("background", "ink", "muted", "guess")},
        "pin": pins.SIZE, "tie": pins.TIE, "ground": pins.GROUND,
    }  # fmt: skip


def _solid(faces: Faces) -> Mapping[str, Any]:
    size = int(faces.sizes[0])
    return {"points": [_listed(p) for p in faces.points], "sides": faces.corners.reshape(-1, size).tolist()}


def _part(part: Disc | Ring | Polygon) -> Mapping[str, Any]:
    if isinstance(part, Polygon):
        return {"corners": part.corners, "width": part.width}
    return {"radius": part.radius, "width": part.width if isinstance(part, Ring) else 0}


def _listed(values: Any) -> list[float]:
    return [float(f"{n:.9g}") for n in values]

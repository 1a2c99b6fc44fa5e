"""The manual as one file, with its pictures inside: for any browser, without a network."""

import re
from base64 import b64encode
from collections.abc import Iterable
from html import escape
from pathlib import Path

from app.draw.markup import code
from app.draw.theme import THEMES
from app.manual.chapters import FOLDER, PICTURE, Chapter
from subdivision.files.saving import save

TITLE = "Subdivision Studio: the manual"


def page(chapters: Iterable[Chapter]) -> str:
    """All chapters one under another, their list before them; light or dark as the reader's system is."""
    those = tuple(chapters)
    listed = "".join(f'<li><a href="#{each.id}">{escape(each.title)}</a></li>\n' for each in those)
    whole = "\n".join(f'<section id="{each.id}">\n{each.html}\n</section>' for each in those)
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{TITLE}</title>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; img-src data:; '
        f"style-src 'unsafe-inline'\">\n<style>{_style()}</style>\n</head>\n<body>\n"
        f"<nav><b>{TITLE}</b>\n<ul>\n{listed}</ul></nav>\n<main>\n{PICTURE.sub(_inside, whole)}\n</main>\n"
        "</body>\n</html>\n"
    )


def write(path: Path, chapters: Iterable[Chapter]) -> Path:
    """The page in a file, whole or not at all."""
    save(path, (page(chapters).encode(),))
    return path


def _inside(found: re.Match[str]) -> str:
    data = b64encode((FOLDER / found[1]).read_bytes()).decode()
    return f'<img src="data:image/png;base64,{data}"'


def _style() -> str:
    light, dark = (_variables(name) for name in ("light", "dark"))
    return f":root{{{light};color-scheme:light dark}}\n@media (prefers-color-scheme:dark){{:root{{{dark}}}}}\n{STYLE}"


def _variables(theme: str) -> str:
    paints = THEMES[theme]
    roles = ("background", "panel", "ink", "muted", "accent")
    return ";".join(f"--{role}:{code(getattr(paints, role))}" for role in roles)


STYLE = """*{box-sizing:border-box}
body{margin:0;display:flex;background:var(--background);color:var(--ink);
font:1rem/1.55 Inter,system-ui,"Helvetica Neue",Arial,sans-serif}
nav{position:sticky;top:0;flex:0 0 16rem;height:100vh;overflow:auto;padding:1.5rem;background:var(--panel)}
nav ul{margin:1rem 0;padding:0;list-style:none}
nav a{text-decoration:none;line-height:1.9}
a{color:var(--accent)}
main{flex:1;min-width:0;max-width:52rem;padding:1.5rem 3rem 6rem}
section{padding-bottom:2rem}
h1{margin:2rem 0 1rem;font-size:2rem;line-height:1.2}
h2{margin:2.2rem 0 .6rem;font-size:1.3rem}
img{max-width:100%;height:auto;border-radius:.5rem}
table{border-collapse:collapse}
td,th{padding:.3rem .9rem .3rem 0;text-align:left;vertical-align:top}
code{font-size:.9em}
pre{padding:1rem;overflow:auto;background:var(--panel);border-radius:.5rem;line-height:1.4}
i{color:var(--muted)}
@media (max-width:60rem){body{display:block}nav{position:static;height:auto}main{padding:1rem}}
@media print{nav{display:none}h1{break-before:page}}
"""

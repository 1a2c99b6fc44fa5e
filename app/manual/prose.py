"""Words of a page of Markdown or of a docstring, as HTML of few tags, which every viewer knows."""

import re
from functools import cache
from inspect import cleandoc
from typing import Any

CITED = re.compile(r"\[(\w+)\]_")


@cache
def _reader() -> Any:
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"html": False}).enable("table")


def from_markdown(text: str) -> str:
    """A page of Markdown, with tables; no HTML of its own passes."""
    return str(_reader().render(text))


def from_docstring(text: str) -> str:
    """A docstring of this project: ``code`` in two backquotes, ``::`` before a block, sources as ``[Key]_``."""
    plain = cleandoc(text).replace("``", "`").replace("::\n", ":\n")
    return from_markdown(CITED.sub(r"[\1](#\1)", plain))

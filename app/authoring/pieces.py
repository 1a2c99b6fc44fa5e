"""Python as people write it: strings in pieces, lines that fit, imports in their order."""

import ast
import re
import tokenize
from collections.abc import Iterator
from dataclasses import fields
from typing import Any

from subdivision.words import phrase

WIDTH = 120
PIECE = 84
"""Letters of a sentence that stand together."""

OURS = ("lessons", "subdivision")
"""Packages that stand after all others, in alphabetical order."""


class RecordingError(ValueError):
    """Why a view cannot be recorded, in a sentence."""


def string(text: str) -> str:
    """A text as Python writes it, in the house's quotes: a formula raw, a long sentence in pieces."""
    is_raw = "\\" in text and '"' not in text and not text.endswith("\\") and text.isprintable()
    pieces = re.findall(rf".{{1,{PIECE}}}(?:\s+|$)|.{{1,{PIECE}}}(?<!\\)", str.__str__(text), re.DOTALL) or [""]
    return " ".join(f'r"{piece}"' if is_raw else _quoted(piece) for piece in pieces)


def _quoted(piece: str) -> str:
    plain = repr(piece)
    return f'"{plain[1:-1]}"' if plain[0] == "'" and '"' not in plain and "\\'" not in plain else plain


def number(at: float) -> str:
    """A number, a whole one without a point."""
    return str(int(at)) if at == int(at) else repr(float(at))


def plain(name: str, value: Any) -> str:
    """The call that makes a value of numbers, with those that are not as usual."""
    told = (f"{f.name}={float(getattr(value, f.name))!r}" for f in fields(value)
            if getattr(value, f.name) != f.default)  # fmt: skip
    return f"{name}({', '.join(told)})"


def wrapped(line: str, hang: int) -> str:
    """A statement in lines of at most ``WIDTH``, broken after commas and between strings."""
    lines, begin, room, places = [], 0, WIDTH, list(_places(line))
    while len(line) - begin > room:
        later = [
            (p > begin + room, p <= begin + room // 3, depth, abs(begin + room - p)) for depth, p in places if p > begin
        ]
        if not later:
            break
        best = min(later)
        at = begin + room + (best[3] if best[0] else -best[3])
        lines.append(line[begin:at])
        begin, room = at + 1, WIDTH - hang
    lines.append(line[begin:])
    return f"\n{' ' * hang}".join(lines)


def _places(line: str) -> Iterator[tuple[int, int]]:
    """Where a statement may be broken: how deep in brackets, and after how many letters."""
    depth, was_string = 0, -1
    for token in tokenize.generate_tokens(iter([line]).__next__):
        if was_string >= 0 and token.type == tokenize.STRING:
            yield depth, was_string
        depth += (token.string in tuple("([{")) - (token.string in tuple(")]}"))
        was_string = token.end[1] if token.type == tokenize.STRING else -1
        if token.string == ",":
            yield depth, token.end[1]


def whole(text: str) -> str:
    """A file that can be parsed: a new one has no body yet."""
    return f"{text}    pass\n" if text.rstrip().endswith(":") else text


def assignments(text: str) -> dict[str, str]:
    """Every expression that is assigned to one name in a lesson, and the name."""
    try:
        tree = ast.parse(whole(text))
    except SyntaxError as error:
        raise RecordingError(phrase("line {line} is not Python; mend it first", line=error.lineno or 0)) from None
    found = (node for node in ast.walk(tree) if isinstance(node, ast.Assign))
    return {ast.unparse(n.value): n.targets[0].id for n in found if isinstance(n.targets[0], ast.Name)}


def added(old: str, body: list[str], names: set[tuple[str, str]], file: str) -> str:
    """A file with lines at the end of its lesson, and with the names imported, ``module: name``, that they need.

    Raises
    ------
    RecordingError
        If there is no lesson in it.
    """
    tree = ast.parse(whole(old))
    told = [node for node in tree.body if isinstance(node, ast.FunctionDef) and _is_lesson(node)]
    if not told:
        raise RecordingError(phrase("{file} has no lesson to add to; choose another file", file=file))
    rows = old.splitlines()
    at = told[-1].end_lineno or len(rows)
    if whole(old) != old:
        rows += body
    else:
        rows[at:at] = ["", *body]
    return "\n".join(_with_imports(rows, tree, names)) + "\n"


def _is_lesson(node: ast.FunctionDef) -> bool:
    return any("lesson" in ast.unparse(each) for each in node.decorator_list)


def _with_imports(rows: list[str], tree: ast.Module, names: set[tuple[str, str]]) -> list[str]:
    """The file with what is not there yet imported, where it belongs."""
    nodes = [node for node in tree.body if isinstance(node, ast.ImportFrom)]
    there = {(node.module or "", alias.name) for node in nodes for alias in node.names}
    spans = {node.module: node for node in nodes if all(alias.asname is None for alias in node.names)}
    changes = []
    for module in sorted({module for module, _ in names - there}):
        wanted = {name for of, name in names - there if of == module}
        if (node := spans.get(module)) is not None:
            wanted |= {alias.name for alias in node.names}
            first, end = node.lineno - 1, node.end_lineno or node.lineno
        else:
            first = end = _place_for(module, tree)
        line = f"from {module} import {', '.join(sorted(wanted, key=lambda n: (not n.isupper(), n[0].islower(), n)))}"
        changes.append((first, end, [line] if len(line) <= WIDTH else _in_brackets(line)))
    found = list(rows)
    for first, end, lines in sorted(changes, reverse=True):  # from below, so that lines above keep their numbers
        found[first:end] = lines
    return found


def _place_for(module: str, tree: ast.Module) -> int:
    """After how many lines a module is imported: before the first one of ours that sorts after it."""
    ours = [n for n in tree.body if isinstance(n, ast.ImportFrom) and (n.module or "").split(".")[0] in OURS]
    if module.split(".")[0] not in OURS:
        return next((n.lineno - 1 for n in tree.body if isinstance(n, ast.Import | ast.ImportFrom)), 0)
    after = [n.lineno - 1 for n in ours if (n.module or "") > module]
    return min(after) if after else max((n.end_lineno or 0 for n in ours), default=_docstring_end(tree))


def _docstring_end(tree: ast.Module) -> int:
    first = tree.body[0]
    is_docstring = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return (first.end_lineno or 0) if is_docstring else 0


def _in_brackets(line: str) -> list[str]:
    head, _, names = line.partition(" import ")
    return [f"{head} import (", *(f"    {name}," for name in names.split(", ")), ")"]

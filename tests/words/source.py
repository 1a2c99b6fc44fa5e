"""Texts that the source shows, read off its syntax trees: no list to keep, so that none is forgotten."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

HOUSE = Path(__file__).parents[2]

SAID = {"tr", "phrase", "_said"}
"""Functions whose first argument is said."""

SHOWN = {"Choice", "Stepper", "Section", "Place", "Number", "heading", "addMenu", "setToolTip", "setText"}
"""What shows the words it is given."""

HIDDEN = {
    "setStyleSheet", "setObjectName", "compile", "getattr", "setStyle", "QFont", "TypeVar", "info", "debug", "warning",
    "error",
}
"""Calls whose words nobody reads."""

NAMES = {
    "Fusion", "Inter", "DejaVu Sans", "Left", "Right", "Up", "Down", "Window", "sharp edges", "sharp vertices",
    "hidden faces", "pointed at", "subdivision-studio session", "pointed out", "topology with face points", "in order",
    "format binary_little_endian 1.0", "property double x", "property double y", "property double z", "vertex {}",
    "Mapping[int, Exact]",
}
"""What reads like words, and is a name within the program or in a file."""

SENTENCE = re.compile(r"[A-Za-z{}’',;:.)…]{2,}[ \u00a0]+[(\"'{A-Za-z]")
"""Two words."""

WORD = re.compile(r"[A-Z][a-z’]+(…| |$)")
"""A word as a menu has it."""

MARKUP = re.compile(r"^[<#/.]|</|=\"|: ?#|\w+\(\)|^[a-z-]+: |; *[a-z-]+: ?[\w#]|px|\\|^\W*$|=> \{|^\"\"\"|^ {4}|\{:")


class Text(NamedTuple):
    """What is said, where it stands, and what is said for another number than one."""

    text: str
    file: str
    many: str = ""


def texts(*folders: str) -> Iterator[Text]:
    """All texts of the source below some folders."""
    for folder in folders:
        for path in sorted((HOUSE / folder).rglob("*.py")):
            name = path.relative_to(HOUSE).as_posix()
            yield from _Reader(name).read(ast.parse(path.read_text(encoding="utf-8")))


class _Reader(ast.NodeVisitor):
    def __init__(self, file: str) -> None:
        self.file, self.found = file, list[Text]()
        self.is_window = file.startswith("app/gui/")

    def read(self, tree: ast.Module) -> list[Text]:
        self.visit(tree)
        return self.found

    def visit_Expr(self, node: ast.Expr) -> None:
        if not isinstance(node.value, ast.Constant):  # else it documents
            self.generic_visit(node)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        for each in node.values:
            if isinstance(each, ast.FormattedValue):
                self.visit(each.value)

    def visit_Dict(self, node: ast.Dict) -> None:
        for value in node.values:
            self.visit(value)

    def visit_Subscript(self, node: ast.Subscript) -> None:
        self.visit(node.value)

    def visit_Compare(self, node: ast.Compare) -> None:
        for call in [each for each in ast.walk(node) if isinstance(each, ast.Call)]:
            self.visit(call)

    def visit_Call(self, node: ast.Call) -> None:
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        if name == "plural":
            one, many = (each.value for each in node.args[:2])
            self.found.append(Text(one, self.file, many))
        elif name in SAID | SHOWN:
            for text in _constants(node.args[0]) if node.args else ():
                self.found.append(Text(text, self.file))
        for keyword in node.keywords:
            if keyword.arg == "help":
                self.found.extend(Text(text, self.file) for text in _constants(keyword.value))
        if name not in HIDDEN:
            self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        if isinstance(node.value, str) and is_said(node.value, self.is_window):
            self.found.append(Text(node.value, self.file))


def _constants(node: ast.expr) -> Iterator[str]:
    """The texts an argument may be."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from (*_constants(node.body), *_constants(node.orelse))


def is_said(text: str, in_window: bool) -> bool:
    """Whether a constant reads like something for people: two words, or a word of the window."""
    if text in NAMES or MARKUP.search(text):
        return False
    return bool(SENTENCE.search(text)) or (in_window and bool(WORD.match(text)))

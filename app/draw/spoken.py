"""A picture in another language: every text on it said by ``tr``, formulas and numbers as they are."""

from dataclasses import replace
from typing import Any, TypeVar

from app.draw.picture import Bar, Box, Diagram, Entry, Label, Note, Pane, Picture, Scene
from app.words import ENGLISH, language, tr

Part = TypeVar("Part", Picture, Pane, Scene, Bar, Label, Entry, Box, Note)


def translated(picture: Picture) -> Picture:
    """The picture in the language that is spoken; a caption has been said with the names of its colours already."""
    if language() == ENGLISH:
        return picture
    legend = tuple(_said(entry, "text") for entry in picture.legend)
    return replace(_said(picture, "title", "corner"), legend=legend, panes=tuple(_pane(pane) for pane in picture.panes))


def _pane(pane: Pane) -> Pane:
    content = pane.content
    spoken = _diagram(content) if isinstance(content, Diagram) else _scene(content)
    return replace(_said(pane, "title", "reading"), content=spoken)


def _scene(scene: Scene) -> Scene:
    bar = _said(scene.bar, "title") if scene.bar is not None else None
    return replace(_said(scene, "remark"), labels=tuple(_said(each, "text") for each in scene.labels), bar=bar)


def _diagram(diagram: Diagram) -> Diagram:
    boxes = tuple(_changed(box, texts=tuple(map(tr, box.texts))) for box in diagram.boxes)
    return replace(diagram, boxes=boxes, notes=tuple(_said(note, "text") for note in diagram.notes))


def _said(part: Part, *names: str) -> Part:
    """The part with the texts of these names translated."""
    return _changed(part, **{name: tr(getattr(part, name)) for name in names})


def _changed(part: Part, **texts: Any) -> Part:
    """With other texts; the part itself where none is another."""
    is_other = any(getattr(part, name) != text for name, text in texts.items())
    return replace(part, **texts) if is_other else part

"""The picture of a state from where the hand has turned it: what is on the screen is what is taken away."""

from dataclasses import replace

from app.draw.fading import faded
from app.draw.picture import Picture, Scene
from app.draw.turned import turned
from app.state import State
from lessons.turn import REST, Turn


def seen(state: State) -> Picture:
    """The picture of a state as the hand has turned it."""
    return from_there(faded(state), state.turn)


def from_there(picture: Picture, turn: Turn) -> Picture:
    """A picture whose scenes are seen from elsewhere."""
    if turn == REST:
        return picture
    panes = (
        replace(pane, content=replace(pane.content, camera=turned(pane.content.camera, turn)))
        if isinstance(pane.content, Scene)
        else pane
        for pane in picture.panes
    )
    return replace(picture, panes=tuple(panes))

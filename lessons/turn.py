"""How the hand turns the lesson's camera: a value that applies to every pane alike, so that panes stay linked."""

from dataclasses import dataclass, replace

import numpy as np

NEAREST, FARTHEST = 30.0, 0.15
"""Between these the magnification stays."""


@dataclass(frozen=True)
class Turn:
    """Radians round the vertical and upwards; magnification; shift in heights of the untouched view."""

    around: float = 0.0
    over: float = 0.0
    zoom: float = 1.0
    right: float = 0.0
    up: float = 0.0

    def rotated(self, across: float, down: float) -> "Turn":
        """After a drag by parts of the view's height: half a turn for one height."""
        return replace(self, around=self.around - np.pi * across, over=self.over + np.pi * down)

    def panned(self, across: float, down: float) -> "Turn":
        """After a drag by parts of the view's height: what was under the mouse stays under it."""
        return replace(self, right=self.right - across / self.zoom, up=self.up + down / self.zoom)

    def zoomed(self, factor: float, across: float = 0.0, down: float = 0.0) -> "Turn":
        """Magnified about a place ``across`` and ``down`` from the middle, in parts of the view's height."""
        zoom = float(np.clip(self.zoom * factor, FARTHEST, NEAREST))
        kept = 1 / self.zoom - 1 / zoom
        return replace(self, zoom=zoom, right=self.right + across * kept, up=self.up - down * kept)


REST = Turn()
"""The camera where the lesson has it."""

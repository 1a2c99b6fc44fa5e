"""What is on the screen, to take away: the view, the lesson or everything, as pictures, films, paper or meshes."""

from app.export.making import export
from app.export.wish import FORMATS, SCOPES, ExportError, Format, Wish

__all__ = ["FORMATS", "SCOPES", "ExportError", "Format", "Wish", "export"]

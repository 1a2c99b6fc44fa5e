"""The sources, as ``assets/references.bib`` lists them."""

from app import ASSETS


def references() -> dict[str, str]:
    """Key -> the entry in HTML, in the order of the authors' names."""
    from pybtex.database import parse_file
    from pybtex.plugin import find_plugin

    style, writer = find_plugin("pybtex.style.formatting", "plain")(), find_plugin("pybtex.backends", "html")()
    entries = style.format_bibliography(parse_file(str(ASSETS / "references.bib")))
    found = {entry.key: entry.text.render(writer) for entry in entries}
    return {key: _plain(text) for key, text in found.items()}


def _plain(text: str) -> str:
    """What guards capitals in BibTeX goes, and a root is a root."""
    for tag in ('<span class="bibtex-protected">', "</span>"):
        text = text.replace(tag, "")
    return text.replace(r"$\sqrt 3$", "√3").replace("&nbsp;", " ").replace("\n", " ")

"""The chapters of the manual, in order."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from sys import modules

import lessons
from app import ASSETS
from app.draw.compose import said
from app.manual.prose import from_docstring, from_markdown
from app.manual.references import references
from app.state import at_stop, start, stops
from app.words import tr
from lessons.script import Beat, Lesson
from subdivision.catalogue import FAMILIES, Family, Parameter, scheme
from subdivision.words import phrase

FOLDER = ASSETS / "manual"

WRITTEN = (
    ("first_steps", "First steps"),
    ("window", "The window"),
    ("presenting", "Presenting"),
    ("questions", "Questions to the class"),
    ("laboratory", "The laboratory"),
    ("taking_away", "Taking it away"),
    ("commands", "Without the window"),
    ("authoring", "Lessons of your own"),
)
"""File and title of each chapter in ``assets/manual``."""

WIDTH, WIDE = 560, 720
"""Of a lesson's picture and of the window's, in pixels."""

PICTURE = re.compile(r'<img src="(pictures/[\w.-]+\.png)"')

Keys = Mapping[str, Sequence[tuple[str, Sequence[str]]]]
"""Group -> (what a command does, its keys)."""


@dataclass(frozen=True)
class Chapter:
    """``html`` begins with its title; pictures in it are named relative to ``assets/manual``."""

    id: str
    title: str
    html: str


def chapters(keys: Keys) -> tuple[Chapter, ...]:
    """The whole manual; the keys are the window's.  Lessons have to be told, so it takes a while."""
    *before, commands, authoring = written()
    return (*before, *lesson_chapters(), schemes(), key_table(keys), commands, authoring, sources())


def written() -> tuple[Chapter, ...]:
    """The chapters that stand in files."""
    return tuple(Chapter(id_, tr(title), _headed(tr(title), _written(id_))) for id_, title in WRITTEN)


def _headed(title: str, html: str) -> str:
    return f"<h1>{escape(title)}</h1>\n{html}"


def _written(name: str) -> str:
    """A page of the folder without its own first heading."""
    text = (FOLDER / f"{name}.md").read_text(encoding="utf-8")
    made = from_markdown(text.split("\n", 1)[1] if text.startswith("# ") else text)
    return PICTURE.sub(lambda found: f'{found[0]} width="{_width(found[1])}"', made)


def _width(picture: str) -> int:
    """As wide as it is, up to ``WIDE``."""
    from PIL import Image

    with Image.open(FOLDER / picture) as found:
        return min(found.width, WIDE)


# -- lessons ----------------------------------------------------------------------------------


def lesson_chapters() -> Iterator[Chapter]:
    """A chapter for every section of the lecture."""
    for section, those in groupby(lessons.all_lessons(), key=lambda each: each.section):
        title = tr(section)
        yield Chapter(f"lessons-{section.split()[0].lower()}", title, _headed(title, "\n".join(map(_lesson, those))))


def _lesson(lesson: Lesson) -> str:
    state = start(lesson)
    places = {stop.beat: stop for stop in stops(state.lesson)}
    steps = [_step(beat, said(at_stop(state, places[k]), beat)) for k, beat in enumerate(state.lesson.beats)]
    picture = f'<p><img src="pictures/{lesson.id}.png" alt="{escape(tr(lesson.title))}" width="{WIDTH}"></p>'
    ours = f"<p><b>{tr('Not in the lecture')}:</b> {escape(tr(lesson.ours))}</p>" if lesson.ours else ""
    turned = ", ".join(f"{tr(knob.label)} {knob.least} – {knob.most}" for knob in lesson.knobs)
    knobs = f"<p><b>{tr('To turn')}:</b> {escape(turned)}.</p>" if turned else ""
    name = f'<h2 id="{lesson.id}">{escape(" ".join(tr(lesson.title).split()))}</h2>'
    return f"{name}\n{picture}\n<ol>{''.join(steps)}</ol>\n{knobs}{ours}"


def _step(beat: Beat, caption: str) -> str:
    notes = f"<br><i>{escape(tr(beat.notes))}</i>" if beat.notes else ""
    return f"<li>{escape(caption.replace('$', ''))}{notes}</li>\n"


# -- schemes, keys, sources -------------------------------------------------------------------


def schemes() -> Chapter:
    """Every scheme of the laboratory: what it is, how it can be told, where it comes from."""
    title = tr("Schemes")
    lead = f"<p>{tr('What the laboratory offers. A telling is a way to reach the same points by other stages.')}</p>\n"
    return Chapter("schemes", title, _headed(title, lead + "\n".join(map(_scheme, FAMILIES.values()))))


def _scheme(family: Family) -> str:
    made = scheme(family.name)
    tellings = ", ".join(tr(each) for each in made.tellings)
    numbers = "; ".join(map(_range, family.parameters))
    parameters = f"<br><b>{tr('To choose')}:</b> {escape(numbers)}" if numbers else ""
    paper = f'<br><b>{tr("Source")}:</b> <a href="#{made.paper}">{made.paper}</a>' if made.paper else ""
    about = from_docstring(_told_by(family))
    told = f"<p><b>{tr('Told by')}:</b> {escape(tellings)}{parameters}{paper}</p>"
    return f"<h2>{escape(tr(family.title))}</h2>\n{about}{told}"


def _range(p: Parameter) -> str:
    name, start = tr(p.name), f"{p.start}"
    return (
        name
        if p.is_vectors
        else tr(
            phrase(
                "{name} from {least} to {most}, at first {start}", name=name, least=p.least, most=p.most, start=start
            )
        )
    )


def _told_by(family: Family) -> str:
    """The docstring of the file that the scheme is written in."""
    made = scheme(family.name)
    first = next(iter(made.tellings.values()))
    files = [module for name, module in modules.items() if name.startswith("subdivision.schemes.")]
    own = (module for module in files if any(value is made for value in vars(module).values()))
    telling = modules[getattr(first, "func", first).__module__]
    return next(own, telling).__doc__ or ""


def key_table(keys: Keys) -> Chapter:
    """Every command that has a key."""
    title, parts = tr("Keys"), []
    for group, those in keys.items():
        rows = "".join(f"<tr><td>{escape(', '.join(k))}</td><td>{escape(what)}</td></tr>\n" for what, k in those)
        parts.append(f'<h2>{escape(tr(group))}</h2>\n<table cellpadding="4">\n{rows}</table>')
    return Chapter("keys", title, _headed(title, "\n".join(parts)))


def sources() -> Chapter:
    """The papers that docstrings and schemes name."""
    title = tr("Sources")
    rows = [f'<p><a name="{key}" id="{key}"></a><b>{key}</b> {text}</p>' for key, text in references().items()]
    return Chapter("sources", title, _headed(title, "\n".join(rows)))

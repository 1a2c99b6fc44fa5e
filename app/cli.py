"""The command line.  Anything slow to import waits until a command needs it."""

import argparse
import errno
import gc
import json
import os
import signal
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import groupby
from pathlib import Path
from time import perf_counter
from typing import Any

import lessons
from app.draw.theme import THEMES
from app.figures import BACKGROUNDS, FORMATS, LEAST, MOST, FigureError
from app.state import State
from app.words import LANGUAGES, speak, system_language, tr
from lessons import own
from lessons.script import Lesson
from subdivision import Boundary, Mesh, TopologyError, files, subdivide
from subdivision.continuity import alpha, checked_vectors, degree, mask, promise, smoothness
from subdivision.exact import Exact, spelled
from subdivision.schemes import SCHEMES
from subdivision.size import STAGED, require_room
from subdivision.words import joined, phrase

NAMES = {s.name: s for s in SCHEMES}

MOST_NAMES = 12
"""More points of the same weight are named by the first and the last."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; 0 if all went well, 1 after a fault told in a sentence, 2 after a misuse, else ``BUG``."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    speak(_wished(arguments) or system_language())
    parser, commands = _parsers()
    chosen = commands[arguments.pop(0)] if arguments and arguments[0] in commands else parser
    options = chosen.parse_args(arguments)
    if argv is None and options.run is not open_window:  # a program to be ended: what it has half written goes
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    try:
        _bring(options)
        status = int(options.run(options) or 0)
        sys.stdout.flush()  # here, where what is wrong with it can be told
        return status
    except (TopologyError, files.FileError, Fault) as fault:
        print(f"subdivision-studio: {tr(str(fault))}", file=sys.stderr)
        return 1
    except MemoryError:
        sentence = tr("there is not enough memory for this; choose fewer levels")
        print(f"subdivision-studio: {sentence}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except BrokenPipeError:  # the reader of our output, such as head, has had enough
        sys.stderr.close()
        return 0
    except OSError as fault:
        return _unprinted(fault) if fault.errno in (errno.ENOSPC, errno.EIO) and fault.filename is None else _bug()
    except Exception:
        return _bug()


def _unprinted(fault: OSError) -> int:
    """Say that what was printed has found no room; nothing more is tried there."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    sentence = phrase("what was printed could not be written ({reason}); print it elsewhere", reason=fault.strerror)
    print(f"subdivision-studio: {tr(sentence)}", file=sys.stderr)
    return 1


def _bug() -> int:
    """Say that something is wrong inside the program; the traceback goes to the log."""
    from app.log import BUG, LOG, keep_log

    log = keep_log()
    LOG.critical("uncaught", exc_info=True)
    sentence = tr(phrase("something went wrong inside the program; the details are in {log}", log=log))
    print(f"subdivision-studio: {sentence}", file=sys.stderr)
    return BUG


def _wished(arguments: Sequence[str]) -> str:
    """The language that is asked for, known before anything is said; "": none."""
    _, _, asked = " ".join(arguments).replace("=", " ").partition("--language ")
    code = asked.split(" ")[0]
    return code if code in LANGUAGES else ""


class Fault(Exception):
    """What went wrong, in a sentence for the user."""


def _bring(options: argparse.Namespace) -> None:
    """Have the lessons of the folder that is named with ``--lessons``; what is wrong with some of them is said.

    The window asks for itself whether a folder may run, and opens the one that was open last.
    """
    named: Path | None = getattr(options, "own", None)
    if named is None and options.run is not open_window:
        return
    from app.authoring import shelf

    place, is_window = shelf.usual_place(), options.run is open_window
    kept = shelf.remembered(place)
    if (folder := named or (Path(kept.folder) if kept.folder else None)) is None:
        return
    if not (folder.is_dir() or (is_window and named is None)):
        raise Fault(shelf.no_folder(folder))
    if options.trust or kept.is_agreed(folder):
        with suppress(OSError):  # what cannot be remembered is tried again next time
            found = shelf.opened(folder, kept, _warn, shelf.tried_now if named else lambda path, taken: None)
            lessons.bring(each for those in found.found.values() for each in those)
            for fault in found.faults:
                _warn(fault)
            shelf.remember(place, found.shelf)
    elif not is_window:
        raise Fault(
            phrase(
                "lessons are programs, and those in {folder} have not been agreed to; read them, then add --trust",
                folder=folder,
            )
        )


def _warn(fault: own.Fault) -> None:
    print(f"subdivision-studio: {fault.sentence}", file=sys.stderr)


def open_window(options: argparse.Namespace) -> int:
    """Open the window, at a lesson and a step if they are named; or at what a link or a file holds."""
    gc.disable()  # until it is open: what a start makes stays, and to look for garbage in it takes a tenth of the time
    try:
        return _opened(options)
    finally:
        gc.enable()


def _opened(options: argparse.Namespace) -> int:
    from app.sessions.opening import meant
    from app.sessions.strict import KeepingError

    try:
        found = meant(options.lesson or "")
    except KeepingError as fault:
        raise Fault(str(fault)) from fault
    if found is not None:
        return _open(*found, options)
    if options.set and not options.lesson:
        raise Fault("--set turns a knob of a lesson: name the lesson before it, such as 1 --set degree=5")
    (chosen,) = _turned([_to_open(options)], dict(options.set)) if options.lesson else (None,)
    from app.gui.application import run

    return run(
        chosen,
        options.step,
        options.theme,
        options.as_caption,
        own=options.own,
        is_trusted=options.trust,
        language=options.language or "",
    )


def _to_open(options: argparse.Namespace) -> Lesson:
    """The lesson that is named; one of a folder that was not agreed to is not there yet."""
    try:
        return _lesson(options.lesson)
    except Fault:
        if options.own is None or options.trust:
            raise
        raise Fault(
            phrase(
                "there is no lesson '{name}' that may run; if it is one of those in {folder}, leave its name out, "
                "agree to the folder in the window, and name it the next time; or add --trust",
                name=options.lesson,
                folder=options.own,
            )
        ) from None


def _open(opening: Callable[[State], State], path: Path | None, options: argparse.Namespace) -> int:
    """Open the window at what was found, in the looks that are wished for."""
    if options.set or options.step:
        raise Fault("--set and --step go with a lesson; a link or a file has a place of its own: leave them out")
    from app.gui.application import run
    from app.state import choose

    wished = {"theme": options.theme, "as_caption": options.as_caption}
    looks = {name: value for name, value in wished.items() if value}
    return run(theme=options.theme, opening=lambda state: choose(opening(state), **looks), path=path,
               own=options.own, is_trusted=options.trust, language=options.language or "")  # fmt: skip


def list_lessons(options: argparse.Namespace) -> None:
    """Print every lesson under the heading of its section: id, number of steps, title."""
    from app.state import stops

    listed = lessons.all_lessons()
    if options.json:
        print(json.dumps([
            {"id": each.id, "title": each.title, "section": each.section, "steps": len(stops(each)),
             "knobs": [vars(knob) for knob in each.knobs], "ours": each.ours}
            for each in listed
        ], indent=2, ensure_ascii=False))  # fmt: skip
        return
    width = max(len(each.id) for each in listed)
    for section, those in groupby(listed, key=lambda each: each.section):
        print(tr(section))
        for each in those:
            steps = tr(phrase("{n:>3} steps", n=len(stops(each))))
            print(f"  {each.id:<{width}}  {steps}  {tr(each.title)}")


def draw_figures(options: argparse.Namespace) -> None:
    """Render lessons to files, and a page that shows them."""
    from app import gallery

    named = {_lesson(name) for name in options.lessons}
    chosen = _turned([each for each in lessons.all_lessons() if each in named or not named], dict(options.set))
    drawn = gallery.Drawn(
        options.format, options.size, options.background, options.theme, options.steps, options.as_caption,
        options.scale,
    )  # fmt: skip
    begin = perf_counter()
    written = 0
    try:
        for path in gallery.draw(chosen, options.out, drawn):
            print(path, flush=True)
            written += 1
        if options.sheet is not None:
            print(gallery.draw_sheet(chosen, options.sheet, drawn))
            written += 1
    except FigureError as fault:
        raise Fault(str(fault)) from fault
    took = phrase("{written} files in {seconds:.1f} s", written=written, seconds=perf_counter() - begin)
    print(tr(took), file=sys.stderr)


def export_files(options: argparse.Namespace) -> None:
    """Write the view, the lesson or everything in one of the formats to take away."""
    from app import export

    state, out = _to_export(options), options.output
    suffixes = {kind.suffix: name for name, kind in [*export.FORMATS.items()][::-1]}
    of = options.of or ("view" if options.step else "lesson" if options.what else "everything")
    try:
        if (chosen := options.format or suffixes.get(out.suffix.lower(), "")) == "":
            raise Fault(
                phrase(
                    "{out} does not say in which format: end it in one of {suffixes}, or add --format",
                    out=out,
                    suffixes=" ".join(suffixes),
                )
            )
        wish = export.Wish(
            chosen, of, options.size, options.background, options.pace, options.level, options.limit
        )  # fmt: skip
        if options.progress:
            from app.export.worker import reported

            written = reported(state, wish, out)
        else:
            written = export.export(state, wish, out)
    except export.ExportError as fault:
        raise Fault(str(fault)) from fault
    for path in written:
        print(path)


def _to_export(options: argparse.Namespace) -> State:
    """The state that is meant: of a session, a link or a mesh as it was, else a lesson at its step or its end."""
    from app.sessions.opening import meant
    from app.sessions.strict import KeepingError
    from app.state import Options, choose, last, open_lesson, start

    looks = Options(theme=options.theme or "light", as_caption=options.as_caption, scale=options.scale)
    try:
        found = meant(options.what or "")
    except KeepingError as fault:
        raise Fault(str(fault)) from fault
    if found is not None:
        if options.set or options.step:
            raise Fault("--set and --step go with a lesson; a link or a file has a place of its own: leave them out")
        state = found[0](start(lessons.all_lessons()[0], looks))
        return choose(state, as_caption=True) if options.as_caption else state
    named = _lesson(options.what) if options.what else lessons.all_lessons()[0]
    state = start(_turned([named], dict(options.set))[0], looks)
    return open_lesson(state, state.lesson, options.step - 1) if options.step else last(state)


def write_page(options: argparse.Namespace) -> None:
    """Write a lesson as one HTML file that plays by itself."""
    from app.page import write_page_of
    from app.state import Options, start

    (chosen,) = _turned([_lesson(options.lesson)], dict(options.set))
    path = options.output or Path(f"{chosen.id}.html")
    try:
        size = write_page_of(start(chosen, Options(as_caption=options.as_caption, asking=options.questions)), path)
    except FigureError as fault:
        raise Fault(str(fault)) from fault
    print(tr(phrase("{path}: {size:.0f} kB, opens in any browser", path=path, size=size / 1000)))


def write_manual(options: argparse.Namespace) -> None:
    """Write the manual as one HTML file."""
    from app.gui.sheets import rows
    from app.manual.chapters import chapters
    from app.manual.page import write

    try:
        print(write(options.output, chapters(rows())))
    except OSError as fault:
        raise Fault(phrase("{path} cannot be written: {reason}", path=options.output, reason=fault.strerror)) from fault


def subdivide_file(options: argparse.Namespace) -> None:
    """Read a mesh, subdivide it, write it."""
    mesh = files.read(options.input)
    scheme = NAMES[options.scheme]
    control = Mesh(mesh.surface.with_boundary(Boundary(options.boundary)), mesh.points)
    require_room(scheme, control.surface, options.levels, STAGED, options.most_faces)  # a file wants all of it
    fine = subdivide(control, scheme, options.levels, most=options.most_faces)
    if options.limit:
        from subdivision.limit import limit_points

        fine = Mesh(fine.topology, limit_points(fine, scheme)[: fine.topology.n_vertices])
    files.write(options.output, fine)
    t = fine.topology
    faces = int((~t.hidden).sum())
    print(tr(phrase("{path}: {n} vertices, {faces} faces", path=options.output, n=t.n_vertices, faces=faces)))


def print_stencil(options: argparse.Namespace) -> None:
    """Print exact weights at a valence."""
    from subdivision.spectrum import stencil_by_valence

    scheme = NAMES[options.scheme]
    terms = stencil_by_valence(scheme, options.valence, options.point).terms
    if options.json:
        exact = {name: {"weight": str(w), "value": float(w)} for name, w in terms}
        head = {"scheme": scheme.name, "valence": options.valence, "point": options.point}
        print(json.dumps({**head, "weights": exact}, indent=2, ensure_ascii=False))
        return
    heading = phrase(HEADINGS[options.point], scheme=scheme.title, valence=options.valence)
    print(tr(heading))
    grouped = groupby(terms, key=lambda term: term[1])
    rows = [(_listed([name for name, _ in alike]), _written(w)) for w, alike in grouped]
    rows.append((tr(phrase("sum")), spelled(sum((w for _, w in terms), Fraction(0)))))
    width = max(len(names) for names, _ in rows)
    for names, w in rows:
        print(f"  {names:<{width}}  {w}" + (tr(phrase(" each")) if " " in names else ""))


HEADINGS = {
    "vertex": "{scheme}: vertex point at valence {valence}",
    "edge": "{scheme}: edge point at valence {valence}",
    "face": "{scheme}: face point at valence {valence}",
}


def print_mask(options: argparse.Namespace) -> None:
    """Print a box spline's mask and what its vector set promises."""
    vectors = checked_vectors(options.vectors)
    table = mask(vectors)
    if options.json:
        print(json.dumps({
            "vectors": vectors, "degree": degree(vectors), "alpha": alpha(vectors), "continuity": smoothness(vectors),
            "origin": table.origin, "mask": [[str(c) for c in row] for row in table.rows], "promise": promise(vectors),
        }, indent=2))  # fmt: skip
        return
    below = max(c.denominator for row in table.rows for c in row)
    width = max(len(str(int(c * below))) for row in table.rows for c in row)
    print(tr(phrase("1/{below} times", below=below)))
    for row in table.rows:
        print("  " + " ".join(f"{int(c * below):>{width}}" for c in row))
    x, y = table.origin
    print(tr(phrase("rows: powers of x from {x}   columns: powers of y from {y}", x=x, y=y)))
    numbers = {"degree": degree(vectors), "alpha": alpha(vectors), "k": smoothness(vectors)}
    print(tr(phrase("degree {degree}, alpha {alpha}, continuity C^{k}", **numbers)))
    print(tr(promise(vectors)))


class _Parser(argparse.ArgumentParser):
    """Helps in the reader's language."""

    def __init__(self, prog: str, description: str, **how: Any) -> None:
        super().__init__(prog=prog, description=tr(description), add_help=False, **how)
        self.add_argument("-h", "--help", action="help", help="show this help and end")
        self.add_argument("--language", choices=LANGUAGES, help="of all words; else the system's")

    def add_argument(self, *names: Any, **how: Any) -> argparse.Action:
        told = {"help": tr(how["help"])} if "help" in how else {}
        return super().add_argument(*names, **{**how, **told})

    def format_help(self) -> str:
        found = super().format_help()
        for words in (phrase("usage:"), phrase("positional arguments:"), phrase("options:")):
            found = found.replace(words, tr(words), 1)
        return found


def _parsers() -> tuple[argparse.ArgumentParser, dict[str, argparse.ArgumentParser]]:
    parser = _Parser(
        prog="subdivision-studio",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Watch subdivision curves and surfaces happen, one stage at a time.",
        epilog=tr("commands (each has --help):")
        + "".join(f"\n  {name:<10} {tr(text)}" for name, (_, text) in COMMANDS.items()),
    )
    parser.add_argument(
        "lesson", nargs="?", metavar="LESSON",
        help="open at this lesson: a figure's number, or an id; or a link, a session, a mesh",
    )  # fmt: skip
    parser.add_argument("--step", type=_counting, metavar="N", help="... and at its N-th step, from 1")
    _looks(parser)
    parser.set_defaults(run=open_window)
    commands = {name: _command(name, text, build) for name, (build, text) in COMMANDS.items()}
    return parser, commands


def _command(name: str, text: str, build: Callable[[argparse.ArgumentParser], None]) -> argparse.ArgumentParser:
    parser = _Parser(prog=f"subdivision-studio {name}", description=text)
    build(parser)
    return parser


def _for_lessons(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="as JSON")
    _from_elsewhere(parser)
    parser.set_defaults(run=list_lessons)


def _for_figures(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("lessons", nargs="*", metavar="LESSON", help="which lessons; none: all")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where to; made if it is not there")
    parser.add_argument(
        "--format", type=_formats, default=("png", "svg"), metavar="F,F",
        help=phrase("some of {names} (png,svg)", names=",".join(FORMATS)),
    )  # fmt: skip
    parser.add_argument("--size", type=_size, default=(1920, 1080), metavar="WxH", help="in pixels (1920x1080)")
    parser.add_argument("--background", choices=BACKGROUNDS, default="", help="white, or that of the theme named")
    parser.add_argument("--steps", action="store_true", help="one image for each step")
    _scale(parser)
    parser.add_argument("--sheet", type=Path, metavar="PNG", help="also one picture of them all, small, in this file")
    _looks(parser)
    parser.set_defaults(run=draw_figures)


def _for_export(parser: argparse.ArgumentParser) -> None:
    from app.export.wish import FASTEST, FORMATS, SCOPES, SLOWEST

    listed = joined("; ", (phrase("{name}: {kind}", name=name, kind=kind.title) for name, kind in FORMATS.items()))
    parser.add_argument(
        "what", nargs="?", metavar="WHAT", help="a lesson, a session, a link or a mesh; none: the whole lecture"
    )
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="OUT",
        help="the file, whose suffix says the format; or, where there are several, their folder",
    )  # fmt: skip
    parser.add_argument("--format", choices=list(FORMATS), default="", metavar="F", help=listed)
    parser.add_argument("--of", choices=SCOPES, default="", help="view: only what is shown; lesson; everything")
    parser.add_argument("--step", type=_counting, metavar="N", help="only the lesson's N-th step, from 1")
    parser.add_argument("--size", type=_size, default=(1920, 1080), metavar="WxH", help="in pixels (1920x1080)")
    _scale(parser)
    parser.add_argument("--background", choices=BACKGROUNDS, default="theme", help="the theme's own, if not named")
    parser.add_argument(
        "--pace", type=float, default=1.0, metavar="X",
        help=phrase("of a film: 2 is twice as fast ({least:g} to {most:g})", least=SLOWEST, most=FASTEST),
    )  # fmt: skip
    parser.add_argument("--level", type=_whole, metavar="N", help="of a view's mesh: not the one shown, but level N")
    parser.add_argument("--limit", action="store_true", help="push a mesh's vertices to the limit surface")
    parser.add_argument("--progress", action="store_true", help=argparse.SUPPRESS)
    _looks(parser)
    parser.set_defaults(run=export_files)


def _for_page(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("lesson", metavar="LESSON", help="a figure's number, or an id")
    parser.add_argument("-o", "--output", type=Path, metavar="OUT", help="an HTML file (the lesson's id)")
    parser.add_argument("--questions", action="store_true", help="ask for predictions before the answers are shown")
    _colours_and_knobs(parser)
    parser.set_defaults(run=write_page)


def _from_elsewhere(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--lessons", type=Path, dest="own", metavar="DIR", help="also the lessons in this folder")
    parser.add_argument(
        "--trust", action="store_true", help="... which are programs: run them without having agreed in the window"
    )


def _scale(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--scale", type=_percent, default=1.0, metavar="PERCENT",
        help="how large type, strokes and points are, up to 250 and as far as there is room (100)",
    )  # fmt: skip


def _looks(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--theme", choices=list(THEMES), default="")
    _colours_and_knobs(parser)


def _colours_and_knobs(parser: argparse.ArgumentParser) -> None:
    _from_elsewhere(parser)
    parser.add_argument("--as-caption", action="store_true", help="colours as in the lecture's own captions")
    parser.add_argument(
        "--set", type=_setting, action="append", default=[], metavar="NAME=VALUE",
        help="turn a lesson's knob, such as degree=5; 'lessons --json' lists them",
    )  # fmt: skip


def _for_subdivide(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("input", type=Path, metavar="IN", help="an OBJ, OFF, PLY or STL file")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="OUT", help="an OBJ, PLY, STL or glTF (.glb) file"
    )
    parser.add_argument("--scheme", choices=list(NAMES), required=True)
    parser.add_argument("--levels", type=_whole, required=True, metavar="N")
    parser.add_argument("--boundary", choices=[b.value for b in Boundary], default=Boundary.EDGE.value)
    parser.add_argument("--limit", action="store_true", help="push the vertices to the limit surface")
    parser.add_argument(
        "--most-faces", type=_counting, metavar="N", help="make no more than so many (as many as the memory holds)"
    )
    parser.set_defaults(run=subdivide_file)


def _for_stencil(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--scheme", choices=list(NAMES), required=True)
    parser.add_argument("--valence", type=_counting, required=True, metavar="N")
    parser.add_argument("--point", choices=("vertex", "edge", "face"), default="vertex")
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.set_defaults(run=print_stencil)


def _for_mask(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--vectors", type=_vectors, required=True, metavar='"1,0 0,1 1,1"')
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.set_defaults(run=print_mask)


def _for_manual(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("-o", "--output", type=Path, default=Path("manual.html"), help="file (manual.html)")
    parser.set_defaults(run=write_manual)


COMMANDS: dict[str, tuple[Callable[[argparse.ArgumentParser], None], str]] = {
    "lessons": (_for_lessons, "list the lessons"),
    "figures": (_for_figures, "render lessons to pictures; needs no screen"),
    "export": (_for_export, "take away pictures, films, slides, a handout, meshes; needs no screen"),
    "page": (_for_page, "write a lesson as one HTML file that plays by itself"),
    "subdivide": (_for_subdivide, "subdivide a mesh file"),
    "stencil": (_for_stencil, "print exact weights at a valence"),
    "mask": (_for_mask, "print a box spline's mask, degree and continuity"),
    "manual": (_for_manual, "write the manual as one HTML file"),
}


def _lesson(name: str) -> Lesson:
    try:
        return lessons.find(name)
    except KeyError as unknown:
        raise Fault(unknown.args[0]) from unknown


def _turned(chosen: list[Lesson], settings: dict[str, int]) -> list[Lesson]:
    """The lessons, those with knobs so named turned to the values."""
    knobs = [(knob, each) for each in chosen for knob in each.knobs]
    for name, value in settings.items():
        meant = [(knob, each) for knob, each in knobs if knob.name == name]
        for knob, each in meant:
            if not knob.least <= value <= knob.most:
                raise Fault(
                    phrase(
                        "{name} of {lesson} goes from {least} to {most}, not to {value}",
                        name=name,
                        lesson=each.id,
                        least=knob.least,
                        most=knob.most,
                        value=value,
                    )
                )
        if not meant:
            if not knobs:
                raise Fault(phrase("there is no knob '{name}' here; there is none", name=name))
            knob_of = "{name} ({least} to {most}) of {lesson}"
            there = [phrase(knob_of, name=k.name, least=k.least, most=k.most, lesson=each.id) for k, each in knobs]
            raise Fault(
                phrase("there is no knob '{name}' here; there are {there}", name=name, there=joined(", ", there))
            )
    return [each.turned(**settings) for each in chosen]


def _listed(names: list[str]) -> str:
    return " ".join(names) if len(names) <= MOST_NAMES else f"{names[0]} {names[1]} ... {names[-1]}"


def _written(weight: Exact) -> str:
    return str(weight) if isinstance(weight, Fraction) else f"{weight} = {float(weight):.12g}"


def _refused(sentence: str) -> argparse.ArgumentTypeError:
    return argparse.ArgumentTypeError(tr(sentence))


def _whole(text: str) -> int:
    number = int(text)
    if number < 0:
        raise _refused(phrase("{text} is negative", text=text))
    return number


def _counting(text: str) -> int:
    if _whole(text) == 0:
        raise _refused("counting starts at 1")
    return int(text)


def _percent(text: str) -> float:
    number = text.removesuffix("%")
    if not (number.isdecimal() and 75 <= int(number) <= 250):
        raise _refused(phrase("'{text}' is not a size in per cent, from 75 to 250", text=text))
    return int(number) / 100


def _formats(text: str) -> tuple[str, ...]:
    chosen = tuple(part.strip().lower() for part in text.split(",") if part.strip())
    for each in chosen:
        if each not in FORMATS:
            raise _refused(phrase("'{each}' is not one of {names}", each=each, names=", ".join(FORMATS)))
    if not chosen:
        raise _refused("name at least one format")
    return chosen


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and all(LEAST <= int(n) <= MOST for n in (width, height))):
        raise _refused(
            phrase(
                "'{text}' is not a size such as 1920x1080 ({least} to {most} each way)",
                text=text,
                least=LEAST,
                most=MOST,
            )
        )
    return int(width), int(height)


def _setting(text: str) -> tuple[str, int]:
    name, _, value = text.partition("=")
    try:
        return name.strip(), int(value)
    except ValueError as wrong:
        raise _refused(phrase("'{text}' is not a name and a whole number such as degree=5", text=text)) from wrong


def _vectors(text: str) -> list[tuple[int, ...]]:
    try:
        return [tuple(int(x) for x in pair.split(",")) for pair in text.split()]
    except ValueError as wrong:
        raise _refused(
            phrase('{text} is not a list of integer pairs such as "1,0 0,1 1,1"', text=repr(text))
        ) from wrong

"""A lesson or a stage played, as GIF or MP4: eased stages, and a rest at every stop long enough to read it."""

import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from subprocess import DEVNULL, PIPE, Popen
from tempfile import TemporaryFile
from typing import IO

import numpy as np
from PIL import Image

from app.draw.picture import Picture
from app.draw.raster import Pixels, image
from app.draw.seen import seen
from app.state import State, Stop, at_stop, first, forward, segments, settle
from subdivision.words import phrase

RATE, FINE = 15, 30
"""Pictures a second: of a GIF, and of an MP4."""

STAGE = 1.0
"""Seconds for one stage."""

REST, READING = 1.2, 0.045
"""Seconds of rest at a stop, and as many more for each letter of the caption."""

COLOURS = 255


@dataclass(frozen=True, eq=False)
class Shot:
    """One picture and how many seconds it stays."""

    state: State
    seconds: float


def shots(state: State, rate: int = RATE, pace: float = 1.0) -> Iterator[Shot]:
    """The state's lesson from its first stop to its last; at ``pace`` 2 twice as fast."""
    state = first(state)
    yield Shot(state, _rest(state) / pace)
    while True:
        there = forward(state)
        if (there.beat, there.at) == (state.beat, state.at) and there.goal is None:
            return
        if there.goal is not None:
            yield from _played(there, there.at, there.goal.at, rate, pace)
        state = settle(there)
        yield Shot(state, _rest(state) / pace)


def stage_shots(state: State, rate: int = RATE, pace: float = 1.0) -> Iterator[Shot]:
    """The stage that has led to the state, or the first one to come; only a rest where nothing is played."""
    state = settle(state)
    played = [s for s in segments(state.lesson) if s.start < s.stop]
    begun = [s for s in played if (s.beat, s.start) < (state.beat, state.at)]
    if played:
        stage = begun[-1] if begun else played[0]
        state = at_stop(state, Stop(stage.beat, stage.start))
        yield Shot(state, REST / pace)
        yield from _played(state, stage.start, stage.stop, rate, pace)
        state = at_stop(state, Stop(stage.beat, stage.stop))
    yield Shot(state, _rest(state) / pace)


def _played(state: State, begin: float, end: float, rate: int, pace: float) -> Iterator[Shot]:
    """What is between two stops."""
    n = max(round(rate * STAGE / pace), 2)
    yield from (Shot(replace(state, at=begin + (end - begin) * k / n), STAGE / pace / (n - 1)) for k in range(1, n))


def gif(
    played: Sequence[Shot],
    width: int,
    height: int,
    *,
    look: Callable[[Picture], Picture] = lambda picture: picture,
    transparent: bool = False,
    progress: Callable[[float], None] = lambda done: None,
) -> bytes:
    """The bytes of the file.  ``look`` changes every picture, for instance its background."""
    palette = _palette([_frame(s, width, height, look) for s in _telling(played)])
    frames = []
    for k, shot in enumerate(played):
        frames.append(_indexed(_frame(shot, width, height, look, transparent=transparent), palette))
        progress((k + 1) / len(played))
    out = BytesIO()
    frames[0].save(
        out, "GIF", save_all=True, append_images=frames[1:], loop=0, optimize=False, disposal=2 if transparent else 1,
        duration=[round(100 * s.seconds) * 10 for s in played], **({"transparency": COLOURS} if transparent else {}),
    )  # fmt: skip
    return out.getvalue()


def _frame(
    shot: Shot, width: int, height: int, look: Callable[[Picture], Picture], *, transparent: bool = False
) -> Pixels:
    return image(look(seen(shot.state)), width, height, transparent=transparent, is_frame=True)


def film(
    played: Sequence[Shot],
    width: int,
    height: int,
    path: Path,
    *,
    look: Callable[[Picture], Picture] = lambda picture: picture,
    progress: Callable[[float], None] = lambda done: None,
) -> None:
    """Write an MP4 (H.264), ``FINE`` pictures a second; it is whole only when this returns.

    Raises
    ------
    FilmError
        If there is no ffmpeg, or it fails.
    """
    with TemporaryFile() as said, _encoder(width, height, path, said) as encoder:
        assert encoder.stdin is not None
        due = 0.0
        try:
            for k, shot in enumerate(played):
                due += FINE * shot.seconds
                frame = np.ascontiguousarray(_frame(shot, width, height, look)[..., :3]).tobytes()
                for _ in range(max(round(due), 1)):
                    encoder.stdin.write(frame)
                due -= max(round(due), 1)
                progress((k + 1) / len(played))
            encoder.stdin.close()
        except BrokenPipeError:  # it has said why
            with suppress(OSError):
                encoder.stdin.close()
        except BaseException:
            encoder.kill()
            raise
        status = encoder.wait()
        said.seek(0)
        reason = said.read().decode(errors="replace").strip().rpartition("\n")[2]
        if status != 0 or reason:  # it ends with 0 where only the end of the file could not be written
            raise FilmError(
                phrase(
                    "ffmpeg could not write the film: {reason}; try another folder",
                    reason=reason or "it gave no reason",
                )
            )


class FilmError(Exception):
    """Why there is no film, in a sentence for the user."""


def _encoder(width: int, height: int, path: Path, said: IO[bytes]) -> Popen[bytes]:
    """ffmpeg, waiting for pictures; H.264 wants even sides, so an odd one gets a row of its last colour."""
    command = [
        ffmpeg(), "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}",
        "-r", str(FINE), "-i", "-", "-an", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264",
        "-preset", "medium", "-crf", "18", "-tune", "animation", "-pix_fmt", "yuv420p",
        "-movflags", "+faststart", "-f", "mp4", "-y", str(path),
    ]  # fmt: skip
    return Popen(command, stdin=PIPE, stdout=DEVNULL, stderr=said)


def ffmpeg() -> str:
    """The program that makes MP4: the package's, else the system's.

    Raises
    ------
    FilmError
        If there is neither.
    """
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        pass
    if (found := shutil.which("ffmpeg")) is None:
        raise FilmError("MP4 needs the program ffmpeg: install it (Debian: sudo apt-get install ffmpeg), or choose GIF")
    return found


def _rest(state: State) -> float:
    return REST + READING * len(state.now.text)


def _telling(played: Sequence[Shot]) -> list[Shot]:
    """The stops, and the middles between them: together they hold every colour."""
    stops = [k for k, s in enumerate(played) if s.seconds > 0.5]
    middles = [(a + b) // 2 for a, b in pairwise(stops) if b - a > 1]
    chosen = sorted({*stops, *middles}) or range(len(played))  # none rests long where the pace is fast
    return [played[k] for k in chosen[:: max(len(chosen) // 12, 1)]]


def _palette(pictures: list[Pixels]) -> Image.Image:
    """One palette for all frames, so that nothing flickers."""
    strip = np.concatenate([p[::2, ::2, :3] for p in pictures])
    return Image.fromarray(strip).quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)


def _indexed(pixels: Pixels, palette: Image.Image) -> Image.Image:
    """Nearest colours and no dither: its noise would be most of the file."""
    found = Image.fromarray(np.ascontiguousarray(pixels[..., :3])).quantize(palette=palette, dither=Image.Dither.NONE)
    clear = pixels[..., 3] < 128
    if clear.any():
        numbers = np.asarray(found).copy()
        numbers[clear] = COLOURS
        held = Image.frombytes("P", found.size, numbers.tobytes())
        held.putpalette(found.getpalette() or [])
        return held
    return found

"""What the README shows is so."""

import re
import shlex
from pathlib import Path

from app.cli import COMMANDS, _parsers

README = (Path(__file__).parent.parent / "README.md").read_text(encoding="utf-8")
CODE = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
SHELL = re.findall(r"^subdivision-studio (.*)", README, re.MULTILINE)


def run(code):
    names = {}
    exec(code, names)
    return names


def test_the_engine_says_what_its_comment_says():
    (code,) = (each for each in CODE if "told.step(0)" in each)
    expression, said = re.search(r"^(told\.step.*?) +# (.*)$", code, re.MULTILINE).groups()
    assert str(eval(expression, run(code))) == said


def test_the_example_is_a_lesson_whose_claims_hold_and_whose_lines_fit():
    (code,) = (each for each in CODE if "@lesson" in each)
    example = run(code)["icosahedron"]
    assert [beat.text for beat in example.beats if not beat.claim] == []
    assert max(map(len, code.splitlines())) <= 120


def test_the_commands_can_be_typed_as_they_are_shown():
    parser, commands = _parsers()
    typed = [shlex.split(line, comments=True) for line in SHELL]
    assert {words[0] for words in typed} >= set(COMMANDS)
    for words in typed:
        if words[0] in commands:
            commands[words[0]].parse_args(words[1:])
        else:
            parser.parse_args(words)

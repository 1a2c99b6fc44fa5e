"""What comes from elsewhere is data: it runs nothing, and nothing is opened but what was named."""

import json
import subprocess
import sys
import zlib
from base64 import urlsafe_b64encode
from html.parser import HTMLParser
from pathlib import Path

import pytest

import lessons
from app.draw.seen import seen
from app.draw.vector import svg
from app.export import Wish, export
from app.laboratory.bench import enter, replace_control
from app.laboratory.lab import titled
from app.page import page_of
from app.sessions import keeping
from app.sessions.keeping import document, restored
from app.sessions.link import HEAD, followed, link
from app.sessions.strict import KeepingError
from app.state import State, start
from subdivision import shapes

ROOT = Path(__file__).parent.parent

READING = """
import sys
from pathlib import Path

from app.sessions.link import followed
from app.sessions.opening import opening
from app.state import start
from app.sessions.strict import KeepingError
from subdivision import TopologyError, files
from tests.hostile.corpus import corpus
import lessons

folder = Path(sys.argv[1])
FORBIDDEN = ("os.system", "os.exec", "os.posix_spawn", "os.fork", "os.spawn", "subprocess.", "socket.", "urllib.",
             "exec", "compile", "import", "pickle.", "ctypes.", "os.remove", "os.rename", "os.mkdir", "os.rmdir",
             "os.chmod", "os.chown", "os.link", "os.symlink", "os.truncate", "os.utime", "os.putenv", "os.listdir",
             "os.scandir", "os.walk", "shutil.", "tempfile.", "webbrowser.", "sqlite3.", "mmap.", "code.", "marshal.")
meant, found, is_watched = None, [], False

def heard(event, arguments):
    if not is_watched:
        return
    if event == "open" and str(arguments[0]) != str(meant):
        found.append(f"{meant} opens {arguments[0]}")
    if event == "open" and isinstance(arguments[1], str) and set(arguments[1]) & set("wax+"):
        found.append(f"{meant} writes {arguments[0]}")
    if event.startswith(FORBIDDEN):
        found.append(f"{meant}: {event} {arguments!r:.200}")

def read(path):
    global meant, is_watched
    meant, is_watched = path, False
    for is_watched in (is_sound, True):  # what is needed is loaded by files that are sound
        try:
            if path.suffix == ".link":
                followed(path.read_text(errors="replace"))
            else:
                opening(path)(before)
        except (files.FileError, TopologyError, KeepingError):
            pass
        finally:
            is_watched = False

before = start(lessons.all_lessons()[0])
sys.addaudithook(heard)
n = 0
for is_sound in (False, True):
    for path in sorted(folder.iterdir()):
        if path.stem.startswith("sound") == (not is_sound):
            read(path)
            n += 1
print(n, "read")
print("\\n".join(found[:20]))
"""

OBJ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\n"
ESCAPES = {
    "mtllib.obj": f"mtllib /etc/passwd\n{OBJ}usemtl a\nf 1 2 3 4\n",
    "relative.obj": f"mtllib ../../../../etc/passwd\n{OBJ}f 1 2 3 4\n",
    "called.obj": f"call /etc/passwd\n{OBJ}f 1 2 3 4\n",
    "shelled.obj": f"csh touch /tmp/hacked\ncsh -touch /tmp/hacked\n{OBJ}f 1 2 3 4\n",
    "url.obj": f"mtllib http://127.0.0.1:9/a.mtl\nmap_Kd \\\\127.0.0.1\\a.png\n{OBJ}f 1 2 3 4\n",
    "texture.ply": "ply\nformat ascii 1.0\ncomment TextureFile /etc/passwd\nelement vertex 3\nproperty float x\n"
                   "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                   "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "texture.off": "OFF # file:///etc/passwd\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
}  # fmt: skip
"""Names of other files, of programs and of addresses, where formats or programs that read them have room for such."""

NAMES = (
    "../../../etc/passwd", "/etc/passwd", "file:///etc/passwd", "__import__('os').system('true')", "{0.__class__}",
    "%n%s", "<img src='file:///etc/passwd'>", "<script>alert(1)</script>", "</script><script>alert(1)</script>",
    "$\\frac{$", "$\\notacommand{}$", "$" + "{" * 140 + "}" * 140 + "$", "a$b", "\x00\x01\x1b[31m", "\u202eedoc",
    "\ud800", "]]>", "&#x26;amp;", "x" * 300,
)  # fmt: skip
"""What a session, a link or a file may call its object."""


def named(name: str) -> State:
    return replace_control(enter(start(lessons.find("14"))), shapes.cube(), name)


def hostile_sessions():
    told = document(enter(start(lessons.all_lessons()[0])))
    for k, name in enumerate(NAMES):
        yield f"name{k}", {**told, "laboratory": {**told["laboratory"], "name": name}}
        yield f"lesson{k}", {**told, "lesson": name}
        yield f"theme{k}", {**told, "options": {**told["options"], "theme": name}}
        yield f"shape{k}", {**told, "laboratory": {**told["laboratory"], "object": {"shape": name}}}
        yield f"key{k}", {**told, name: name}
    for key in ("__class__", "__reduce__", "py/object", "$ref", "include", "path", "own"):
        yield key.replace("/", "-"), {**told, key: "/etc/passwd"}


@pytest.fixture
def corpus_of_escapes(tmp_path):
    from tests.hostile.corpus import corpus, sound

    folder = tmp_path / "hostile"
    folder.mkdir()
    for name, data in (*corpus(worst=False), *((name, text.encode()) for name, text in ESCAPES.items())):
        (folder / name).write_bytes(data)
    for name, data in sound().items():
        (folder / f"sound-{name}").write_bytes(data)
    keeping.write(folder / "sound.subdivision", named("cube"))
    (folder / "sound.link").write_text(link(named("cube")))
    for name, told in hostile_sessions():
        text = json.dumps(told)
        (folder / f"{name}.subdivision").write_text(text)
        packed = zlib.compress(text.encode())
        letters = urlsafe_b64encode(zlib.crc32(packed).to_bytes(4, "big") + packed).rstrip(b"=").decode()
        (folder / f"{name}.link").write_text(HEAD + letters)
    return folder


def test_whatever_is_read_opens_only_what_was_named_and_runs_nothing(corpus_of_escapes):
    done = subprocess.run(
        [sys.executable, "-c", READING, str(corpus_of_escapes)], cwd=ROOT, capture_output=True, text=True, timeout=300,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    first, _, rest = done.stdout.partition("\n")
    assert int(first.split()[0]) > 1000
    assert rest.strip() == ""
    assert not Path("/tmp/hacked").exists()


@pytest.mark.parametrize("name", NAMES)
def test_whatever_an_object_is_called_it_is_drawn_and_exported_as_words(tmp_path, name):
    state = named(name)
    assert "$" not in titled(name)
    drawn = svg(seen(state), 320, 180)
    for words in ("<script", "<img"):
        assert words not in drawn
    for kind in ("svg", "pptx", "pdf"):
        (made,) = export(state, Wish(kind, "view", (160, 90)), tmp_path / f"a.{kind}")
        assert made.parent == tmp_path
    assert {each.suffix for each in tmp_path.iterdir()} == {".svg", ".pptx", ".pdf"}


def test_a_session_with_such_a_name_is_kept_and_restored_and_nothing_leaves_its_place():
    for name in NAMES:
        if "\ud800" not in name:
            assert restored(keeping.kept(named(name))).lab.name == name


def test_a_link_that_would_unpack_to_gigabytes_is_refused():
    packed = zlib.compress(b"[" * (1 << 26), 9)
    letters = urlsafe_b64encode(zlib.crc32(packed).to_bytes(4, "big") + packed).decode().rstrip("=")
    with pytest.raises(KeepingError, match=r"a link has at most|unpacks to more"):
        followed(HEAD + letters[:60_000])


class Parts(HTMLParser):
    """What a page would do."""

    def __init__(self) -> None:
        super().__init__()
        self.scripts, self.handlers, self.addresses, self.policies = [], [], [], []

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name.startswith("on") or name == "style":
                self.handlers.append((tag, name))
            if name in ("src", "href", "action", "formaction", "xlink:href", "data", "poster", "srcset"):
                self.addresses.append(value)
        told = dict(attributes)
        if tag == "script":
            self.scripts.append(told.get("type", "text/javascript"))
        if tag == "meta" and told.get("http-equiv") == "Content-Security-Policy":
            self.policies.append(told["content"])


@pytest.mark.parametrize("name", ["</script><script>alert(1)</script>", "<img src=x onerror=alert(1)>"])
def test_a_page_carries_its_own_script_only_whatever_its_object_is_called(name):
    parts = Parts()
    parts.feed(page_of(named(name)).decode())
    assert parts.scripts == ["application/octet-stream", "text/javascript"]
    assert parts.handlers == []
    assert all(address.startswith("#") for address in parts.addresses)
    (policy,) = parts.policies
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert policy.count("'sha256-") == 2

"""A state as one word that can be sent: the text of ``keeping``, packed, behind ``subdivision-studio://``."""

import base64
import binascii
import json
import re
import zlib

from app.sessions.keeping import document, restored
from app.sessions.strict import KeepingError
from app.state import Options, State
from subdivision.words import phrase

SCHEME = "subdivision-studio:"
HEAD = f"{SCHEME}//session/"

MOST_LETTERS = 30_000
"""Letters of a link; longer ones are cut by what they are sent with."""

MOST_UNPACKED = 1 << 20
CHECK = 4
"""Bytes in front that tell whether the link has come whole."""

BROKEN = "the link has not come whole; copy it again, from its first letter to its last"


def is_link(text: str) -> bool:
    """Whether a text means to be a link of ours."""
    return text.strip().lower().startswith(SCHEME)


def link(state: State) -> str:
    """The state as a link; options that stand as usual are left out.

    Raises
    ------
    KeepingError
        If its control object is too large for a link.
    """
    told, usual = document(state), Options()
    told["options"] = {name: value for name, value in told["options"].items() if value != getattr(usual, name)}
    plain = json.dumps(told, separators=(",", ":")).encode()
    packed = zlib.compress(plain, 9)
    letters = base64.urlsafe_b64encode(zlib.crc32(packed).to_bytes(CHECK, "big") + packed).rstrip(b"=").decode()
    if len(HEAD) + len(letters) > MOST_LETTERS or len(plain) > MOST_UNPACKED:
        raise KeepingError("the object in the laboratory is too large for a link; save a session and send that")
    return HEAD + letters


def followed(text: str, options: Options | None = None) -> State:
    """The state that a link stands for; spaces and line ends that mail has put into it are passed over.

    Raises
    ------
    KeepingError
        If it is none of ours, or has not come whole.
    """
    if len(text) > 2 * MOST_LETTERS:
        raise KeepingError(phrase("a link has at most {most:,} letters; copy it again", most=MOST_LETTERS))
    word = re.sub(r"\s", "", text)
    if not word.lower().startswith(HEAD):
        raise KeepingError(phrase("this is no link of this program; it begins with {head}", head=HEAD))
    return restored(_unpacked(word[len(HEAD) :]), options)


def _unpacked(letters: str) -> bytes:
    try:
        packed = base64.b64decode(letters + "=" * (-len(letters) % 4), altchars=b"-_", validate=True)
        check, packed = packed[:CHECK], packed[CHECK:]
        if len(check) < CHECK or zlib.crc32(packed) != int.from_bytes(check, "big"):
            raise KeepingError(BROKEN)
        unpacking = zlib.decompressobj()
        plain = unpacking.decompress(packed, MOST_UNPACKED)
    except (binascii.Error, ValueError, zlib.error) as fault:
        raise fault if isinstance(fault, KeepingError) else KeepingError(BROKEN) from None
    if unpacking.unconsumed_tail:
        raise KeepingError("the link unpacks to more than a session is; copy it again")
    if not unpacking.eof:
        raise KeepingError(BROKEN)
    return plain

"""What was made lately, kept as long as all of it together is not too heavy."""

from collections.abc import Callable, Hashable
from threading import Lock
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Made = TypeVar("Made")


class Lately(Generic[Key, Made]):
    """``make`` of a key, made again only where it has gone: what was asked for longest ago goes when room is needed.

    ``weigh`` tells how heavy something is, and ``most`` how heavy all of it may be; the newest always stays.
    """

    def __init__(self, make: Callable[[Key], Made], weigh: Callable[[Made], int], most: int) -> None:
        self._make, self._weigh, self.most = make, weigh, most
        self._kept: dict[Key, tuple[Made, int]] = {}
        self._lock = Lock()

    def __call__(self, key: Key) -> Made:
        with self._lock:
            if (found := self._kept.pop(key, None)) is not None:
                self._kept[key] = found  # the newest is the last
                return found[0]
        made = self._make(key)  # unlocked: another thread may make the same meanwhile, which is only wasted
        with self._lock:
            self._kept[key] = made, self._weigh(made)
            while len(self._kept) > 1 and self.weight > self.most:
                del self._kept[next(iter(self._kept))]
        return made

    @property
    def weight(self) -> int:
        """Of all that is kept."""
        return sum(weight for _, weight in self._kept.values())

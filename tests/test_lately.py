"""The history of a laboratory takes the room of a few of its states, and all of them are there again."""

import gc

import pytest

from app.laboratory import bench, editing, lab
from app.lately import Lately
from app.state import Picked, last, pick, start, stops
from lessons import find
from subdivision import Trace


@pytest.fixture
def little_room(monkeypatch):
    for kept in (lab._TRACES, lab._STORIES):
        monkeypatch.setattr(kept, "most", 2_000)


def alive() -> list[Trace]:
    gc.collect()
    return [each for each in gc.get_objects() if isinstance(each, Trace)]


def test_many_edits_take_the_room_of_a_few_and_every_state_before_them_is_there_again(little_room):
    state = bench.take(bench.enter(start(find("14"))), "icosahedron")
    past, seen, before = [], [], len(alive())
    for edge in range(30):
        state = last(editing.sharpen(pick(state, Picked("edge", (edge,))), 2.0))
        past.append(state)
        seen.append(state.now.lead.trace.points[-1])
    assert len({id(each.lesson) for each in past}) == 30
    assert len(alive()) - before < 20
    for each, points in zip(past[::-1], seen[::-1], strict=True):
        assert (each.beat, each.at) == (stops(each.lesson)[-1].beat, stops(each.lesson)[-1].at)
        assert (each.now.lead.trace.points[-1] == points).all()


def test_what_was_asked_for_longest_ago_goes_first_and_the_newest_always_stays():
    made = []
    kept = Lately(lambda key: made.append(key) or key * 10, len, 6)
    for key in ("a", "b", "a", "c"):  # each weighs 10, so there is room for one
        assert kept(key) == key * 10
    assert made == ["a", "b", "a", "c"]
    kept.most = 20
    for key in ("a", "c", "b", "c"):
        kept(key)
    assert made == ["a", "b", "a", "c", "a", "b"]
    assert kept.weight == 20

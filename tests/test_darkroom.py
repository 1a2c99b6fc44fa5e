"""The process that draws pictures: every order is answered, whatever became of the one before."""

import pickle
from dataclasses import replace
from io import BytesIO

import lessons
from app.draw.darkroom import Failure, Order, drawn, serve
from app.draw.seen import seen
from app.state import last, start


def test_a_picture_that_cannot_be_drawn_does_not_take_the_next_one_along():
    sound = Order("svg", seen(last(start(lessons.find("14")))), 640, 360)
    heard, said = BytesIO(), BytesIO()
    for order in (replace(sound, kind="xyz"), replace(sound, width=1 << 40, kind="pixels"), sound):
        pickle.dump(order, heard)
    serve(BytesIO(heard.getvalue()), said)
    said.seek(0)
    unknown, huge, whole = (pickle.load(said) for _ in range(3))
    assert isinstance(unknown, Failure)
    assert "xyz" in unknown.traceback
    assert isinstance(huge, Failure)
    assert whole == drawn(sound)

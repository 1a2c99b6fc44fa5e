"""A phrase is its English sentence, and knows what it was made of."""

import copy
import pickle

from subdivision.words import Phrase, phrase


def test_a_phrase_reads_as_its_sentence_and_keeps_its_parts() -> None:
    said = phrase("An {edge} point at each of {n} edges: {share:.2f}.", n=12, share=1 / 3)
    assert said == "An {edge} point at each of 12 edges: 0.33."
    assert (said.template, said.values["n"]) == ("An {edge} point at each of {n} edges: {share:.2f}.", 12)


def test_a_phrase_survives_errors_copies_and_pickles() -> None:
    said = phrase("level {level} of {levels}", level=2, levels=5)
    for same in (str(ValueError(said)), copy.deepcopy(said), pickle.loads(pickle.dumps(said)), str(said)):
        assert isinstance(same, Phrase)
        assert (same, same.template, same.values) == (said, said.template, said.values)

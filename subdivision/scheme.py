"""A scheme is a name, a paper, and one matrix told in one or more ways."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from subdivision.manifold import TopologyError
from subdivision.operators import Operator
from subdivision.rows import Connectivity
from subdivision.stage import Stage, Step
from subdivision.topology import Topology

NOT_A_MESH = "it subdivides polygon meshes"


@dataclass(frozen=True)
class Scheme:
    """Tellings are interchangeable: all of them multiply to the same matrix (tested).

    The limit rules may be left out; ``limit.py`` says who asks for them, and when they hold.

    Attributes
    ----------
    name : str
        As the command line spells it.
    title : str
        As people say it.
    paper : str
        Key into ``assets/references.bib``.
    refuses : Connectivity -> str
        Why it cannot subdivide a control object; empty where it can.
    tellings : name -> (Connectivity -> Step)
        The first one is the telling for those who do not choose.
    limit : Connectivity -> Stage, optional
        Points to where they tend to.
    tangents : Topology -> (Operator, Operator), optional
        Two directions in the tangent plane at every limit point.
    """

    name: str
    title: str
    paper: str
    refuses: Callable[[Connectivity], str]
    tellings: Mapping[str, Callable[[Connectivity], Step]]
    limit: Callable[[Connectivity], Stage] | None = None
    tangents: Callable[[Topology], tuple[Operator, Operator]] | None = None

    def accepts(self, topology: Connectivity) -> bool:
        """Whether it can subdivide a control object."""
        return not self.refuses(topology)

    def step(self, topology: Connectivity, telling: str | None = None) -> Step:
        """One subdivision step on ``topology``.

        Raises
        ------
        TopologyError
            If the scheme refuses the control object, or knows no such telling.
        """
        if reason := self.refuses(topology):
            raise TopologyError(f"{self.title} cannot subdivide this: {reason}")
        if telling is not None and telling not in self.tellings:
            raise TopologyError(f"{self.title} has no telling '{telling}'; it has {', '.join(self.tellings)}")
        return self.tellings[telling or next(iter(self.tellings))](topology)

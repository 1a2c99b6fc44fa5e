"""A scheme is a name, a paper, and one matrix told in one or more ways."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from subdivision.exact import Exact
from subdivision.manifold import TopologyError
from subdivision.operators import Operator
from subdivision.plans.corner_numbers import Numbering
from subdivision.refine import Refinement
from subdivision.rows import Connectivity
from subdivision.stage import Stage, Step
from subdivision.topology import Topology
from subdivision.words import phrase


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
    refinement : Refinement, optional
        How it splits meshes; left out by schemes of polygons and nets.
    rings : int
        How many rings of faces round a vertex the points near it read.
    reach : valence -> number, optional
        How far a smooth vertex goes to the mean of its ring, if that is all that tells the scheme from
        the others of its refinement; then ``plan.py`` knows a fast way.
    corners : (number of corners, steps ahead) -> weight, optional
        Likewise of a dual scheme: what a new corner of a face holds of the corner so far ahead of it.
    numbering : Numbering, optional
        Likewise: after how many steps there is one for each old corner, and in which order.
    middles : valence -> number, optional
        Likewise of a scheme that gives triangles middles and flips edges: how far an old vertex goes to the mean
        of the middles round it.
    beside : (valence, steps round) -> number, optional
        Likewise of the butterfly: what the point beside an extraordinary vertex holds of the neighbour so far round
        from its own.
    tension : number, optional
        Likewise of an interpolating scheme of quads: of the curve that it is in both directions.
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
    refinement: Refinement | None = None
    rings: int = 1
    reach: Callable[[int], Exact | int] | None = None
    corners: Callable[[int, int], Exact | int] | None = None
    numbering: Numbering | None = None
    middles: Callable[[int], Exact | int] | None = None
    beside: Callable[[int, int], Exact | int] | None = None
    tension: Fraction | None = None
    limit: Callable[[Connectivity], Stage] | None = None
    tangents: Callable[[Topology], tuple[Operator, Operator]] | None = None

    def accepts(self, topology: Connectivity) -> bool:
        """Whether it can subdivide a control object."""
        return not self.refuses(topology)

    def require(self, topology: Connectivity) -> None:
        """Raise the ``TopologyError`` that says why the scheme refuses a control object, if it does."""
        if reason := self.refuses(topology):
            raise TopologyError(phrase("{scheme} cannot subdivide this: {reason}", scheme=self.title, reason=reason))

    def faces_after(self, topology: Topology, levels: int) -> int:
        """How many faces ``levels`` steps make of a mesh, told without making them.

        Raises
        ------
        TopologyError
            If the scheme refuses the mesh.
        """
        self.require(topology)
        if levels == 0 or self.refinement is None:
            return topology.n_faces
        return self.refinement.faces(topology, levels)

    def step(self, topology: Connectivity, telling: str | None = None) -> Step:
        """One subdivision step on ``topology``.

        Raises
        ------
        TopologyError
            If the scheme refuses the control object, or knows no such telling.
        """
        self.require(topology)
        if telling is not None and telling not in self.tellings:
            raise TopologyError(
                phrase(
                    "{scheme} has no telling '{telling}'; it has {tellings}",
                    scheme=self.title,
                    telling=telling,
                    tellings=", ".join(self.tellings),
                )
            )
        return self.tellings[telling or next(iter(self.tellings))](topology)

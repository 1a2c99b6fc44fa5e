"""How a scheme acts round a vertex of valence n: read off its own step on a fan of n faces.

Nothing here is typed in: rows are stencils of ``Scheme.step``, and eigenvalues are those of the
Fourier blocks of these rows (turning the fan by one face changes nothing).
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from subdivision.arrays import Floats
from subdivision.exact import Exact, cosine, spelled
from subdivision.manifold import TopologyError
from subdivision.refine import QUADS, TRIANGLES
from subdivision.scheme import Scheme
from subdivision.stage import Step
from subdivision.topology import Topology
from subdivision.words import phrase

Point: TypeAlias = Literal["vertex", "edge", "face"]


@dataclass(frozen=True)
class NamedStencil:
    """``point`` is the sum of ``weight * old[name]`` over ``terms``.

    Names: ``V`` the vertex, ``E1`` ... its neighbours, counter-clockwise; on quads ``Fi`` the
    corner opposite to V between ``Ei`` and the next.
    """

    point: str
    terms: tuple[tuple[str, Exact], ...]

    def weight(self, name: str) -> Exact:
        """The exact weight of one point (0 where it does not contribute)."""
        return dict(self.terms).get(name, Fraction(0))

    def __str__(self) -> str:
        return " + ".join(f"{spelled(w)} {name}" for name, w in self.terms).replace("+ -", "- ")


@dataclass(frozen=True, eq=False)
class Ring:
    """One step of a scheme on a vertex and the faces round it.

    Attributes
    ----------
    valence : int
    names : (m,)
        V, E1 .. En and on quads F1 .. Fn; a point and its successor share a name.
    stencils : (m,)
        The successors, in that order.
    """

    scheme: Scheme
    valence: int
    names: tuple[str, ...]
    stencils: tuple[NamedStencil, ...]

    @cached_property
    def matrix(self) -> Floats:
        """(m, m) float: the local subdivision matrix."""
        return np.array([[float(stencil.weight(name)) for name in self.names] for stencil in self.stencils])

    def block(self, mode: int) -> NDArray[np.complex128]:
        """(k, k): how a wave that runs ``mode`` times round the vertex is multiplied; V takes part in mode 0 only."""
        n = self.valence
        wave = np.exp(2j * pi * mode * np.arange(n) / n)
        rings = self.matrix[1:, 1:].reshape(-1, n, len(self.names) // n, n)[:, 0] @ wave
        if mode % n:
            return np.asarray(rings)
        whole = np.zeros((len(rings) + 1, len(rings) + 1), dtype=complex)
        whole[1:, 1:], whole[1:, 0], whole[0, 0] = rings, self.matrix[1::n, 0], self.matrix[0, 0]
        whole[0, 1:] = self.matrix[0, 1:].reshape(-1, n).sum(axis=1)
        return whole

    def eigenvalues(self, mode: int) -> Floats:
        """Eigenvalues of one mode, the largest first (all of them are real)."""
        values = np.linalg.eigvals(self.block(mode))
        return np.asarray(values[np.argsort(-np.abs(values))].real)

    @property
    def spectrum(self) -> Floats:
        """(m,) float: all eigenvalues, the largest first."""
        values = np.concatenate([self.eigenvalues(mode) for mode in range(self.valence)])
        return np.asarray(values[np.argsort(-np.abs(values), kind="stable")])

    @property
    def subdominant(self) -> float:
        """What rings shrink by if the scheme is C1: the largest eigenvalue of modes 1 and n - 1, so a double one."""
        return float(self.eigenvalues(1)[0])

    @property
    def cup(self) -> float:
        """The second eigenvalue of mode 0: how bowls and tips shrink."""
        return float(self.eigenvalues(0)[1])

    @property
    def saddle(self) -> float:
        """The largest eigenvalue of mode 2: how saddles shrink.  At valence 3 there is no such mode: 0."""
        return float(self.eigenvalues(2)[0]) if self.valence > 3 else 0.0

    @property
    def is_smooth(self) -> bool:
        """C1 as far as eigenvalues tell: everything but the subdominant pair shrinks faster."""
        others = [*self.eigenvalues(0)[1:], *self.eigenvalues(1)[1:]]
        others += [value for mode in range(2, self.valence - 1) for value in self.eigenvalues(mode)]
        return bool(max(abs(value) for value in others) < self.subdominant - 1e-12)

    @property
    def curvature_is_bounded(self) -> bool:
        """Neither cup nor saddle shrinks slower than the square of the ring."""
        return max(abs(self.cup), abs(self.saddle)) <= self.subdominant**2 + 1e-12

    @property
    def reading(self) -> str:
        """What becomes of the curvature of a bowl at the vertex, in a sentence."""
        square = self.subdominant**2
        if not self.is_smooth:
            return phrase(
                "a tip remains: it shrinks by {cup:.5f}, no faster than its ring, {ring:.5f}",
                cup=self.cup,
                ring=self.subdominant,
            )
        if abs(self.cup - square) <= 1e-12:
            return phrase(
                "bowls keep a bounded curvature, not zero: they shrink by {square:.5f}, as the ring squared",
                square=square,
            )
        if self.cup > square:
            return phrase(
                "bowls are pinched: they shrink by {cup:.5f}, slower than the ring squared, {square:.5f}",
                cup=self.cup,
                square=square,
            )
        return phrase(
            "bowls flatten: they shrink by {cup:.5f}, faster than the ring squared, {square:.5f}",
            cup=self.cup,
            square=square,
        )

    def characteristic_map(self) -> Floats:
        """(m, 2) float: the ring as the scheme sees it, level after level: V at 0, E1 at (1, 0)."""
        values, vectors = np.linalg.eig(self.block(1))
        slowest = vectors[:, np.argmax(np.abs(values))]
        wave = np.exp(2j * pi * np.arange(self.valence) / self.valence)
        ring = np.outer(slowest / slowest[0], wave).ravel()
        return np.concatenate([[[0.0, 0.0]], np.stack([ring.real, ring.imag], axis=1)])


def ring(scheme: Scheme, valence: int) -> Ring:
    """The local subdivision matrix of a mesh scheme.

    Raises
    ------
    TopologyError
        For a valence below 3, for schemes of polygons and nets, and for those whose new points are not told by the
        faces round one vertex.
    """
    step, names, successors = step_on_fan(scheme, valence)
    return Ring(scheme, valence, names, tuple(_named(step, names, name, point) for name, point in successors.items()))


def stencil_by_valence(scheme: Scheme, valence: int, point: Point) -> NamedStencil:
    """The stencil of the vertex point at V, of the edge point on V E1, or of the face point between E1 and E2.

    Raises
    ------
    TopologyError
        As ``ring``, and for face points of triangle schemes.
    """
    step, names, successors = step_on_fan(scheme, valence)
    name = {"vertex": "V", "edge": "E1", "face": "F1"}.get(point)
    if name is None:
        raise TopologyError(phrase("there is no '{point}' point; choose vertex, edge or face", point=point))
    if name not in successors:
        raise TopologyError(
            phrase("{scheme} makes no face points: triangles are split at their edges only", scheme=scheme.title)
        )
    return _named(step, names, point, successors[name])


def beta_min(n: int) -> Exact:
    """``(1 - cos(2 pi/n))/(4 n)``: a triangle scheme is C1 at valence ``n`` only if its beta is larger."""
    return (1 - cosine(n)) * Fraction(1, 4 * n)


def fan(n: int, corners: int) -> Topology:
    """``n`` quads or triangles round vertex 0: neighbours ``1 .. n``, then on quads the opposite corners."""
    k = np.arange(n)
    around = [np.zeros(n, dtype=np.intp), 1 + k, *([1 + n + k] if corners == 4 else []), 1 + (k + 1) % n]
    return Topology.from_corners(np.full(n, corners), np.stack(around, axis=1).ravel())


def step_on_fan(scheme: Scheme, n: int) -> tuple[Step, tuple[str, ...], dict[str, int]]:
    """A step on a fan; names of the old points; and where their successors are among the new ones."""
    if n < 3:
        raise TopologyError(phrase("{n} faces do not close round a vertex; choose a valence of 3 or more", n=n))
    if scheme.refinement not in (None, QUADS, TRIANGLES):
        raise TopologyError(
            phrase("{scheme} makes no point for every vertex and edge: no valence tells a stencil", scheme=scheme.title)
        )
    if scheme.rings > 1:
        raise TopologyError(
            phrase(
                "{scheme} reads {rings} rings of faces: no valence alone tells a stencil",
                scheme=scheme.title,
                rings=scheme.rings,
            )
        )
    fans = [fan(n, 4), fan(n, 3)]
    t = next((t for t in fans if scheme.accepts(t)), None)
    if t is None:
        raise TopologyError(
            phrase(
                "{scheme} has no vertices of any valence: it subdivides polygons or nets, not meshes",
                scheme=scheme.title,
            )
        )
    quads = t.is_quadrilateral
    step = scheme.step(t)
    along = np.arange(n) * (4 if quads else 3)
    first_edge = t.n_vertices + (t.n_faces if quads else 0)
    names = ["V", *(f"E{i}" for i in range(1, n + 1)), *(f"F{i}" for i in range(1, n + 1) if quads)]
    successors = [0, *(first_edge + t.edge[along]), *(t.n_vertices + t.face[along] if quads else ())]
    return step, tuple(names), dict(zip(names, map(int, successors), strict=True))


def _named(step: Step, names: tuple[str, ...], name: str, point: int) -> NamedStencil:
    return NamedStencil(name, tuple((names[parent], weight) for parent, weight in step.stencil(point).terms))

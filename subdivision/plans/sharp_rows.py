"""What sharpness changes in a step: few rows, made over after all others have been made as if nothing were sharp."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import _sparsetools, csr_array, diags_array

from subdivision.arrays import Floats, Indices, Small, taken
from subdivision.sharpness import CORNER, CREASE, SMOOTH, vertex_rules
from subdivision.topology import Topology


@dataclass(frozen=True, eq=False)
class Creases:
    """The sharp vertices and edges of a mesh and the ends of these, and no others, numbered from 0.

    Attributes
    ----------
    edges, vertices : (n_edges,), (n_vertices,) int
        Their numbers in the mesh.
    ends, edge_sharpness, vertex_sharpness : (n_edges, 2) int, (n_edges,) float, (n_vertices,) float
        As of a mesh.
    """

    edges: Indices
    vertices: Indices
    ends: Indices
    edge_sharpness: Floats
    vertex_sharpness: Floats

    @property
    def n_vertices(self) -> int:
        return len(self.vertices)


@dataclass(frozen=True, eq=False)
class SharpRows:
    """Rows of a step that are not as where all is smooth.

    Attributes
    ----------
    edges, ends, share : (n,) int, (n, 2) int, (n, 1) float
        These edges go ``share`` of the way to their midpoints.
    vertices, smooth, keep : (m,) int, (m, 1) float, (m, 1) float
        These vertices hold so much of their smooth place, and so much of where they were,
    at, towards, weight : (k,) int, (k,) int, (k,) float
        and, the one with this place among them, so much of a neighbour along a crease.
    """

    edges: Indices
    ends: Indices
    share: Floats
    vertices: Indices
    smooth: Floats
    keep: Floats
    at: Small
    towards: Small
    weight: Floats

    def apply(self, points: Floats, vertices: Floats, edges: Floats) -> None:
        """Make over what was made of ``points``."""
        midpoints = taken(points, self.ends[:, 0])
        midpoints += taken(points, self.ends[:, 1])
        midpoints *= 0.5
        smooth = taken(edges, self.edges)
        edges[self.edges] = smooth + self.share * (midpoints - smooth)
        moved = self.smooth * taken(vertices, self.vertices)
        moved += self.keep * taken(points, self.vertices)
        _sparsetools.coo_matmat_dense(
            len(self.at), points.shape[1], self.at, self.towards, self.weight, points.reshape(-1), moved.reshape(-1)
        )
        vertices[self.vertices] = moved

    def assembled(self, vertices: csr_array, edges: csr_array) -> tuple[csr_array, csr_array]:
        """The same done to matrices."""
        V, E = vertices.shape[1], edges.shape[0]
        n = len(self.edges)
        share, smooth = np.zeros(E), np.ones(V)
        share[self.edges], smooth[self.vertices] = self.share.ravel(), self.smooth.ravel()
        halves = csr_array((np.full(2 * n, 0.5), (np.repeat(self.edges, 2), self.ends.ravel())), shape=(E, V))
        keep = csr_array((self.keep.ravel(), (self.vertices, self.vertices)), shape=(V, V))
        along = csr_array((self.weight, (self.vertices[self.at], self.towards)), shape=(V, V))
        return (
            csr_array(diags_array(smooth) @ vertices + keep + along),
            csr_array(diags_array(1 - share) @ edges + diags_array(share) @ halves),
        )


def creases(t: Topology) -> Creases:
    """What is sharp in ``t``."""
    sharp = t.edge_sharpness > 0
    edges = np.flatnonzero(sharp)
    h = np.flatnonzero(taken(sharp, t.edge))
    ends = np.empty((len(edges), 2), dtype=np.intp)
    ends[np.searchsorted(edges, t.edge[h])] = np.stack([t.origin[h], t.origin[t.next[h]]], axis=1)
    pinned = t.vertex_sharpness > 0
    pinned[ends] = True
    vertices = np.flatnonzero(pinned)
    return Creases(
        edges, vertices, np.searchsorted(vertices, ends), t.edge_sharpness[edges], t.vertex_sharpness[vertices]
    )


def sharp_rows(t: Topology) -> SharpRows | None:
    """The rows of ``t`` that sharpness changes; None where everything is smooth."""
    if t.is_smooth:
        return None
    sharp = creases(t)
    rules = vertex_rules(sharp)
    parts = [(rules.now, rules.stays, rules.sharp_now), (rules.then, 1 - rules.stays, rules.sharp_then)]
    smooth, keep, crease = (
        sum(share * (rule == kind) for rule, share, _ in parts) for kind in (SMOOTH, CORNER, CREASE)
    )
    ends = [sharp.ends[edges] for _, _, edges in parts]
    at = np.concatenate([pair.T.ravel() for pair in ends])
    towards = np.concatenate([pair[:, ::-1].T.ravel() for pair in ends])
    held = [share * (rule == CREASE) for rule, share, _ in parts]
    weight = np.concatenate([some[pair.T.ravel()] / 8 for some, pair in zip(held, ends, strict=True)])
    share = np.minimum(sharp.edge_sharpness, 1)[:, None]
    return SharpRows(
        sharp.edges, sharp.vertices[sharp.ends], share, sharp.vertices, smooth[:, None],
        (keep + 3 / 4 * crease)[:, None], at.astype(np.int32), sharp.vertices[towards].astype(np.int32), weight,
    )  # fmt: skip

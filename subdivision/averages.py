"""Averages read off a mesh: every row of these operators is a mean of points.

They are the whole vocabulary of the schemes; a scheme file combines them with weights.
"""

import numpy as np

from subdivision.arrays import Mask
from subdivision.operators import Mean, MeanOf, Operator
from subdivision.topology import Topology


def face_centroids(t: Topology) -> Operator:
    """(n_faces, n_vertices): each face to the mean of its corners."""
    if t.is_quadrilateral or t.is_triangular:
        return MeanOf(t.origin.reshape(t.n_faces, -1), t.n_vertices)
    return Mean(t.face, t.origin, (t.n_faces, t.n_vertices))


def edge_midpoints(t: Topology) -> Operator:
    """(n_edges, n_vertices): each edge to its midpoint."""
    return MeanOf(t.ends, t.n_vertices)


def edge_faces(t: Topology) -> Operator:
    """(n_edges, n_faces): each edge to the mean of the faces beside it."""
    return Mean(t.edge, t.face, (t.n_edges, t.n_faces))


def edge_wings(t: Topology) -> Operator:
    """(n_edges, n_vertices): each edge of a triangle mesh to the mean of the corners opposite to it."""
    return Mean(t.edge, t.origin[t.prev], (t.n_edges, t.n_vertices))


def vertex_faces(t: Topology) -> Operator:
    """(n_vertices, n_faces): each vertex to the mean of the faces around it."""
    return Mean(t.origin, t.face, (t.n_vertices, t.n_faces))


def vertex_corners(t: Topology) -> Operator:
    """(n_vertices, n_halfedges): each vertex to the mean of what belongs to its own corners."""
    return Mean(t.origin, np.arange(t.n_halfedges), (t.n_vertices, t.n_halfedges))


def corner_ends(t: Topology) -> Operator:
    """(n_halfedges, n_vertices): each corner of a triangle to the mean of the other two."""
    return MeanOf(np.stack([t.origin[t.next], t.origin[t.prev]], axis=1), t.n_vertices)


def neighbours(t: Topology, along: Mask | None = None) -> Operator:
    """(n_vertices, n_vertices): each vertex to the mean of its neighbours ``along`` some edges (all of them)."""
    a, b = (t.ends if along is None else t.ends[along]).T
    return Mean(np.r_[a, b], np.r_[b, a], (t.n_vertices, t.n_vertices))

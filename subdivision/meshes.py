"""Which control objects the mesh schemes take, and the sentence for those they refuse."""

import numpy as np

from subdivision.manifold import TopologyError
from subdivision.rows import Connectivity
from subdivision.topology import Topology


def refuses_non_meshes(t: Connectivity) -> str:
    """Why ``t`` is no polygon mesh; empty where it is."""
    return "" if isinstance(t, Topology) else "it is not a polygon mesh (make one of a net with Grid.mesh())"


def refuses_non_quads(t: Connectivity) -> str:
    """Why ``t`` is no quad mesh; empty where it is."""
    return _refuses_other_faces(t, 4, "quadrilateral", "one step of Catmull-Clark makes all faces quads")


def refuses_non_triangles(t: Connectivity) -> str:
    """Why ``t`` is no triangle mesh; empty where it is."""
    return _refuses_other_faces(t, 3, "triangle", "triangulate the mesh, or use Catmull-Clark")


def only_quads(t: Connectivity, title: str) -> Topology:
    """``t`` itself, if all its faces are quads."""
    if not isinstance(t, Topology) or not t.is_quadrilateral:
        raise TopologyError(f"{title} is told by centroid averaging on quads only: {refuses_non_quads(t)}")
    return t


def _refuses_other_faces(t: Connectivity, size: int, kind: str, mend: str) -> str:
    if not isinstance(t, Topology):
        return refuses_non_meshes(t)
    other = np.flatnonzero(t.face_sizes != size)
    if other.size == 0:
        return ""
    return f"face {other[0]} has {t.face_sizes[other[0]]} corners, and every face must be a {kind}; {mend}"

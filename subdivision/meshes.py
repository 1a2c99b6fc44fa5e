"""Which control objects the mesh schemes take, and the sentence for those they refuse."""

from collections.abc import Callable

import numpy as np

from subdivision.manifold import TopologyError
from subdivision.rows import Connectivity
from subdivision.topology import Topology
from subdivision.words import phrase


def refuses_non_meshes(t: Connectivity) -> str:
    """Why ``t`` is no polygon mesh; empty where it is."""
    return "" if isinstance(t, Topology) else "it is not a polygon mesh (make one of a net with Grid.mesh())"


def as_mesh(t: Connectivity) -> Topology:
    """``t`` itself, if it is a polygon mesh."""
    if not isinstance(t, Topology):
        raise TopologyError(phrase("this scheme subdivides meshes only: {reason}", reason=refuses_non_meshes(t)))
    return t


def refusing(*reasons: Callable[[Topology], str]) -> Callable[[Connectivity], str]:
    """Why a scheme does not take ``t``: it is no polygon mesh, or the first of the reasons that holds; else empty."""

    def refuses(t: Connectivity) -> str:
        if not isinstance(t, Topology):
            return refuses_non_meshes(t)
        return next(filter(None, (reason(t) for reason in reasons)), "")

    return refuses


def refuses_non_quads(t: Connectivity) -> str:
    """Why ``t`` is no quad mesh; empty where it is."""
    return _refuses_other_faces(t, 4, phrase("quadrilateral"), "one step of Catmull-Clark makes all faces quads")


def refuses_non_triangles(t: Connectivity) -> str:
    """Why ``t`` is no triangle mesh; empty where it is."""
    return _refuses_other_faces(t, 3, phrase("triangle"), "triangulate the mesh, or use Catmull-Clark")


def refuses_sharp(t: Topology) -> str:
    """Why ``t`` has sharpness inside that a scheme without creases cannot follow; empty where it has none."""
    if t.is_smooth:
        return ""
    creases = np.flatnonzero((t.edge_sharpness > 0) & ~t.boundary)
    if creases.size:
        a, b = t.ends[creases[0]]
        return phrase(
            "the edge between vertices {a} and {b} is sharp, and it knows no creases; make the edge smooth", a=a, b=b
        )
    pins = np.flatnonzero((t.vertex_sharpness > 0) & ~t.on_boundary)
    return (
        phrase("vertex {vertex} is sharp, and it knows no corners; make the vertex smooth", vertex=pins[0])
        if pins.size
        else ""
    )


def refuses_literal_boundaries(t: Topology) -> str:
    """Why the outline of ``t`` has no curve of its own, as an interpolating scheme gives it; empty where it has one."""
    if (t.edge_sharpness[t.boundary] > 0).all():
        return ""
    return "its outline is to follow the rule of the inside, which has no points there; choose another boundary"


def refuses_open(
    t: Topology,
    why: str = "it ends at the edge between vertices {a} and {b}, and no boundary rule is known; close the mesh",
) -> str:
    """Why ``t``, which has an outline, is not taken; empty where it is closed."""
    rim = np.flatnonzero(t.boundary)
    if rim.size == 0:
        return ""
    a, b = t.ends[rim[0]]
    return phrase(why, a=a, b=b)


def refuses_curves_at_the_boundary(t: Topology) -> str:
    """Why the outline of ``t`` is to be a curve, which a dual scheme does not make; empty where it is not."""
    if (t.edge_sharpness[t.boundary] == 0).all() and (t.vertex_sharpness == 0).all():
        return ""
    return (
        "its outline is to be a curve, and a dual scheme makes none; choose the literal boundary, "
        "under which the mesh shrinks as an open net does"
    )


def only_quads(t: Connectivity, title: str) -> Topology:
    """``t`` itself, if all its faces are quads."""
    if not isinstance(t, Topology) or not t.is_quadrilateral:
        raise TopologyError(
            phrase(
                "{title} is told by centroid averaging on quads only: {reason}",
                title=title,
                reason=refuses_non_quads(t),
            )
        )
    return t


def _refuses_other_faces(t: Connectivity, size: int, kind: str, mend: str) -> str:
    if not isinstance(t, Topology):
        return refuses_non_meshes(t)
    other = np.flatnonzero(t.face_sizes != size)
    if other.size == 0:
        return ""
    return phrase(
        "face {face} has {n} corners, and every face must be a {kind}; {mend}",
        face=other[0],
        n=t.face_sizes[other[0]],
        kind=kind,
        mend=mend,
    )

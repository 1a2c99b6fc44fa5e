"""Control objects small enough to count by hand: polygons, nets, fragments, solids; and three to remember.

All are centred, about as large as the unit ball, with z up and faces counter-clockwise from
outside.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from subdivision.shapes.characters import duck, mug, pawn
from subdivision.shapes.fans import (
    dome,
    face_and_ring,
    quad_fan,
    quad_sheet,
    quad_star,
    triangle_fan,
    triangle_sheet,
    triangle_star,
    two_triangles_and_ring,
)
from subdivision.shapes.nets import cylinder_net, landscape, net, torus_net
from subdivision.shapes.polygons import closed_polygon, hook, polygon
from subdivision.shapes.solids import (
    bipyramid,
    cube,
    icosahedron,
    octahedron,
    plus_sign,
    quad_bipyramid,
    tetrahedron,
    torus,
    triangle_torus,
)
from subdivision.trace import Mesh

SHAPES: Mapping[str, Callable[[], Mesh]] = MappingProxyType({
    "cube": cube,
    "plus-sign": plus_sign,
    "torus": torus,
    "quad-bipyramid": quad_bipyramid,
    "quad-fan": lambda: quad_fan(6, rings=2),
    "quad-sheet": quad_sheet,
    "duck": duck,
    "mug": mug,
    "pawn": pawn,
    "tetrahedron": tetrahedron,
    "octahedron": octahedron,
    "icosahedron": icosahedron,
    "bipyramid": bipyramid,
    "triangle-torus": triangle_torus,
    "triangle-fan": lambda: triangle_fan(8, rings=2),
    "triangle-sheet": triangle_sheet,
    "polygon": polygon,
    "hook": hook,
    "closed-polygon": closed_polygon,
    "net": net,
    "three-direction-net": lambda: net(diagonal=True),
    "landscape": landscape,
    "cylinder-net": cylinder_net,
    "torus-net": torus_net,
})  # fmt: skip
"""Menus and the command line offer these, in this order; words are joined by hyphens."""

__all__ = [
    "SHAPES", "bipyramid", "closed_polygon", "cube", "cylinder_net", "dome", "duck", "face_and_ring", "hook",
    "icosahedron", "landscape", "mug", "net", "octahedron", "pawn", "plus_sign", "polygon", "quad_bipyramid",
    "quad_fan", "quad_sheet", "quad_star", "tetrahedron", "torus", "torus_net", "triangle_fan", "triangle_sheet",
    "triangle_star", "triangle_torus", "two_triangles_and_ring",
]  # fmt: skip

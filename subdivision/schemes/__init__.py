"""Every mesh scheme the program knows, in menu order, and the families that take parameters."""

from subdivision.schemes.box_spline import THREE_DIRECTION_LINEAR, THREE_DIRECTION_QUARTIC, ZWART_POWELL, box_spline
from subdivision.schemes.catmull_clark import CATMULL_CLARK
from subdivision.schemes.chaikin import CHAIKIN
from subdivision.schemes.doo_sabin import DOO_SABIN, DOO_SABIN_MEAN
from subdivision.schemes.four_point import Ends, four_point
from subdivision.schemes.kobbelt import KOBBELT, kobbelt
from subdivision.schemes.lane_riesenfeld import lane_riesenfeld
from subdivision.schemes.loop import LOOP, LOOP_WARREN
from subdivision.schemes.mid_edge import MID_EDGE
from subdivision.schemes.modified_butterfly import MODIFIED_BUTTERFLY
from subdivision.schemes.quad_centroid import QUAD_CENTROID
from subdivision.schemes.quad_pull import quad_pull
from subdivision.schemes.sqrt3 import SQRT3
from subdivision.schemes.tensor_product import tensor_product
from subdivision.schemes.triangle_centroid import TRIANGLE_CENTROID
from subdivision.schemes.triangle_pull import triangle_pull

LECTURE = (QUAD_CENTROID, CATMULL_CLARK, TRIANGLE_CENTROID, LOOP, LOOP_WARREN)
"""What the lecture tells: primal, approximating, with creases and boundaries."""

SCHEMES = (*LECTURE, DOO_SABIN, DOO_SABIN_MEAN, MID_EDGE, KOBBELT, MODIFIED_BUTTERFLY, SQRT3)

__all__ = [
    "CATMULL_CLARK", "CHAIKIN", "DOO_SABIN", "DOO_SABIN_MEAN", "KOBBELT", "LECTURE", "LOOP", "LOOP_WARREN", "MID_EDGE",
    "MODIFIED_BUTTERFLY", "QUAD_CENTROID", "SCHEMES", "SQRT3", "THREE_DIRECTION_LINEAR", "THREE_DIRECTION_QUARTIC",
    "TRIANGLE_CENTROID", "ZWART_POWELL", "Ends", "box_spline", "four_point", "kobbelt", "lane_riesenfeld",
    "quad_pull", "tensor_product", "triangle_pull",
]  # fmt: skip

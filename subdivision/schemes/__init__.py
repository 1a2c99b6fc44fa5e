"""Every mesh scheme the program knows, in menu order, and the families that take parameters."""

from subdivision.schemes.box_spline import THREE_DIRECTION_LINEAR, THREE_DIRECTION_QUARTIC, ZWART_POWELL, box_spline
from subdivision.schemes.catmull_clark import CATMULL_CLARK
from subdivision.schemes.chaikin import CHAIKIN
from subdivision.schemes.four_point import Ends, four_point
from subdivision.schemes.lane_riesenfeld import lane_riesenfeld
from subdivision.schemes.loop import LOOP, LOOP_WARREN
from subdivision.schemes.quad_centroid import QUAD_CENTROID
from subdivision.schemes.tensor_product import tensor_product
from subdivision.schemes.triangle_centroid import TRIANGLE_CENTROID

SCHEMES = (QUAD_CENTROID, CATMULL_CLARK, TRIANGLE_CENTROID, LOOP, LOOP_WARREN)

__all__ = [
    "CATMULL_CLARK", "CHAIKIN", "LOOP", "LOOP_WARREN", "QUAD_CENTROID", "SCHEMES", "THREE_DIRECTION_LINEAR",
    "THREE_DIRECTION_QUARTIC", "TRIANGLE_CENTROID", "ZWART_POWELL", "Ends", "box_spline", "four_point",
    "lane_riesenfeld", "tensor_product",
]  # fmt: skip

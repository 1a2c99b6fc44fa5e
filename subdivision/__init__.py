"""Subdivision curves and surfaces: topology, stages, schemes.  No windows, no graphics."""

from subdivision.manifold import TopologyError
from subdivision.plans.plan import Plan, plan
from subdivision.rows import Connectivity, Grid, Polyline
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Stencil, Step
from subdivision.topology import Boundary, Topology
from subdivision.trace import Frame, Mesh, Trace, subdivide, trace

__all__ = [
    "Boundary", "Connectivity", "Frame", "Grid", "Mesh", "Plan", "Polyline", "Role", "Scheme", "Stage", "Stencil",
    "Step", "Topology", "TopologyError", "Trace", "plan", "subdivide", "trace",
]  # fmt: skip

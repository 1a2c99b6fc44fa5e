"""From an instant of a trace to a scene: surface, net, ghost, markers by role, and what is pointed out."""

from functools import lru_cache

import numpy as np

from app.draw import motion
from app.draw.cues import cues
from app.draw.picture import Camera, Colour, Faces, Label, Lines, Markers, Scene, Shape
from app.draw.pointed import Pointed
from app.draw.theme import NAMES, SHAPES, SIZES, Theme
from app.state import Options
from subdivision import Connectivity, Frame, Grid, Mesh, Polyline, Role, Topology, Trace
from subdivision.arrays import Floats, Indices, Mask
from subdivision.exact import spelled_together
from subdivision.rows import shown_corners, shown_faces
from subdivision.words import phrase

MARKER = 0.036
"""Radius of an original point, relative to the radius of the control object."""

ROOM = 40
"""Up to so many vertices markers have that size; more of them are smaller."""

CROWDED = 0.17
"""... but no more than this part of the typical edge."""

CORNERED = 0.55
"""How much smaller helpers are, and without a ring, where a face has one for every corner."""

MANY = 220
"""Beyond so many points on a whole picture only extraordinary vertices are marked once a level is done."""

TOO_MANY = 1000
"""Beyond so many points the same holds at any time after the control object."""

MANY_ON_A_CURVE = 30
"""The same on a polygon, where none is extraordinary."""

APART = 0.6
"""Size of an extraordinary vertex marked alone, relative to an original point of the control object."""

OPEN, DENSE, SHUT = 800, 4000, 28_000
"""Edges on a whole picture: up to the first number they have their full width, up to the second their full colour;
beyond the last only the outline is drawn, and the surface speaks for itself."""

HEAVY = 2.35
"""Width of an edge laid over a surface, relative to the edges of the surface itself."""

GHOSTED = 300
"""Up to so many edges on a whole picture a net leaves a ghost."""

CREASE = 0.18
"""How much heavier a sharp edge is for each unit of its sharpness, relative to a smooth one."""

CORNER = 0.22
"""How far the heavy strokes of a sharp vertex reach along its edges."""

PALE = 0.4
"""What is left of helpers once every vertex has gone to the centroid of its own."""

FEW = 60
"""Up to so many points, ids and valences are written at them."""

KNOWN = 6
"""How many connectivities are known by the kinds of their edges."""

PALEST, DEEPEST = 0.35, 0.8
"""How deep the colour of the lightest and of the heaviest contributor is."""

CONTRIBUTOR, POINTED_OUT = phrase("contributor"), "pointed out"
"""Names of the markers of a stencil."""

EXTRAORDINARY_NAME = "extraordinary vertex"


def scene(
    frame: Frame,
    trace: Trace,
    seen: Camera,
    options: Options,
    theme: Theme,
    row: Pointed | None = None,
    marks: tuple[tuple[int, str], ...] = (),
    over: Mesh | None = None,
    share: float = 1.0,
    stands_for: Connectivity | None = None,
) -> Scene:
    """One instant of a trace in space, ``seen`` by a camera; ``over`` is laid over it in dashes.

    ``share`` is the part of the picture that the pane has: on less room less is drawn.  A coarse level that
    ``stands_for`` a finer one has strokes and markers of the sizes they have there.
    """
    fine = stands_for or frame.topology
    radius = _marker_radius(trace, frame, theme, fine) * share**-0.1
    faint = _faint(frame.topology, len(frame.points))
    faint_before = _faint(frame.before.topology, len(frame.old_points))
    faces = _faces(frame, theme) if options.surface else ()
    lines = (*_net(frame, theme, options, share, fine), *_belonging(frame, theme, options))
    lines = (*lines, *(_ghost(frame, theme, options, share) if over is None else _laid_over(over, theme, share)))
    if options.ghost:
        lines = (*lines, *cues(frame, theme, faint, faint_before))
    sizes = _sizes(frame, radius, alone=_extent(trace) * MARKER * APART, is_many=_is_many(frame, trace, faint, share))
    left = _left(frame, options) if row is None else 0.0
    leaving = _leaving(frame, theme, options, radius, faint_before, max(1 - frame.progress, left))
    markers = (*leaving, *_markers(frame, theme, options, sizes, faint))
    if options.control and frame.stage is not None:
        held, handles = _control(trace, radius, theme)
        lines, markers = (*lines, held), (*markers, handles)
    labels = (*_marks(frame, marks, theme), *_numbers(frame, theme, options))
    if row is not None and options.weights:
        picked, rays, words = _pointed_out(trace, row, theme, radius)
        markers, lines, labels = (*markers, *picked), (*lines, *rays), (*labels, *words)
    return Scene(seen, faces, lines, markers, labels)


def _extent(trace: Trace) -> float:
    """Half the diagonal of the control object."""
    return float(np.linalg.norm(np.ptp(trace.control.points, axis=0))) / 2


def _marker_radius(trace: Trace, frame: Frame, theme: Theme, fine: Connectivity) -> float:
    """Of an original point; the edges of what is ``fine`` are shorter than those of the frame, as they are more."""
    size = _extent(trace)
    ends = frame.topology.ends
    ways = frame.points.take(ends[:, 0], axis=0) - frame.points.take(ends[:, 1], axis=0)
    lengths = np.sqrt(np.einsum("ij,ij->i", ways, ways))
    apart = lengths[lengths > 1e-6 * max(size, 1e-9)]
    typical = float(np.median(apart)) if apart.size else size
    typical *= (len(ends) / fine.n_edges) ** 0.5 if len(ends) else 1.0
    fewer = (ROOM / max(fine.n_vertices, ROOM)) ** (1 / 3)
    return float(min(MARKER * size * fewer * theme.points, CROWDED * typical))


def _faint(t: Connectivity, n_points: int) -> Mask:
    """(n_points,) bool: points that only support the surface: every face round them is hidden."""
    if not t.hidden.any():
        return np.zeros(n_points, dtype=np.bool_)
    return ~np.concatenate([_shown_vertices(t), _shown_helpers(t, n_points - t.n_vertices)])


def _shown_vertices(t: Connectivity) -> Mask:
    """(n_vertices,) bool: corners of faces that are not hidden; all of them where none is."""
    shown = np.full(t.n_vertices, not t.hidden.any())
    shown[shown_faces(t)[1]] = True
    return shown


def _shown_helpers(t: Connectivity, helpers: int) -> Mask:
    """A helper belongs to the face, the edge or the corner that has its number; edges may come after faces."""
    edges: Mask = np.asarray(_shown_vertices(t)[t.ends].all(axis=1))
    faces: Mask = np.asarray(~t.hidden)
    kinds: tuple[Mask, ...] = (faces, edges, np.concatenate([faces, edges]), shown_corners(t))
    for shown in kinds:
        if len(shown) == helpers:
            return shown
    return np.ones(helpers, dtype=np.bool_)


def _faces(frame: Frame, theme: Theme) -> tuple[Faces, ...]:
    t = frame.topology
    sizes, corners = shown_faces(t)
    return (Faces(frame.points[: t.n_vertices], sizes, corners, theme.surface),) if len(sizes) else ()


def _net(frame: Frame, theme: Theme, options: Options, share: float, fine: Connectivity) -> tuple[Lines, ...]:
    """The edges; those only hidden faces have are faint, those a stage brings grow in, sharp ones are heavy."""
    if not options.net:
        return ()
    t = frame.topology
    points, faint, outline, sharp, inner = frame.points[: t.n_vertices], *_kinds(t)
    width = theme.stroke * _stroke(fine, share)
    parts = [
        Lines(points, t.ends[faint], theme.faint, 0.7 * width),
        Lines(points, t.ends[outline], theme.edge, width),
        *_within(frame, points, inner, theme.edge, width, _strength(fine, share)),
        *_creases(t, points, sharp, theme.ink, width),
        *_corners(t, points, theme.ink, width),
    ]
    return tuple(p for p in parts if len(p.pairs) and p.opacity > 0)


@lru_cache(maxsize=KNOWN)
def _kinds(t: Connectivity) -> tuple[Mask, Mask, Mask, Mask]:
    """(n_edges,) bool each: edges that only hidden faces have, and of the others the outline, the sharp, the rest."""
    shown = _shown_vertices(t)
    faint = ~(shown[t.ends[:, 0]] & shown[t.ends[:, 1]])
    outline, sharp = _outline(t), _sharp(t)
    return faint, outline & ~faint, sharp & ~faint, ~(faint | sharp | outline)


def _within(
    frame: Frame, points: Floats, inner: Mask, colour: Colour, width: float, strength: float
) -> tuple[Lines, ...]:
    """The edges within a surface, or of a curve: those that were there, and those that grow in."""
    if not strength:
        return ()
    ends, newborn = frame.topology.ends, frame.newborn
    new = newborn[ends[:, 0]] & newborn[ends[:, 1]]
    growth = float(frame.progress)
    return (
        Lines(points, ends[inner & ~new], colour, width, strength),
        Lines(points, ends[inner & new], colour, width, strength * growth),
    )


def _creases(t: Connectivity, points: Floats, sharp: Mask, colour: Colour, width: float) -> list[Lines]:
    """Sharp edges: the sharper, the heavier."""
    if not isinstance(t, Topology) or not sharp.any():
        return []
    steps = np.ceil(2 * t.edge_sharpness) / 2
    return [
        Lines(points, t.ends[sharp & (steps == step)], colour, float(1.2 + CREASE * step) * width)
        for step in np.unique(steps[sharp])
    ]


def _corners(t: Connectivity, points: Floats, colour: Colour, width: float) -> list[Lines]:
    """Sharp vertices: the first part of every edge there is heavy, the heavier the sharper."""
    if not isinstance(t, Topology) or not (sharp := t.vertex_sharpness > 0).any():
        return []
    spokes = np.concatenate([t.ends, t.ends[:, ::-1]])
    steps = np.ceil(2 * t.vertex_sharpness[spokes[:, 0]]) / 2 * sharp[spokes[:, 0]]
    tips = points[spokes[:, 0]] + CORNER * (points[spokes[:, 1]] - points[spokes[:, 0]])
    pairs = np.stack([spokes[:, 0], len(points) + np.arange(len(spokes))], axis=1)
    both = np.vstack([points, tips])
    return [
        Lines(both, pairs[steps == step], colour, float(1.2 + CREASE * step) * width)
        for step in np.unique(steps[steps > 0])
    ]


def _stroke(t: Connectivity, share: float) -> float:
    """Width of an edge in logical points: thin on surfaces, heavy on curves, heaviest where no point is marked."""
    if t.n_faces:
        return 3.2 * float(np.clip((OPEN * share / t.n_edges) ** 0.25, 0.35, 1.0))
    return 5.5 if t.n_vertices <= MANY_ON_A_CURVE else 8.0


def _strength(t: Connectivity, share: float) -> float:
    """Opacity of the edges within a surface: a close mesh must not blacken it."""
    if not t.n_faces or t.n_edges <= DENSE * share:
        return 1.0
    return max((DENSE * share / t.n_edges) ** 0.5, 0.26) if t.n_edges < SHUT * share**0.5 else 0.0


def _outline(t: Connectivity) -> Mask:
    """(n_edges,) bool: edges of one face only."""
    return np.zeros(t.n_edges, dtype=np.bool_) if isinstance(t, Polyline) else t.boundary


def _is_cornered(t: Connectivity, roles: Indices) -> bool:
    """Whether the helpers are one to each corner of each face: weighted centroids."""
    helpers = roles[t.n_vertices :]
    return 0 < len(t.origin) == len(helpers) and bool((helpers == Role.CENTROID).all())


def _belonging(frame: Frame, theme: Theme, options: Options) -> tuple[Lines, ...]:
    """A thin stroke from every weighted centroid to the corner it is for."""
    if not options.helpers or not _is_cornered(frame.topology, frame.roles):
        return ()
    t, n = frame.topology, frame.topology.n_vertices
    pairs = np.stack([t.origin, n + np.arange(len(t.origin))], axis=1)[shown_corners(t)]
    return (Lines(frame.points, pairs, theme.roles[Role.CENTROID], 2.4 * theme.stroke, float(frame.progress)),)


def _sharp(t: Connectivity) -> Mask:
    """(n_edges,) bool: inner edges with a crease on them."""
    return (t.edge_sharpness > 0) & ~t.boundary if isinstance(t, Topology) else np.zeros(t.n_edges, dtype=np.bool_)


def _ghost(frame: Frame, theme: Theme, options: Options, share: float) -> tuple[Lines, ...]:
    """What the stage began with, while and after points leave it."""
    if not options.ghost or frame.stage is None or not frame.stage.moves:
        return ()
    before = frame.before
    shown = _shown_vertices(before.topology)[before.topology.ends].all(axis=1)
    if shown.sum() > GHOSTED * share:
        return ()
    return (Lines(before.points, before.topology.ends[shown], theme.net, 2.4 * theme.stroke, 0.7, dashed=True),)


def _left(frame: Frame, options: Options) -> float:
    """Opacity of the helpers that stay in a fragment when they have done their work: what every vertex is amid."""
    is_fragment = bool(frame.topology.hidden.any())
    return PALE if options.ghost and is_fragment and (frame.old_roles == Role.CENTROID).any() else 0.0


def _leaving(
    frame: Frame, theme: Theme, options: Options, radius: float, faint: Mask, opacity: float
) -> tuple[Markers, ...]:
    """What no point continues, such as helpers that have done their work, fades while the stage plays."""
    if opacity == 0 or not len(frame.leaving):
        return ()
    shown = frame.leaving[~faint[frame.leaving]]
    cornered = _is_cornered(frame.before.topology, frame.old_roles)
    found = []
    for role in Role:
        of = shown[frame.old_roles[shown] == role]
        if len(of) and (options.helpers or role is not Role.CENTROID):
            shape, size = _marker(role, cornered)
            fade, none = np.full(len(of), opacity), np.full(len(of), -1)
            sizes = np.full(len(of), size * radius)
            found.append(Markers(frame.old_points[of], shape, theme.roles[role], sizes, fade, none, NAMES[role]))
    return tuple(found)


def _marker(role: Role, cornered: bool) -> tuple[Shape, float]:
    """Shape and relative size of a role's marker."""
    if cornered and role is Role.CENTROID:
        return Shape.SPHERE, CORNERED * SIZES[role]
    return SHAPES[role], SIZES[role]


def _is_many(frame: Frame, trace: Trace, faint: Mask, share: float) -> bool:
    """Whether there are too many points to mark them all: when a level is done, or at all."""
    if frame.stage is None:
        return False
    if (~faint).sum() > TOO_MANY * share:
        return True
    if frame.progress < 1 or len(frame.points) > frame.topology.n_vertices:
        return False
    k = trace.index(frame.stage) + 1
    is_done = k == len(trace.stages) or trace.levels[k] > trace.levels[k - 1]
    is_done = is_done or (frame.stage.moves and not isinstance(frame.topology, Grid))
    return is_done and (~faint).sum() > (MANY if frame.topology.n_faces else MANY_ON_A_CURVE) * share**0.9


def _sizes(frame: Frame, radius: float, *, alone: float, is_many: bool) -> Floats:
    """(n,) radius of each point's marker; where there are too many only extraordinary vertices have one."""
    if is_many:
        return np.where(_extraordinary(frame), alone, 0.0)
    cornered = _is_cornered(frame.topology, frame.roles)
    sizes: Floats = np.array([_marker(r, cornered)[1] for r in Role])[_roles(frame)]
    return sizes * radius * motion.grown(frame.birth)


def _roles(frame: Frame) -> Indices:
    """(n,) int: a point that changes its role wears the new one from the middle of the stage on."""
    early = frame.stage is not None and frame.stage.moves and frame.progress < 0.5
    return frame.roles_before if early else frame.roles


def _markers(frame: Frame, theme: Theme, options: Options, size: Floats, faint: Mask) -> tuple[Markers, ...]:
    """The points by role."""
    roles, cornered = _roles(frame), _is_cornered(frame.topology, frame.roles)
    found = []
    special = _extraordinary(frame) & (roles == Role.ORIGINAL) & (theme.extraordinary is not None)
    for role in Role:
        ids = np.flatnonzero((roles == role) & ~faint & ~special & (size > 0))
        if len(ids) and (options.helpers or role is not Role.CENTROID):
            shape, colour = _marker(role, cornered)[0], theme.roles[role]
            found.append(Markers(frame.points[ids], shape, colour, size[ids], np.ones(len(ids)), ids, NAMES[role]))
    ids = np.flatnonzero(special & ~faint & (size > 0))
    if len(ids) and theme.extraordinary is not None:
        all_there = np.ones(len(ids))
        found.append(
            Markers(frame.points[ids], Shape.SPHERE, theme.extraordinary, size[ids], all_there, ids, EXTRAORDINARY_NAME)
        )
    ids = np.flatnonzero(faint & (roles == Role.ORIGINAL) & (size > 0))
    if len(ids):
        small = 0.6 * size[ids]
        found.append(Markers(frame.points[ids], Shape.SPHERE, theme.faint, small, np.ones(len(ids)), ids, ""))
    return tuple(found)


def _extraordinary(frame: Frame) -> Mask:
    """(n,) bool: extraordinary vertices of a mesh."""
    found = np.zeros(len(frame.points), dtype=np.bool_)
    if isinstance(frame.topology, Topology):
        found[: frame.topology.n_vertices] = frame.topology.extraordinary
    return found


def _numbers(frame: Frame, theme: Theme, options: Options) -> tuple[Label, ...]:
    """Point numbers, or valences at vertices, where there are few enough to be read; else at extraordinary ones."""
    n = frame.topology.n_vertices
    if n > FEW:
        return _extraordinary_valences(frame, theme) if options.valences else ()
    if not (options.labels or options.valences):
        return _copies(frame, theme)
    texts = [f"v{k}" if options.labels else "" for k in range(n)]
    if options.valences:
        texts = [f"{text} n={v}".strip() for text, v in zip(texts, frame.topology.valence, strict=True)]
    return tuple(Label(p, text, theme.ink) for p, text in zip(frame.points[:n], texts, strict=True))


def _extraordinary_valences(frame: Frame, theme: Theme) -> tuple[Label, ...]:
    """Valences at extraordinary vertices, where these are few enough."""
    found = np.flatnonzero(_extraordinary(frame))
    if len(found) > FEW:
        return ()
    return tuple(Label(frame.points[v], f"n={frame.topology.valence[v]}", theme.ink) for v in found)


def _copies(frame: Frame, theme: Theme) -> tuple[Label, ...]:
    """How many points lie on top of each other, where a split has put some and they have not parted yet."""
    if frame.stage is None or frame.topology.n_vertices < len(frame.points) or isinstance(frame.topology, Topology):
        return ()
    _, first, counts = np.unique(np.round(frame.points, 9), axis=0, return_index=True, return_counts=True)
    return tuple(
        Label(frame.points[k], f"×{c}", theme.muted, 26.0) for k, c in zip(first, counts, strict=True) if c > 1
    )


def _control(trace: Trace, radius: float, theme: Theme) -> tuple[Lines, Markers]:
    """The control object over a later level: its net, and its points as handles to drag."""
    points, n = trace.control.points, trace.control.topology.n_vertices
    net = Lines(points, trace.control.topology.ends, theme.net, 2.0 * theme.stroke, 0.8)
    size, there = np.full(n, 1.15 * radius), np.ones(n)
    ink = theme.roles[Role.ORIGINAL]
    return net, Markers(points, Shape.SPHERE, ink, size, there, np.arange(n), NAMES[Role.ORIGINAL], 0)


def _marks(frame: Frame, marks: tuple[tuple[int, str], ...], theme: Theme) -> tuple[Label, ...]:
    """What the lesson writes at vertices."""
    return tuple(Label(frame.points[v], text, theme.ink, 28.0) for v, text in marks)


def _laid_over(mesh: Mesh, theme: Theme, share: float) -> tuple[Lines, ...]:
    """Another control object's net, in dashes: heavy ones over a surface, so that they tell over the same edges.

    Of a close net only the outline.
    """
    t = mesh.topology
    width = theme.stroke * (HEAVY * _stroke(t, share) if t.n_faces else 4.0)
    shown = _outline(t) if t.n_faces and t.n_edges > DENSE * share else np.ones(t.n_edges, dtype=np.bool_)
    return (Lines(mesh.points, t.ends[shown], theme.ink, width, dashed=True),)


def _pointed_out(
    trace: Trace, row: Pointed, theme: Theme, radius: float
) -> tuple[list[Markers], list[Lines], list[Label]]:
    """The point of a stencil, rays from its contributors, and the exact weight at each of them."""
    stencil = row.stencil
    parents = trace.points[row.stage - row.span][stencil.parents]
    point = row.place if row.place is not None else trace.points[row.stage][stencil.point]
    weights = np.abs(stencil.weights)
    size = radius * (0.7 + 1.1 * np.sqrt(weights / weights.max()))
    none = np.full(len(parents), -1)
    shade = PALEST + (DEEPEST - PALEST) * weights / weights.max()
    rings = Markers(parents, Shape.SPHERE, theme.selection, size, shade, none, CONTRIBUTOR)
    chosen = Markers(
        point[None], Shape.HALO, theme.selection, np.array([1.5 * radius]), np.ones(1), none[:1], POINTED_OUT
    )
    ends = np.stack([np.arange(len(parents)), np.full(len(parents), len(parents))], axis=1)
    rays = Lines(np.vstack([parents, point]), ends, theme.selection, 3.0 * theme.stroke, 0.8)
    words = [
        Label(p, text, theme.ink, 26.0)
        for p, text in zip(parents, spelled_together([w for _, w in stencil.terms]), strict=True)
    ]
    return [rings, chosen], [rays], words

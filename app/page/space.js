// Vectors, cameras and what the hand does to them: as app/draw/picture.py, layout.py and turned.py have it.

const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => times(a, 1 / Math.max(length(a), 1e-300));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

const REST = { around: 0, over: 0, zoom: 1, right: 0, up: 0 };
const STEEPEST = (89 * Math.PI) / 180;

/** How much of space is seen from top to bottom, at the focal point. */
function heightSeen(camera) {
  return camera.scale ? 2 * camera.scale : 2 * length(minus(camera.position, camera.focal)) * camera.tangent;
}

/** The camera as the hand has turned it; a parallel one does not rotate. */
function turned(camera, turn) {
  const tall = heightSeen(camera);
  let away = minus(camera.position, camera.focal);
  let up = camera.up;
  if (!camera.scale) [away, up] = rotated(away, up, turn);
  const side = unit(cross(up, away));
  up = unit(cross(away, side));
  const focal = plus(camera.focal, plus(times(side, tall * turn.right), times(up, tall * turn.up)));
  const reach = camera.scale ? 1 : 1 / turn.zoom;
  return { ...camera, position: plus(focal, times(away, reach)), focal, up, scale: camera.scale / turn.zoom };
}

function rotated(away, up, turn) {
  const far = length(away);
  let height = Math.asin(clamp(away[2] / far, -1, 1));
  const isSteep = Math.abs(height) > Math.PI / 2 - 1e-6;
  const level = isSteep ? up : away;
  const azimuth = Math.atan2(level[1], level[0]) + (isSteep && height > 0 ? Math.PI : 0) + turn.around;
  if (turn.over) height = clamp(height + turn.over, -STEEPEST, STEEPEST);
  const out = [Math.cos(azimuth), Math.sin(azimuth), 0];
  const c = Math.cos(height), s = Math.sin(height);
  return [times(plus(times(out, c), [0, 0, s]), far), plus(times(out, -s), [0, 0, c])];
}

/** The camera stepped back for a pane too narrow for it: what it must show stays visible. */
function fitted(camera, area) {
  const back = Math.max(1, (camera.aspect * area.tall) / area.wide);
  const tangent = Math.tan((camera.angle * Math.PI) / 360);
  return camera.scale ? { ...camera, tangent, scale: camera.scale * back } : { ...camera, tangent: tangent * back };
}

/** How space gets onto a pane: pixels right and down from the corner of the picture, and depth away from the eye. */
class Sight {
  constructor(camera, area) {
    this.camera = camera;
    this.area = area;
    this.ahead = unit(minus(camera.focal, camera.position));
    this.right = unit(cross(this.ahead, camera.up));
    this.up = cross(this.right, this.ahead);
    this.slack = LOOKS.slack * heightSeen(camera);
  }

  /** How many pixels a unit of space is at a depth. */
  perUnit(depth) {
    const half = this.camera.scale || Math.max(depth, 1e-9) * this.camera.tangent;
    return this.area.tall / 2 / half;
  }

  /** Three numbers for each of the points, which are three numbers each. */
  project(points) {
    const { ahead, right, up, area } = this;
    const [px, py, pz] = this.camera.position;
    const middle = [area.x + area.wide / 2, area.y + area.tall / 2];
    const flat = new Float32Array(points.length);
    for (let k = 0; k < points.length; k += 3) {
      const x = points[k] - px, y = points[k + 1] - py, z = points[k + 2] - pz;
      const depth = x * ahead[0] + y * ahead[1] + z * ahead[2];
      const scale = this.perUnit(depth);
      flat[k] = middle[0] + (x * right[0] + y * right[1] + z * right[2]) * scale;
      flat[k + 1] = middle[1] - (x * up[0] + y * up[1] + z * up[2]) * scale;
      flat[k + 2] = depth;
    }
    return flat;
  }

  /** The place of space that is seen at a pixel, as far from the eye as another place is. */
  place(x, y, beside) {
    const depth = this.project(beside)[2], scale = this.perUnit(depth), { area, ahead, right, up } = this;
    const aside = (x - area.x - area.wide / 2) / scale, above = (area.y + area.tall / 2 - y) / scale;
    const inside = plus(times(ahead, depth), plus(times(right, aside), times(up, above)));
    return plus(this.camera.position, inside);
  }

  /** A direction of space as (right, up, towards the eye). */
  turn(x, y, z) {
    const { right, up, ahead } = this;
    return [
      x * right[0] + y * right[1] + z * right[2],
      x * up[0] + y * up[1] + z * up[2],
      -(x * ahead[0] + y * ahead[1] + z * ahead[2]),
    ];
  }
}

/** How bright a side is with its unit normal (right, up, towards the eye); 1 shows the colour as it is. */
function lit(normal, [ambient, diffuse]) {
  let glow = ambient;
  for (const [direction, intensity] of LOOKS.lights) glow += diffuse * intensity * Math.max(dot(normal, direction), 0);
  return glow;
}

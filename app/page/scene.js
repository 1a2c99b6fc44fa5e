// A scene on a canvas: surfaces, strokes cut where surfaces hide them, markers, words at points.

/** Draw the parts of one scene; `point` is a thousandth of the picture's height in pixels. */
function drawScene(pen, parts, sight, relief, point, paint) {
  for (const part of parts) if (part.kind === "lines") drawLines(pen, part, sight, relief, point, paint);
  drawMarkers(pen, parts, sight, relief, paint);
  drawLabels(pen, parts, sight, point, paint);
}

function drawLines(pen, part, sight, relief, point, paint) {
  const flat = sight.project(part.points);
  pen.save();
  pen.beginPath();
  for (let k = 0; k < part.pairs.length; k += 2) {
    const a = 3 * part.pairs[k], b = 3 * part.pairs[k + 1];
    if (flat[a + 2] <= 0 || flat[b + 2] <= 0) continue;
    for (const [from, to] of visible(flat, a, b, sight, relief)) {
      pen.moveTo(flat[a] + from * (flat[b] - flat[a]), flat[a + 1] + from * (flat[b + 1] - flat[a + 1]));
      pen.lineTo(flat[a] + to * (flat[b] - flat[a]), flat[a + 1] + to * (flat[b + 1] - flat[a + 1]));
    }
  }
  pen.globalAlpha = part.opacity[0];
  pen.strokeStyle = paint(part.colour);
  pen.lineWidth = Math.max(part.width[0] * point, 0.5);
  pen.lineCap = part.dashed ? "butt" : "round";
  if (part.dashed) pen.setLineDash([sight.dash, sight.dash]);
  pen.stroke();
  pen.restore();
}

/** The stretches of a stroke, from 0 to 1, that no surface hides. */
function visible(flat, a, b, sight, relief) {
  const far = Math.hypot(flat[b] - flat[a], flat[b + 1] - flat[a + 1]);
  const count = clamp(Math.ceil(far / 3), 1, 400);
  const found = [];
  let begin = -1;
  for (let k = 0; k <= count; k += 1) {
    const t = (k + 0.5) / count;
    const at = (i) => flat[a + i] + t * (flat[b + i] - flat[a + i]);
    const isSeen = k < count && relief.shows(at(0), at(1), at(2), sight.slack);
    if (isSeen && begin < 0) begin = k;
    if (!isSeen && begin >= 0) {
      found.push([begin / count, k / count]);
      begin = -1;
    }
  }
  return found;
}

/** All markers from back to front; a hidden one is faint. */
function drawMarkers(pen, parts, sight, relief, paint) {
  const found = [];
  for (const part of parts) {
    if (part.kind !== "markers") continue;
    const flat = sight.project(part.points);
    const slack = sight.slack + 1.8 * Math.max(...part.radius);
    part.radius.forEach((radius, k) => {
      const [x, y, depth] = flat.subarray(3 * k, 3 * k + 3);
      if (depth <= 0 || radius <= 0) return;
      const isSeen = relief.shows(x, y, depth, slack);
      const strength = part.opacity[k] * (isSeen ? 1 : LOOKS.hidden);
      found.push({ x, y, depth, r: radius * sight.perUnit(depth), strength, part });
    });
  }
  found.sort((a, b) => b.depth - a.depth);
  for (const { x, y, r, strength, part } of found) {
    pen.save();
    pen.globalAlpha = strength;
    pen.translate(x, y);
    pen.scale(r, r);
    drawMarker(pen, part.shape, part.colour, sight, paint);
    pen.restore();
  }
}

/** A marker of radius 1 round the origin. */
function drawMarker(pen, shape, colour, sight, paint) {
  if (shape === "diamond" || shape === "cube") return drawSolid(pen, LOOKS[shape], colour, sight, paint);
  if (shape === "bead") {
    const [behind, before] = ring(sight);
    stroke(pen, behind, 2 * LOOKS.ring[1], paint(colour));
    drawBall(pen, LOOKS.bead, colour, paint);
    return stroke(pen, before, 2 * LOOKS.ring[1], paint(colour));
  }
  drawBall(pen, 1, colour, paint);
  if (shape === "halo") {
    const [outer, inner] = LOOKS.halo;
    const middle = new Path2D();
    middle.arc(0, 0, (outer * (1 + inner)) / 2, 0, 2 * Math.PI);
    stroke(pen, middle, outer * (1 - inner), paint(colour));
  }
}

function stroke(pen, path, width, style) {
  pen.lineWidth = width;
  pen.lineCap = "butt";
  pen.strokeStyle = style;
  pen.stroke(path);
}

/** A disc, lighter where the light comes from. */
function drawBall(pen, r, colour, paint) {
  const shine = pen.createRadialGradient(-0.32 * r, -0.36 * r, 0, 0, 0, r);
  shine.addColorStop(0, paint(colour, (c) => 0.68 * c + 82));
  shine.addColorStop(0.5, paint(colour, (c) => 0.97 * c + 8));
  shine.addColorStop(1, paint(colour, (c) => 0.84 * c));
  pen.fillStyle = shine;
  pen.beginPath();
  pen.arc(0, 0, r, 0, 2 * Math.PI);
  pen.fill();
}

/** The sides of a small solid that face the eye. */
function drawSolid(pen, solid, colour, sight, paint) {
  const places = solid.points.map((p) => sight.turn(...p));
  for (const side of solid.sides) {
    const [a, b, c] = side.map((k) => places[k]);
    const normal = unit(cross(minus(b, a), minus(c, b)));
    if (normal[2] <= 1e-6) continue;
    const glow = lit(normal, LOOKS.marker);
    pen.beginPath();
    for (const k of side) pen.lineTo(places[k][0], -places[k][1]);
    pen.closePath();
    pen.fillStyle = paint(colour, (value) => Math.min(value * glow, 255));
    pen.strokeStyle = pen.fillStyle;
    pen.lineWidth = 0.03;
    pen.fill();
    pen.stroke();
  }
}

/** The half of a bead's ring behind its ball, and the half before it. */
function ring(sight) {
  const axis = unit(sight.turn(...LOOKS.axis));
  const level = [-axis[1], axis[0], 0];
  const right = length(level) > 1e-9 ? unit(level) : [1, 0, 0];
  const down = cross(axis, right);
  const halves = [1, -1].map((sign) => {
    const path = new Path2D();
    let middle = 0;
    for (let k = 0; k <= 16; k += 1) {
      const t = (Math.PI * k) / 16;
      const p = plus(times(right, Math.cos(t)), times(down, sign * Math.sin(t)));
      path.lineTo(LOOKS.ring[0] * p[0], -LOOKS.ring[0] * p[1]);
      if (k === 8) middle = p[2];
    }
    return { path, middle };
  });
  return halves.sort((a, b) => a.middle - b.middle).map((half) => half.path);
}

// -- words at points --------------------------------------------------------------------------

const WAYS = [[1, 1], [1, 0], [-1, 1], [-1, 0], [1, -1], [-1, -1], [0, 1], [0, -1],
  [0.5, 1], [-0.5, 1], [1, 0.5], [-1, 0.5], [0.5, -1], [-0.5, -1], [1, -0.5], [-1, -0.5]];
const ROUNDS = Array.from({ length: 26 }, (_, k) => (k < 12 ? 0.5 * k : 6 + 2 * (k - 12)));
const REACHES = { sphere: 1, diamond: 1.28, cube: 1.2, bead: 1.75, halo: 1.75 };
const TIED = 0.9;

/** Words at their points, none over a marker or other words: as app/draw/labels.py places them. */
function drawLabels(pen, parts, sight, point, paint) {
  const labels = parts.filter((part) => part.kind === "label");
  if (!labels.length) return;
  const discs = markerDiscs(parts, sight), taken = [], { area } = sight;
  for (const label of labels.sort((a, b) => b.size[0] - a.size[0])) {
    const [x, y] = sight.project(label.points);
    if (x < area.x || x > area.x + area.wide || y < area.y || y > area.y + area.tall) continue;
    const size = Math.max(label.size[0] * point, LEAST_TYPE);
    const best = bestPlace(label, x, y, size, point, area, discs, taken);
    taken.push(best);
    pen.globalAlpha = label.opacity[0];
    if (best.off > TIED) tie(pen, x, y, best, paint(label.colour), point);
    const [, ascent] = TEXTS[label.text].room;
    drawText(pen, label.text, best.x, best.y + ascent * size, size, paint(label.colour), paint(LOOKS.background));
    pen.globalAlpha = 1;
  }
}

function markerDiscs(parts, sight) {
  const discs = [];
  for (const part of parts) {
    if (part.kind !== "markers") continue;
    const flat = sight.project(part.points);
    part.radius.forEach((radius, k) => {
      const r = REACHES[part.shape] * radius * sight.perUnit(flat[3 * k + 2]);
      discs.push([flat[3 * k], flat[3 * k + 1], r]);
    });
  }
  return discs;
}

/** The nearest free place for a label, and how many of its heights off that is. */
function bestPlace(label, x, y, size, point, area, discs, taken) {
  const [wide, tall] = [TEXTS[label.text].room[0] * size, (TEXTS[label.text].room[1] + TEXTS[label.text].room[2]) * size];
  const most = Math.max(...label.away.map(Math.abs));
  const under = discs.filter((d) => Math.hypot(d[0] - x, d[1] - y) < d[2]).map((d) => d[2]);
  const clear = Math.max(0, ...under) + 0.5 * most * point;
  const ways = most ? [label.away.map((n) => n / most), ...WAYS] : WAYS;
  const near = discs.filter((d) => Math.hypot(d[0] - x, d[1] - y) < d[2] + 8 * (wide + tall));
  let best = null;
  for (const off of ROUNDS) {
    if (best && best.cost <= 3 * off) break;
    ways.forEach((way, turn) => {
      const corner = Math.min(Math.abs(way[0]), Math.abs(way[1])) > 0.3 ? 0.75 : 1;
      const reach = clear * corner + off * tall;
      const box = { x: x + way[0] * (reach + wide / 2) - wide / 2, y: y - way[1] * (reach + 0.4 * tall) - tall / 2, wide, tall, off };
      const meets = 50 * isOutside(box, area) + 4 * taken.filter((other) => overlap(box, other)).length
        + near.filter((d) => covers(box, d)).length;
      box.cost = 3 * off + 0.12 * turn + 1000 * meets;
      if (!best || box.cost < best.cost) best = box;
    });
  }
  return best;
}

function isOutside(box, area) {
  return box.x < area.x || box.y < area.y || box.x + box.wide > area.x + area.wide || box.y + box.tall > area.y + area.tall;
}

const overlap = (a, b) => a.x < b.x + b.wide && b.x < a.x + a.wide && a.y < b.y + b.tall && b.y < a.y + a.tall;

function covers(box, [x, y, r]) {
  return Math.hypot(clamp(x, box.x, box.x + box.wide) - x, clamp(y, box.y, box.y + box.tall) - y) < r;
}

function tie(pen, x, y, box, style, point) {
  const line = new Path2D();
  line.moveTo(x, y);
  line.lineTo(clamp(x, box.x, box.x + box.wide), clamp(y, box.y, box.y + box.tall));
  stroke(pen, line, 1.4 * point, style);
}

// Surfaces: polygons as smoothly shaded triangles in a picture of their own, with the depth of what is nearest.

/** What does not change while points move: a triangle for each corner of a polygon, round its middle. */
class Fan {
  constructor(sizes, corners) {
    this.sizes = sizes;
    this.corners = corners;
    this.next = new Uint32Array(corners.length);
    this.face = new Uint32Array(corners.length);
    this.start = new Uint32Array(sizes.length);
    for (let f = 0, start = 0; f < sizes.length; start += sizes[f], f += 1) {
      this.start[f] = start;
      for (let k = 0; k < sizes[f]; k += 1) {
        this.next[start + k] = start + ((k + 1) % sizes[f]);
        this.face[start + k] = f;
      }
    }
  }

  /** The middle of every polygon. */
  middles(points) {
    const middles = new Float64Array(3 * this.sizes.length);
    this.corners.forEach((p, k) => {
      const f = this.face[k];
      for (let i = 0; i < 3; i += 1) middles[3 * f + i] += points[3 * p + i] / this.sizes[f];
    });
    return middles;
  }

  /** The unit normal of every polygon, also a bent one: Newell's formula. */
  normals(points, middles) {
    const normals = new Float64Array(middles.length);
    this.corners.forEach((p, k) => {
      const q = this.corners[this.next[k]], f = 3 * this.face[k];
      const ax = points[3 * p] - middles[f], ay = points[3 * p + 1] - middles[f + 1], az = points[3 * p + 2] - middles[f + 2];
      const bx = points[3 * q] - middles[f], by = points[3 * q + 1] - middles[f + 1], bz = points[3 * q + 2] - middles[f + 2];
      normals[f] += ay * bz - az * by;
      normals[f + 1] += az * bx - ax * bz;
      normals[f + 2] += ax * by - ay * bx;
    });
    return normalised(normals);
  }

  /** The normal each polygon wears at each corner: the mean round the point, but its own where that is a crease. */
  shading(points, normals) {
    const mean = new Float64Array(points.length);
    this.corners.forEach((p, k) => {
      for (let i = 0; i < 3; i += 1) mean[3 * p + i] += normals[3 * this.face[k] + i];
    });
    normalised(mean);
    const worn = new Float64Array(3 * this.corners.length);
    const [creased, smooth] = LOOKS.creased;
    this.corners.forEach((p, k) => {
      const f = 3 * this.face[k];
      const agree = normals[f] * mean[3 * p] + normals[f + 1] * mean[3 * p + 1] + normals[f + 2] * mean[3 * p + 2];
      const t = clamp((agree - creased) / (smooth - creased), 0, 1);
      const part = t * t * (3 - 2 * t);
      for (let i = 0; i < 3; i += 1) worn[3 * k + i] = normals[f + i] + part * (mean[3 * p + i] - normals[f + i]);
    });
    return normalised(worn);
  }
}

function normalised(vectors) {
  for (let k = 0; k < vectors.length; k += 3) {
    const n = Math.hypot(vectors[k], vectors[k + 1], vectors[k + 2]) || 1;
    for (let i = 0; i < 3; i += 1) vectors[k + i] /= n;
  }
  return vectors;
}

/** The z-buffer of a picture, and the surfaces in it; `fine` cells to a pixel. */
class Relief {
  constructor(wide, tall, fine) {
    this.fine = fine;
    this.columns = Math.max(Math.ceil(wide * fine), 1);
    this.rows = Math.max(Math.ceil(tall * fine), 1);
    this.nearest = new Float32Array(this.columns * this.rows).fill(Infinity);
    this.image = new ImageData(this.columns, this.rows);
    this.paint = new Uint32Array(this.image.data.buffer);
  }

  /** Paint polygons where they are nearest. */
  show(part, fan, sight) {
    const middles = fan.middles(part.points);
    const normals = fan.normals(part.points, middles);
    const worn = fan.shading(part.points, normals);
    const flat = sight.project(part.points), centre = sight.project(middles);
    const clip = sight.area;
    const faced = (a, b, c, wornBy, f) => {
      const turns = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0 ? -1 : 1;
      const glows = wornBy.map(([vectors, k]) => {
        const n = sight.turn(vectors[3 * k], vectors[3 * k + 1], vectors[3 * k + 2]);
        return lit(turns < 0 ? times(n, -1) : n, LOOKS.surface);
      });
      this.fill(a, b, c, glows, this.colour(part, fan, f), part.opacity[0], clip);
    };
    const at = (places, k) => [places[3 * k], places[3 * k + 1], places[3 * k + 2]];
    fan.corners.forEach((p, k) => {
      const f = fan.face[k], next = fan.next[k];
      const here = at(flat, p), there = at(flat, fan.corners[next]);
      if (fan.sizes[f] !== 3) {
        faced(here, there, at(centre, f), [[worn, k], [worn, next], [normals, f]], f);
      } else if (fan.next[next] === k + 2 && next === k + 1) {
        faced(here, there, at(flat, fan.corners[k + 2]), [[worn, k], [worn, next], [worn, k + 2]], f);
      }
    });
  }

  /** The colour of a polygon: one for all, or the mean of those its corners wear. */
  colour(part, fan, f) {
    if (!part.worn) return part.colour;
    const start = fan.start[f], size = fan.sizes[f], mean = [0, 0, 0];
    for (let k = start; k < start + size; k += 1) {
      for (let i = 0; i < 3; i += 1) mean[i] += part.worn[3 * fan.corners[k] + i] / size;
    }
    return mean;
  }

  fill(a, b, c, glows, colour, opacity, clip) {
    const s = this.fine;
    const ax = a[0] * s, ay = a[1] * s, bx = b[0] * s, by = b[1] * s, cx = c[0] * s, cy = c[1] * s;
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (Math.abs(area) < 1e-9 || a[2] <= 0 || b[2] <= 0 || c[2] <= 0) return;
    const left = Math.max(Math.floor(Math.min(ax, bx, cx)), Math.floor(clip.x * s), 0);
    const right = Math.min(Math.ceil(Math.max(ax, bx, cx)), Math.ceil((clip.x + clip.wide) * s), this.columns);
    const top = Math.max(Math.floor(Math.min(ay, by, cy)), Math.floor(clip.y * s), 0);
    const bottom = Math.min(Math.ceil(Math.max(ay, by, cy)), Math.ceil((clip.y + clip.tall) * s), this.rows);
    const vx = (cy - ay) / area, vy = -(cx - ax) / area, wx = -(by - ay) / area, wy = (bx - ax) / area;
    const near = -1e-6;
    for (let row = top; row < bottom; row += 1) {
      const y = row + 0.5 - ay;
      for (let column = left; column < right; column += 1) {
        const x = column + 0.5 - ax;
        const v = x * vx + y * vy, w = x * wx + y * wy;
        if (v < near || w < near || v + w > 1 - near) continue;
        const depth = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
        const cell = row * this.columns + column;
        if (depth >= this.nearest[cell]) continue;
        const glow = glows[0] + v * (glows[1] - glows[0]) + w * (glows[2] - glows[0]);
        const red = Math.min(colour[0] * glow, 255), green = Math.min(colour[1] * glow, 255);
        const blue = Math.min(colour[2] * glow, 255);
        if (opacity < 1) {
          this.blend(cell, red, green, blue, opacity);
        } else {
          this.paint[cell] = 0xff000000 | (blue << 16) | (green << 8) | red;
          this.nearest[cell] = depth;
        }
      }
    }
  }

  /** A translucent surface over what is there; it hides nothing. */
  blend(cell, red, green, blue, opacity) {
    const old = this.paint[cell], cover = (old >>> 24) / 255, kept = cover * (1 - opacity), whole = kept + opacity;
    const mixed = (shift, value) => (((old >>> shift) & 255) * kept + value * opacity) / whole;
    const alpha = Math.round(255 * whole) << 24;
    this.paint[cell] = (alpha | (mixed(16, blue) << 16) | (mixed(8, green) << 8) | mixed(0, red)) >>> 0;
  }

  /** Whether a place is in front, or no more than `slack` behind: the farthest of the cells around decides. */
  shows(x, y, depth, slack) {
    const column = Math.floor(x * this.fine), row = Math.floor(y * this.fine);
    let farthest = 0;
    for (let j = row - 1; j <= row + 1; j += 1) {
      for (let i = column - 1; i <= column + 1; i += 1) {
        const isInside = i >= 0 && j >= 0 && i < this.columns && j < this.rows;
        farthest = Math.max(farthest, isInside ? this.nearest[j * this.columns + i] : Infinity);
      }
    }
    return depth <= farthest + slack;
  }
}

// The lesson as it was written down: unpacked, and read at any time.

/** What the page carries: a table in JSON and, after it, arrays of numbers; all deflated, in base64. */
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = await new Response(stream).arrayBuffer();
  const size = new DataView(bytes).getUint32(0, true);
  const told = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size)));
  let at = 4 + size;
  told.arrays = told.arrays.map(([kind, count]) => {
    const type = { u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, f4: Float32Array }[kind];
    const found = new type(bytes.slice(at, at + count * type.BYTES_PER_ELEMENT));
    at += found.byteLength;
    return found;
  });
  return told;
}

/** What stands in the fields of a part, by its kind. */
const FIELDS = {
  faces: ["sizes", "corners", "colour", "worn"],
  lines: ["pairs", "colour", "dashed"],
  markers: ["shape", "colour", "count"],
  label: ["text", "colour", "right", "up"],
  area: ["wide", "tall"],
  stroke: ["box", "colour", "dashed"],
  plate: ["box", "fill", "stroke"],
  mark: ["box", "shape", "colour"],
  text: ["box", "text", "colour", "halo", "align"],
};

class Lesson {
  constructor(told) {
    Object.assign(this, told);
    this.palette = told.palette.map((pair) => pair.map(rgb));
    this.places = new Map();
    this.fans = new Map();
  }

  /** The parts of a pane at eased time `e`. */
  parts(pane, e) {
    const later = pane.pieces.findIndex((each) => e <= each.ends);
    let piece = pane.pieces[later < 0 ? pane.pieces.length - 1 : later];
    const before = pane.pieces[later - 1];
    if (before && e < piece.begins && e - before.ends < piece.begins - e) piece = before;
    return piece.parts.map((part) => this.part(part, e));
  }

  part(written, e) {
    const kind = written[0], tracks = written[written.length - 1], found = { kind };
    FIELDS[kind].forEach((name, k) => (found[name] = this.meant(name, written[k + 1])));
    for (const name of Object.keys(tracks)) found[name] = this.track(name, tracks[name], e);
    if (kind === "faces") found.fan = this.fan(found, written);
    if (kind === "area") found.size = [found.wide, found.tall];
    if (kind === "label") found.away = [found.right, found.up];
    return found;
  }

  meant(name, value) {
    if (["sizes", "corners", "pairs"].includes(name)) return this.arrays[value];
    if (name === "worn") return value < 0 ? null : this.arrays[value];
    if (["colour", "fill", "stroke", "halo"].includes(name)) return value < 0 ? null : this.palette[value];
    return value;
  }

  fan(part, written) {
    const key = `${written[1]} ${written[2]}`;
    if (!this.fans.has(key)) this.fans.set(key, new Fan(part.sizes, part.corners));
    return this.fans.get(key);
  }

  /** A track: one array that stays, or arrays at some instants with straight runs between them. */
  track(name, track, e) {
    const read = (number) => (name === "points" ? this.cloud(number) : this.arrays[number]);
    if (typeof track === "number") return read(track);
    const [instants, numbers] = track;
    const k = instants.findIndex((instant) => e <= instant);
    if (k < 0) return read(numbers[numbers.length - 1]);
    if (k === 0) return read(numbers[0]);
    const t = (e - instants[k - 1]) / (instants[k] - instants[k - 1]);
    const a = read(numbers[k - 1]), b = read(numbers[k]);
    return Float64Array.from(a, (value, i) => value + t * (b[i] - value));
  }

  /** Places in space, from whole steps in the lesson's box. */
  cloud(number) {
    if (!this.places.has(number)) {
      const { low, wide } = this;
      this.places.set(number, Float64Array.from(this.arrays[number], (n, k) => low[k % 3] + (n / FINE) * wide[k % 3]));
    }
    return this.places.get(number);
  }
}

const FINE = 65535;

function rgb(code) {
  return [1, 3, 5].map((k) => parseInt(code.slice(k, k + 2), 16));
}

/** Slow in, slow out; whole positions stay. */
function eased(at) {
  const whole = Math.floor(at), t = at - whole;
  return whole + t * t * (3 - 2 * t);
}

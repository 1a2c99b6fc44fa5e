// Where the reader is in the lesson, and how to go on: stop by stop, a stage playing between them.

const STAGE = 1500;
const REST_AT_STOP = 1200, FOR_EACH_LETTER = 45;
const RESTING = { leg: 0, x: 1, way: 0 };

class Player {
  /** `changed` is called when there is something else to see. */
  constructor(lesson, changed) {
    this.lesson = lesson;
    this.changed = changed;
    this.stop = 0;
    this.going = RESTING;
    this.isThrough = false;
    this.isHeld = false;
    this.until = 0;
    this.prefersStill = () => lesson.isStill || matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  get last() {
    return this.lesson.stops.length - 1;
  }

  /** What there is to see: panes, their parts, the stop whose words belong to it. */
  get shown() {
    const { leg, x, way } = this.going;
    const still = this.lesson.stops[this.stop];
    if (!way) {
      const parts = still.panes.map((pane) => this.lesson.parts(pane, 0));
      return { panes: still.panes, parts, still, corner: still.corner, legend: still.legend };
    }
    const played = this.lesson.legs[leg];
    const panes = played.panes.map((pane) => this.withReading(pane, x));
    const parts = played.panes.map((pane) => this.lesson.parts(pane, this.time(pane, x)));
    const legend = (played.legends.findLast(([begins]) => begins <= x) ?? played.legends[0])[1];
    return { panes, parts, still: this.lesson.stops[leg], corner: played.corner, legend };
  }

  time(pane, x) {
    return pane.from === pane.to ? x : eased(pane.from + x * (pane.to - pane.from));
  }

  /** The pane with what is measured at this instant. */
  withReading(pane, x) {
    if (!pane.readings) return pane;
    const [instants, texts] = pane.readings;
    const e = this.time(pane, x);
    const nearest = instants.reduce((best, at, k) => (Math.abs(at - e) < Math.abs(instants[best] - e) ? k : best), 0);
    return { ...pane, reading: texts[nearest] };
  }

  /** Rest at a stop. */
  go(stop) {
    this.stop = clamp(stop, 0, this.last);
    this.going = RESTING;
    this.isHeld = false;
    this.until = 0;
    this.changed();
  }

  /** Be at part `x` of the way to a stop, and stay there. */
  hold(leg, x) {
    this.stop = leg;
    this.going = { leg, x: clamp(x, 0, 1), way: 1 };
    this.isHeld = true;
    this.changed();
  }

  /** Play to the next stop; if playing already, be there at once and play on. */
  forward() {
    if (this.isHeld) return this.resume(1);
    this.settle();
    if (this.stop === this.last) return;
    this.start(this.stop + 1, 1);
  }

  /** Play backwards to the stop before. */
  back() {
    if (this.isHeld) return this.resume(-1);
    this.settle();
    if (this.stop === 0) return;
    this.start(this.stop, -1);
  }

  start(leg, way) {
    if (!this.lesson.legs[leg] || this.prefersStill()) {
      this.go(way > 0 ? leg : leg - 1);
    } else {
      this.going = { leg, x: way > 0 ? 0 : 1, way };
      this.changed();
    }
  }

  resume(way) {
    this.going = { ...this.going, way };
    this.isHeld = false;
    this.changed();
  }

  settle() {
    const { leg, way } = this.going;
    if (way) this.stop = way > 0 ? leg : leg - 1;
    this.going = RESTING;
    this.isHeld = false;
  }

  /** Play through to the end, with rests to read; or pause where we are. */
  toggle() {
    if (this.isMoving) {
      this.isThrough = false;
      this.isHeld = this.going.way !== 0;
    } else {
      this.isThrough = true;
      if (this.stop === this.last && !this.isHeld) this.go(0);
      else this.forward();
      if (!this.going.way) this.until = performance.now() + this.rest;
    }
    this.changed();
  }

  pause() {
    this.isThrough = false;
  }

  get rest() {
    return REST_AT_STOP + FOR_EACH_LETTER * this.lesson.captions[this.stop].length;
  }

  get isMoving() {
    return !this.isHeld && (this.going.way !== 0 || this.isThrough);
  }

  /** `passed` milliseconds later. */
  tick(passed, now) {
    const { leg, x, way } = this.going;
    if (way) {
      const there = x + (way * passed) / (STAGE * Math.max(this.lesson.legs[leg].stages, 0.5));
      if (there <= 0 || there >= 1) {
        this.settle();
        this.until = now + this.rest;
      } else {
        this.going = { leg, x: there, way };
      }
      this.changed();
    } else if (this.isThrough && now >= this.until) {
      if (this.stop === this.last) this.isThrough = false;
      else this.forward();
      if (!this.going.way) this.until = now + this.rest;
      this.changed();
    }
  }
}

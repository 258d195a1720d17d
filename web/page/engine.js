// The module's functions for JavaScript: memory, numbers, the fluid. Memory of ours is what memory.grow adds, above all of the module's.

const PAGE = 65536;
const ERRORS = { "-3": "too little memory", "-4": "full", "-5": "outside", "-6": "not finite", "-7": "bad argument", "-10": "undefined" };

/** A stretch of the module's memory that is given out piece by piece. */
export class Arena {
  constructor(exports) { this.exports = exports; this.start = this.at = this.end = 0; }

  /** Starts anew with at least so many bytes. */
  reset(bytes) {
    if (this.end - this.start < bytes) {
      const pages = Math.ceil(bytes / PAGE);
      this.start = this.exports.memory.grow(pages) * PAGE;
      this.end = this.start + pages * PAGE;
    }
    this.at = this.start;
  }

  take(bytes) {
    const place = this.at;
    this.at += (bytes + 7) & ~7;
    if (this.at > this.end) throw new Error(`an arena of ${this.end - this.start} bytes is full`);
    return place;
  }
}

/** Numbers of a scalar in the module's memory. */
export class Numbers {
  constructor(exports, scalar) { this.exports = exports; this.scalar = scalar; this.fixed = scalar === "q16"; }
  view(at, count) { return new (this.fixed ? Int32Array : Float32Array)(this.exports.memory.buffer, at, count); }
  of(x) { return this.fixed ? Math.round(x * 65536) : x; }
  to(x) { return this.fixed ? x / 65536 : x; }
  write(at, values) {
    const view = this.view(at, values.length);
    for (let i = 0; i < values.length; i++) view[i] = this.of(values[i]);
  }
  read(at, count) { return Array.from(this.view(at, count), (x) => this.to(x)); }
  call(name, ...rest) { return this.exports[`fluisim_${this.scalar}_2d_${name}`](...rest); }
}

/** Lamps along an axis at most, and the densities at which one comes on and goes out. */
export const MOST_LAMPS = 48;
const [ON, OFF] = [96, 64];

/** A fluid in two dimensions. `shape` is {box: [w, h]}, {disc: r} or {mask: {bits, width, height, pixel}}. */
export class Fluid {
  constructor(exports, arena, scalar, shape, capacity) {
    this.numbers = new Numbers(exports, scalar);
    const { box, disc, mask } = shape;
    this.size = box ?? (disc ? [2 * disc, 2 * disc] : [mask.width * mask.pixel, mask.height * mask.pixel]);
    const cells = (Math.ceil(this.size[0]) + 1) * (Math.ceil(this.size[1]) + 1);
    const bytes = this.numbers.call("bytes", capacity, cells);
    arena.reset(bytes + 65536);
    this.out = arena.take(64);
    this.vector = arena.take(64);
    const [memory, pointer] = [arena.take(bytes), arena.take(8)];
    this.density = arena.take(MOST_LAMPS ** 2);
    this.lit = arena.take(MOST_LAMPS ** 2);
    new Uint8Array(exports.memory.buffer, this.lit, MOST_LAMPS ** 2).fill(0);
    const n = this.numbers;
    let code;
    if (box) {
      n.write(this.vector, box);
      code = n.call("init_box", memory, bytes, capacity, this.vector, pointer);
    } else if (disc) {
      code = n.call("init_disc", memory, bytes, capacity, n.of(disc), pointer);
    } else {
      const bits = arena.take(mask.bits.length);
      new Uint8Array(exports.memory.buffer, bits, mask.bits.length).set(mask.bits);
      code = n.call("init_mask", memory, bytes, capacity, bits, mask.width, mask.height, n.of(mask.pixel), pointer);
    }
    this.check(code, "init");
    this.at = new Uint32Array(exports.memory.buffer, pointer, 1)[0];
    this.count = 0;
  }

  check(code, what) { if (code < 0) throw new Error(`fluisim: ${what}: ${ERRORS[code] ?? code}`); }

  /** Whether the particle is in the container and was added. */
  add(x, y) {
    this.numbers.write(this.vector, [x, y]);
    const code = this.numbers.call("add", this.at, this.vector, 0);
    if (code === -5) return false;
    this.check(code, "add");
    this.count += 1;
    return true;
  }

  /** Moves by a frame. With `raw`, the numbers are those of the scalar already. */
  step(x, y, raw = false) {
    const view = this.numbers.view(this.vector, 2);
    view[0] = raw ? x : this.numbers.of(x);
    view[1] = raw ? y : this.numbers.of(y);
    this.check(this.numbers.call("step", this.at, this.vector), "step");
  }

  impulse(x, y, radius, dx, dy) {
    this.numbers.write(this.vector, [x, y, dx, dy]);
    const code = this.numbers.call("impulse", this.at, this.vector, this.numbers.of(radius), this.vector + 8);
    this.check(code, "impulse");
  }

  /** columns² lamps of side `pixel`, 1 or 0, row by row from the bottom. Each keeps its state to the next call. */
  lamps(pixel, columns) {
    const { numbers, density, lit } = this;
    this.check(numbers.call("draw", this.at, numbers.of(pixel), columns, columns, density), "draw");
    this.check(numbers.exports.fluisim_light_lamps(density, columns ** 2, ON, OFF, lit), "light_lamps");
    return new Uint8Array(numbers.exports.memory.buffer, lit, columns ** 2);
  }

  /** Where the particles are: x0, y0, x1, y1, … in h. */
  positions(into) {
    const ask = this.numbers.exports[`fluisim_${this.numbers.scalar}_2d_position`];
    const view = this.numbers.view(this.out, 2);
    const unit = this.numbers.fixed ? 1 / 65536 : 1;
    for (let i = 0; i < this.count; i++) {
      ask(this.at, i, this.out);
      into[2 * i] = view[0] * unit;
      into[2 * i + 1] = view[1] * unit;
    }
    return into;
  }
}

/** The exports of a module given as bytes. */
export async function load(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  return instance.exports;
}

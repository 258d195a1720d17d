// The scene of the golden digests: 48 particles in a box of 5.5, turned and shaken for 600 frames.
import { Fluid } from "./engine.js";

const TURNS = [[0, -6], [4, -4], [6, 0], [4, 4]];
const NOTHING = 0xcbf29ce484222325n;
const FNV = 0x100000001b3n;
const FRAMES = 600;

/** FNV-1a of a 32-bit number that counts as eight bytes. */
function fnv(digest, bits) {
  for (let byte = 0; byte < 8; byte++) {
    digest = BigInt.asUintN(64, (digest ^ BigInt(byte < 4 ? (bits >>> (8 * byte)) & 255 : 0)) * FNV);
  }
  return digest;
}

/** n / m as the scalar rounds it: fixed point to the nearest, halves away from zero. */
function ratio(fixed, n, m) {
  if (!fixed) return Math.fround(n / m);
  return Math.sign(n) * Math.floor((Math.abs(n) * 65536 + Math.floor(m / 2)) / m);
}

export class Scene {
  constructor(exports, arena, scalar) {
    this.fluid = new Fluid(exports, arena, scalar, { box: [5.5, 5.5] }, 48);
    this.name = scalar === "q16" ? "i16f16" : "f32";
    this.frame = 0;
    for (let k = 0; k < 48; k++) this.fluid.add((2 * (k % 6) + 1) / 4, (2 * Math.floor(k / 6) + 1) / 4);
  }

  get done() { return this.frame >= FRAMES; }

  step() {
    const { frame } = this;
    const turn = TURNS[Math.floor(frame / 75) % 4];
    const shake = (((frame * 7) % 5) - 2) * 3;
    const fixed = this.fluid.numbers.fixed;
    this.fluid.step(ratio(fixed, turn[0] + shake, 1000), ratio(fixed, turn[1], 1000), true);
    this.frame += 1;
  }

  /** The digest of "positions", "velocities" or "pressures", 16 hexadecimal digits. */
  digest(quantity) {
    const { numbers, at, out, count } = this.fluid;
    const [name, axes] = { positions: ["position", 2], velocities: ["velocity", 2], pressures: ["pressure", 1] }[quantity];
    let digest = NOTHING;
    for (let i = 0; i < count; i++) {
      numbers.call(name, at, i, out);
      const view = numbers.view(out, axes);
      if (!numbers.fixed) for (let axis = 0; axis < axes; axis++) view[axis] += 0; // both zeros have the same bits
      const bits = new Uint32Array(numbers.exports.memory.buffer, out, axes);
      for (let axis = 0; axis < axes; axis++) digest = fnv(digest, bits[axis]);
    }
    return digest.toString(16).padStart(16, "0");
  }

  /** The golden row of a quantity. */
  row(quantity) { return `${this.name} 2d position-based ${quantity}`; }
}

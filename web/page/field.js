// A field sampled on a jittered lattice, its estimate by the module, and the error against the truth.
import { Numbers } from "./engine.js";

const SIDE = 16; // samples along an axis; lengths are in spacings of the lattice
export const POINTS = 28;
const WAVE = (2 * Math.PI) / 12;

export const truth = (x, y) => Math.sin(WAVE * x) * Math.cos(WAVE * y);
const slope = (x, y) => [WAVE * Math.cos(WAVE * x) * Math.cos(WAVE * y), -WAVE * Math.sin(WAVE * x) * Math.sin(WAVE * y)];

/** Numbers from -1 to 1, the same each time. */
function random() {
  let state = 7;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 31 - 1;
}

/** The samples' positions. */
export function lattice(jitter) {
  const next = random();
  return Array.from({ length: 2 * SIDE * SIDE }, (_, k) => {
    const i = k >> 1;
    return (k & 1 ? Math.floor(i / SIDE) : i % SIDE) + 0.5 + jitter * next();
  });
}

/** Where point `index` of the estimate lies along an axis: away from the border, beyond which there are no samples. */
export const place = (index) => 3 + ((SIDE - 6) * (index + 0.5)) / POINTS;

/** Values and gradients at POINTS x POINTS points, and the roots of the mean squares of their errors; null for a kernel without sums. */
export function estimate(exports, arena, { scalar, kernel, support, method, jitter }) {
  const n = new Numbers(exports, scalar);
  const count = SIDE * SIDE;
  arena.reset(65536);
  const [x, masses, densities, volumes, values] = [2, 1, 1, 1, 1].map((axes) => arena.take(4 * axes * count));
  const [point, value, gradient] = [8, 8, 8].map((bytes) => arena.take(bytes));
  const positions = lattice(jitter);
  n.write(x, positions);
  n.write(masses, Array(count).fill(1));
  n.write(values, Array.from({ length: count }, (_, i) => truth(positions[2 * i], positions[2 * i + 1])));
  if (n.call("densities", kernel, n.of(support), x, masses, count, densities) < 0) return null;
  if (exports[`fluisim_${scalar}_volumes`](masses, densities, count, volumes) < 0) return null;
  const found = { values: [], gradients: [], undefined: 0 };
  let [errors, slopes, defined] = [0, 0, 0];
  for (let k = 0; k < POINTS * POINTS; k++) {
    const at = [place(k % POINTS), place(Math.floor(k / POINTS))];
    n.write(point, at);
    const code = n.call(method, kernel, n.of(support), x, volumes, values, count, point, value, gradient);
    if (code < 0) {
      found.values.push(NaN); found.gradients.push([NaN, NaN]); found.undefined += 1;
      continue;
    }
    const [a, g, right] = [n.read(value, 1)[0], n.read(gradient, 2), slope(...at)];
    found.values.push(a); found.gradients.push(g);
    errors += (a - truth(...at)) ** 2;
    slopes += (g[0] - right[0]) ** 2 + (g[1] - right[1]) ** 2;
    defined += 1;
  }
  return { ...found, positions, error: Math.sqrt(errors / defined), slopeError: Math.sqrt(slopes / defined) / WAVE };
}

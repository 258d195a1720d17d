// Two views of a fluid: smooth, from the positions alone, and lamps as on a badge.
import { MOST_LAMPS } from "./engine.js";

const CELLS = 180;
const small = Object.assign(document.createElement("canvas"), { width: CELLS, height: CELLS });
const picture = small.getContext("2d").createImageData(CELLS, CELLS);
let [cells, spare] = [new Float32Array(CELLS * CELLS), new Float32Array(CELLS * CELLS)];

/** Adds each particle to its four nearest of the CELLS² cells, as 1/(4 w²), w the side of a cell: fluid at rest is 1. */
function splat(into, side, positions, count) {
  into.fill(0);
  const weight = (CELLS / side) ** 2 / 4;
  const most = CELLS - 1.001;
  for (let i = 0; i < count; i++) {
    const x = Math.min(Math.max((positions[2 * i] / side) * CELLS - 0.5, 0), most);
    const y = Math.min(Math.max((positions[2 * i + 1] / side) * CELLS - 0.5, 0), most);
    const [column, row] = [x | 0, y | 0];
    const [fx, fy, at] = [x - column, y - row, row * CELLS + column];
    into[at] += weight * (1 - fx) * (1 - fy);
    into[at + 1] += weight * fx * (1 - fy);
    into[at + CELLS] += weight * (1 - fx) * fy;
    into[at + CELLS + 1] += weight * fx * fy;
  }
}

/** A mean over 2 r + 1 cells along lines that are `step` apart; the border repeats. */
function blur(from, to, r, step) {
  const stride = step === 1 ? CELLS : 1;
  for (let line = 0; line < CELLS; line++) {
    const start = line * stride;
    const last = start + (CELLS - 1) * step;
    let sum = from[start] * r;
    for (let k = 0; k <= r; k++) sum += from[start + k * step];
    for (let k = 0, at = start; k < CELLS; k++, at += step) {
      to[at] = sum / (2 * r + 1);
      sum += from[Math.min(at + (r + 1) * step, last)] - from[Math.max(at - r * step, start)];
    }
  }
}

export function drawSmooth(context, { side, positions, count }) {
  splat(cells, side, positions, count);
  const r = Math.max(1, Math.round((0.3 * CELLS) / side));
  for (let pass = 0; pass < 2; pass++) {
    blur(cells, spare, r, 1);
    blur(spare, cells, r, CELLS);
  }
  const { data } = picture;
  for (let row = 0; row < CELLS; row++) {
    for (let column = 0; column < CELLS; column++) {
      const at = row * CELLS + column;
      const [density, above] = [cells[at], cells[Math.min(row + 3, CELLS - 1) * CELLS + column]];
      const light = Math.min(Math.max((density - above) * 1.6, 0), 1);
      const to = 4 * ((CELLS - 1 - row) * CELLS + column);
      data[to] = 20 + 170 * light;
      data[to + 1] = 100 + 60 * Math.min(density, 1.2) + 60 * light;
      data[to + 2] = 225 + 30 * light;
      data[to + 3] = 255 * Math.min(Math.max((density - 0.32) * 5, 0), 1);
    }
  }
  small.getContext("2d").putImageData(picture, 0, 0);
  context.imageSmoothingEnabled = true;
  context.imageSmoothingQuality = "high";
  context.drawImage(small, 0, 0, context.canvas.width, context.canvas.height);
}

/** Lamps of about a support radius, as the module lights them. */
export function drawLamps(context, { side, fluid, contains }) {
  const columns = Math.min(Math.max(Math.round(side), 8), MOST_LAMPS);
  const lit = fluid.lamps(side / columns, columns);
  const pitch = context.canvas.width / columns;
  const paths = [new Path2D(), new Path2D()];
  for (let at = 0; at < lit.length; at++) {
    const [column, row] = [at % columns, Math.floor(at / columns)];
    if (!contains(((column + 0.5) * side) / columns, ((row + 0.5) * side) / columns)) continue;
    const [x, y] = [(column + 0.5) * pitch, (columns - row - 0.5) * pitch];
    paths[lit[at]].moveTo(x, y);
    paths[lit[at]].arc(x, y, pitch * 0.36, 0, 7);
  }
  context.fillStyle = "#1b2334";
  context.fill(paths[0]);
  context.fillStyle = "#ffb347";
  context.fill(paths[1]);
}

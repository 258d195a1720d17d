// The pane of the fluid: its container, how it is tilted and poked, and what is told about it.
import { Arena, Fluid } from "./engine.js";
import { drawLamps, drawSmooth } from "./draw.js";

const GRAVITY = 0.005;

/** Whether a point of the unit square is in a heart. */
function inHeart(u, v) {
  const [x, y] = [2.5 * (u - 0.5), 2.5 * (v - 0.46)];
  return (x * x + y * y - 1) ** 3 - x * x * y ** 3 < 0;
}

/** A container that `count` particles at rest fill by about half, its side, and which points are in it. */
export function container(shape, count) {
  const area = count / 4 / 0.5;
  if (shape === "box") {
    const side = Math.max(Math.sqrt(area), 2);
    return { shape: { box: [side, side] }, side, contains: () => true };
  }
  if (shape === "disc") {
    const r = Math.max(Math.sqrt(area / Math.PI), 1);
    return { shape: { disc: r }, side: 2 * r, contains: (x, y) => (x - r) ** 2 + (y - r) ** 2 < r * r };
  }
  const side = Math.sqrt(area / 0.53);
  const width = Math.min(Math.floor(2 * side), 96);
  const row = Math.ceil(width / 8);
  const bits = new Uint8Array(row * width);
  const inside = (column, line) => inHeart((column + 0.5) / width, (line + 0.5) / width);
  for (let k = 0; k < width * width; k++) {
    const [column, line] = [k % width, Math.floor(k / width)];
    if (inside(column, line)) bits[line * row + (column >> 3)] |= 128 >> (column & 7);
  }
  const pixel = Math.ceil((side / width) * 65536) / 65536;
  const contains = (x, y) => inside(Math.floor(x / pixel), Math.floor(y / pixel));
  return { shape: { mask: { bits, width, height: width, pixel } }, side: width * pixel, contains };
}

/** What the pane shows. */
export class Pool {
  constructor(exports, canvas) {
    this.exports = exports;
    this.arena = new Arena(exports);
    this.context = canvas.getContext("2d");
    this.options = { view: "smooth", scalar: "f32", shape: "disc", count: 1000 };
    this.angle = 0; // of down, clockwise from the bottom
    this.down = [0, -GRAVITY];
    this.start();
  }

  /** Fills the container from the bottom up. */
  start() {
    const { scalar, shape, count } = this.options;
    Object.assign(this, container(shape, count));
    this.fluid = new Fluid(this.exports, this.arena, scalar, this.shape, count);
    this.positions = new Float32Array(2 * count);
    for (let y = 0.25; y < this.side && this.fluid.count < count; y += 0.5) {
      for (let x = 0.25; x < this.side && this.fluid.count < count; x += 0.5) this.fluid.add(x, y);
    }
    this.count = this.fluid.count;
    this.fluid.positions(this.positions);
  }

  tilt(angle, strength = 1) {
    this.angle = ((angle + 540) % 360) - 180;
    const radians = (this.angle * Math.PI) / 180;
    this.down = [-Math.sin(radians) * GRAVITY * strength, -Math.cos(radians) * GRAVITY * strength];
  }

  /** A push at a point of the canvas, 0 to 1 from its top left, by shares of its side. */
  poke(u, v, du, dv) {
    const held = (change) => Math.min(Math.max(change * this.side, -0.3), 0.3);
    this.fluid.impulse(u * this.side, (1 - v) * this.side, Math.max(1.5, this.side * 0.09), held(du), held(-dv));
  }

  step() {
    this.fluid.step(...this.down);
    this.fluid.positions(this.positions);
  }

  draw() {
    const { canvas } = this.context;
    this.context.clearRect(0, 0, canvas.width, canvas.height);
    if (this.options.view === "lamps") return drawLamps(this.context, this);
    this.context.save();
    this.outline();
    this.context.clip();
    drawSmooth(this.context, this);
    this.context.restore();
  }

  /** The container behind the fluid; its outline stays the path. */
  outline() {
    const width = this.context.canvas.width;
    const { disc, mask } = this.shape;
    this.context.beginPath();
    if (disc) this.context.arc(width / 2, width / 2, width / 2, 0, 7);
    else if (!mask) this.context.rect(0, 0, width, width);
    const pixel = mask ? width / mask.width : 0;
    for (let k = 0; mask && k < mask.width ** 2; k++) {
      const [column, line] = [k % mask.width, Math.floor(k / mask.width)];
      if (this.contains((column + 0.5) * mask.pixel, (line + 0.5) * mask.pixel)) {
        this.context.rect(column * pixel, width - (line + 1) * pixel, pixel + 0.5, pixel + 0.5);
      }
    }
    this.context.fillStyle = "#152238";
    this.context.fill();
  }
}

// The pane of the kernels and of the sampled field.
import { Arena } from "./engine.js";
import { POINTS, estimate, place } from "./field.js";

const [VALUE, SLOPE, NORMALISATION, RATIO] = [0, 1, 2, 3];
const element = (id) => document.getElementById(id);
const short = (x) => (Number.isNaN(x) ? "–" : Math.abs(x) >= 1e4 || (x !== 0 && Math.abs(x) < 1e-3) ? x.toExponential(3) : x.toFixed(4));

export class Kernels {
  constructor(exports) {
    this.exports = exports;
    this.arena = new Arena(exports);
    element("kernel").innerHTML = KERNELS.map((name) => `<option>${name}</option>`).join("");
    element("kernel").value = "wendland-c2";
    for (const id of ["kernel", "dimension", "q"]) element(id).addEventListener("input", () => this.draw());
    for (const id of ["method", "field-scalar", "support", "jitter", "kernel"]) {
      element(id).addEventListener("input", () => this.drawField());
    }
  }

  number(kernel, quantity, q = 0.5) {
    return this.exports.fluisim_web_kernel(kernel, Number(element("dimension").value), quantity, q);
  }

  show() { this.draw(); this.drawField(); }

  draw() {
    const canvas = element("curves");
    const context = canvas.getContext("2d");
    const chosen = element("kernel").selectedIndex;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.fillStyle = "#2b3a55";
    context.fillRect(20, canvas.height / 2, canvas.width - 40, 2);
    for (let kernel = 0; kernel < KERNELS.length; kernel++) if (kernel !== chosen) this.curve(context, kernel, VALUE, "#31415f", 2);
    this.curve(context, chosen, SLOPE, "#ffb347", 4);
    this.curve(context, chosen, VALUE, "#4aa8ff", 5);
    const q = Number(element("q").value);
    context.fillStyle = "#9fb0c9";
    context.fillRect(20 + q * (canvas.width - 40) - 1, 10, 2, canvas.height - 20);
    element("q-told").textContent = q.toFixed(2);
    const rows = [["value W", VALUE], ["slope dW/dr", SLOPE], ["normalisation σ", NORMALISATION], ["support radius / smoothing length", RATIO]];
    element("numbers").innerHTML = rows
      .map(([name, quantity]) => `<tr><td>${name}</td><td>${short(this.number(chosen, quantity, q))}</td></tr>`).join("");
  }

  /** A kernel's value above the axis or its slope below it, scaled by the largest size. A kernel that diverges begins at 0.1. */
  curve(context, kernel, quantity, colour, width) {
    const { canvas } = context;
    const first = KERNELS[kernel] === "viscosity" ? 0.1 : 0;
    if (Number.isNaN(this.number(kernel, quantity))) return;
    const heights = [];
    for (let k = 0; k <= 200; k++) heights.push(this.number(kernel, quantity, first + ((1 - first) * k) / 200));
    const most = Math.max(...heights.map(Math.abs));
    context.beginPath();
    heights.forEach((height, k) => {
      const x = 20 + (first + ((1 - first) * k) / 200) * (canvas.width - 40);
      context.lineTo(x, canvas.height / 2 - (height / most) * (canvas.height / 2 - 16));
    });
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
  }

  drawField() {
    const value = (id) => Number(element(id).value);
    const [kernel, support, jitter] = [element("kernel").selectedIndex, value("support"), value("jitter")];
    const [scalar, method] = [element("field-scalar").value, element("method").value];
    element("support-told").textContent = `${support.toFixed(1)} spacings`;
    element("jitter-told").textContent = `${jitter.toFixed(2)} spacings`;
    const context = element("field").getContext("2d");
    context.clearRect(0, 0, 720, 720);
    const found = estimate(this.exports, this.arena, { scalar, kernel, support, method, jitter });
    if (!found) {
      element("errors").textContent = "This kernel diverges at 0: there are no sums with it.";
      return;
    }
    this.paint(context, found);
    const holes = found.undefined ? ` At ${found.undefined} of ${POINTS * POINTS} points there is no value: too few samples in reach.` : "";
    element("errors").textContent = `Against the truth, root mean square: value ${short(found.error)}, gradient ${short(found.slopeError)} `
      + `(of amplitudes of 1).${holes}`;
  }

  paint(context, { values, gradients, positions }) {
    const cell = 720 / POINTS;
    values.forEach((a, k) => {
      const shade = Math.min(Math.abs(a), 1);
      context.fillStyle = Number.isNaN(a) ? "#333" : a > 0 ? `rgb(${20 + 54 * shade},${28 + 140 * shade},${45 + 210 * shade})` : `rgb(${20 + 235 * shade},${28 + 151 * shade},${45 + 26 * shade})`;
      // whole points of the canvas, or seams show between the squares
      const [left, top] = [Math.round((k % POINTS) * cell), Math.round(720 - (Math.floor(k / POINTS) + 1) * cell)];
      context.fillRect(left, top, Math.ceil(cell), Math.ceil(cell));
    });
    context.strokeStyle = context.fillStyle = "#ffffff";
    context.lineWidth = 2;
    context.globalAlpha = 0.75;
    gradients.forEach(([gx, gy], k) => {
      const [column, row] = [k % POINTS, Math.floor(k / POINTS)];
      if (column % 3 !== 1 || row % 3 !== 1 || Number.isNaN(gx)) return;
      const [x, y] = [(column + 0.5) * cell, 720 - (row + 0.5) * cell];
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + gx * 70, y - gy * 70);
      context.stroke();
      context.fillRect(x - 3, y - 3, 6, 6);
    });
    const [first, unit] = [place(-0.5), cell / (place(1) - place(0))];
    context.fillStyle = "#05080e";
    for (let i = 0; i < positions.length; i += 2) {
      context.beginPath();
      context.arc((positions[i] - first) * unit, 720 - (positions[i + 1] - first) * unit, 4, 0, 7);
      context.fill();
    }
    context.globalAlpha = 1;
  }
}

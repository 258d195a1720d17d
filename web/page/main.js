// What joins the panes: switches, keys, the pointer, the device's tilt, the frames.
import { Arena, load } from "./engine.js";
import { Scene } from "./digest.js";
import { Pool } from "./fluid.js";
import { Kernels } from "./kernels.js";

const MOST = 20000;
const exports = await load(Uint8Array.from(atob(MODULE), (letter) => letter.charCodeAt(0)));
const pool = new Pool(exports, element("fluid"));
const kernels = new Kernels(exports);
const scenes = new Arena(exports);
let scene;
let running = !matchMedia("(prefers-reduced-motion: reduce)").matches;
let pane = "fluid";

/** Particles of a place of the slider: 100 to 20,000, each place a few per cent more. */
const particles = (at) => Math.round(100 * (MOST / 100) ** (at / 100));
const sliderAt = (count) => (100 * Math.log(count / 100)) / Math.log(MOST / 100);

function tellTilt() {
  const radians = (pool.angle * Math.PI) / 180;
  element("dial").setAttribute("aria-valuenow", Math.round(pool.angle));
  element("dial").firstChild.style.transform = `translate(${-Math.sin(radians) * 34}px, ${Math.cos(radians) * 34}px)`;
}

function setRunning(run) {
  running = run;
  element("run").textContent = run ? "Pause" : "Run";
  element("run").setAttribute("aria-pressed", run);
  if (!scene.done) element("verdict").textContent = run ? "running" : "press Run";
}

function setOption(name, value) {
  pool.options[name] = value;
  for (const button of element(name)?.querySelectorAll("button") ?? []) {
    button.setAttribute("aria-pressed", button.value === value);
  }
  if (name === "scalar") newScene();
  if (name !== "view") pool.start();
  pool.draw();
}

function setCount(count) {
  element("count-told").textContent = count;
  element("count").value = sliderAt(count);
  setOption("count", count);
}

function newScene() {
  scene = new Scene(exports, scenes, pool.options.scalar);
  element("golden").textContent = GOLDEN[scene.row("positions")];
  element("verdict").className = "";
  element("verdict").textContent = running ? "running" : "press Run";
}

/** Moves the scene of the digests and tells them. */
function proceed() {
  if (scene.done) return;
  for (let k = 0; k < 3; k++) scene.step();
  element("frame").textContent = scene.frame;
  element("here").textContent = scene.digest("positions");
  if (!scene.done) return;
  const same = ["positions", "velocities", "pressures"].every((name) => scene.digest(name) === GOLDEN[scene.row(name)]);
  element("verdict").className = same ? "same" : "differs";
  element("verdict").textContent = same ? "✓ positions, velocities and pressures: the same bits" : "✗ the bits differ";
}

const told = { steps: 0, draws: 0, frames: 0, since: performance.now() };

function tell(now) {
  if (now - told.since < 500) return;
  const a = (sum) => (sum / told.frames).toFixed(1);
  told.step = told.steps / told.frames;
  told.draw = told.draws / told.frames;
  element("rate").textContent = `${Math.round((told.frames * 1000) / (now - told.since))} frames a second`;
  element("cost").textContent = `step ${a(told.steps)} ms, picture ${a(told.draws)} ms`;
  Object.assign(told, { steps: 0, draws: 0, frames: 0, since: now });
}

let [due, last] = [0, 0];

/** A frame of the screen: at most 60 steps a second, whatever the screen does. */
function frame(now) {
  requestAnimationFrame(frame);
  due = Math.min(due + (now - last) * 0.06, 1.5);
  last = now;
  if (!running || pane !== "fluid" || due < 0.9) return;
  due = Math.max(due - 1, 0);
  const before = performance.now();
  pool.step();
  const between = performance.now();
  pool.draw();
  told.steps += between - before;
  told.draws += performance.now() - between;
  told.frames += 1;
  proceed();
  tell(performance.now());
}

function keys(event) {
  const turn = { ArrowLeft: 15, ArrowRight: -15 }[event.key];
  if (turn) pool.tilt(pool.angle + turn);
  else if (event.key === "ArrowUp") pool.tilt(180);
  else if (event.key === "ArrowDown") pool.tilt(0);
  else if (event.key === " ") setRunning(!running);
  else if (event.key === "Enter") pool.poke(0.5, 0.8, 0.02, -0.03);
  else return;
  event.preventDefault();
  tellTilt();
}

function pointers() {
  let at = null;
  const place = (event) => {
    const box = element("fluid").getBoundingClientRect();
    const side = Math.min(box.width, box.height);
    return [(event.clientX - box.left - (box.width - side) / 2) / side, (event.clientY - box.top - (box.height - side) / 2) / side];
  };
  element("fluid").addEventListener("pointerdown", (event) => {
    at = place(event);
    element("fluid").setPointerCapture(event.pointerId);
    pool.poke(...at, 0, -0.012);
  });
  element("fluid").addEventListener("pointermove", (event) => {
    if (!at) return;
    const [u, v] = place(event);
    pool.poke(u, v, (u - at[0]) * 0.3, (v - at[1]) * 0.3);
    at = [u, v];
  });
  for (const end of ["pointerup", "pointercancel"]) element("fluid").addEventListener(end, () => (at = null));
  const turn = (event) => {
    if (event.type === "pointerdown") element("dial").setPointerCapture(event.pointerId);
    else if (!event.buttons) return;
    const box = element("dial").getBoundingClientRect();
    const [x, y] = [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2];
    pool.tilt((Math.atan2(-x, y) * 180) / Math.PI);
    tellTilt();
  };
  for (const kind of ["pointerdown", "pointermove"]) element("dial").addEventListener(kind, turn);
}

/**
 * Where down is on the screen, to the right and up; its length is 1 where the screen stands upright. In the device's own axes it is
 * (cos beta sin gamma, -sin beta): W3C, Device Orientation and Motion. `turned` is by how many degrees the page is turned against them.
 */
function downOnScreen(beta, gamma, turned) {
  const [b, g, t] = [beta, gamma, turned].map((degrees) => (degrees * Math.PI) / 180);
  const [x, y] = [Math.cos(b) * Math.sin(g), -Math.sin(b)];
  return [x * Math.cos(t) - y * Math.sin(t), x * Math.sin(t) + y * Math.cos(t)];
}

/** The device's tilt, after a press: browsers of phones ask for leave, and some give it to pages of https alone. */
async function sensor() {
  const Sensor = window.DeviceOrientationEvent;
  const leave = Sensor?.requestPermission ? await Sensor.requestPermission().catch(() => "denied") : "granted";
  if (!Sensor || leave !== "granted") return void (element("sensor").textContent = "No sensor here");
  let seen = false;
  addEventListener("deviceorientation", ({ beta, gamma }) => {
    if (beta === null) return;
    seen = true;
    const [x, y] = downOnScreen(beta, gamma, screen.orientation?.angle ?? 0);
    pool.tilt((Math.atan2(-x, -y) * 180) / Math.PI, Math.min(Math.hypot(x, y), 1));
    tellTilt();
  });
  setTimeout(() => (element("sensor").textContent = seen ? "Tilting with the device" : "No sensor here"), 1000);
}

function choosePane(name) {
  pane = name;
  for (const other of ["fluid", "kernels"]) {
    element(`pane-${other}`).hidden = other !== name;
    element(`tab-${other}`).setAttribute("aria-selected", other === name);
    element(`tab-${other}`).tabIndex = other === name ? 0 : -1;
  }
  if (name === "kernels") kernels.show();
}

for (const name of ["view", "scalar", "shape"]) {
  element(name).addEventListener("click", ({ target }) => target.value && setOption(name, target.value));
}
for (const name of ["fluid", "kernels"]) {
  element(`tab-${name}`).addEventListener("click", () => choosePane(name));
  element(`tab-${name}`).addEventListener("keydown", ({ key }) => {
    if (key !== "ArrowLeft" && key !== "ArrowRight") return;
    choosePane(name === "fluid" ? "kernels" : "fluid");
    element(`tab-${pane}`).focus();
  });
}
element("count").addEventListener("input", () => setCount(particles(Number(element("count").value))));
element("run").addEventListener("click", () => setRunning(!running));
element("again").addEventListener("click", () => { newScene(); pool.start(); pool.draw(); });
element("most").addEventListener("click", () => {
  if (told.step) setCount(Math.round(Math.min(Math.max((pool.count * Math.max(13 - told.draw, 2)) / told.step, 100), MOST)));
});
element("sensor").addEventListener("click", sensor);
for (const id of ["fluid", "dial"]) element(id).addEventListener("keydown", keys);
pointers();
for (const name of ["view", "scalar", "shape"]) setOption(name, pool.options[name]);
setCount(pool.options.count);
setRunning(running);
tellTilt();
requestAnimationFrame(frame);

// Runs the pendant's firmware on an emulated Pico, tilts it, and compares what its display shows.
// node run.mjs UF2 GOLDEN OUT GIF [--update]: rows of a table on standard output, the rest on standard error.

import fs from "node:fs";
import { check } from "./golden.mjs";
import { Lis3dh, Ssd1306 } from "./devices.mjs";
import { enlarge, gif } from "./picture.mjs";
import { Pico } from "./pico.mjs";

/** What the sensor reads until which frame: upright, its right side down, upside down, upright again. */
const G = 16384;
const TILTS = [[20, [0, G, 0]], [90, [-G, 0, 0]], [150, [0, -G, 0]], [Infinity, [0, G, 0]]];
const LAST = 200;
/** Frames that are compared. */
const PICTURES = [["pico-at-rest", 19], ["pico-flowing-right", 36], ["pico-right-side-down", 89], ["pico-upside-down", 149]];
/** The animation: from which frame on, every so many, at so many times the display's size, in these colours. */
const ANIMATION = { begin: 15, every: 2, scale: 3, colours: [[10, 14, 24], [150, 215, 255]] };
/** Pins that are high while the fluid moves, while it is drawn, and where no sensor answers. */
const [MOVES, IS_DRAWN, LAMP] = [2, 3, 25];
const PARTICLES = 200;
const STEPS = 2;

const [uf2, golden, out, animation, ...more] = process.argv.slice(2);
const options = { golden, out, update: more.includes("--update") };
const file = fs.readFileSync(uf2);

/** Runs for so many frames; the pictures, the time and the cycles at the end of each, and the cycles of work at pins. */
function run(frames, readings) {
    const shown = [];
    const display = new Ssd1306((display) => shown.push({ pixels: display.picture(), seconds: pico.seconds, cycles: pico.cycles }));
    const sensor = readings && new Lis3dh(readings);
    const pico = new Pico(file, sensor ? [sensor, display] : [display]);
    const work = new Map([MOVES, IS_DRAWN].map((pin) => [pin, 0]));
    for (const pin of work.keys()) pico.watch(pin, (isHigh) => work.set(pin, work.get(pin) + (isHigh ? -pico.cycles : pico.cycles)));
    let lamp = false;
    pico.watch(LAMP, (isHigh) => (lamp = isHigh));
    pico.run(() => shown.length >= frames || pico.seconds > frames);
    if (shown.length < frames) throw new Error(`${shown.length} frames in ${pico.seconds} s, expected ${frames}`);
    return { shown, work, lamp, clock: pico.chip.clkSys };
}

/** Without a sensor the fluid rests, and the lamp says so. */
function checkWithoutSensor() {
    const { shown, lamp } = run(4);
    const good = lamp && shown[3].pixels.some((pixel) => pixel === 1);
    console.error(`${"pico-without-sensor".padEnd(30)} ${good ? "holds" : "FAILS: no lamp or no picture"}`);
    return good;
}

/** Rows of the table: the work of each kind in cycles, a frame in µs. */
function tell({ shown, work, clock }) {
    const [first, last] = [shown[0], shown.at(-1)];
    const frames = shown.length - 1;
    const row = (quantity, number) => console.log(`rp2040,saturating i16f16,${PARTICLES},${quantity},${Math.round(number)}`);
    row("cycles of a step", work.get(MOVES) / shown.length / STEPS);
    row("cycles of a picture 124 x 60", work.get(IS_DRAWN) / shown.length);
    row("cycles of a frame", (last.cycles - first.cycles) / frames);
    row("microseconds of a frame", ((last.seconds - first.seconds) / frames) * 1e6);
    console.error(`${"pico".padEnd(30)} ${(frames / (last.seconds - first.seconds)).toFixed(1)} frames a second at ${clock / 1e6} MHz`);
    return clock === 125e6;
}

const picture = (pixels) => ({ width: 128, height: 64, bits: 1, pixels });
const pendant = run(LAST, (reading) => TILTS.find(([until]) => reading < until)[1]);
let good = !pendant.lamp && checkWithoutSensor();
for (const [name, frame] of PICTURES) good = check(name, picture(pendant.shown[frame].pixels), options) && good;
good = tell(pendant) && good;
if (options.update) {
    const { begin, every, scale, colours } = ANIMATION;
    const frames = pendant.shown.filter((_, frame) => frame >= begin && (frame - begin) % every === 0);
    fs.writeFileSync(animation, gif(frames.map(({ pixels }) => enlarge(picture(pixels), scale)), colours, 5));
}
process.exitCode = good ? 0 : 1;

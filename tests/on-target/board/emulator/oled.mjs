// Runs the pendant's firmware for an LM3S6965 under QEMU, and compares what its display shows after some frames.
// node oled.mjs ELF GOLDEN OUT [--update]

import fs from "node:fs";
import path from "node:path";
import { spawn } from "node:child_process";
import { check } from "./golden.mjs";

const PICTURES = [["oled-at-rest", 20], ["oled-flowing-right", 37], ["oled-right-side-down", 120], ["oled-upside-down", 200]];
/** Where the firmware reads the number of frames. */
const FRAMES = 0x2000fff0;
/** Longer than this it hangs. */
const PATIENCE = 60_000;

const [elf, golden, out, ...more] = process.argv.slice(2);
const options = { golden, out, update: more.includes("--update") };

/** Runs until so many frames have been shown, and gives what QEMU draws of the display. */
function run(frames) {
    const file = path.join(out, "oled.ppm");
    const qemu = spawn("qemu-system-arm", [
        "-machine", "lm3s6965evb", "-display", "none", "-serial", "none", "-monitor", "stdio",
        "-semihosting-config", "enable=on,target=native",
        "-device", `loader,addr=${FRAMES},data=${frames},data-len=4`, "-kernel", elf,
    ]);
    const timer = setTimeout(() => qemu.kill(), PATIENCE);
    qemu.stdout.resume();
    let told = "";
    qemu.stderr.on("data", (text) => {
        told += text;
        if (told.includes("shown")) qemu.stdin.end(`screendump ${file}\nquit\n`);
    });
    qemu.stdin.on("error", () => {}); // it may have quit already
    return new Promise((resolve, reject) => {
        qemu.on("error", reject);
        qemu.on("exit", (status) => {
            clearTimeout(timer);
            if (status === 0) resolve(fs.readFileSync(file));
            else reject(new Error(`QEMU ended with ${status}: ${told}`));
        });
    });
}

/** A pixel of the display from each square of the PPM file: one of 16 greys. */
function read(file) {
    const [head, width, height] = file.subarray(0, 32).toString("latin1").match(/^P6\n(\d+) (\d+)\n255\n/) ?? [];
    if (!head) throw new Error("QEMU's picture is no PPM of 8 bits a colour");
    const scale = width / 128;
    if (scale !== height / 64 || !Number.isInteger(scale)) throw new Error(`QEMU's picture has ${width} x ${height} pixels`);
    const red = (place) => file[head.length + 3 * (width * scale * (place >> 7) + scale * (place & 127))];
    const pixels = Array.from({ length: 128 * 64 }, (_, place) => red(place));
    const brightest = Math.max(...pixels);
    return { width: 128, height: 64, bits: 4, pixels: Uint8Array.from(pixels, (pixel) => Math.round((15 * pixel) / brightest)) };
}

let good = true;
for (const [name, frames] of PICTURES) good = check(name, read(await run(frames)), options) && good;
process.exitCode = good ? 0 : 1;

// Puts the page together: build.mjs MODULE GOLDEN OUT. Prints the size of the module and of the page.
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const page = (name) => readFileSync(new URL(`page/${name}`, import.meta.url), "utf8");

/** A module without its custom sections, which are for debuggers. */
export function stripped(module) {
  const parts = [module.subarray(0, 8)];
  for (let at = 8; at < module.length; ) {
    let [size, shift, next] = [0, 0, at + 1];
    do { size |= (module[next] & 127) << shift; shift += 7; } while (module[next++] & 128);
    if (module[at] !== 0) parts.push(module.subarray(at, next + size));
    at = next + size;
  }
  return Buffer.concat(parts);
}

const [, , modulePath, goldenPath, out] = process.argv;
const module = stripped(readFileSync(modulePath));
const golden = {};
for (const line of readFileSync(goldenPath, "utf8").split("\n")) {
  const found = /^((?:f32|i16f16) 2d position-based \S+) (\S+)$/.exec(line);
  if (found) golden[found[1]] = found[2];
}
if (Object.keys(golden).length !== 6) throw new Error(`${goldenPath}: ${Object.keys(golden).length} rows of the fluid, not 6`);
// The kernels' names, each at its number.
const kernels = [];
const header = readFileSync(new URL("../sph-core/c/include/fluisim.h", import.meta.url), "utf8");
for (const [, name, number] of header.matchAll(/^#define FLUISIM_KERNEL_(\w+) (\d+)/gm)) {
  kernels[number] = name.toLowerCase().replaceAll("_", "-");
}
if (kernels.length === 0 || kernels.includes(undefined)) throw new Error(`kernels of fluisim.h: ${kernels}`);
const scripts = ["engine.js", "digest.js", "field.js", "draw.js", "fluid.js", "kernels.js", "main.js"]
  .map((name) => page(name).replace(/^import .*\n/gm, "").replace(/^export /gm, ""));
const data = `const GOLDEN = ${JSON.stringify(golden)};\nconst KERNELS = ${JSON.stringify(kernels)};\nconst MODULE = "${module.toString("base64")}";\n`;
const html = page("index.html")
  .replace("/* style */", () => page("style.css"))
  .replace("/* script */", () => data + scripts.join("\n"));
writeFileSync(out.replace(/[^/]*$/, "fluisim.wasm"), module);
writeFileSync(out, html);
console.log(`module ${module.length} bytes, ${gzipSync(module, { level: 9 }).length} gzipped; page ${html.length} bytes`);
if (gzipSync(module, { level: 9 }).length > 65536) throw new Error("the module is above 64 kB gzipped");

// Node: the module's digests are the golden ones: node.mjs MODULE GOLDEN.
import { readFileSync } from "node:fs";
import { Arena, load } from "../page/engine.js";
import { Scene } from "../page/digest.js";
import { estimate } from "../page/field.js";

const golden = readFileSync(process.argv[3], "utf8").split("\n");
const exports = await load(readFileSync(process.argv[2]));
let wrong = 0;
for (const scalar of ["f32", "q16"]) {
  const scene = new Scene(exports, new Arena(exports), scalar);
  while (!scene.done) scene.step();
  for (const quantity of ["positions", "velocities", "pressures"]) {
    const row = `${scene.row(quantity)} ${scene.digest(quantity)}`;
    if (!golden.includes(row)) { wrong += 1; console.log(`not in the golden file: ${row}`); }
  }
  const field = estimate(exports, new Arena(exports), { scalar, kernel: 6, support: 2.5, method: "corrected", jitter: 0.15 });
  if (!(field.error < 0.1 && field.slopeError < 0.2)) { wrong += 1; console.log(`${scalar}: errors ${field.error}, ${field.slopeError}`); }
}
console.log(`node: ${wrong} wrong`);
process.exitCode = wrong ? 1 : 0;

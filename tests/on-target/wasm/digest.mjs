// Runs the module named on the command line and prints its digests.
import { readFileSync } from "node:fs";

const decoder = new TextDecoder();
let text = "";
const host = {
  write: (start, length) => {
    text += decoder.decode(new Uint8Array(instance.exports.memory.buffer, start, length));
  },
};
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { host });
const good = instance.exports.digests();
process.stdout.write(text);
process.exitCode = good ? 0 : 1;

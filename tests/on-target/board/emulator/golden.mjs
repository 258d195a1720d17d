// Pictures that are kept: compared pixel by pixel, or replaced.

import fs from "node:fs";
import path from "node:path";
import { enlarge, png, shows } from "./picture.mjs";

/** Pixels of the file to a pixel of the display, along each axis. */
const SCALE = 4;

/** Compares a display's picture with the one of this name, or replaces that; what is seen is written to `out` as well. */
export function check(name, picture, { golden, out, update }) {
    const [kept, seen] = [golden, out].map((folder) => path.join(folder, `${name}.png`));
    const large = enlarge(picture, SCALE);
    fs.writeFileSync(seen, png(large));
    const same = fs.existsSync(kept) && shows(fs.readFileSync(kept), large);
    if (update && !same) {
        fs.mkdirSync(golden, { recursive: true });
        fs.copyFileSync(seen, kept);
    }
    console.error(`${name.padEnd(30)} ${same ? "holds" : update ? "replaced" : `FAILS: ${seen} is not ${kept}`}`);
    return same || update;
}

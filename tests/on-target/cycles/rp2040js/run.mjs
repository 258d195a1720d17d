// Runs firmware on rp2040js, an emulator of the RP2040 that counts cycles: node run.mjs FIRMWARE.elf
// Prints `instructions,cycles` for each region between `mov r9, r9` and `mov r10, r10`, until the firmware ends through semihosting.
import { readFileSync } from "node:fs";
import { RP2040, ConsoleLogger, LogLevel } from "rp2040js";

const [BEGIN, END] = [0x46c9, 0x46d2];
const FLASH = 0x10000000;
const [OPEN, EXIT, EXIT_WITH_CODE] = [0x01, 0x18, 0x20];

/** Puts what an ELF file has for flash into the chip's, and starts at the vector table at its begin. */
function load(chip, elf) {
  const [programs, size, count] = [elf.readUInt32LE(28), elf.readUInt16LE(42), elf.readUInt16LE(44)];
  for (let k = 0; k < count; k++) {
    const [type, from, , to, length] = [0, 1, 2, 3, 4].map((n) => elf.readUInt32LE(programs + k * size + 4 * n));
    const isFlash = to >= FLASH && to + length <= FLASH + chip.flash.length; // RAM starts empty
    if (type === 1 && isFlash) chip.flash.set(elf.subarray(from, from + length), to - FLASH);
  }
  chip.core.VTOR = FLASH;
  chip.core.SP = chip.readUint32(FLASH);
  chip.core.PC = chip.readUint32(FLASH + 4) & ~1;
}

const chip = new RP2040();
chip.logger = new ConsoleLogger(LogLevel.Error, false);
load(chip, readFileSync(process.argv[2]));

let running = true;
chip.onBreak = () => {
  const operation = chip.core.registers[0];
  if (operation === EXIT || operation === EXIT_WITH_CODE) running = false;
  chip.core.registers[0] = operation === OPEN ? 1 : 0; // a file is open; all is written
};

let begin = null;
let instructions = 0;
while (running) {
  const first = chip.readUint16(chip.core.PC);
  if (first === END && begin !== null) {
    console.log(`${instructions - begin.instructions},${chip.core.cycles - begin.cycles}`);
    begin = null;
  }
  chip.core.executeInstruction();
  instructions += 1;
  if (first === BEGIN) begin = { instructions, cycles: chip.core.cycles };
}

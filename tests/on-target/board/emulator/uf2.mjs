// Reads a UF2 file as the RP2040's boot ROM does, and refuses what that would.

const [MAGIC, SECOND_MAGIC, LAST_MAGIC] = [0x0a324655, 0x9e5d5157, 0x0ab16f30];
const HAS_FAMILY = 0x2000;
const RP2040 = 0xe48bff56;
const FLASH = 0x10000000;

/** Puts the file's blocks into flash; an error where a block is not what the boot ROM takes. */
export function load(file, flash) {
    if (file.length === 0 || file.length % 512 !== 0) throw new Error(`UF2: ${file.length} bytes are no whole blocks`);
    const words = new DataView(file.buffer, file.byteOffset, file.length);
    const count = file.length / 512;
    for (let block = 0; block < count; block++) {
        const word = (offset) => words.getUint32(512 * block + offset, true);
        const expect = (what, offset, expected) => {
            if (word(offset) !== expected) throw new Error(`UF2: block ${block}: ${what} is ${word(offset)}, expected ${expected}`);
        };
        expect("the first magic number", 0, MAGIC);
        expect("the second magic number", 4, SECOND_MAGIC);
        expect("the flags", 8, HAS_FAMILY);
        expect("the payload's size", 16, 256);
        expect("the number of the block", 20, block);
        expect("the number of blocks", 24, count);
        expect("the family", 28, RP2040);
        expect("the last magic number", 508, LAST_MAGIC);
        const address = word(12) - FLASH;
        if (address % 256 !== 0 || address < 0 || address + 256 > flash.length) throw new Error(`UF2: block ${block}: address ${word(12)} is no page of the flash`);
        flash.set(file.subarray(512 * block + 32, 512 * block + 288), address);
    }
    checkBoot(flash);
}

/** The first 252 bytes of flash have their checksum behind them: else the boot ROM does not run them. */
function checkBoot(flash) {
    let crc = 0xffffffff;
    for (const byte of flash.subarray(0, 252)) {
        crc ^= byte << 24;
        for (let bit = 0; bit < 8; bit++) crc = crc & 0x80000000 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
    }
    const stored = new DataView(flash.buffer, flash.byteOffset + 252, 4).getUint32(0, true);
    if (crc >>> 0 !== stored) throw new Error(`the boot loader's checksum is ${stored}, expected ${crc >>> 0}`);
}

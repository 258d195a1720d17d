// Pictures of a few greys as PNG, and as animated GIF.

import zlib from "node:zlib";

const SIGNATURE = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);

/** A picture: a byte for each pixel, so many to a row, 0 to 2^bits − 1; each becomes a square of `scale` pixels. */
export function enlarge({ width, height, bits, pixels }, scale) {
    const [wide, high] = [width * scale, height * scale];
    const place = (index) => width * Math.floor(index / wide / scale) + Math.floor((index % wide) / scale);
    return { width: wide, height: high, bits, pixels: Uint8Array.from({ length: wide * high }, (_, index) => pixels[place(index)]) };
}

/** The rows of a PNG of 1, 2, 4 or 8 bits of grey a pixel, without filters. */
function rows({ width, height, bits, pixels }) {
    const stride = Math.ceil((width * bits) / 8) + 1;
    const bytes = Buffer.alloc(stride * height);
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            bytes[stride * y + 1 + ((x * bits) >> 3)] |= pixels[width * y + x] << (8 - bits - ((x * bits) & 7));
        }
    }
    return bytes;
}

function chunk(name, data) {
    const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
    const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    length.writeUInt32BE(data.length);
    let crc = 0xffffffff;
    for (const byte of body) {
        crc ^= byte;
        for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
    }
    sum.writeUInt32BE(~crc >>> 0);
    return Buffer.concat([length, body, sum]);
}

function header({ width, height, bits }) {
    const data = Buffer.alloc(13);
    data.writeUInt32BE(width, 0);
    data.writeUInt32BE(height, 4);
    data[8] = bits;
    return chunk("IHDR", data);
}

/** The picture as PNG. */
export function png(picture) {
    const data = chunk("IDAT", zlib.deflateSync(rows(picture), { level: 9 }));
    return Buffer.concat([SIGNATURE, header(picture), data, chunk("IEND", Buffer.alloc(0))]);
}

/** Whether a file that `png` wrote shows the picture: pixel by pixel, since zlib may pack them otherwise tomorrow. */
export function shows(file, picture) {
    const head = Buffer.concat([SIGNATURE, header(picture)]);
    if (!file.subarray(0, head.length).equals(head)) return false;
    const length = file.readUInt32BE(head.length);
    const packed = file.subarray(head.length + 8, head.length + 8 + length);
    return zlib.inflateSync(packed).equals(rows(picture));
}

/** Pictures of one size as an animation that begins anew; `colours` are red, green and blue of each grey, `hundredths` a frame lasts. */
export function gif(pictures, colours, hundredths) {
    const [{ width, height, bits }] = pictures;
    const word = (value) => [value & 255, value >> 8];
    const depth = Math.max(bits, 1);
    const parts = [
        Buffer.from("GIF89a", "latin1"),
        Buffer.from([...word(width), ...word(height), 0x80 | (depth - 1), 0, 0, ...colours.flat()]),
        Buffer.from([0x21, 0xff, 11, ...Buffer.from("NETSCAPE2.0", "latin1"), 3, 1, 0, 0, 0]),
    ];
    for (const { pixels } of pictures) {
        parts.push(Buffer.from([0x21, 0xf9, 4, 4, ...word(hundredths), 0, 0]));
        parts.push(Buffer.from([0x2c, 0, 0, 0, 0, ...word(width), ...word(height), 0]));
        parts.push(blocks(Math.max(depth, 2), pixels));
    }
    return Buffer.concat([...parts, Buffer.from([0x3b])]);
}

/** The codes in blocks of at most 255 bytes, behind how many bits a pixel has. */
function blocks(bits, pixels) {
    const bytes = codes(bits, pixels);
    const parts = [Buffer.from([bits])];
    for (let begin = 0; begin < bytes.length; begin += 255) {
        const part = bytes.slice(begin, begin + 255);
        parts.push(Buffer.from([part.length, ...part]));
    }
    return Buffer.concat([...parts, Buffer.from([0])]);
}

/** LZW with codes that grow to 12 bits, the first bits lowest. */
function codes(bits, pixels) {
    const clear = 1 << bits;
    const bytes = [];
    let [held, filled, size, next, table] = [0, 0, bits + 1, clear + 2, new Map()];
    const put = (code) => {
        held |= code << filled;
        for (filled += size; filled >= 8; filled -= 8, held >>>= 8) bytes.push(held & 255);
    };
    put(clear);
    let prefix = pixels[0];
    for (const pixel of pixels.subarray(1)) {
        const key = (prefix << bits) | pixel;
        if (table.has(key)) {
            prefix = table.get(key);
            continue;
        }
        put(prefix);
        prefix = pixel;
        if (next === 4096) {
            put(clear);
            [size, next, table] = [bits + 1, clear + 2, new Map()];
            continue;
        }
        if (next === 1 << size) size++;
        table.set(key, next++);
    }
    put(prefix);
    put(clear + 1);
    if (filled > 0) bytes.push(held & 255);
    return bytes;
}

// The two chips on the bus. A device is told when it is addressed, is given or asked for a byte, and when a transfer has ended.

/** The accelerometer LIS3DH, with the registers that a pendant uses. */
export class Lis3dh {
    address = 0x18;
    /** Gives what is read along x, y and z for the nth reading; 16384 is 1 g. */
    constructor(readings) {
        this.readings = readings;
        this.registers = new Uint8Array(64);
        this.registers[0x0f] = 0x33;
        this.count = 0;
    }

    begin(isRead) {
        this.isFirst = !isRead;
    }

    write(byte) {
        if (this.isFirst) [this.register, this.goesOn, this.isFirst] = [byte & 0x3f, (byte & 0x80) !== 0, false];
        else this.registers[this.next()] = byte;
    }

    read() {
        if (this.register === 0x28) this.sample();
        return this.registers[this.next()];
    }

    end() {}

    next() {
        const register = this.register;
        if (this.goesOn) this.register = (register + 1) & 0x3f;
        return register;
    }

    /** A sample, if it has been told to measure all axes at ±2 g in high resolution. */
    sample() {
        if ((this.registers[0x20] & 0x0f) !== 7 || this.registers[0x20] >> 4 === 0 || this.registers[0x23] !== 0x88) return;
        const words = new DataView(this.registers.buffer);
        this.readings(this.count++).forEach((reading, axis) => words.setInt16(0x28 + 2 * axis, reading, true));
    }
}

/** How many more bytes a command of the SSD1306 has. */
const PARAMETERS = new Map([[0x20, 1], [0x21, 2], [0x22, 2], [0x81, 1], [0x8d, 1], [0xa8, 1], [0xd3, 1], [0xd5, 1], [0xd9, 1], [0xda, 1], [0xdb, 1]]);

/** The display SSD1306: 128 × 64 pixels, a byte for eight, the lowest bit at the top. */
export class Ssd1306 {
    address = 0x3c;
    memory = new Uint8Array(1024).map((_, place) => (place * 73) ^ (place >> 3)); // after power-on it is anything
    state = { columns: [0, 127], pages: [0, 7], isOn: false, mode: 2, charge: 0, rows: 0 };

    /** Calls `shown` with itself after each transfer that has filled the window. */
    constructor(shown) {
        this.shown = shown;
        [this.column, this.page] = [0, 0];
    }

    begin() {
        [this.control, this.command, this.isFull] = [undefined, [], false];
    }

    write(byte) {
        if (this.control === undefined) this.control = byte;
        else if (this.control === 0x40) this.put(byte);
        else if (this.control === 0x00) this.obey(byte);
        else throw new Error(`SSD1306: control byte ${this.control}, expected 0 or 64`);
    }

    read() {
        return 0;
    }

    end() {
        if (this.isFull) this.shown(this);
    }

    obey(byte) {
        this.command.push(byte);
        const [name, ...values] = this.command;
        if (values.length < (PARAMETERS.get(name) ?? 0)) return;
        this.command = [];
        const { state } = this;
        if (name === 0x20) [state.mode] = values;
        else if (name === 0x21) [state.columns, this.column] = [values, values[0]];
        else if (name === 0x22) [state.pages, this.page] = [values, values[0]];
        else if (name === 0x8d) [state.charge] = values;
        else if (name === 0xa8) [state.rows] = values;
        else if (name === 0xae || name === 0xaf) state.isOn = name === 0xaf;
        else if (!PARAMETERS.has(name) && !(name >= 0x40 && name < 0x80) && ![0xa0, 0xa1, 0xa4, 0xa6, 0xc0, 0xc8].includes(name)) {
            throw new Error(`SSD1306: unknown command ${name}`);
        }
    }

    put(byte) {
        const { mode, columns, pages } = this.state;
        if (mode !== 0) throw new Error("SSD1306: pixels before horizontal addressing");
        this.memory[128 * this.page + this.column] = byte;
        if (this.column++ < columns[1]) return;
        this.column = columns[0];
        if (this.page++ < pages[1]) return;
        [this.page, this.isFull] = [pages[0], true];
    }

    /** What is seen: a byte for each pixel, 1 where it shines. All dark without its voltage, its rows or when it is off. */
    picture() {
        const { isOn, charge, rows } = this.state;
        if (!isOn || charge !== 0x14 || rows !== 63) return new Uint8Array(128 * 64);
        return Uint8Array.from({ length: 128 * 64 }, (_, place) => (this.memory[128 * (place >> 10) + (place & 127)] >> ((place >> 7) & 7)) & 1);
    }
}

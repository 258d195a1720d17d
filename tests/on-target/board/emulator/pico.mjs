// A Raspberry Pi Pico, by rp2040js: what its boot ROM does, chips on I²C 0 in the time that the bus takes, and cycles by pins.

import { RP2040, ConsoleLogger, LogLevel } from "rp2040js";
import { load } from "./uf2.mjs";

const BOOT = 0x20041f00;
const DREQ_I2C0_TX = 32;
const [DATA_CMD, FS_SPKLEN, DMA_CR, DMA_TDLR] = [0x10, 0xa0, 0x88, 0x8c];

export class Pico {
    /** With the UF2 file in its flash, and devices on the bus. */
    constructor(file, devices) {
        this.chip = new RP2040();
        this.chip.logger = new ConsoleLogger(LogLevel.Error, false);
        load(file, this.chip.flash);
        this.join(this.chip.i2c[0], devices);
        this.boot();
    }

    /** The boot ROM copies the first 256 bytes of the flash to the end of the RAM and goes there with a link of 0. */
    boot() {
        const { core, sram, flash } = this.chip;
        sram.set(flash.subarray(0, 256), BOOT & 0xfffff);
        core.registers[14] = 0;
        core.SP = BOOT;
        core.PC = BOOT;
    }

    /** Runs until `isDone`, which is asked now and then. */
    run(isDone) {
        const { core, clock } = this.chip;
        while (!isDone()) {
            for (let count = 0; count < 10_000; count++) {
                if (!core.waiting) {
                    clock.tick((core.executeInstruction() * 1e9) / this.chip.clkSys);
                    continue;
                }
                clock.tick(clock.nanosToNextAlarm);
                if (core.interruptsUpdated && core.checkForInterrupts()) core.waiting = false;
            }
        }
    }

    /** Seconds since it was started. */
    get seconds() {
        return this.chip.clock.nanos / 1e9;
    }

    /** Cycles, apart from those slept through. */
    get cycles() {
        return this.chip.core.cycles;
    }

    /** Calls back with whether a pin is high, when that changes. */
    watch(pin, changed) {
        this.chip.gpio[pin].addListener((state) => changed(state === 1));
    }

    /** Every bit takes its time, a byte nine of them; a device that is not there does not answer. */
    join(bus, devices) {
        let [device, then] = [undefined, () => {}];
        const alarm = this.chip.clock.createAlarm(() => then());
        const after = (bits, next) => {
            then = () => {
                next();
                this.ask(bus);
            };
            // the clock's periods as the data sheet gives them, those of the filter included
            const period = bus.sclLowPeriod + 1 + bus.sclHighPeriod + bus.readUint32(FS_SPKLEN) + 7;
            alarm.schedule((bits * period * 1e9) / this.chip.clkSys);
        };
        const end = () => {
            device?.end();
            device = undefined;
        };
        bus.onStart = () => after(1, () => bus.completeStart());
        bus.onConnect = (address, mode) =>
            after(9, () => {
                end();
                device = devices.find((device) => device.address === address);
                device?.begin(mode === 1);
                bus.completeConnect(device !== undefined);
            });
        bus.onWriteByte = (byte) =>
            after(9, () => {
                device.write(byte);
                bus.completeWrite(true);
            });
        bus.onReadByte = () => after(9, () => bus.completeRead(device.read()));
        bus.onStop = () =>
            after(1, () => {
                end();
                bus.completeStop();
            });
        this.addRequests(bus);
    }

    /** rp2040js lacks the bus's requests to DMA: asks for a word while no more are left than the register says. */
    addRequests(bus) {
        [this.requests, this.level] = [false, 0];
        const write = bus.writeUint32.bind(bus);
        bus.writeUint32 = (offset, value) => {
            if (offset === DMA_CR) this.requests = (value & 2) !== 0;
            else if (offset === DMA_TDLR) this.level = value;
            else write(offset, value);
            if (offset === DATA_CMD || offset === DMA_CR) this.ask(bus);
        };
    }

    ask(bus) {
        const wants = this.requests && bus.txFIFO.itemCount <= this.level;
        if (wants) this.chip.dma.setDREQ(DREQ_I2C0_TX);
        else this.chip.dma.clearDREQ(DREQ_I2C0_TX);
    }
}

/* Runs a sketch: `program KEY LOOPS` tilts it to a side (a left, d right, w up, s down), calls `loop`, and then prints what the lamps and
 * the display show, if there is something on them. Serial prints what the sketch prints.
 *
 * KEY is what Serial reads first, what an LIS3DH measures, and what time it is for a sketch whose gravity turns in 16384 ms. */
#include "Arduino.h"
#include "Wire.h"
#include <stdio.h>
#include <stdlib.h>

MockSerial Serial;
MockWire Wire;

static int key = 's';
static bool key_is_read;
static unsigned long waited;

/* Three shift registers with lamps on them, and the memory of an SSD1306. */
static uint32_t shifted;
static uint16_t rows[8];
static uint8_t display[1024];
static size_t at;
static bool latched;

void pinMode(int, int) {}
void shiftOut(int, int, int, uint8_t value) { shifted = shifted << 8 | value; }

void digitalWrite(int, int level) {
    if (level == LOW) return;
    latched = true;
    for (int row = 0; row < 8; row++)
        if (shifted >> row & 1) rows[row] = (uint16_t)(shifted >> 8);
}

unsigned long millis() { return key == 'd' ? 4096 : key == 'w' ? 8192 : key == 'a' ? 12288 : 0; }

void delay(unsigned long milliseconds) {
    waited += milliseconds;
    if (milliseconds >= 1000 || waited > 1000000) exit(3); /* the sketch has given up */
}

void MockSerial::begin(unsigned long) {}
int MockSerial::available() { return !key_is_read; }
int MockSerial::read() {
    key_is_read = true;
    return key;
}
void MockSerial::println(const char *text) { puts(text); }
void MockSerial::println(int number) { printf("%d\n", number); }
void MockSerial::println(long number) { printf("%ld\n", number); }

static uint8_t target, sent[32], answer[4];
static size_t length, answered;

void MockWire::begin() {}
void MockWire::setClock(uint32_t) {}
void MockWire::beginTransmission(uint8_t address) { target = address, length = 0; }

size_t MockWire::write(uint8_t byte) {
    if (length == sizeof sent) exit(4); /* what is beyond the buffer is lost on a board */
    sent[length++] = byte;
    return 1;
}

uint8_t MockWire::endTransmission(bool) {
    if (target != 0x3C || length == 0 || sent[0] != 0x40) return 0;
    for (size_t k = 1; k < length; k++) display[at++ % sizeof display] = sent[k];
    return 0;
}

/* An axis that points away from the ground measures 16384. */
uint8_t MockWire::requestFrom(uint8_t address, uint8_t count) {
    if (address != 0x18 || count != sizeof answer || length != 1 || sent[0] != (0x28 | 0x80)) return 0;
    const int x = key == 'd' ? -16384 : key == 'a' ? 16384 : 0, y = key == 'w' ? -16384 : key == 's' ? 16384 : 0;
    const uint8_t bytes[4] = {(uint8_t)x, (uint8_t)((unsigned)x >> 8), (uint8_t)y, (uint8_t)((unsigned)y >> 8)};
    for (size_t k = 0; k < sizeof answer; k++) answer[k] = bytes[k];
    answered = 0;
    return count;
}
int MockWire::read() { return answered < sizeof answer ? answer[answered++] : -1; }

int main(int count, char **words) {
    if (count == 3) key = words[1][0];
    setup();
    for (int k = count == 3 ? atoi(words[2]) : 0; k > 0; k--) loop();
    for (int row = 7; latched && row >= 0; row--) {
        putchar('|');
        for (int column = 0; column < 16; column++) putchar(rows[row] >> column & 1 ? '#' : ' ');
        puts("|");
    }
    for (int row = 0; at > 0 && row < 64; row++) {
        putchar('|');
        for (int column = 0; column < 128; column++) putchar(display[row / 8 * 128 + column] >> row % 8 & 1 ? '#' : ' ');
        puts("|");
    }
    return 0;
}

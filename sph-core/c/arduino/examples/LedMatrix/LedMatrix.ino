/* A fluid on 16 x 8 lamps. Gravity turns once in sixteen seconds; put what your sensor says into `down` instead.
 *
 * Lamps behind shift registers (74HC595), scanned row by row: three in a chain, first the one for the rows, then two for the
 * columns. A strip of WS2812 or a display with a library of its own needs another `show` alone: `lamps` has 1 for light and
 * `density` what `fluisim_brightness` makes a brightness of, both row by row from the bottom. */
#include <Arduino.h>
#include <fluisim.h>

#define COLUMNS 16
#define ROWS 8
#define PARTICLES 200

static const int DATA_PIN = 2, CLOCK_PIN = 3, LATCH_PIN = 4;

/* A lamp is a square of side 1, the support radius: four particles fill it. */
static const fluisim_q16 SIZE[2] = {FLUISIM_Q16(COLUMNS), FLUISIM_Q16(ROWS)};
static const fluisim_q16 PIXEL = FLUISIM_Q16(1);

static FLUISIM_MEMORY(memory, FLUISIM_Q16_2D_BYTES(PARTICLES, FLUISIM_CELLS_2D(COLUMNS, ROWS)));
static fluisim_q16_2d *fluid;
static uint8_t density[COLUMNS * ROWS];
static uint8_t lamps[COLUMNS * ROWS];

static bool fill() {
    for (int k = 0; k < PARTICLES; k++) {
        const fluisim_q16 at[2] = {FLUISIM_Q16(0.25) + k % 25 * FLUISIM_Q16(0.5), FLUISIM_Q16(0.25) + k / 25 * FLUISIM_Q16(0.5)};
        if (fluisim_q16_2d_add(fluid, at, NULL) != FLUISIM_OK) return false;
    }
    return true;
}

/* Lights each row for a millisecond. */
static void show() {
    for (int row = 0; row < ROWS; row++) {
        uint16_t columns = 0;
        for (int column = 0; column < COLUMNS; column++)
            if (lamps[row * COLUMNS + column]) columns |= (uint16_t)(1u << column);
        shiftOut(DATA_PIN, CLOCK_PIN, MSBFIRST, (uint8_t)(columns >> 8));
        shiftOut(DATA_PIN, CLOCK_PIN, MSBFIRST, (uint8_t)columns);
        shiftOut(DATA_PIN, CLOCK_PIN, MSBFIRST, (uint8_t)(1u << row));
        digitalWrite(LATCH_PIN, HIGH);
        digitalWrite(LATCH_PIN, LOW);
        delay(1);
    }
}

void setup() {
    pinMode(DATA_PIN, OUTPUT);
    pinMode(CLOCK_PIN, OUTPUT);
    pinMode(LATCH_PIN, OUTPUT);
    const int32_t made = fluisim_q16_2d_init_box(memory, sizeof memory, PARTICLES, SIZE, &fluid);
    if (made == FLUISIM_OK && fill()) return;
    for (;;) { /* the first row alone: something is wrong */
        lamps[0] = 1;
        show();
    }
}

void loop() {
    const float angle = (float)(millis() % 16384) * (6.2832f / 16384.0f);
    const fluisim_q16 down[2] = {(fluisim_q16)(328.0f * sinf(angle)), (fluisim_q16)(-328.0f * cosf(angle))}; /* 0.005 of 65536 */
    fluisim_q16_2d_step(fluid, down);
    fluisim_q16_2d_draw(fluid, PIXEL, COLUMNS, ROWS, density);
    fluisim_light_lamps(density, sizeof density, 96, 64, lamps);
    show();
    show();
}

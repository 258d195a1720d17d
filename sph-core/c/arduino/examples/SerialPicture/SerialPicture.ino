/* A fluid as a picture in letters on the serial monitor (115200 baud): no display and no sensor is needed.
 *
 * Keys tilt it: a left, d right, w up, s down. In the Arduino IDE, type one and press Enter. */
#include <Arduino.h>
#include <fluisim.h>

#define COLUMNS 32
#define ROWS 12
#define PARTICLES 160

/* A box of 16 x 6 support radii; two columns and two rows of letters to a radius. */
static const fluisim_q16 SIZE[2] = {FLUISIM_Q16(16), FLUISIM_Q16(6)};
static const fluisim_q16 PIXEL = FLUISIM_Q16(0.5);
static const fluisim_q16 GRAVITY = FLUISIM_Q16(0.005);

static FLUISIM_MEMORY(memory, FLUISIM_Q16_2D_BYTES(PARTICLES, FLUISIM_CELLS_2D(16, 6)));
static fluisim_q16_2d *fluid;
static fluisim_q16 down[2] = {0, -GRAVITY};
static uint8_t density[COLUMNS * ROWS];

/* Particles rest half a support radius apart: in the middle, 16 to a row. */
static bool fill() {
    for (int k = 0; k < PARTICLES; k++) {
        const fluisim_q16 at[2] = {FLUISIM_Q16(4.25) + k % 16 * FLUISIM_Q16(0.5), FLUISIM_Q16(0.25) + k / 16 * FLUISIM_Q16(0.5)};
        if (fluisim_q16_2d_add(fluid, at, NULL) != FLUISIM_OK) return false;
    }
    return true;
}

static void print_picture() {
    static const char SHADES[] = " .:-=+*#%@";
    fluisim_q16_2d_draw(fluid, PIXEL, COLUMNS, ROWS, density);
    for (int row = ROWS - 1; row >= 0; row--) {
        char line[COLUMNS + 3] = {'|'};
        for (int column = 0; column < COLUMNS; column++)
            line[column + 1] = SHADES[fluisim_brightness(density[row * COLUMNS + column]) * 9 / 255];
        line[COLUMNS + 1] = '|';
        Serial.println(line);
    }
    Serial.println();
}

static void tilt(int key) {
    const fluisim_q16 x = key == 'd' ? GRAVITY : key == 'a' ? -GRAVITY : 0;
    const fluisim_q16 y = key == 'w' ? GRAVITY : key == 's' ? -GRAVITY : 0;
    if (x == 0 && y == 0) return;
    down[0] = x;
    down[1] = y;
}

void setup() {
    Serial.begin(115200);
    const int32_t made = fluisim_q16_2d_init_box(memory, sizeof memory, PARTICLES, SIZE, &fluid);
    if (made == FLUISIM_OK && fill()) return;
    for (;;) { /* the codes are in fluisim.h */
        Serial.println(made);
        delay(1000);
    }
}

void loop() {
    static unsigned long frame = 0;
    while (Serial.available() > 0) tilt(Serial.read());
    fluisim_q16_2d_step(fluid, down);
    if (++frame % 12 == 0) print_picture();
    delay(16);
}

/* A fluid on an SSD1306 of 128 x 64 pixels that follows an LIS3DH, both by I2C: no other library is needed.
 *
 * The sensor's x is to the right of the display and its y upwards; where it is mounted otherwise, change `read_tilt`.
 * Addresses: 0x3C is the usual one of the display; the sensor has 0x18, or 0x19 with SDO high. */
#include <Arduino.h>
#include <Wire.h>
#include <fluisim.h>

#define COLUMNS 64 /* dots of 2 x 2 pixels */
#define ROWS 32
#define PARTICLES 256

static const uint8_t DISPLAY_ADDRESS = 0x3C, SENSOR_ADDRESS = 0x18;

/* A box of 16 x 8 support radii, a dot a quarter of one: half of it is full. */
static const fluisim_q16 SIZE[2] = {FLUISIM_Q16(16), FLUISIM_Q16(8)};
static const fluisim_q16 DOT = FLUISIM_Q16(0.25);

static FLUISIM_MEMORY(memory, FLUISIM_Q16_2D_BYTES(PARTICLES, FLUISIM_CELLS_2D(16, 8)));
static fluisim_q16_2d *fluid;
static uint8_t density[COLUMNS * ROWS];
static uint8_t lamps[COLUMNS * ROWS];

static bool fill() {
    for (int k = 0; k < PARTICLES; k++) {
        const fluisim_q16 at[2] = {FLUISIM_Q16(0.25) + k % 32 * FLUISIM_Q16(0.5), FLUISIM_Q16(0.25) + k / 32 * FLUISIM_Q16(0.5)};
        if (fluisim_q16_2d_add(fluid, at, NULL) != FLUISIM_OK) return false;
    }
    return true;
}

static void write_register(uint8_t number, uint8_t value) {
    Wire.beginTransmission(SENSOR_ADDRESS);
    Wire.write(number);
    Wire.write(value);
    Wire.endTransmission();
}

static void begin_sensor() {
    write_register(0x20, 0x57); /* 100 samples a second, all axes */
    write_register(0x23, 0x88); /* +-2 g, high resolution, both bytes of one sample */
}

/* Gravity in h a frame^2: the sensor gives 16384 for 1 g, which is 0.005, or 328 in fixed point. Left as it is without an answer. */
static void read_tilt(fluisim_q16 down[2]) {
    Wire.beginTransmission(SENSOR_ADDRESS);
    Wire.write((uint8_t)(0x28 | 0x80)); /* the registers of x and y, one after the other */
    Wire.endTransmission(false);
    if (Wire.requestFrom(SENSOR_ADDRESS, (uint8_t)4) != 4) return;
    for (int axis = 0; axis < 2; axis++) {
        const int low = Wire.read(), high = Wire.read();
        down[axis] = -(int16_t)(uint16_t)(high << 8 | low) / 50; /* at rest it measures the push of the table, upwards */
    }
}

static void begin_display() {
    static const uint8_t COMMANDS[] = {
        0xAE, 0xD5, 0x80, 0xA8, 0x3F, 0xD3, 0x00, 0x40, /* off; clock, 64 rows, from the first */
        0x8D, 0x14, 0x20, 0x00, 0xA1, 0xC8, 0xDA, 0x12, /* charge pump; byte after byte along the pages; which way up */
        0x81, 0xCF, 0xD9, 0xF1, 0xDB, 0x40, 0xA4, 0xA6, 0xAF /* contrast; on */
    };
    for (size_t k = 0; k < sizeof COMMANDS; k++) {
        Wire.beginTransmission(DISPLAY_ADDRESS);
        Wire.write((uint8_t)0x00);
        Wire.write(COMMANDS[k]);
        Wire.endTransmission();
    }
}

/* A byte is eight pixels one below the other: four dots, twice each, and each byte twice. */
static uint8_t dots(int page, int column) {
    uint8_t byte = 0;
    for (int dot = 0; dot < 4; dot++)
        if (lamps[(ROWS - 1 - (4 * page + dot)) * COLUMNS + column]) byte |= (uint8_t)(3u << (2 * dot));
    return byte;
}

static void show() {
    for (int page = 0; page < 8; page++) {
        for (int column = 0; column < COLUMNS; column += 8) { /* 17 bytes: some boards send 32 at most */
            Wire.beginTransmission(DISPLAY_ADDRESS);
            Wire.write((uint8_t)0x40);
            for (int k = 0; k < 8; k++) {
                const uint8_t byte = dots(page, column + k);
                Wire.write(byte);
                Wire.write(byte);
            }
            Wire.endTransmission();
        }
    }
}

void setup() {
    Wire.begin();
    Wire.setClock(400000);
    begin_sensor();
    begin_display();
    const int32_t made = fluisim_q16_2d_init_box(memory, sizeof memory, PARTICLES, SIZE, &fluid);
    if (made == FLUISIM_OK && fill()) return;
    for (;;) delay(1000); /* the codes are in fluisim.h */
}

void loop() {
    static fluisim_q16 down[2] = {0, FLUISIM_Q16(-0.005)};
    read_tilt(down);
    fluisim_q16_2d_step(fluid, down);
    fluisim_q16_2d_draw(fluid, DOT, COLUMNS, ROWS, density);
    fluisim_light_lamps(density, sizeof density, 96, 64, lamps);
    show();
}

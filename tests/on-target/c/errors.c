/* What every function answers to what is wrong, and that nothing is changed by it. Prints the lines that fail. */
#include "check.h"
#include <string.h>

#ifdef NO_LIBC
#error "this program needs a C library"
#endif

static int failures;

static void expect_at(int line, int32_t found, int32_t expected) {
    if (found == expected) return;
    failures++;
    print("errors.c, line 0x");
    print_hex((uint64_t)line);
    print(" found 0x");
    print_hex((uint64_t)(int64_t)found);
    print("\n");
}
#define EXPECT(call, expected) expect_at(__LINE__, (int32_t)(call), (expected))

/* Places that are not aligned. */
#define ODD(Type, pointer) ((Type *)(void *)((char *)(pointer) + 1))

/* The largest of the fluids here. */
static FLUISIM_MEMORY(memory, FLUISIM_F32_3D_BYTES(4, FLUISIM_CELLS_3D(5, 5, 5)));
static FLUISIM_MEMORY(before, FLUISIM_F32_3D_BYTES(4, FLUISIM_CELLS_3D(5, 5, 5)));

/* Of a number type: a number that is not finite. */
static float f32_not_finite(int which) {
    static const uint32_t bits[3] = {0x7fc00000u, 0x7f800000u, 0xff800000u};
    float number;
    memcpy(&number, &bits[which], sizeof number);
    return number;
}
static fluisim_q16 q16_not_finite(int which) { return which == 0 ? INT32_MAX : which == 1 ? INT32_MIN : -INT32_MAX; }
#define NUMBER_f32(x) ((float)(x))
#define NUMBER_q16(x) FLUISIM_Q16(x)

#define PASTE_(a, b, c, d, e) a##b##c##d##e
#define PASTE(a, b, c, d, e) PASTE_(a, b, c, d, e)
#define F(name) PASTE(fluisim_, T, _, D, d_##name)
#define FLUID PASTE(fluisim_, T, _, D, d)
#define BAD(which) PASTE(T, _not_finite, , , )(which)
#define N(x) PASTE(NUMBER_, T, , , )(x)
#define BYTES(capacity, cells) PASTE(FLUISIM_, UPPER, _, D, D_BYTES)(capacity, cells)

#define D 2
#define T f32
#define NUM float
#define UPPER F32
#include "wrong.h"
#undef T
#undef NUM
#undef UPPER
#define T q16
#define NUM fluisim_q16
#define UPPER Q16
#include "wrong.h"
#undef D
#define D 3
#include "wrong.h"
#undef T
#undef NUM
#undef UPPER
#define T f32
#define NUM float
#define UPPER F32
#include "wrong.h"

/* Bitmaps and pixels are for two dimensions. */
static void masks_and_pixels(void) {
    static const uint8_t bits[3] = {0xe0, 0xa0, 0xe0};
    const float hole[2] = {3, 3}, open[2] = {1, 1}, down[2] = {0, -0.005f};
    fluisim_f32_2d *fluid;
    uint8_t density[7] = {7, 7, 7, 7, 7, 7, 7}, lamps[5] = {0, 0, 1, 1, 9};
    static const uint8_t lit[4] = {96, 95, 64, 63};
    EXPECT(fluisim_f32_2d_init_mask(memory, sizeof memory, 4, NULL, 3, 3, 2, &fluid), FLUISIM_NULL);
    EXPECT(fluisim_f32_2d_init_mask(memory, sizeof memory, 4, bits, 0, 3, 2, &fluid), FLUISIM_BAD_ARGUMENT);
    EXPECT(fluisim_f32_2d_init_mask(memory, sizeof memory, 4, bits, 3, 0, 2, &fluid), FLUISIM_BAD_ARGUMENT);
    EXPECT(fluisim_f32_2d_init_mask(memory, sizeof memory, 4, bits, 3, 3, 0.4f, &fluid), FLUISIM_BAD_ARGUMENT);
    EXPECT(fluisim_f32_2d_init_mask(memory, sizeof memory, 4, bits, 3, 3, f32_not_finite(0), &fluid), FLUISIM_NOT_FINITE);
    EXPECT(fluisim_q16_2d_init_mask(memory, sizeof memory, 4, bits, 3, 3, INT32_MAX, NULL), FLUISIM_NULL);
    EXPECT(fluisim_f32_2d_init_mask(memory, 64, 4, bits, 3, 3, 2, &fluid), FLUISIM_TOO_SMALL);
    EXPECT(fluid == NULL, 1);
    EXPECT(fluisim_f32_2d_init_mask(memory, sizeof memory, 4, bits, 3, 3, 2, &fluid), FLUISIM_OK);
    EXPECT(fluisim_f32_2d_add(fluid, hole, NULL), FLUISIM_OUTSIDE);
    EXPECT(fluisim_f32_2d_add(fluid, open, NULL), FLUISIM_OK);
    EXPECT(fluisim_f32_2d_step(fluid, down), FLUISIM_OK);

    EXPECT(fluisim_f32_2d_draw(NULL, 1, 3, 2, density), FLUISIM_NULL);
    EXPECT(fluisim_f32_2d_draw(fluid, 1, 3, 2, NULL), FLUISIM_NULL);
    EXPECT(fluisim_f32_2d_draw(fluid, 1, 0, 2, NULL), FLUISIM_OK);
    EXPECT(fluisim_f32_2d_draw(ODD(fluisim_f32_2d, fluid), 1, 3, 2, density), FLUISIM_MISALIGNED);
    EXPECT(fluisim_f32_2d_draw(fluid, 0, 3, 2, density), FLUISIM_BAD_ARGUMENT);
    EXPECT(fluisim_f32_2d_draw(fluid, f32_not_finite(1), 3, 2, density), FLUISIM_NOT_FINITE);
    EXPECT(fluisim_q16_2d_draw((fluisim_q16_2d *)(void *)memory, 65536, 3, 2, density), FLUISIM_NOT_INITIALISED);
    EXPECT(density[0], 7);
    EXPECT(fluisim_f32_2d_draw(fluid, 2, 3, 2, density), FLUISIM_OK);
    EXPECT(density[0] > 0 && density[0] <= 10, 1);
    EXPECT(density[6], 7);

    EXPECT(fluisim_light_lamps(NULL, 2, 96, 64, lamps), FLUISIM_NULL);
    EXPECT(fluisim_light_lamps(lit, 4, 96, 64, NULL), FLUISIM_NULL);
    EXPECT(fluisim_light_lamps(NULL, 0, 96, 64, NULL), FLUISIM_OK);
    EXPECT(fluisim_light_lamps(lit, 4, 64, 96, lamps), FLUISIM_BAD_ARGUMENT);
    EXPECT(fluisim_light_lamps(lit, 4, 96, 64, lamps), FLUISIM_OK);
    EXPECT(lamps[0] == 1 && lamps[1] == 0 && lamps[2] == 1 && lamps[3] == 0 && lamps[4] == 9, 1);
    EXPECT(fluisim_brightness(160), 255);
    EXPECT(fluisim_brightness(80), 127);
}

int main(void) {
    wrong_f32_2d();
    wrong_q16_2d();
    wrong_f32_3d();
    wrong_q16_3d();
    masks_and_pixels();
    EXPECT(fluisim_kernel(NULL), FLUISIM_NULL);
    EXPECT(fluisim_kernel("poly"), FLUISIM_NOT_FOUND);
    EXPECT(fluisim_kernel("wendland-c6"), FLUISIM_KERNEL_WENDLAND_C6);
    EXPECT(fluisim_kernel_name(-1) == NULL && fluisim_kernel_name(9) == NULL, 1);
    EXPECT(strcmp(fluisim_kernel_name(0), "poly6"), 0);
    return failures != 0;
}

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

/* The largest of the fluids here, and the smallest lamps. */
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

/* Bitmaps and lamps are for two dimensions. */
static void masks_and_lamps(void) {
    static const uint8_t bits[3] = {0xe0, 0xa0, 0xe0};
    const float hole[2] = {3, 3}, open[2] = {1, 1}, down[2] = {0, -0.005f};
    fluisim_f32_2d *fluid;
    fluisim_lamps_8x8 *lamps;
    static FLUISIM_MEMORY(room, FLUISIM_LAMPS_BYTES(8, 8));
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

    EXPECT(fluisim_lamps_8x8_init(NULL, sizeof room, 96, 64, &lamps), FLUISIM_NULL);
    EXPECT(fluisim_lamps_8x8_init(room, sizeof room, 96, 64, NULL), FLUISIM_NULL);
    EXPECT(fluisim_lamps_8x8_init(ODD(void, room), sizeof room - 1, 96, 64, &lamps), FLUISIM_MISALIGNED);
    EXPECT(fluisim_lamps_8x8_init(room, FLUISIM_LAMPS_BYTES(8, 8) - 1, 96, 64, &lamps), FLUISIM_TOO_SMALL);
    EXPECT(fluisim_lamps_8x8_init(room, sizeof room, 64, 96, &lamps), FLUISIM_BAD_ARGUMENT);
    EXPECT(lamps == NULL, 1);
    EXPECT(fluisim_lamps_8x8_is_lit((fluisim_lamps_8x8 *)(void *)room, 0, 0), FLUISIM_NOT_INITIALISED);
    EXPECT(fluisim_lamps_8x8_init(room, FLUISIM_LAMPS_BYTES(8, 8), 30, 20, &lamps), FLUISIM_OK);
    EXPECT(fluisim_lamps_8x8_is_lit(lamps, 1, 1), 0);
    EXPECT(fluisim_lamps_8x8_draw_f32_2d(NULL, fluid, 1), FLUISIM_NULL);
    EXPECT(fluisim_lamps_8x8_draw_f32_2d(lamps, NULL, 1), FLUISIM_NULL);
    EXPECT(fluisim_lamps_8x8_draw_f32_2d(lamps, fluid, 0), FLUISIM_BAD_ARGUMENT);
    EXPECT(fluisim_lamps_8x8_draw_f32_2d(lamps, fluid, f32_not_finite(1)), FLUISIM_NOT_FINITE);
    EXPECT(fluisim_lamps_8x8_draw_q16_2d(lamps, (fluisim_q16_2d *)(void *)memory, 65536), FLUISIM_NOT_INITIALISED);
    EXPECT(fluisim_lamps_8x8_draw_f32_2d(lamps, fluid, 2), FLUISIM_OK);
    EXPECT(fluisim_lamps_8x8_density(lamps, 0, 0) > 0, 1);
    EXPECT(fluisim_lamps_8x8_density(lamps, 8, 0), FLUISIM_NOT_FOUND);
    EXPECT(fluisim_lamps_8x8_is_lit(lamps, 0, 8), FLUISIM_NOT_FOUND);
    EXPECT(fluisim_lamps_8x8_is_lit(NULL, 0, 0), FLUISIM_NULL);
}

int main(void) {
    wrong_f32_2d();
    wrong_q16_2d();
    wrong_f32_3d();
    wrong_q16_3d();
    masks_and_lamps();
    EXPECT(fluisim_kernel(NULL), FLUISIM_NULL);
    EXPECT(fluisim_kernel("poly"), FLUISIM_NOT_FOUND);
    EXPECT(fluisim_kernel("wendland-c6"), FLUISIM_KERNEL_WENDLAND_C6);
    EXPECT(fluisim_kernel_name(-1) == NULL && fluisim_kernel_name(9) == NULL, 1);
    EXPECT(strcmp(fluisim_kernel_name(0), "poly6"), 0);
    return failures != 0;
}

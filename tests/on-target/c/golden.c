/* Prints digests of `digest/golden.txt`, computed through fluisim.h: the fluid and the sums over all samples, in two number types and
 * two dimensions. Some functions of the C libraries are used as well, so that they are linked. */
#include "check.h"

#ifdef NO_LIBC /* nor its headers */
void *memcpy(void *restrict to, const void *restrict from, size_t count);
size_t strlen(const char *text);
#else
#include <math.h>
#include <string.h>
static volatile float two = 2.0f;
#endif

/* The scene's random numbers: X <- 1664525 X + 1013904223 mod 2^32. */
static int32_t next(uint32_t *state, int32_t range) {
    *state = *state * 1664525u + 1013904223u;
    return (int32_t)(*state >> 16) % (2 * range + 1) - range;
}

static void row(const char *name, const char *quantity, uint64_t digest) {
    print(name);
    print(quantity);
    print(" ");
    print_hex(digest);
    print("\n");
}

#ifdef FIXED
/* n / m in fixed point, to the nearest, halves away from zero. */
static fluisim_q16 q16_ratio(int32_t n, int32_t m) {
    int64_t size = n < 0 ? -(int64_t)n : n;
    int64_t rounded = (size * 65536 + m / 2) / m;
    return (fluisim_q16)(n < 0 ? -rounded : rounded);
}

static uint64_t q16_bits(fluisim_q16 x) { return (uint32_t)x; }
#else
/* n / m in floating point, rounded once. */
static float f32_ratio(int32_t n, int32_t m) { return (float)n / (float)m; }

/* The bits of a number; both zeros have the same. */
static uint64_t f32_bits(float x) {
    uint32_t bits;
    x += 0.0f;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
#endif

/* The fluid's memory, for the largest of the scenes. */
static FLUISIM_MEMORY(memory, FLUISIM_F32_3D_BYTES(48, FLUISIM_CELLS_3D(5.5, 5.5, 5.5)));

#define PASTE_(a, b, c, d, e) a##b##c##d##e
#define PASTE(a, b, c, d, e) PASTE_(a, b, c, d, e)
#define TEXT_(a) #a
#define TEXT(a) TEXT_(a)
#define F(name) PASTE(fluisim_, T, _, D, d_##name)
#define FLUID PASTE(fluisim_, T, _, D, d)
#define RATIO PASTE(T, _ratio, , , )
#define BITS PASTE(T, _bits, , , )
#define NAME T_NAME " " TEXT(D) "d "

/* Both number types with all kernels do not fit into the 256 KiB of a microbit: FIXED chooses one. */
#ifdef FIXED
#define T q16
#define NUM fluisim_q16
#define T_NAME "i16f16"
#else
#define T f32
#define NUM float
#define T_NAME "f32"
#endif
#define D 2
#include "scene.h"
#undef D
#define D 3
#include "scene.h"

#ifdef FIXED
static int32_t scenes(void) { return fields_q16_2d() | fields_q16_3d() | fluid_q16_2d() | fluid_q16_3d(); }
#else
static int32_t scenes(void) { return fields_f32_2d() | fields_f32_3d() | fluid_f32_2d() | fluid_f32_3d(); }
#endif

int main(void) {
#ifndef NO_LIBC
    uint8_t bytes[33];
    memset(bytes, two > 1.0f ? 7 : 0, sizeof bytes);
    float root = sqrtf(two) + 0.0f * sinf(two);
    if (bytes[32] != 7 || root < 1.4142f || root > 1.4143f) return 1;
#endif
    const int32_t failed = scenes();
    if (failed) print("a function failed\n");
    return failed != 0;
}

/* FLUISIM: a position-based fluid and SPH fields for C99 and later, and C++.
 *
 * No allocation, no global state; no function traps or prints. Everything lies in memory of the caller.
 *
 * Units. The fluid: lengths in support radii h, time in frames; particles rest h/2 apart, four in a square of side h (eight in a
 * cube). Gravity is g dt^2 / h; 0.005 looks right on a pendant. Fields: lengths in any unit L, masses in any unit M.
 *
 * Numbers. Functions with f32 take float, those with q16 take fluisim_q16, 16.16 fixed point in an int32_t: x * 65536.
 * It stays at the ends of its range, and both ends count as not finite.
 *
 * Results. FLUISIM_OK or a number of 0 or more; a code below 0 is an error, and then nothing was changed unless it is said.
 * A null pointer gives FLUISIM_NULL; one that is not aligned as its type must be FLUISIM_MISALIGNED; a NaN, an infinity or an end of
 * the fixed-point range FLUISIM_NOT_FINITE. Memory that init did not make a fluid of gives FLUISIM_NOT_INITIALISED. That holds for
 * every function; what else it returns stands beside it. A pointer that is neither null nor misaligned has to point to what its type
 * says, in the number that is asked for, and what is written must not overlap what is read; no library can check that.
 *
 * Threads and interrupts. A fluid may be used by one at a time; different ones by several.
 */
#ifndef FLUISIM_H
#define FLUISIM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FLUISIM_OK 0
#define FLUISIM_NULL (-1)            /* a pointer is null */
#define FLUISIM_MISALIGNED (-2)      /* a pointer is not aligned as its type must be */
#define FLUISIM_TOO_SMALL (-3)       /* the memory is too small: ask bytes */
#define FLUISIM_FULL (-4)            /* there is no room for another particle */
#define FLUISIM_OUTSIDE (-5)         /* a position is not in the container */
#define FLUISIM_NOT_FINITE (-6)      /* NaN, infinite, or at an end of the fixed-point range */
#define FLUISIM_BAD_ARGUMENT (-7)    /* a number is too small or too large */
#define FLUISIM_NOT_INITIALISED (-8) /* the memory holds something else */
#define FLUISIM_NOT_FOUND (-9)       /* no particle or kernel of this number or name */
#define FLUISIM_UNDEFINED (-10)      /* no value: too few samples in reach, or beyond the range of the numbers */

/* 16.16 fixed point. */
typedef int32_t fluisim_q16;

/* A number as fixed point, for constants; the number is rounded to the nearest. */
#define FLUISIM_Q16(number) ((fluisim_q16)((number) * 65536.0 + ((number) < 0 ? -0.5 : 0.5)))

/* ---- Memory ------------------------------------------------------------------------------------------------------------
 *
 * In a static, for 64 particles in a box of 7.5 x 7.5:
 *
 *     static FLUISIM_MEMORY(memory, FLUISIM_F32_2D_BYTES(64, FLUISIM_CELLS_2D(7.5, 7.5)));
 *
 * A fluid holds no pointer into its own memory, so it may be copied or moved as bytes between two calls; a fluid in a mask holds a
 * pointer to the bits.
 */

/* The cells of a container of this width and height (and depth): whole numbers, or literals such as 7.5. */
#define FLUISIM_CELLS_2D(width, height) (((uint32_t)(width) + 1u) * ((uint32_t)(height) + 1u))
#define FLUISIM_CELLS_3D(width, height, depth) (FLUISIM_CELLS_2D(width, height) * ((uint32_t)(depth) + 1u))

/* The memory of a fluid of at most `capacity` particles in at most `cells` cells, in bytes: a constant expression. */
#define FLUISIM_F32_2D_BYTES(capacity, cells) FLUISIM_BYTES(capacity, cells, 32u)
#define FLUISIM_Q16_2D_BYTES(capacity, cells) FLUISIM_BYTES(capacity, cells, 24u)
#define FLUISIM_F32_3D_BYTES(capacity, cells) FLUISIM_BYTES(capacity, cells, 44u)
#define FLUISIM_Q16_3D_BYTES(capacity, cells) FLUISIM_BYTES(capacity, cells, 36u)
#define FLUISIM_BYTES(capacity, cells, particle) \
    ((size_t)16 + 6u * sizeof(void *) + (size_t)(particle) * (capacity) + (size_t)2 * (cells))

/* An array of so many bytes, aligned as memory must be: as a pointer is. */
#define FLUISIM_MEMORY(name, bytes) uint64_t name[((bytes) + 7u) / 8u]

/* ---- The fluid ---------------------------------------------------------------------------------------------------------*/

/* How a fluid behaves. Numbers beyond what is sensible are held there. */
typedef struct fluisim_settings {
    uint8_t iterations; /* passes of density and correction a frame; 0 counts as 1; at first 2 */
    uint8_t viscosity;  /* XSPH, in 1/256, at most 128, in 3-D 72; at first 26, in 3-D 64 */
    uint8_t cohesion;   /* share of a negative pressure that is kept, in 1/256, at most 64; at first 0 */
} fluisim_settings;

/* Opaque: what init makes of the caller's memory. */
typedef struct fluisim_f32_2d fluisim_f32_2d;
typedef struct fluisim_q16_2d fluisim_q16_2d;
typedef struct fluisim_f32_3d fluisim_f32_3d;
typedef struct fluisim_q16_3d fluisim_q16_3d;

/* The memory in bytes, as FLUISIM_F32_2D_BYTES; SIZE_MAX where it is too much for the processor. */
size_t fluisim_f32_2d_bytes(uint16_t capacity, uint32_t cells);

/* Makes an empty fluid in `memory` and writes a pointer to it to `*fluid`, null after an error; `memory` is then as before.
 * The container is a box from 0 to `size`, each length 1/4 or more. `memory` is the fluid's as long as the fluid is used.
 * FLUISIM_TOO_SMALL: `bytes` are fewer than bytes(capacity, cells). FLUISIM_BAD_ARGUMENT: no capacity; a length below 1/4, or beyond
 * 65536 (fixed point: 32766). */
int32_t fluisim_f32_2d_init_box(void *memory, size_t bytes, uint16_t capacity, const float size[2], fluisim_f32_2d **fluid);

/* As init_box, in a disc (in 3-D a ball) of `radius` 1 or more around (radius, radius): cells as for a square of side 2 radius. */
int32_t fluisim_f32_2d_init_disc(void *memory, size_t bytes, uint16_t capacity, float radius, fluisim_f32_2d **fluid);

/* As init_box, in a bitmap: fluid flows where a bit is 1, all else is wall. Rows from the bottom up, (width + 7) / 8 bytes each, the
 * first pixel the highest bit; `pixel` is the side of one, 1/2 or more. `bits` are read as long as the fluid is used. */
int32_t fluisim_f32_2d_init_mask(void *memory, size_t bytes, uint16_t capacity, const uint8_t *bits, uint8_t width, uint8_t height,
    float pixel, fluisim_f32_2d **fluid);

/* Reads and changes how the fluid behaves. */
int32_t fluisim_f32_2d_settings(const fluisim_f32_2d *fluid, fluisim_settings *settings);
int32_t fluisim_f32_2d_set_settings(fluisim_f32_2d *fluid, const fluisim_settings *settings);

/* Adds a particle at `position` with `velocity` in h a frame, held at 1 along each axis; a null velocity is one at rest.
 * FLUISIM_FULL; FLUISIM_OUTSIDE. */
int32_t fluisim_f32_2d_add(fluisim_f32_2d *fluid, const float position[2], const float velocity[2]);

/* Removes a particle; the last one gets its number. FLUISIM_NOT_FOUND. */
int32_t fluisim_f32_2d_remove(fluisim_f32_2d *fluid, uint16_t index);

/* Adds `change`, in h a frame, to the velocity of the particles no farther than `radius` from `centre`; the sum is held at 1 along
 * each axis. In fixed point a radius above 181 means the square (cube) around the centre. FLUISIM_BAD_ARGUMENT: a radius below 0. */
int32_t fluisim_f32_2d_impulse(fluisim_f32_2d *fluid, const float centre[2], float radius, const float change[2]);

/* Moves the fluid by a frame under `acceleration` in h a frame^2, held at 1/8 along each axis. Numbers of particles change. */
int32_t fluisim_f32_2d_step(fluisim_f32_2d *fluid, const float acceleration[2]);

/* How many particles there are, and how many there is room for. */
int32_t fluisim_f32_2d_count(const fluisim_f32_2d *fluid);
int32_t fluisim_f32_2d_capacity(const fluisim_f32_2d *fluid);

/* Of a particle: its position in h, its velocity in h a frame, its pressure (no unit, 0 at a free surface). FLUISIM_NOT_FOUND. */
int32_t fluisim_f32_2d_position(const fluisim_f32_2d *fluid, uint16_t index, float position[2]);
int32_t fluisim_f32_2d_velocity(const fluisim_f32_2d *fluid, uint16_t index, float velocity[2]);
int32_t fluisim_f32_2d_pressure(const fluisim_f32_2d *fluid, uint16_t index, float *pressure);

/* The same in 16.16 fixed point. */
size_t fluisim_q16_2d_bytes(uint16_t capacity, uint32_t cells);
int32_t fluisim_q16_2d_init_box(void *memory, size_t bytes, uint16_t capacity, const fluisim_q16 size[2], fluisim_q16_2d **fluid);
int32_t fluisim_q16_2d_init_disc(void *memory, size_t bytes, uint16_t capacity, fluisim_q16 radius, fluisim_q16_2d **fluid);
int32_t fluisim_q16_2d_init_mask(void *memory, size_t bytes, uint16_t capacity, const uint8_t *bits, uint8_t width, uint8_t height,
    fluisim_q16 pixel, fluisim_q16_2d **fluid);
int32_t fluisim_q16_2d_settings(const fluisim_q16_2d *fluid, fluisim_settings *settings);
int32_t fluisim_q16_2d_set_settings(fluisim_q16_2d *fluid, const fluisim_settings *settings);
int32_t fluisim_q16_2d_add(fluisim_q16_2d *fluid, const fluisim_q16 position[2], const fluisim_q16 velocity[2]);
int32_t fluisim_q16_2d_remove(fluisim_q16_2d *fluid, uint16_t index);
int32_t fluisim_q16_2d_impulse(fluisim_q16_2d *fluid, const fluisim_q16 centre[2], fluisim_q16 radius, const fluisim_q16 change[2]);
int32_t fluisim_q16_2d_step(fluisim_q16_2d *fluid, const fluisim_q16 acceleration[2]);
int32_t fluisim_q16_2d_count(const fluisim_q16_2d *fluid);
int32_t fluisim_q16_2d_capacity(const fluisim_q16_2d *fluid);
int32_t fluisim_q16_2d_position(const fluisim_q16_2d *fluid, uint16_t index, fluisim_q16 position[2]);
int32_t fluisim_q16_2d_velocity(const fluisim_q16_2d *fluid, uint16_t index, fluisim_q16 velocity[2]);
int32_t fluisim_q16_2d_pressure(const fluisim_q16_2d *fluid, uint16_t index, fluisim_q16 *pressure);

/* The same in three dimensions. */
size_t fluisim_f32_3d_bytes(uint16_t capacity, uint32_t cells);
int32_t fluisim_f32_3d_init_box(void *memory, size_t bytes, uint16_t capacity, const float size[3], fluisim_f32_3d **fluid);
int32_t fluisim_f32_3d_init_disc(void *memory, size_t bytes, uint16_t capacity, float radius, fluisim_f32_3d **fluid);
int32_t fluisim_f32_3d_settings(const fluisim_f32_3d *fluid, fluisim_settings *settings);
int32_t fluisim_f32_3d_set_settings(fluisim_f32_3d *fluid, const fluisim_settings *settings);
int32_t fluisim_f32_3d_add(fluisim_f32_3d *fluid, const float position[3], const float velocity[3]);
int32_t fluisim_f32_3d_remove(fluisim_f32_3d *fluid, uint16_t index);
int32_t fluisim_f32_3d_impulse(fluisim_f32_3d *fluid, const float centre[3], float radius, const float change[3]);
int32_t fluisim_f32_3d_step(fluisim_f32_3d *fluid, const float acceleration[3]);
int32_t fluisim_f32_3d_count(const fluisim_f32_3d *fluid);
int32_t fluisim_f32_3d_capacity(const fluisim_f32_3d *fluid);
int32_t fluisim_f32_3d_position(const fluisim_f32_3d *fluid, uint16_t index, float position[3]);
int32_t fluisim_f32_3d_velocity(const fluisim_f32_3d *fluid, uint16_t index, float velocity[3]);
int32_t fluisim_f32_3d_pressure(const fluisim_f32_3d *fluid, uint16_t index, float *pressure);

/* The same in three dimensions and 16.16 fixed point. */
size_t fluisim_q16_3d_bytes(uint16_t capacity, uint32_t cells);
int32_t fluisim_q16_3d_init_box(void *memory, size_t bytes, uint16_t capacity, const fluisim_q16 size[3], fluisim_q16_3d **fluid);
int32_t fluisim_q16_3d_init_disc(void *memory, size_t bytes, uint16_t capacity, fluisim_q16 radius, fluisim_q16_3d **fluid);
int32_t fluisim_q16_3d_settings(const fluisim_q16_3d *fluid, fluisim_settings *settings);
int32_t fluisim_q16_3d_set_settings(fluisim_q16_3d *fluid, const fluisim_settings *settings);
int32_t fluisim_q16_3d_add(fluisim_q16_3d *fluid, const fluisim_q16 position[3], const fluisim_q16 velocity[3]);
int32_t fluisim_q16_3d_remove(fluisim_q16_3d *fluid, uint16_t index);
int32_t fluisim_q16_3d_impulse(fluisim_q16_3d *fluid, const fluisim_q16 centre[3], fluisim_q16 radius, const fluisim_q16 change[3]);
int32_t fluisim_q16_3d_step(fluisim_q16_3d *fluid, const fluisim_q16 acceleration[3]);
int32_t fluisim_q16_3d_count(const fluisim_q16_3d *fluid);
int32_t fluisim_q16_3d_capacity(const fluisim_q16_3d *fluid);
int32_t fluisim_q16_3d_position(const fluisim_q16_3d *fluid, uint16_t index, fluisim_q16 position[3]);
int32_t fluisim_q16_3d_velocity(const fluisim_q16_3d *fluid, uint16_t index, fluisim_q16 velocity[3]);
int32_t fluisim_q16_3d_pressure(const fluisim_q16_3d *fluid, uint16_t index, fluisim_q16 *pressure);

/* ---- Pixels and lamps --------------------------------------------------------------------------------------------------
 *
 * A fluid in two dimensions on a display of any size. Each pixel is a byte of an array of columns * rows, row by row from the bottom;
 * the first pixel begins at (0, 0). The density of fluid at rest is 160; bytes end at 255.
 *
 *     density = 160 sum_i V / w^2 (1 - |x_i - x| / w)+ (1 - |y_i - y| / w)+       V = 1/4, w = max(pixel, 1), at the pixel's centre
 *
 * Each particle adds a whole number, the nearest one, to a pixel: where the side of a pixel is above 9 h, that is nothing.
 */

/* Draws the fluid into `density`, columns * rows bytes, `pixel` the side of a pixel in h. FLUISIM_BAD_ARGUMENT: a pixel of 0 or less, or
 * more pixels than the processor can address; `density` is then as before. */
int32_t fluisim_f32_2d_draw(const fluisim_f32_2d *fluid, float pixel, uint16_t columns, uint16_t rows, uint8_t *density);
int32_t fluisim_q16_2d_draw(const fluisim_q16_2d *fluid, fluisim_q16 pixel, uint16_t columns, uint16_t rows, uint8_t *density);

/* Lights the first `count` lamps, 1 or 0: one comes on where the density is `on` or more, goes out below `off`, and stays as it is
 * between, so that it does not flicker at the surface; 96 and 64 are good. All lamps are 0 at first. FLUISIM_BAD_ARGUMENT: `off` above
 * `on`. */
int32_t fluisim_light_lamps(const uint8_t *density, size_t count, uint8_t on, uint8_t off, uint8_t *lamps);

/* A density as the brightness of a display in grey, 0 to 255: 255 for fluid at rest. */
int32_t fluisim_brightness(uint8_t density);

/* ---- Fields ------------------------------------------------------------------------------------------------------------
 *
 * Over `count` samples in arrays of the caller, coordinates one after the other: x0, y0, x1, y1, ... Every sample is looked at.
 * Sums are added in the order of the arrays. W(x) = sigma h^-D f(|x| / h) is the kernel's influence of support radius h.
 */

/* The kernels by their number. */
#define FLUISIM_KERNEL_POLY6 0
#define FLUISIM_KERNEL_SPIKY 1
#define FLUISIM_KERNEL_VISCOSITY 2   /* for viscosity forces: diverges at 0, so the functions here answer FLUISIM_BAD_ARGUMENT */
#define FLUISIM_KERNEL_CUBIC_SPLINE 3
#define FLUISIM_KERNEL_QUARTIC_SPLINE 4
#define FLUISIM_KERNEL_QUINTIC_SPLINE 5
#define FLUISIM_KERNEL_WENDLAND_C2 6
#define FLUISIM_KERNEL_WENDLAND_C4 7
#define FLUISIM_KERNEL_WENDLAND_C6 8

/* The number of a kernel by its name, as "wendland-c2"; FLUISIM_NOT_FOUND. */
int32_t fluisim_kernel(const char *name);

/* The name of a kernel by its number; null where there is none. */
const char *fluisim_kernel_name(int32_t kernel);

/* rho(x) = sum_j m_j W(x - x_j), unit M L^-D, and, unless `gradient` is null, its gradient in M L^-D-1.
 * FLUISIM_NOT_FOUND: no such kernel. FLUISIM_BAD_ARGUMENT: a mass or a support radius of 0 or less, or one so small or large that
 * sigma h^-D is not in the range of the numbers. FLUISIM_UNDEFINED: the sum is not in it. */
int32_t fluisim_f32_2d_density(int32_t kernel, float support_radius, const float *positions, const float *masses, size_t count,
    const float point[2], float *density, float gradient[2]);

/* rho at every sample, itself included: count^2 pairs. Errors as density. */
int32_t fluisim_f32_2d_densities(int32_t kernel, float support_radius, const float *positions, const float *masses, size_t count,
    float *densities);

/* A(x) = sum_j V_j A_j W(x - x_j) and, unless `gradient` is null, its gradient; V_j = m_j / rho_j, unit L^D. Errors as density. */
int32_t fluisim_f32_2d_interpolate(int32_t kernel, float support_radius, const float *positions, const float *volumes, const float *values,
    size_t count, const float point[2], float *value, float gradient[2]);

/* A(x) = sum_j V_j A_j W / sum_j V_j W and its gradient: right for constants. FLUISIM_UNDEFINED also where no sample is in reach. */
int32_t fluisim_f32_2d_shepard(int32_t kernel, float support_radius, const float *positions, const float *volumes, const float *values,
    size_t count, const float point[2], float *value, float gradient[2]);

/* A(x) and its slope by linear moving least squares: right for linear fields. FLUISIM_UNDEFINED also where the samples in reach are too
 * few or lie in a line (in 3-D a plane). */
int32_t fluisim_f32_2d_corrected(int32_t kernel, float support_radius, const float *positions, const float *volumes, const float *values,
    size_t count, const float point[2], float *value, float gradient[2]);

/* The same in 16.16 fixed point. */
int32_t fluisim_q16_2d_density(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *masses, size_t count,
    const fluisim_q16 point[2], fluisim_q16 *density, fluisim_q16 gradient[2]);
int32_t fluisim_q16_2d_densities(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *masses, size_t count,
    fluisim_q16 *densities);
int32_t fluisim_q16_2d_interpolate(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *volumes, const fluisim_q16 *values,
    size_t count, const fluisim_q16 point[2], fluisim_q16 *value, fluisim_q16 gradient[2]);
int32_t fluisim_q16_2d_shepard(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *volumes, const fluisim_q16 *values,
    size_t count, const fluisim_q16 point[2], fluisim_q16 *value, fluisim_q16 gradient[2]);
int32_t fluisim_q16_2d_corrected(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *volumes, const fluisim_q16 *values,
    size_t count, const fluisim_q16 point[2], fluisim_q16 *value, fluisim_q16 gradient[2]);

/* The same in three dimensions. */
int32_t fluisim_f32_3d_density(int32_t kernel, float support_radius, const float *positions, const float *masses, size_t count,
    const float point[3], float *density, float gradient[3]);
int32_t fluisim_f32_3d_densities(int32_t kernel, float support_radius, const float *positions, const float *masses, size_t count,
    float *densities);
int32_t fluisim_f32_3d_interpolate(int32_t kernel, float support_radius, const float *positions, const float *volumes, const float *values,
    size_t count, const float point[3], float *value, float gradient[3]);
int32_t fluisim_f32_3d_shepard(int32_t kernel, float support_radius, const float *positions, const float *volumes, const float *values,
    size_t count, const float point[3], float *value, float gradient[3]);
int32_t fluisim_f32_3d_corrected(int32_t kernel, float support_radius, const float *positions, const float *volumes, const float *values,
    size_t count, const float point[3], float *value, float gradient[3]);

/* The same in three dimensions and 16.16 fixed point. */
int32_t fluisim_q16_3d_density(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *masses, size_t count,
    const fluisim_q16 point[3], fluisim_q16 *density, fluisim_q16 gradient[3]);
int32_t fluisim_q16_3d_densities(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *masses, size_t count,
    fluisim_q16 *densities);
int32_t fluisim_q16_3d_interpolate(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *volumes, const fluisim_q16 *values,
    size_t count, const fluisim_q16 point[3], fluisim_q16 *value, fluisim_q16 gradient[3]);
int32_t fluisim_q16_3d_shepard(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *volumes, const fluisim_q16 *values,
    size_t count, const fluisim_q16 point[3], fluisim_q16 *value, fluisim_q16 gradient[3]);
int32_t fluisim_q16_3d_corrected(int32_t kernel, fluisim_q16 support_radius, const fluisim_q16 *positions, const fluisim_q16 *volumes, const fluisim_q16 *values,
    size_t count, const fluisim_q16 point[3], fluisim_q16 *value, fluisim_q16 gradient[3]);

/* V_j = m_j / rho_j, unit L^D. FLUISIM_BAD_ARGUMENT: a density of 0 or less; the volumes before it are then written. */
int32_t fluisim_f32_volumes(const float *masses, const float *densities, size_t count, float *volumes);
int32_t fluisim_q16_volumes(const fluisim_q16 *masses, const fluisim_q16 *densities, size_t count, fluisim_q16 *volumes);

#ifdef __cplusplus
}
#endif

#endif /* FLUISIM_H */

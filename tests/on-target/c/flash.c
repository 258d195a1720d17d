/* What a pendant does, to see how much flash it takes: an empty fluid, a particle, a frame. FIXED chooses the number type. */
#include "fluisim.h"

#ifdef FIXED
#define F(name) fluisim_q16_2d_##name
typedef fluisim_q16_2d fluid_t;
typedef fluisim_q16 number_t;
#define N(number) FLUISIM_Q16(number)
static FLUISIM_MEMORY(memory, FLUISIM_Q16_2D_BYTES(64, FLUISIM_CELLS_2D(7.5, 7.5)));
#else
#define F(name) fluisim_f32_2d_##name
typedef fluisim_f32_2d fluid_t;
typedef float number_t;
#define N(number) ((float)(number))
static FLUISIM_MEMORY(memory, FLUISIM_F32_2D_BYTES(64, FLUISIM_CELLS_2D(7.5, 7.5)));
#endif

int main(void) {
#ifndef EMPTY
    static const number_t size[2] = {N(7.5), N(7.5)}, position[2] = {N(0.25), N(0.25)}, velocity[2] = {N(0), N(0)},
                          down[2] = {N(0), N(-0.005)};
    fluid_t *fluid;
    return F(init_box)(memory, sizeof memory, 64, size, &fluid) | F(add)(fluid, position, velocity) | F(step)(fluid, down);
#else
    (void)memory;
    return 0;
#endif
}

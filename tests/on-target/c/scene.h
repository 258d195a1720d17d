/* The scenes of `digest/src`, in the number type T and D dimensions: included by golden.c once for each. */

/* The number of particles, and of them in a row. */
#define PARTICLES 48
#define COLUMNS (D == 2 ? 6 : 4)

/* A fluid that is turned and shaken for 600 frames. */
static int32_t PASTE(fluid_, T, _, D, d)(void) {
    static const int16_t turns[4][3] = {{0, -6, 0}, {4, -4, -4}, {6, 0, 2}, {4, 4, -3}};
    NUM size[D], position[D], velocity[D], pressure = 0;
    FLUID *fluid;
    for (int axis = 0; axis < D; axis++) size[axis] = RATIO(11, 2);
    int32_t failed = F(init_box)(memory, sizeof memory, PARTICLES, size, &fluid);
    for (int32_t k = 0; k < PARTICLES; k++) {
        for (int32_t axis = 0, rest = k; axis < D; axis++, rest /= COLUMNS)
            position[axis] = RATIO(2 * (axis == D - 1 ? rest : rest % COLUMNS) + 1, 4);
        failed |= F(add)(fluid, position, NULL);
    }
    for (int32_t frame = 0; frame < 600; frame++) {
        NUM acceleration[D];
        for (int axis = 0; axis < D; axis++)
            acceleration[axis] = RATIO(turns[frame / 75 % 4][axis] + (axis == 0 ? (frame * 7 % 5 - 2) * 3 : 0), 1000);
        failed |= F(step)(fluid, acceleration);
    }
    uint64_t digests[3] = {FNV_OF_NOTHING, FNV_OF_NOTHING, FNV_OF_NOTHING};
    for (int32_t index = 0; index < F(count)(fluid); index++) {
        failed |= F(position)(fluid, (uint16_t)index, position) | F(velocity)(fluid, (uint16_t)index, velocity);
        failed |= F(pressure)(fluid, (uint16_t)index, &pressure);
        for (int axis = 0; axis < D; axis++) digests[0] = fnv(digests[0], BITS(position[axis]));
        for (int axis = 0; axis < D; axis++) digests[1] = fnv(digests[1], BITS(velocity[axis]));
        digests[2] = fnv(digests[2], BITS(pressure));
    }
    row(NAME, "position-based positions", digests[0]);
    row(NAME, "position-based velocities", digests[1]);
    row(NAME, "position-based pressures", digests[2]);
    return failed;
}

#define SAMPLES 64

/* What a sum gave: a value, if it is wanted, and a gradient; or that there is none. */
static uint64_t PASTE(take_, T, _, D, d)(uint64_t digest, int32_t result, const NUM *value, const NUM *gradient) {
    if (result == FLUISIM_UNDEFINED) return fnv(digest, UINT64_MAX);
    if (value) digest = fnv(digest, BITS(*value));
    for (int axis = 0; gradient && axis < D; axis++) digest = fnv(digest, BITS(gradient[axis]));
    return digest;
}
#define TAKE PASTE(take_, T, _, D, d)

/* Density, value and gradient of a field of 64 samples at 20 points. */
static int32_t PASTE(fields_, T, _, D, d)(void) {
    static const char *const quantities[6] = {"brute density",       "brute density-gradient", "brute interpolation",
                                              "brute shepard",       "brute least-squares",    "brute gradient"};
    NUM positions[SAMPLES][D], masses[SAMPLES], values[SAMPLES], density[SAMPLES], volumes[SAMPLES];
    uint64_t digests[6];
    uint32_t random = D;
    const int32_t side = D == 2 ? 8 : 4;
    for (int32_t i = 0; i < SAMPLES; i++)
        for (int32_t axis = 0, rest = i; axis < D; axis++, rest /= side)
            positions[i][axis] = RATIO(384 * (rest % side) + next(&random, 96) - 512, 1024);
    for (int32_t i = 0; i < SAMPLES; i++) masses[i] = RATIO((D == 2 ? 9216 : 3456) + next(&random, 512), 65536);
    for (int32_t i = 0; i < SAMPLES; i++) next(&random, 90); /* radii, for a sum that is not here */
    for (int32_t i = 0; i < SAMPLES; i++) values[i] = RATIO(next(&random, 2048), 1024);
    const int32_t kernel = fluisim_kernel("wendland-c2");
    const NUM h = RATIO(15, 16), *const x = positions[0];
    int32_t failed = kernel != FLUISIM_KERNEL_WENDLAND_C2 || strlen(fluisim_kernel_name(kernel)) != 11;
    failed |= F(densities)(kernel, h, x, masses, SAMPLES, density);
    failed |= PASTE(fluisim_, T, _volumes, , )(masses, density, SAMPLES, volumes);
    for (int quantity = 0; quantity < 6; quantity++) digests[quantity] = FNV_OF_NOTHING;
    for (uint32_t point = 0; point < 20; point++) {
        NUM at[D], value, gradient[D];
        random = point * 7919;
        for (int axis = 0; axis < D; axis++) at[axis] = RATIO(1000 + next(&random, 1900), 1024);
        if (point % 4 == 0) memcpy(at, positions[3 * point], sizeof at);
        failed |= F(density)(kernel, h, x, masses, SAMPLES, at, &value, NULL);
        digests[0] = TAKE(digests[0], 0, &value, NULL);
        failed |= F(density)(kernel, h, x, masses, SAMPLES, at, &value, gradient);
        digests[1] = TAKE(digests[1], 0, &value, gradient);
        failed |= F(interpolate)(kernel, h, x, volumes, values, SAMPLES, at, &value, NULL);
        digests[2] = TAKE(digests[2], 0, &value, NULL);
        int32_t result = F(shepard)(kernel, h, x, volumes, values, SAMPLES, at, &value, gradient);
        digests[3] = TAKE(digests[3], result, &value, gradient);
        result = F(corrected)(kernel, h, x, volumes, values, SAMPLES, at, &value, gradient);
        digests[4] = TAKE(digests[4], result, &value, gradient);
        failed |= F(interpolate)(kernel, h, x, volumes, values, SAMPLES, at, &value, gradient);
        digests[5] = TAKE(digests[5], 0, NULL, gradient);
    }
    for (int quantity = 0; quantity < 6; quantity++) row(NAME, quantities[quantity], digests[quantity]);
    return failed;
}

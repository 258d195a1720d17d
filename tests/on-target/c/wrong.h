/* Everything that can be wrong with the functions of the number type T in D dimensions: included by errors.c once for each. */

/* That a call fails with a code and leaves the memory as it was. */
#define REFUSED(call, code) do { memcpy(before, memory, sizeof memory); EXPECT(call, code); EXPECT(memcmp(before, memory, sizeof memory), 0); } while (0)

static void PASTE(fluid_, T, _, D, d)(void) {
    NUM size[D], middle[D], bad[D], far[D], still[D], out[D], pressure;
    FLUID *fluid = NULL, *none = (FLUID *)(void *)memory;
    fluisim_settings settings;
    for (int axis = 0; axis < D; axis++) size[axis] = N(5), middle[axis] = N(2.5), bad[axis] = far[axis] = still[axis] = N(0);
    bad[D - 1] = BAD(0), far[D - 1] = N(5.1);
    const uint32_t cells = D == 2 ? FLUISIM_CELLS_2D(5, 5) : FLUISIM_CELLS_3D(5, 5, 5);
    const size_t bytes = BYTES(4, cells);
    EXPECT(F(bytes)(4, cells) == bytes && F(bytes)(65535, 0) == BYTES((size_t)65535, 0), 1);

    memset(memory, 0xa5, sizeof memory);
    REFUSED(F(init_box)(memory, bytes, 4, size, NULL), FLUISIM_NULL);
    REFUSED(F(init_box)(memory, bytes, 4, size, ODD(FLUID *, memory)), FLUISIM_MISALIGNED);
    REFUSED(F(init_box)(NULL, bytes, 4, size, &fluid), FLUISIM_NULL);
    REFUSED(F(init_box)(ODD(void, memory), bytes, 4, size, &fluid), FLUISIM_MISALIGNED);
    REFUSED(F(init_box)(memory, bytes - 1, 4, size, &fluid), FLUISIM_TOO_SMALL);
    REFUSED(F(init_box)(memory, bytes, 5, size, &fluid), FLUISIM_TOO_SMALL);
    REFUSED(F(init_box)(memory, bytes, 0, size, &fluid), FLUISIM_BAD_ARGUMENT);
    REFUSED(F(init_box)(memory, bytes, 4, NULL, &fluid), FLUISIM_NULL);
    REFUSED(F(init_box)(memory, bytes, 4, ODD(NUM, memory), &fluid), FLUISIM_MISALIGNED);
    REFUSED(F(init_box)(memory, bytes, 4, still, &fluid), FLUISIM_BAD_ARGUMENT);
    size[0] = N(-5);
    REFUSED(F(init_box)(memory, bytes, 4, size, &fluid), FLUISIM_BAD_ARGUMENT);
    size[0] = N(32767);
    REFUSED(F(init_box)(memory, bytes, 4, size, &fluid), sizeof(NUM) == 4 && N(0.5) == 0.5f ? FLUISIM_TOO_SMALL : FLUISIM_BAD_ARGUMENT);
    for (int which = 0; which < 3; which++) {
        size[0] = BAD(which);
        REFUSED(F(init_box)(memory, bytes, 4, size, &fluid), FLUISIM_NOT_FINITE);
        REFUSED(F(init_disc)(memory, bytes, 4, BAD(which), &fluid), FLUISIM_NOT_FINITE);
    }
    size[0] = N(5);
    REFUSED(F(init_disc)(memory, bytes, 4, N(0.9), &fluid), FLUISIM_BAD_ARGUMENT);
    REFUSED(F(init_disc)(memory, bytes, 4, N(4), &fluid), FLUISIM_TOO_SMALL);
    EXPECT(fluid == NULL, 1);

    REFUSED(F(step)(none, still), FLUISIM_NOT_INITIALISED);
    REFUSED(F(add)(none, middle, NULL), FLUISIM_NOT_INITIALISED);
    REFUSED(F(remove)(none, 0), FLUISIM_NOT_INITIALISED);
    REFUSED(F(impulse)(none, middle, N(1), still), FLUISIM_NOT_INITIALISED);
    REFUSED(F(count)(none), FLUISIM_NOT_INITIALISED);
    REFUSED(F(capacity)(none), FLUISIM_NOT_INITIALISED);
    REFUSED(F(settings)(none, &settings), FLUISIM_NOT_INITIALISED);
    EXPECT(F(count)(NULL) == FLUISIM_NULL && F(count)(ODD(FLUID, memory)) == FLUISIM_MISALIGNED, 1);

    EXPECT(F(init_box)(memory, bytes, 4, size, &fluid), FLUISIM_OK);
    EXPECT(F(capacity)(fluid), 4);
    REFUSED(F(position)(fluid, 0, out), FLUISIM_NOT_FOUND);
    REFUSED(F(remove)(fluid, 0), FLUISIM_NOT_FOUND);
    REFUSED(F(add)(fluid, far, NULL), FLUISIM_OUTSIDE);
    REFUSED(F(add)(fluid, bad, NULL), FLUISIM_NOT_FINITE);
    REFUSED(F(add)(fluid, middle, bad), FLUISIM_NOT_FINITE);
    REFUSED(F(add)(fluid, NULL, NULL), FLUISIM_NULL);
    REFUSED(F(add)(fluid, ODD(NUM, memory), NULL), FLUISIM_MISALIGNED);
    REFUSED(F(add)(fluid, middle, ODD(NUM, memory)), FLUISIM_MISALIGNED);
    far[D - 1] = N(-0.01);
    REFUSED(F(add)(fluid, far, NULL), FLUISIM_OUTSIDE);
    for (int k = 0; k < 4; k++) EXPECT(F(add)(fluid, middle, still), FLUISIM_OK);
    REFUSED(F(add)(fluid, middle, still), FLUISIM_FULL);
    EXPECT(F(count)(fluid), 4);

    REFUSED(F(step)(fluid, bad), FLUISIM_NOT_FINITE);
    REFUSED(F(step)(fluid, NULL), FLUISIM_NULL);
    REFUSED(F(step)(fluid, ODD(NUM, memory)), FLUISIM_MISALIGNED);
    REFUSED(F(step)(ODD(FLUID, memory), still), FLUISIM_MISALIGNED);
    REFUSED(F(impulse)(fluid, bad, N(1), still), FLUISIM_NOT_FINITE);
    REFUSED(F(impulse)(fluid, middle, BAD(0), still), FLUISIM_NOT_FINITE);
    REFUSED(F(impulse)(fluid, middle, N(1), bad), FLUISIM_NOT_FINITE);
    REFUSED(F(impulse)(fluid, middle, N(-1), still), FLUISIM_BAD_ARGUMENT);
    REFUSED(F(impulse)(fluid, NULL, N(1), still), FLUISIM_NULL);
    REFUSED(F(remove)(fluid, 4), FLUISIM_NOT_FOUND);
    REFUSED(F(position)(fluid, 4, out), FLUISIM_NOT_FOUND);
    REFUSED(F(position)(fluid, 0, NULL), FLUISIM_NULL);
    REFUSED(F(velocity)(fluid, 0, ODD(NUM, memory)), FLUISIM_MISALIGNED);
    REFUSED(F(pressure)(fluid, 0, NULL), FLUISIM_NULL);
    REFUSED(F(set_settings)(fluid, NULL), FLUISIM_NULL);
    REFUSED(F(settings)(fluid, NULL), FLUISIM_NULL);

    EXPECT(F(settings)(fluid, &settings), FLUISIM_OK);
    EXPECT(settings.iterations == 2 && settings.viscosity == (D == 2 ? 26 : 64) && settings.cohesion == 0, 1);
    memset(&settings, 255, sizeof settings);
    settings.iterations = 3;
    EXPECT(F(set_settings)(fluid, &settings), FLUISIM_OK);
    still[0] = N(0.25);
    EXPECT(F(impulse)(fluid, middle, N(0), still), FLUISIM_OK);
    EXPECT(F(velocity)(fluid, 3, out) == FLUISIM_OK && out[0] == N(0.25) && out[1] == 0, 1);
    still[0] = N(1000);
    for (int frame = 0; frame < 50; frame++) EXPECT(F(step)(fluid, still), FLUISIM_OK);
    EXPECT(F(position)(fluid, 0, out) == FLUISIM_OK && out[0] > N(3) && out[0] < N(5), 1);
    EXPECT(F(pressure)(fluid, 0, &pressure) == FLUISIM_OK && pressure < N(1), 1);
    memcpy(before, memory, sizeof memory); /* a fluid may be moved */
    EXPECT(F(step)((FLUID *)(void *)before, still), FLUISIM_OK);
    EXPECT(F(remove)(fluid, 0) == FLUISIM_OK && F(count)(fluid) == 3, 1);
    for (int k = 0; k < 3; k++) EXPECT(F(remove)(fluid, 0), FLUISIM_OK);
    EXPECT(F(step)(fluid, still) == FLUISIM_OK && F(count)(fluid) == 0, 1);
}

static void PASTE(fields_, T, _, D, d)(void) {
    NUM x[3 * D], ones[3] = {N(1), N(1), N(1)}, bad[D], at[D], value = N(7), gradient[D], many[3];
    for (int axis = 0; axis < D; axis++) at[axis] = bad[axis] = gradient[axis] = N(0);
    for (int k = 0; k < 3 * D; k++) x[k] = N(0);
    x[D] = N(0.5), x[2 * D + 1] = N(0.5), bad[0] = BAD(0);
    const int32_t kernel = FLUISIM_KERNEL_CUBIC_SPLINE;
    EXPECT(F(density)(9, N(1), x, ones, 3, at, &value, NULL), FLUISIM_NOT_FOUND);
    EXPECT(F(density)(-1, N(1), x, ones, 3, at, &value, NULL), FLUISIM_NOT_FOUND);
    EXPECT(F(density)(FLUISIM_KERNEL_VISCOSITY, N(1), x, ones, 3, at, &value, NULL), FLUISIM_BAD_ARGUMENT);
    EXPECT(F(density)(kernel, N(0), x, ones, 3, at, &value, NULL), FLUISIM_BAD_ARGUMENT);
    EXPECT(F(density)(kernel, BAD(0), x, ones, 3, at, &value, NULL), FLUISIM_NOT_FINITE);
    EXPECT(F(density)(kernel, N(1), NULL, ones, 3, at, &value, NULL), FLUISIM_NULL);
    EXPECT(F(density)(kernel, N(1), x, NULL, 3, at, &value, NULL), FLUISIM_NULL);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, NULL, &value, NULL), FLUISIM_NULL);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, at, NULL, NULL), FLUISIM_NULL);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, bad, &value, NULL), FLUISIM_NOT_FINITE);
    EXPECT(F(density)(kernel, N(1), ODD(NUM, x), ones, 3, at, &value, NULL), FLUISIM_MISALIGNED);
    EXPECT(F(density)(kernel, N(1), x, ones, SIZE_MAX / 2, at, &value, NULL), FLUISIM_BAD_ARGUMENT);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, at, &value, ODD(NUM, x)), FLUISIM_MISALIGNED);
    ones[1] = N(0);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, at, &value, NULL), FLUISIM_BAD_ARGUMENT);
    ones[1] = BAD(0);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, at, &value, NULL), FLUISIM_NOT_FINITE);
    ones[1] = N(1);
    EXPECT(F(interpolate)(kernel, N(1), x, ones, NULL, 3, at, &value, NULL), FLUISIM_NULL);
    x[1] = BAD(0);
    EXPECT(F(shepard)(kernel, N(1), x, ones, ones, 3, at, &value, gradient), FLUISIM_NOT_FINITE);
    x[1] = N(0);
    many[0] = many[1] = many[2] = BAD(0);
    EXPECT(F(interpolate)(kernel, N(1), x, ones, many, 3, at, &value, NULL), FLUISIM_NOT_FINITE);
    at[0] = N(20);
    EXPECT(F(shepard)(kernel, N(1), x, ones, ones, 3, at, &value, gradient), FLUISIM_UNDEFINED);
    EXPECT(F(corrected)(kernel, N(1), x, ones, ones, 3, at, &value, gradient), FLUISIM_UNDEFINED);
    EXPECT(value == N(7), 1);
    EXPECT(F(density)(kernel, N(1), x, ones, 3, at, &value, gradient) == FLUISIM_OK && value == 0, 1);
    at[0] = N(0);
    EXPECT(F(shepard)(kernel, N(1), x, ones, ones, 3, at, &value, NULL) == FLUISIM_OK && value > N(0.99) && value < N(1.01), 1);
    EXPECT(F(density)(kernel, N(1), NULL, NULL, 0, at, &value, NULL) == FLUISIM_OK && value == 0, 1);
    EXPECT(F(densities)(kernel, N(1), x, ones, 3, NULL), FLUISIM_NULL);
    EXPECT(F(densities)(kernel, N(1), x, ones, 3, many) == FLUISIM_OK && many[0] > N(1), 1);
    EXPECT(PASTE(fluisim_, T, _volumes, , )(ones, many, 3, NULL), FLUISIM_NULL);
    many[2] = N(-1);
    EXPECT(PASTE(fluisim_, T, _volumes, , )(ones, many, 3, many), FLUISIM_BAD_ARGUMENT);
}

static void PASTE(wrong_, T, _, D, d)(void) {
    PASTE(fluid_, T, _, D, d)();
    PASTE(fields_, T, _, D, d)();
}
#undef REFUSED

/* What the C mains share. */
#ifndef CHECK_H
#define CHECK_H
#include "fluisim.h"

#ifdef __cplusplus
extern "C"
#endif
void print(const char *text);

/* FNV-1a in 64 bits, eight bytes at a time, lowest first. */
static inline uint64_t fnv(uint64_t digest, uint64_t bits) {
    for (int byte = 0; byte < 8; byte++, bits >>= 8) digest = (digest ^ (bits & 255)) * UINT64_C(0x100000001b3);
    return digest;
}
#define FNV_OF_NOTHING UINT64_C(0xcbf29ce484222325)

static inline void print_hex(uint64_t number) {
    char text[17];
    for (int place = 15; place >= 0; place--, number >>= 4) text[place] = "0123456789abcdef"[number & 15];
    text[16] = 0;
    print(text);
}
#endif

/* Bare metal: vectors, memory, and semihosting for output and exit. RISC-V has its own start below. */
#include "check.h"

int main(void);

extern uint32_t _sidata[], _sdata[], _edata[], _sbss[], _ebss[];

#ifdef __riscv
static long semihost(long operation, const void *argument) {
    register long a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = argument;
    __asm__ volatile(".option push\n.option norvc\nslli x0, x0, 0x1f\nebreak\nsrai x0, x0, 7\n.option pop"
                     : "+r"(a0) : "r"(a1) : "memory");
    return a0;
}
#else
static long semihost(long operation, const void *argument) {
    register long r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}
#endif

void print(const char *text) { semihost(4, text); }

static void end(int failed) {
    semihost(0x18, (const void *)(uintptr_t)(failed ? 0x20023 : 0x20026));
    for (;;) {}
}

void start(void);
void start(void) {
#ifdef __ARM_FP
    *(volatile uint32_t *)0xE000ED88 |= 0xF00000;
    __asm__ volatile("dsb\nisb");
#endif
    for (uint32_t *from = _sidata, *to = _sdata; to < _edata;) *to++ = *from++;
    for (uint32_t *to = _sbss; to < _ebss;) *to++ = 0;
    end(main());
}

#ifdef __riscv
__asm__(".section .vectors,\"ax\"\n.global _start\n_start: la sp, _stack\nla t0, trapped\n.option push\n.option arch, +zicsr\ncsrw mtvec, t0\n.option pop\nj start\n.text\n");
__attribute__((aligned(4), used)) void trapped(void) { print("trap\n"); end(1); }
#else
static void trapped(void) { print("trap\n"); end(1); }
extern void stack_top(void) __asm__("_stack"); /* not a function, but in a table of such */
__attribute__((section(".vectors"), used)) static void (*const vectors[16])(void) = {
    stack_top, start, trapped, trapped, trapped, trapped, trapped, 0, 0, 0, 0, trapped, trapped, 0, trapped, trapped};
#endif

#ifdef NO_LIBC /* where the compiler has no C library: what archives ask of one */
void *memcpy(void *restrict to, const void *restrict from, size_t count);
void *memset(void *to, int value, size_t count);
void *memmove(void *to, const void *from, size_t count);
int memcmp(const void *a, const void *b, size_t count);
size_t strlen(const char *text);
void *memcpy(void *restrict to, const void *restrict from, size_t count) {
    for (size_t i = 0; i < count; i++) ((volatile char *)to)[i] = ((const char *)from)[i];
    return to;
}
void *memset(void *to, int value, size_t count) {
    for (size_t i = 0; i < count; i++) ((volatile char *)to)[i] = (char)value;
    return to;
}
void *memmove(void *to, const void *from, size_t count) {
    if ((uintptr_t)to <= (uintptr_t)from) return memcpy(to, from, count);
    while (count-- > 0) ((volatile char *)to)[count] = ((const char *)from)[count];
    return to;
}
int memcmp(const void *a, const void *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (((const uint8_t *)a)[i] != ((const uint8_t *)b)[i]) return ((const uint8_t *)a)[i] - ((const uint8_t *)b)[i];
    return 0;
}
size_t strlen(const char *text) {
    size_t count = 0;
    while (((const volatile char *)text)[count]) count++;
    return count;
}
#endif

/* Where there is an operating system. */
#include "check.h"
#include <stdio.h>

void print(const char *text) { fputs(text, stdout); }

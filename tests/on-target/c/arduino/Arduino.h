/* As much of Arduino's core as the examples use. mock.cpp is behind it. */
#ifndef MOCK_ARDUINO_H
#define MOCK_ARDUINO_H
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#define LOW 0
#define HIGH 1
#define OUTPUT 1
#define MSBFIRST 1

void setup();
void loop();
void pinMode(int pin, int mode);
void digitalWrite(int pin, int level);
void shiftOut(int data, int clock, int order, uint8_t value);
unsigned long millis();
void delay(unsigned long milliseconds);

struct MockSerial {
    void begin(unsigned long baud);
    int available();
    int read();
    void println(const char *text = "");
    void println(int number);
    void println(long number);
};
extern MockSerial Serial;
#endif

/* As much of Arduino's Wire as the examples use. */
#ifndef MOCK_WIRE_H
#define MOCK_WIRE_H
#include <stddef.h>
#include <stdint.h>

struct MockWire {
    void begin();
    void setClock(uint32_t frequency);
    void beginTransmission(uint8_t address);
    size_t write(uint8_t byte);
    uint8_t endTransmission(bool stop = true);
    uint8_t requestFrom(uint8_t address, uint8_t count);
    int read();
};
extern MockWire Wire;
#endif

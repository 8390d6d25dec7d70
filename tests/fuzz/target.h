// A fuzzing target: one function from bytes to nothing, which stops the program when something that
// must hold does not. libFuzzer calls it with bytes it invents, replay.cpp with those of files.
#pragma once

#include <cstddef>
#include <cstdint>

/// libFuzzer's own name and signature. Always 0.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

// --limit NAME=VALUE: how much a file may ask for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/result.h"
#include "csg/read_csg.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has named it
class App;
}

namespace whittle {

/// No option takes a size of memory beyond this, bytes.
inline constexpr uint64_t kMostMemory = uint64_t(1) << 50;

/// Bytes, or with K, M or G behind them 1024, 1024^2 or 1024^3 of them; 1 to `most`, or refuses.
uint64_t parse_bytes(const char* option, const std::string& text, uint64_t most);

/// --limit, which may be given again for another name. A limit of memory takes effect at once.
void add_limit_option(CLI::App& app, ReadLimits& limits);

/// Puts the name of the option that raises a limit into messages about that limit.
Result<Read> with_limit_option(Result<Read> read);

/// Limits the memory of this process (RLIMIT_DATA): where it runs out, std::bad_alloc is thrown.
/// Does nothing under the sanitizers, which take terabytes for themselves.
void limit_memory(uint64_t bytes);

/// What limit_memory() has set, or what the machine has if it did nothing.
uint64_t memory_limit();

/// What the machine has.
uint64_t physical_memory();

/// That there is no more memory, and which limit it is that ended it.
std::string out_of_memory();

}  // namespace whittle

// What is true of every run on a hostile file.
#pragma once

#include "support/program.h"

namespace whittle {

/// Less than 1 GB, or what else is said. Under the sanitizers it is theirs more than the program's,
/// so it says nothing.
inline void expect_little_memory([[maybe_unused]] const Ended& done,
                                 [[maybe_unused]] uint64_t most = 1'000'000'000) {
#if !defined(WHITTLE_SANITIZED)
  EXPECT_LT(done.peak_memory_bytes, most);
#endif
}

/// Refused: one line on standard error, that exit code, nothing written.
inline void expect_refused(const Ended& done, int exit_code, const std::string& err) {
  EXPECT_EQ(done.exit_code, exit_code) << "signal " << done.signal;
  EXPECT_EQ(done.err, err + "\n");
  EXPECT_EQ(done.out, "");
  expect_little_memory(done);
}

}  // namespace whittle

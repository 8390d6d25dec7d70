// Many files in one run: several at a time, as far as threads and memory go.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace whittle {

struct ManyFiles {
  std::vector<std::string> files;
  int threads = 0;             ///< of all together; 0: all
  bool one_at_a_time = false;  ///< a device serves one
  bool quiet = false;
};

/// Calls draw(i, threads) once for each file, from several threads, and returns the exit code of
/// all together: the largest of what draw() returns. What a file has to say stays together and
/// comes in the order of the files; a last line names those that have errors.
///
/// Small files are drawn side by side on a thread each; a file that makes up a large share of all
/// bytes gets the same share of the threads. A file waits while what is in memory and what it is
/// expected to take are more than half of what may be taken. Where memory runs out all the same,
/// the file is drawn again, alone (docs/decisions/0049-many-files-and-questions.md).
int draw_all(const ManyFiles& many, const std::function<int(size_t file, int threads)>& draw);

}  // namespace whittle

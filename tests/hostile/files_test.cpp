// Small bad files, each with what the program says about it: files/expected.txt.
//
// A file that is refused leaves nothing behind; one that is not gets its picture, and warnings.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/hostile.h"
#include "support/program.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

struct Expected {
  std::string file;
  int exit_code = -1;
  std::string err;  ///< all of standard error
};

/// Lines "NAME CODE", each followed by the lines of standard error, indented by four blanks.
std::vector<Expected> read_expected() {
  std::vector<Expected> all;
  std::ifstream list(WHITTLE_HOSTILE_FILES "/expected.txt", std::ios::binary);
  for (std::string line; std::getline(list, line);) {
    if (line.starts_with("    ")) {
      all.back().err += line.substr(4) + "\n";
    } else if (!line.empty() && !line.starts_with("#")) {
      std::istringstream words(line);
      Expected& one = all.emplace_back();
      words >> one.file >> one.exit_code;
    }
  }
  return all;
}

class BadFiles : public ProgramTest {};

TEST_F(BadFiles, AreAnsweredAsTheListSays) {
  for (const Expected& expected : read_expected()) {
    SCOPED_TRACE(expected.file);
    fs::copy_file(fs::path(WHITTLE_HOSTILE_FILES) / expected.file, path(expected.file));
    const Ended done = run({expected.file, "-o", "x.png", "--imgsize", "16,16"});
    EXPECT_EQ(done.exit_code, expected.exit_code) << "signal " << done.signal;
    EXPECT_EQ(done.err, expected.err);
    expect_little_memory(done);
    std::vector<std::string> left{expected.file};
    // What is not all of the model is shown, and is no success.
    const bool is_drawn =
        done.exit_code == 0 || done.err.find("(--lenient accepts that)") != std::string::npos;
    if (is_drawn) left.emplace_back("x.png");
    EXPECT_EQ(files(), left);
    for (const std::string& file : left) fs::remove(path(file));
  }
}

TEST_F(BadFiles, AreAllInTheList) {
  std::vector<std::string> listed, there;
  size_t refused = 0;
  for (const Expected& expected : read_expected()) {
    listed.push_back(expected.file);
    refused += expected.exit_code == 1;
  }
  for (const auto& entry : fs::directory_iterator(WHITTLE_HOSTILE_FILES)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".csg")) there.push_back(name);
  }
  std::ranges::sort(there);
  EXPECT_EQ(listed, there);
  EXPECT_GE(refused, 60u);
}

}  // namespace
}  // namespace whittle

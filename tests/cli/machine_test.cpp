// What the machine refuses, exit code 3; and that nothing is ever left half done.
#include <csignal>
#include <filesystem>

#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

class Machine : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg", "difference() { cube(20, center = true); sphere(12); }\n");
  }

  void expect_refused(const Ended& done, const std::string& message) {
    EXPECT_EQ(done.exit_code, 3);
    EXPECT_EQ(done.signal, 0);
    EXPECT_EQ(done.err, "whittle: " + message + "\n");
  }
};

TEST_F(Machine, FoldersThatCannotBeWrittenToAreFoundBeforeTheWork) {
  // The model is broken, too; that is not said, as it is not read.
  write("bad.csg", "cube(;");
  expect_refused(run({"bad.csg", "-o", "absent/x.png"}),
                 "cannot write 'absent/x.png': No such file or directory");
  expect_refused(run({"bad.csg", "-o", "part.csg/x.exr"}),
                 "cannot write 'part.csg/x.exr': Not a directory");
  std::filesystem::create_directory(path("folder.png"));
  expect_refused(run({"bad.csg", "-o", "folder.png"}), "cannot write 'folder.png': Is a directory");
  EXPECT_EQ(files(), (std::vector<std::string>{"bad.csg", "folder.png", "part.csg"}));
}

TEST_F(Machine, AFullDiskIsSaidAndLeavesTheOldFile) {
  write("x.png", "old");
  write("x.exr", "old");
  const RunSettings small{.file_limit = 2000};
  expect_refused(run({"part.csg", "-o", "x.png"}, small), "cannot write 'x.png': File too large");
  expect_refused(run({"model", "cheese", "-o", "x.csg"}, small),
                 "cannot write 'x.csg': File too large");
  EXPECT_EQ(run({"part.csg", "-o", "x.exr"}, small).exit_code, 3);
  EXPECT_EQ(read("x.png"), "old");
  EXPECT_EQ(read("x.exr"), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"part.csg", "x.exr", "x.png"}));
  expect_refused(run({"part.csg", "-o", "/dev/full", "--export-format", "png"}),
                 "cannot write '/dev/full': No space left on device");
}

TEST_F(Machine, StandardOutputThatTakesNothingIsSaid) {
  const std::vector<std::vector<std::string>> all = {
      {"part.csg", "-o", "-", "--export-format", "png"},
      {"part.csg", "-o", "-", "--export-format", "exr"},
      {"model", "r9"},
      {"model", "--list"},
      {"info", "part.csg"},
      {"info", "part.csg", "--json"},
      {"bench", "part.csg", "--repeat", "1", "--imgsize", "16,16"},
      {"--help"},
      {"--version"}};
  for (const std::vector<std::string>& arguments : all) {
    SCOPED_TRACE(arguments[0]);
    expect_refused(run(arguments, {.out = StandardOutput::kDevFull}),
                   "cannot write 'standard output': No space left on device");
    expect_refused(run(arguments, {.out = StandardOutput::kClosedPipe}),
                   "cannot write 'standard output': Broken pipe");
    expect_refused(run(arguments, {.out = StandardOutput::kClosed}),
                   "cannot write 'standard output': Bad file descriptor");
  }
}

TEST_F(Machine, AClosedStandardOutputIsNoMatterWhereItIsNotUsed) {
  const Ended done =
      run({"part.csg", "-o", "x.png", "--imgsize", "16,16"}, {.out = StandardOutput::kClosed});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(bool(read_png(path("x.png"))));
}

TEST_F(Machine, RunningOutOfMemoryIsSaidWithTheLimitThatEndedIt) {
  constexpr uint64_t kOneGiB = uint64_t(1) << 30;
  const std::vector<std::string> large{"part.csg", "-o", "x.png", "--imgsize", "16384,16384"};
  expect_refused(run(large, {.memory_limit = kOneGiB}),
                 "out of memory: the limit of the shell (ulimit -v) is 1.0 GiB");
  std::vector<std::string> limited = large;
  limited.insert(limited.end(), {"--limit", "memory=200M"});
  expect_refused(run(limited),
                 "out of memory: the limit is 200.0 MiB; --limit memory=SIZE raises it");
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
}

TEST_F(Machine, RunningOutOfMemoryIsSaidWhereNoThreadCanStart) {
  // Those that can start take what memory there is for their stacks.
  const Ended done = run({"part.csg", "-o", "x.png", "--threads", "1000", "--limit", "memory=64M"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_EQ(done.err.substr(0, 9), "whittle: ") << done.err;
  EXPECT_EQ(done.err.find('\n'), done.err.size() - 1) << done.err;
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
}

TEST_F(Machine, AnInterruptedRunLeavesTheWholePictureOrNone) {
  write("x.png", "old");
  const std::vector<std::string> arguments{"part.csg",  "-o",      "x.png",     "--aa", "8",
                                           "--imgsize", "300,300", "--threads", "2"};
  size_t interrupted = 0;
  for (int step = 0; step < 24; ++step) {
    constexpr int kStepMicroseconds = 4000;
    const int signal = step % 3 == 0 ? SIGINT : step % 3 == 1 ? SIGTERM : SIGHUP;
    const Ended done = run_and_signal(arguments, signal, 2000 + step * kStepMicroseconds);
    if (done.exit_code != 0) {
      ++interrupted;
      EXPECT_EQ(done.signal, signal) << "it ends as by the signal, for who asked for that to see";
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"part.csg", "x.png"}));
    if (read("x.png") != "old") {
      EXPECT_TRUE(bool(read_png(path("x.png"))));
    }
  }
  EXPECT_GT(interrupted, 0u);
}

TEST_F(Machine, ALinkIsFollowedAndAPipeWrittenStraight) {
  write("target.png", "old");
  std::filesystem::create_symlink("target.png", path("link.png"));
  EXPECT_EQ(run({"part.csg", "-o", "link.png", "--imgsize", "16,16"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.png")));
  EXPECT_TRUE(bool(read_png(path("target.png"))));
  EXPECT_EQ(run({"part.csg", "-o", "/dev/null", "--export-format", "exr", "--imgsize", "16,16"})
                .exit_code,
            0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(Machine, NoProgressIsShownWhereNobodyLooks) {
  const Ended done =
      run({"part.csg", "-o", "x.png", "--backend", "oracle", "--imgsize", "256,256"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
}

}  // namespace
}  // namespace whittle

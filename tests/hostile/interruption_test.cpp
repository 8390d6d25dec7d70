// A run that is interrupted, at whatever stage, ends by the signal and leaves what was there.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "image/exr.h"
#include "support/hostile.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

class Interruption : public ProgramTest {
 protected:
  void SetUp() override { write("x.png", "old"); }

  /// Long enough for the program to have come to a stage that takes far longer.
  static void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(400)); }

  void expect_ended(const Ended& done, int signal, const std::string& input) {
    EXPECT_EQ(done.signal, signal) << "exit code " << done.exit_code;
    EXPECT_EQ(read("x.png"), "old");
    EXPECT_EQ(files(), (std::vector<std::string>{input, "x.png"}));
  }
};

TEST_F(Interruption, WhileReading) {
  ASSERT_EQ(::mkfifo(path("pipe.csg").c_str(), 0600), 0);
  for (const int signal : kSignals) {
    int writer = -1;
    const Ended done = run_and_signal({"pipe.csg", "-o", "x.png"}, signal, [&] {
      // Returns when the program has opened the other end; it then waits for more.
      writer = ::open(path("pipe.csg").c_str(), O_WRONLY);
      EXPECT_EQ(::write(writer, "cube(", 5), 5);
    });
    ::close(writer);
    expect_ended(done, signal, "pipe.csg");
  }
}

/// True if the process runs; one that has ended may still be listed, until it is asked for.
bool runs(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const size_t name_end = text.rfind(") ");
  return name_end != std::string::npos && text[name_end + 2] != 'Z';
}

class InterruptionOfOpenscad : public Interruption {
 protected:
  void SetUp() override {
    Interruption::SetUp();
    write("part.scad", "");
    path_before_ = std::getenv("PATH");
    fs::create_directory(path("bin"));
    fs::create_directory(path("tmp"));
    ::setenv("TMPDIR", path("tmp").c_str(), 1);
    ::setenv("PATH", (path("bin") + ":" + path_before_).c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("TMPDIR");
    ::setenv("PATH", path_before_.c_str(), 1);
  }

  /// Puts a shell script in the place of openscad, which writes ids of processes to a file.
  void install_openscad(const std::string& script) const {
    write("bin/openscad", "#!/bin/sh\nids=" + path("ids") + "\n" + script);
    fs::permissions(path("bin/openscad"), fs::perms::owner_all);
  }

  /// Runs on a program until there are that many ids, then ends the run; the processes.
  std::vector<pid_t> run_until_ids(size_t count, int signal,
                                   const std::vector<std::string>& more = {}) {
    fs::remove(path("ids"));
    std::vector<pid_t> ids;
    std::vector<std::string> command{"part.scad", "-o", "x.png"};
    command.insert(command.end(), more.begin(), more.end());
    const Ended done = run_and_signal(command, signal, [&] {
      while (ids.size() < count) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ids.clear();
        std::ifstream file(path("ids"));
        for (pid_t id = 0; file >> id;) ids.push_back(id);
      }
    });
    EXPECT_EQ(done.signal, signal) << "exit code " << done.exit_code;
    EXPECT_EQ(read("x.png"), "old");
    return ids;
  }

  /// They are not there, or soon are not: nobody waits for what a killed process leaves behind.
  static void expect_gone(const std::vector<pid_t>& processes) {
    constexpr int kMostTries = 10'000;
    for (const pid_t process : processes) {
      for (int i = 0; i < kMostTries && runs(process); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      EXPECT_FALSE(runs(process)) << process;
      if (runs(process)) ::kill(process, SIGKILL);
    }
  }

  std::string path_before_;
};

TEST_F(InterruptionOfOpenscad, EndsItAndAllThatItHasStarted) {
  install_openscad("sleep 1000 &\necho $! $$ >$ids\nwait\n");
  for (const int signal : kSignals) {
    expect_gone(run_until_ids(2, signal));
    EXPECT_TRUE(fs::is_empty(path("tmp")));
  }
}

TEST_F(InterruptionOfOpenscad, EndsAllThatEvaluateFrames) {
  install_openscad("echo $$ >>$ids\nexec sleep 1000\n");
  const size_t at_a_time = std::clamp<size_t>(std::thread::hardware_concurrency(), 1, 8);
  for (const int signal : {SIGINT, SIGTERM}) {
    expect_gone(run_until_ids(at_a_time, signal, {"--animate", "20"}));
    EXPECT_TRUE(fs::is_empty(path("tmp")));
  }
}

TEST_F(InterruptionOfOpenscad, EndsOneThatDoesNotListen) {
  install_openscad("trap '' INT TERM HUP\necho $$ >$ids\nwhile :; do sleep 1; done\n");
  for (const int signal : kSignals) {
    expect_gone(run_until_ids(1, signal));
    EXPECT_TRUE(fs::is_empty(path("tmp")));
  }
}

TEST_F(InterruptionOfOpenscad, EndsItWhereTheProgramIsKilledOutright) {
  install_openscad("echo $$ >$ids\nexec sleep 1000\n");
  expect_gone(run_until_ids(1, SIGKILL));
}

TEST_F(Interruption, WhileSubdividing) {
  // Read at once; thousands of rough curved surfaces through one point are not soon parted.
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    text += "rotate([" + std::to_string(i * 7.1) + "," + std::to_string(i * 31.3) +
            ",0])cylinder(h=10,r=" + std::to_string(1 + i * 1e-5) + ",center=true);";
  }
  write("bundle.csg", text);
  for (const int signal : kSignals) {
    expect_ended(
        run_and_signal({"bundle.csg", "-o", "x.png", "--leaf-size", "1"}, signal, wait_a_little),
        signal, "bundle.csg");
  }
}

TEST_F(Interruption, WhileTracing) {
  // The oracle has no other stage, and every ray meets every sphere.
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    text += "translate([" + std::to_string(i * 7 % 100) + "," + std::to_string(i * 31 % 100) +
            ",0])sphere(3);";
  }
  write("spheres.csg", text);
  for (const int signal : kSignals) {
    expect_ended(run_and_signal({"spheres.csg", "-o", "x.png", "--backend", "oracle", "--imgsize",
                                 "2000,2000"},
                                signal, wait_a_little),
                 signal, "spheres.csg");
  }
}

TEST_F(Interruption, WhileWriting) {
  write("part.csg", "cube(1);\n");
  write("x.exr", "old");
  // Before the work such a file is there too, for a moment and empty: to see whether it can be.
  const auto is_there = [&](bool has_bytes) {
    for (const std::string& file : files()) {
      std::error_code gone;
      if (file.starts_with(".whittle-") &&
          (!has_bytes || (fs::file_size(path(file), gone) > 0 && !gone))) {
        return true;
      }
    }
    return false;
  };
  const std::string old = read("x.exr");
  const auto is_done = [&] { return fs::file_size(path("x.exr")) != old.size(); };
  // A signal may come too late; then the whole new picture is there. Some must not.
  constexpr int kMostTries = 60, kEnough = 3;
  int before = 0, within = 0;
  for (int i = 0; i < kMostTries && within < kEnough; ++i) {
    const int signal = kSignals[i % 3];
    const bool has_bytes = i >= 3;
    const Ended done = run_and_signal(
        {"part.csg", "-o", "x.exr", "--imgsize", "1500,1500", "--aa", "1"}, signal, [&] {
          while (!is_there(has_bytes) && !is_done()) {
            std::this_thread::sleep_for(std::chrono::microseconds(100));
          }
        });
    EXPECT_TRUE(done.signal == signal || done.exit_code == 0) << done.signal;
    (has_bytes ? within : before) += done.signal == signal;
    EXPECT_EQ(files(), (std::vector<std::string>{"part.csg", "x.exr", "x.png"}));
    if (!is_done()) continue;
    EXPECT_TRUE(bool(read_exr(path("x.exr"))));
    write("x.exr", old);
  }
  EXPECT_GT(before, 0);
  EXPECT_EQ(within, kEnough);
}

}  // namespace
}  // namespace whittle

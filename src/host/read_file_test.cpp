#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/folder_for_test.h"
#include "csg/test_support.h"
#include "host/output_file.h"
#include "host/read_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

class ReadFileTest : public testing::Test {
 protected:
  void SetUp() override {
    path_before_ = std::getenv("PATH");
    // What is flattened leaves its traces, if any, in here.
    fs::create_directory(folder_ / "tmp");
    ::setenv("TMPDIR", (folder_ / "tmp").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("TMPDIR");
    ::setenv("PATH", path_before_.c_str(), 1);
  }

  std::string write(const char* name, std::string_view text) const {
    const std::string path = (folder_ / name).string();
    EXPECT_TRUE(write_file(path, text));
    return path;
  }
  /// Puts a shell script in the place of openscad. It is called as `openscad -o OUT IN`.
  void install_openscad(const std::string& script) const {
    fs::create_directory(folder_ / "bin");
    const std::string path = write("bin/openscad", "#!/bin/sh\n" + script);
    ASSERT_EQ(::chmod(path.c_str(), 0755), 0);
    ::setenv("PATH", ((folder_ / "bin").string() + ":/usr/bin:/bin").c_str(), 1);
  }
  static Error error_of(const std::string& path) {
    const Result<Read> read = read_file(path);
    return read ? Error{ErrorKind::kInput, "no error"} : read.error();
  }

  const TestFolder own_folder_;
  const fs::path& folder_ = own_folder_.path();
  std::string path_before_;
};

TEST_F(ReadFileTest, ReadsAFileAndCallsItByItsName) {
  const std::string path = write("a.csg", "cube();\nroof() square();");
  const Result<Read> read = read_file(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(tree(read->model), "U(c1 U())");
  EXPECT_EQ(read->model.file, path);
  ASSERT_EQ(read->warnings.size(), 1u);
  EXPECT_TRUE(read->warnings[0].starts_with(path + ":2:1: warning: "));
}

TEST_F(ReadFileTest, ReadsStandardInput) {
  const std::string path = write("a.csg", "cube(");
  const int before = ::dup(STDIN_FILENO);
  const int file = ::open(path.c_str(), O_RDONLY);
  ::dup2(file, STDIN_FILENO);
  const Error error = error_of("-");
  ::dup2(before, STDIN_FILENO);
  ::close(before);
  ::close(file);
  EXPECT_EQ(error.message, "<stdin>:1:6: error: expected a value before the end of the file");
}

TEST_F(ReadFileTest, WhatCannotBeReadIsSaid) {
  const std::string missing = (folder_ / "none.csg").string();
  EXPECT_EQ(error_of(missing).message,
            missing + ": error: cannot be read: No such file or directory");
  EXPECT_EQ(error_of(missing).kind, ErrorKind::kInput);
  EXPECT_EQ(error_of(folder_.string()).message,
            folder_.string() + ": error: cannot be read: Is a directory");
}

TEST_F(ReadFileTest, AScadFileIsFlattened) {
  install_openscad("echo 'WARNING: odd' >&2\ncp \"$3\" \"$2\"\n");
  const std::string path = write("it's $(a) file.scad", "cube();\nroof() sphere();");
  const Result<Read> read = read_file(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(tree(read->model), "U(c1 U())");
  EXPECT_EQ(read->model.file, path);
  ASSERT_EQ(read->warnings.size(), 2u);
  EXPECT_EQ(read->warnings[0], path + ": openscad: WARNING: odd");
  EXPECT_TRUE(read->warnings[1].starts_with(path + ": warning: in \"roof()\": "))
      << read->warnings[1];
  ASSERT_TRUE(read->unsupported);
  EXPECT_TRUE(read->refusal.starts_with(path + ": error: in \"roof()\": ")) << read->refusal;
  EXPECT_TRUE(fs::is_empty(folder_ / "tmp"));
}

TEST_F(ReadFileTest, OpenscadIsGivenAbsolutePaths) {
  install_openscad("case $2$3 in /*/model.csg/*) echo 'cube();' > \"$2\";; *) exit 9;; esac\n");
  write("a.scad", "");
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const Result<Read> read = read_file("a.scad");
  fs::current_path(before);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(tree(read->model), "U(c1)");
}

TEST_F(ReadFileTest, WhatOpenscadSaysIsPassedOn) {
  install_openscad("echo 'WARNING: odd' >&2\necho \"Can't parse\" >&2\nexit 1\n");
  const std::string path = write("a.scad", "cube(");
  const Error error = error_of(path);
  EXPECT_EQ(error.kind, ErrorKind::kInput);
  EXPECT_EQ(error.message,
            path + ": error: openscad cannot evaluate it: WARNING: odd; Can't parse");
  EXPECT_TRUE(fs::is_empty(folder_ / "tmp"));
}

TEST_F(ReadFileTest, TheFirstErrorOfOpenscadIsOneWithItsPlace) {
  const std::string path = write("a.scad", std::string(20, '\n'));
  const std::string folder = path.substr(0, path.rfind('/') + 1);
  const auto error_where_openscad_says = [&](const std::string& lines, int exit_code) {
    install_openscad("cat >&2 <<'END'\n" + lines + "\nEND\necho 'cube();' > \"$2\"\nexit " +
                     std::to_string(exit_code) + "\n");
    const Error error = error_of(path);
    EXPECT_EQ(error.kind, ErrorKind::kInput);
    return error.message;
  };
  const std::string traced =
      "WARNING: odd\nERROR: Assertion '(1 > 2)' failed: \"no\" in file a.scad, line 12\n"
      "TRACE: called by 'm' in file a.scad, line 3\nERROR: more";
  const std::string expected = path + ":12: error: openscad: Assertion '(1 > 2)' failed: \"no\"";
  EXPECT_EQ(error_where_openscad_says(traced, 0), expected);
  EXPECT_EQ(error_where_openscad_says(traced, 1), expected);
  // Where the file ends too early, openscad speaks of what it has appended.
  EXPECT_EQ(error_where_openscad_says("ERROR: x in file a.scad, line 22", 0),
            path + ":20: error: openscad: x");
  EXPECT_EQ(error_where_openscad_says("ERROR: x in file lib/b, line 1.scad, line 2", 0),
            folder + "lib/b, line 1.scad:2: error: openscad: x");
  EXPECT_EQ(error_where_openscad_says("ERROR: x in file /b.scad, line 2", 0),
            "/b.scad:2: error: openscad: x");
  EXPECT_EQ(error_where_openscad_says("ERROR: x in file , line 2", 0),
            path + ":2: error: openscad: x");
  EXPECT_EQ(error_where_openscad_says("ERROR: x in file a.scad, line two", 0),
            path + ": error: openscad: x in file a.scad, line two");
  EXPECT_EQ(error_where_openscad_says("ERROR: x, line 2 in file a.scad", 0),
            path + ": error: openscad: x, line 2 in file a.scad");
  install_openscad("echo 'ECHO: \"ERROR: x\"' >&2\necho 'cube();' > \"$2\"\n");
  EXPECT_TRUE(bool(read_file(path)));
}

TEST_F(ReadFileTest, WhatAFailedOpenscadLeavesIsNotRead) {
  install_openscad("echo 'cube();' > \"$2\"\nexit 1\n");
  const std::string path = write("a.scad", "cube();");
  EXPECT_EQ(error_of(path).message, path + ": error: openscad cannot evaluate it");
}

TEST_F(ReadFileTest, OpenscadThatWritesNothingIsAnError) {
  install_openscad("exit 0\n");
  const std::string path = write("a.scad", "cube();");
  EXPECT_EQ(error_of(path).message, path + ": error: openscad cannot evaluate it");
}

TEST_F(ReadFileTest, WithoutOpenscadItSaysWhatToInstall) {
  ::setenv("PATH", folder_.c_str(), 1);
  const Error error = error_of(write("a.scad", "cube();"));
  EXPECT_EQ(error.kind, ErrorKind::kMachine);
  EXPECT_NE(error.message.find("apt-get install openscad"), std::string::npos) << error.message;
}

TEST_F(ReadFileTest, AMissingScadFileIsMissing) {
  install_openscad("exit 0\n");
  const std::string missing = (folder_ / "none.scad").string();
  EXPECT_EQ(error_of(missing).message,
            missing + ": error: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace whittle

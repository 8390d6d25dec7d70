// Things that are no file, or not the whole of one.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <thread>

#include "image/png.h"
#include "support/hostile.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

class OddFiles : public ProgramTest {
 protected:
  /// Runs on that file, which must be refused with that message and exit code 1.
  void expect_unreadable(const std::string& file, const std::string& message,
                         const RunSettings& settings = {}) {
    SCOPED_TRACE(file);
    const std::vector<std::string> before = files();
    expect_refused(run({file, "-o", "x.png"}, settings), 1, message);
    EXPECT_EQ(files(), before);
  }
};

TEST_F(OddFiles, ThatCannotBeReadAreRefusedWithTheReason) {
  expect_unreadable("absent.csg", "absent.csg: error: cannot be read: No such file or directory");
  expect_unreadable("absent/x.csg",
                    "absent/x.csg: error: cannot be read: No such file or directory");
  fs::create_directory(path("folder.csg"));
  expect_unreadable("folder.csg", "folder.csg: error: cannot be read: Is a directory");
  expect_unreadable(".", ".: error: cannot be read: Is a directory");
  fs::create_directory(path("folder.scad"));
  expect_unreadable("folder.scad", "folder.scad: error: cannot be read: Is a directory");
  write("part.csg", "cube(1);\n");
  expect_unreadable("part.csg/x.csg", "part.csg/x.csg: error: cannot be read: Not a directory");
  fs::create_symlink("two.csg", path("one.csg"));
  fs::create_symlink("one.csg", path("two.csg"));
  expect_unreadable("one.csg", "one.csg: error: cannot be read: Too many levels of symbolic links");
  const std::string long_name(300, 'x');
  expect_unreadable(long_name, long_name + ": error: cannot be read: File name too long");
}

TEST_F(OddFiles, WithoutPermissionAreRefused) {
  for (const std::string file : {"secret.csg", "secret.scad"}) {
    write(file, "cube(1);\n");
    fs::permissions(path(file), fs::perms::none);
    expect_unreadable(file, file + ": error: cannot be read: Permission denied",
                      {.obeys_permissions = true});
  }
}

TEST_F(OddFiles, AFolderWithoutPermissionIsNotWrittenTo) {
  write("part.csg", "cube(1);\n");
  fs::create_directory(path("closed"));
  fs::permissions(path("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  expect_refused(run({"part.csg", "-o", "closed/x.png"}, {.obeys_permissions = true}), 3,
                 "whittle: cannot write 'closed/x.png': Permission denied");
  EXPECT_TRUE(fs::is_empty(path("closed")));
  fs::permissions(path("closed"), fs::perms::owner_all);
}

TEST_F(OddFiles, AReadOnlyPictureIsNotReplaced) {
  write("part.csg", "cube(1);\n");
  write("x.png", "old");
  fs::permissions(path("x.png"), fs::perms::owner_read);
  expect_refused(run({"part.csg", "-o", "x.png"}, {.obeys_permissions = true}), 3,
                 "whittle: cannot write 'x.png': Permission denied");
  EXPECT_EQ(read("x.png"), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"part.csg", "x.png"}));
}

TEST_F(OddFiles, StandardInputMayBeEmptyOrBad) {
  const Ended empty = run({"-", "-o", "x.png", "--imgsize", "8,8"});
  EXPECT_EQ(empty.exit_code, 0);
  EXPECT_EQ(empty.err, "<stdin>: warning: the solid is empty\n");
  fs::remove(path("x.png"));
  expect_refused(run({"-", "-o", "x.png"}, {.in = "cube("}), 1,
                 "<stdin>:1:6: error: expected a value before the end of the file");
  EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(OddFiles, APipeIsReadToItsEnd) {
  ASSERT_EQ(::mkfifo(path("pipe.csg").c_str(), 0600), 0);
  std::jthread writer([name = path("pipe.csg")] {
    std::ofstream pipe(name);
    for (int i = 0; i < 100'000; ++i) pipe << "// a comment\n";
    pipe << "cube(;\n";
  });
  expect_unreadable("pipe.csg", "pipe.csg:100001:6: error: expected a value before ';'");
}

TEST_F(OddFiles, AFileCutOffAnywhereIsReadOrRefusedWithAPlace) {
  std::ifstream file(WHITTLE_EXAMPLES "/rook.csg", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(whole.size(), 2000u);
  // "", or lines with a place each: warnings, and at last an error.
  const std::regex answer(
      "(cut\\.csg(:\\d+:\\d+)?: warning: [^\\n]+\\n)*"
      "(cut\\.csg:\\d+:\\d+: error: [^\\n]+\\n)?");
  size_t refused = 0;
  constexpr size_t kStep = 37;
  for (size_t size = 0; size < whole.size(); size += kStep) {
    write("cut.csg", whole.substr(0, size));
    const Ended done = run({"cut.csg", "-o", "x.png", "--imgsize", "8,8", "--aa", "1"});
    SCOPED_TRACE(size);
    EXPECT_TRUE(done.exit_code == 0 || done.exit_code == 1) << "signal " << done.signal;
    EXPECT_TRUE(std::regex_match(done.err, answer)) << done.err;
    EXPECT_EQ(done.err.find("error: ") != std::string::npos, done.exit_code == 1) << done.err;
    EXPECT_EQ(fs::remove(path("x.png")), done.exit_code == 0);
    EXPECT_EQ(files(), std::vector<std::string>{"cut.csg"});
    refused += done.exit_code == 1;
  }
  EXPECT_GT(refused, 20u);
}

TEST_F(OddFiles, ProgramsThatIncludeThemselvesEnd) {
  write("self.scad", "include <self.scad>\ncube(1);\n");
  const Ended self = run({"self.scad", "-o", "x.png", "--imgsize", "8,8"});
  EXPECT_EQ(self.exit_code, 0) << self.err;
  EXPECT_NE(self.err.find("self.scad: openscad: WARNING: Can't open include file 'self.scad'"),
            std::string::npos)
      << self.err;
  write("one.scad", "use <two.scad>\ncube(1);\n");
  write("two.scad", "use <one.scad>\ncube(1);\n");
  const Ended circle = run({"one.scad", "-o", "x.png", "--imgsize", "8,8"});
  EXPECT_EQ(circle.exit_code, 0) << circle.err;
}

TEST_F(OddFiles, ProgramsInWhichOpenscadFindsAnErrorAreRefused) {
  write("x.png", "old");
  const auto expect_error = [&](const std::string& text, const std::string& place,
                                const std::string& message) {
    write("part.scad", text);
    expect_unreadable("part.scad", place + ": error: openscad: " + message);
    EXPECT_EQ(read("x.png"), "old");
  };
  expect_error("cube(1);\nassert(false, \"no way\");", "part.scad:2",
               "Assertion 'false' failed: \"no way\"");
  expect_error("module a() { a(); }\na();\ncube(1);", "part.scad:1",
               "Recursion detected calling module 'a'");
  expect_error("module m(n) m(n + 1);\nm(0);\n", "part.scad:1",
               "Recursion detected calling module 'm'");
  expect_error("function f(x) = f(x + 1);\ncube(f(1));", "part.scad:1",
               "Recursion detected calling function 'f'");
  expect_error("cube(1);\ncube(;", "part.scad:2", "Parser error: syntax error");
  fs::create_directory(path("lib"));
  write("lib/check.scad", "\n\nassert(1 > 2);");
  expect_error("include <lib/check.scad>\ncube(1);", "lib/check.scad:3",
               "Assertion '(1 > 2)' failed");
}

}  // namespace
}  // namespace whittle

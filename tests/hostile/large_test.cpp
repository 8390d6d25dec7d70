// Files of up to a hundred megabytes of one thing. Made here, as nobody wants them in a repository.
#include <filesystem>
#include <fstream>

#include "support/hostile.h"

namespace whittle {
namespace {

constexpr size_t kLarge = 100'000'000, kFairlyLarge = 25'000'000;

/// A file is `head`, then `part` again and again, then `tail`.
struct Large {
  const char* name;
  std::string head, part, tail;
  int exit_code;
  std::string err;              ///< without the name of the file
  size_t bytes = kFairlyLarge;  ///< of all parts together
};

const Large kFiles[] = {
    {"parentheses", "", "(", "", 1, ":1:1: error: expected a statement before '('\n"},
    {"parentheses in a cube", "cube(", "(", "", 1,
     ":1:6: error: expected a value before '(' (values must be constants here; only a .scad file "
     "may have expressions)\n",
     kLarge},
    {"brackets", "cube(", "[", "", 1,
     ":1:10000006: error: the statement has more values than the limit of 10000000; --limit "
     "values=N raises it\n",
     kLarge},
    {"braces that open", "", "{", "", 1,
     ":1:1000001: error: statements are nested deeper than the limit of 1000000; --limit depth=N "
     "raises it\n"},
    {"braces that close", "", "}", "", 1, ":1:1: error: no '{' is open for this '}'\n"},
    {"ten million levels with braces", "", "group(){", "", 1,
     ":1:8000008: error: statements are nested deeper than the limit of 1000000; --limit depth=N "
     "raises it\n",
     kLarge},
    {"three million levels without", "", "union() ", "cube(1);", 1,
     ":1:8000009: error: statements are nested deeper than the limit of 1000000; --limit depth=N "
     "raises it\n"},
    {"one string", "text(\"", "a", "\");", 1,
     ":1:1: error: flat shapes, hulls and sums up to this one are computed from 20000000000 "
     "corners, "
     "more "
     "than the limit of 63000000; --limit facets=N raises it\n",
     kLarge},
    {"one string without an end", "text(\"", "a", "", 1,
     ":1:6: error: the string is not closed: expected '\"' before the end of the file\n"},
    {"escaped quotes", "text(\"", "\\\"", "", 1,
     ":1:6: error: the string is not closed: expected '\"' before the end of the file\n"},
    {"digits", "cube(", "1", ");", 0,
     ":1:1: warning: cube: a size is not finite; the shape is empty\nFILE: warning: the solid is "
     "empty\n",
     kLarge},
    {"hexadecimal digits", "cube(0x", "f", ");", 0,
     ":1:1: warning: cube: a size is not finite; the shape is empty\nFILE: warning: the solid is "
     "empty\n"},
    {"digits behind the point", "sphere(.", "0", "1);", 0, ": warning: the solid is empty\n"},
    {"exponent", "sphere(1e-", "9", ");", 0, ": warning: the solid is empty\n"},
    {"signs", "cube(", "-", "1);", 0, ""},
    {"blanks", "", " ", "cube(1);", 0, "", kLarge},
    {"line ends", "", "\n", "cube(", 1,
     ":25000001:6: error: expected a value before the end of the file\n"},
    {"comment", "/*", "*", "", 1,
     ":1:1: error: the comment is not closed: expected '*/' before the end of the file\n", kLarge},
    {"comments", "", "//\n", "cube(1);", 0, ""},
    {"semicolons", "", ";", "cube(1);", 0, ""},
    {"modifiers", "", "%", "", 1,
     ":1:25000001: error: expected a statement before the end of the file\n"},
    {"one name", "", "x", "", 1,
     ":1:25000001: error: expected '(' after 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...' before "
     "the end of the file\n"},
    {"numbers", "cube([", "1,", "1]);", 1,
     ":1:20000005: error: the statement has more values than the limit of 10000000; --limit "
     "values=N raises it\n"},
    {"arguments", "cube(", "1,", "1);", 1,
     ":1:200006: error: the statement has more than 100000 arguments\n"},
    {"zero bytes", "", std::string(1, '\0'), "", 1,
     ":1:1: error: a NUL byte; this is not a text file\n"},
};

class LargeFiles : public ProgramTest {
 protected:
  void write_large(const Large& file) const {
    constexpr size_t kBlock = 1'000'000;
    std::string block;
    while (block.size() < kBlock) block += file.part;
    std::ofstream out(path("large.csg"), std::ios::binary);
    out << file.head;
    size_t left = file.bytes / file.part.size() * file.part.size();
    for (; left > block.size(); left -= block.size()) out << block;
    out << block.substr(0, left) << file.tail;
  }
};

TEST_F(LargeFiles, AreAnsweredInLittleMemory) {
  for (const Large& file : kFiles) {
    SCOPED_TRACE(file.name);
    write_large(file);
    const Ended done = run({"large.csg", "-o", "x.png", "--imgsize", "16,16"});
    EXPECT_EQ(done.exit_code, file.exit_code) << "signal " << done.signal;
    std::string expected = file.err.empty() ? "" : "large.csg" + file.err;
    if (const size_t at = expected.find("FILE"); at != std::string::npos) {
      expected.replace(at, 4, "large.csg");
    }
    EXPECT_EQ(done.err, expected);
    expect_little_memory(done);
    if (done.exit_code == 0) std::filesystem::remove(path("x.png"));
    EXPECT_EQ(files(), std::vector<std::string>{"large.csg"});
  }
}

TEST_F(LargeFiles, ManyNamesAreTooMany) {
  std::string text;
  for (int i = 0; i <= 1'000'000; ++i) text += "n" + std::to_string(i) + "=1;";
  write("names.csg", text);
  expect_refused(run({"names.csg", "-o", "x.png"}), 1,
                 "names.csg:1:9888891: error: the file has more than 1000000 names for values");
}

TEST_F(LargeFiles, WarningsAreSummedUp) {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += "a" + std::to_string(i) + "();cube(u);\n";
  write("warnings.csg", text);
  const Ended done = run({"info", "warnings.csg"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_LT(done.err.size(), 20'000u);
  EXPECT_NE(done.err.find("299980 more times: cube: the size is neither a number nor three; it is "
                          "read as 1\n"),
            std::string::npos);
  expect_little_memory(done);
}

// So many literals of so few half-spaces that the memory for cells would not suffice if each took
// what a half-space of its own does.
TEST_F(LargeFiles, NearlyAMillionLevelsOfOneBodyAreSplit) {
  constexpr size_t kLevels = 900'000;
  std::string deep;
  for (size_t i = 0; i < kLevels; ++i) deep += "difference(){cube(2);";
  write("deep.csg", deep + "cube(1);" + std::string(kLevels, '}'));
  const Ended done = run({"deep.csg", "-o", "x.png", "--imgsize", "16,16", "--stats"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.err.find("by half-spaces: 6: 8\n"), std::string::npos) << done.err;
  // Each of five million faces has a half-space of its own until the equal ones are found.
  expect_little_memory(done, 2'000'000'000);
}

TEST_F(LargeFiles, AnEndlessDeviceEnds) {
  expect_refused(run({"/dev/zero", "-o", "x.png"}), 1,
                 "/dev/zero:1:1: error: a NUL byte; this is not a text file");
  EXPECT_EQ(files(), std::vector<std::string>{});
}

}  // namespace
}  // namespace whittle

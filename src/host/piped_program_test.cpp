#include "host/piped_program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include "base/folder_for_test.h"
#include "host/file_text.h"
#include "host/input_file.h"

namespace whittle {
namespace {

class PipedPrograms : public testing::Test {
 protected:
  void SetUp() override { before_ = std::signal(SIGPIPE, SIG_IGN); }
  void TearDown() override { std::signal(SIGPIPE, before_); }

 private:
  void (*before_)(int) = SIG_DFL;
};

TEST_F(PipedPrograms, ReadWhatIsWritten) {
  const TestFolder folder;
  Result<PipedProgram> copy =
      PipedProgram::start("/bin/sh", {"sh", "-c", "cat > '" + (folder / "copy") + "'"});
  ASSERT_TRUE(copy);
  // More than a pipe holds.
  std::string text;
  for (int i = 0; i < 40000; ++i) text += "line " + std::to_string(i) + "\n";
  EXPECT_TRUE(copy->write(text.substr(0, 1000)));
  EXPECT_TRUE(copy->write(text.substr(1000)));
  EXPECT_TRUE(copy->end());
  const Result<std::string> copied = read_text(folder / "copy");
  ASSERT_TRUE(copied);
  EXPECT_EQ(*copied, text);
}

TEST_F(PipedPrograms, ThatFailSayWhy) {
  Result<PipedProgram> program =
      PipedProgram::start("/bin/sh", {"sh", "-c", "echo first; echo no such codec >&2; exit 3"});
  ASSERT_TRUE(program);
  const Status ended = program->end();
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().kind, ErrorKind::kMachine);
  EXPECT_EQ(ended.error().message, "sh failed: no such codec");
}

TEST_F(PipedPrograms, ThatStopReadingEndTheWriting) {
  Result<PipedProgram> program =
      PipedProgram::start("/bin/sh", {"sh", "-c", "echo enough >&2; exit 1"});
  ASSERT_TRUE(program);
  const std::string much(1 << 20, 'x');
  const Status written = program->write(much);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message, "sh failed: enough");
}

TEST_F(PipedPrograms, ThatCannotBeRunAreNamed) {
  Result<PipedProgram> program = PipedProgram::start("/nowhere/none", {"none"});
  ASSERT_TRUE(program);
  const Status ended = program->end();
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().message, "none cannot be run: No such file or directory");
}

}  // namespace
}  // namespace whittle

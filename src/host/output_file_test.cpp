#include "host/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "base/folder_for_test.h"
#include "host/input_file.h"
#include "host/pending_files.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }
  int files() const {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++count;
    return count;
  }
  static std::string content(const std::string& path) {
    Result<std::string> text = read_text(path);
    return text ? *text : text.error().message;
  }

  const TestFolder own_folder_;
  const fs::path& folder_ = own_folder_.path();
};

TEST_F(OutputFileTest, TheTargetAppearsWholeWithCommit) {
  Result<OutputFile> file = OutputFile::create(path("a"));
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->write("one "));
  EXPECT_TRUE(file->write("two"));
  EXPECT_FALSE(fs::exists(path("a")));
  EXPECT_TRUE(file->commit());
  EXPECT_EQ(content(path("a")), "one two");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, WithoutCommitTheOldFileStaysAndNothingElse) {
  ASSERT_TRUE(write_file(path("a"), "old"));
  {
    Result<OutputFile> file = OutputFile::create(path("a"));
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->write("new"));
    EXPECT_EQ(files(), 2);
  }
  EXPECT_EQ(content(path("a")), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, OthersMayWriteToItsPath) {
  Result<OutputFile> file = OutputFile::create(path("a"));
  ASSERT_TRUE(file);
  ASSERT_TRUE(write_file(file->path(), "by another"));
  EXPECT_TRUE(file->commit());
  EXPECT_EQ(content(path("a")), "by another");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, PermissionsAndLinksStay) {
  ASSERT_TRUE(write_file(path("a"), "old"));
  ASSERT_EQ(::chmod(path("a").c_str(), 0640), 0);
  fs::create_symlink("a", path("link"));
  ASSERT_TRUE(write_file(path("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("a")), "new");
  struct stat status {};
  ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST_F(OutputFileTest, WhereALinkLeadsToNothingTheFileIsMade) {
  ASSERT_TRUE(fs::create_directory(path("folder")));
  fs::create_symlink("folder/second", path("first"));
  fs::create_symlink("../a", path("folder/second"));
  ASSERT_TRUE(write_file(path("first"), "new"));
  EXPECT_TRUE(fs::is_symlink(path("first")));
  EXPECT_TRUE(fs::is_symlink(path("folder/second")));
  EXPECT_EQ(content(path("a")), "new");
  fs::create_symlink(path("b"), path("absolute"));
  ASSERT_TRUE(write_file(path("absolute"), "new"));
  EXPECT_EQ(content(path("b")), "new");
}

TEST_F(OutputFileTest, ALinkThatLeadsNowhereIsAnErrorAndStays) {
  fs::create_symlink("loop", path("loop"));
  fs::create_symlink("none/a", path("astray"));
  for (const char* link : {"loop", "astray"}) {
    const Status status = write_file(path(link), "x");
    ASSERT_FALSE(status) << link;
    EXPECT_EQ(status.error().kind, ErrorKind::kMachine);
    EXPECT_TRUE(fs::is_symlink(path(link)));
  }
  EXPECT_EQ(files(), 2);
}

TEST_F(OutputFileTest, ANewFileHasTheUsualPermissions) {
  const mode_t mask = ::umask(022);
  const Status written = write_file(path("a"), "");
  ::umask(mask);
  ASSERT_TRUE(written);
  struct stat status {};
  ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST_F(OutputFileTest, ErrorsGiveTheReason) {
  const auto message = [](const std::string& target) {
    const Status status = write_file(target, "x");
    if (status) return std::string("no error");
    EXPECT_EQ(status.error().kind, ErrorKind::kMachine);
    return status.error().message;
  };
  EXPECT_EQ(message(path("none/a")),
            "cannot write '" + path("none/a") + "': No such file or directory");
  EXPECT_EQ(message(folder_.string()), "cannot write '" + folder_.string() + "': Is a directory");
  EXPECT_EQ(message(path("new/")), "cannot write '" + path("new/") + "': Is a directory");
  EXPECT_EQ(message(""), "cannot write '': No such file or directory");
  EXPECT_EQ(message("/dev/full"), "cannot write '/dev/full': No space left on device");
  EXPECT_EQ(files(), 0);
}

TEST_F(OutputFileTest, WhatIsNoRegularFileIsWrittenStraight) {
  EXPECT_TRUE(write_file("/dev/null", "x"));
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST_F(OutputFileTest, AnOpenFileWithoutANameIsWrittenStraight) {
  ASSERT_TRUE(write_file(path("a"), "longer than what follows"));
  const int open_file = ::open(path("a").c_str(), O_RDWR);
  ASSERT_GE(open_file, 0);
  ASSERT_TRUE(fs::remove(path("a")));
  const std::string name = "/dev/fd/" + std::to_string(open_file);
  EXPECT_TRUE(write_file(name, "new"));
  EXPECT_EQ(content(name), "new");
  ::close(open_file);
  EXPECT_EQ(files(), 0);
}

TEST_F(OutputFileTest, AClosedPipeIsAnError) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  Result<OutputFile> file = OutputFile::create("/dev/fd/" + std::to_string(ends[1]));
  ASSERT_TRUE(file);
  ::close(ends[0]);
  ::close(ends[1]);
  auto* const before = std::signal(SIGPIPE, SIG_IGN);
  const Status status = file->write("x");
  std::signal(SIGPIPE, before);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("Broken pipe"), std::string::npos);
}

TEST_F(OutputFileTest, AnInterruptedRunLeavesNothing) {
  Result<OutputFile> unfinished = OutputFile::create(path("a"));
  ASSERT_TRUE(unfinished);
  ASSERT_TRUE(write_file(path("b"), "finished"));
  ASSERT_TRUE(fs::create_directory(path("folder")));
  const PendingFile folder(path("folder"));
  ASSERT_TRUE(write_file(path("folder/c"), ""));
  const PendingFile in_folder(path("folder/c"));
  EXPECT_EQ(files(), 3);
  remove_pending_files();
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(content(path("b")), "finished");
}

TEST_F(OutputFileTest, WhatIsNoLongerPendingIsNotRemoved) {
  ASSERT_TRUE(write_file(path("a"), ""));
  { const PendingFile pending(path("a")); }
  remove_pending_files();
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace whittle

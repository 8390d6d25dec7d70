#include "viewer/file_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>

#include "base/folder_for_test.h"

namespace whittle {
namespace {

using std::chrono::milliseconds;

void save(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

/// Counts what it is told.
class FileWatchTest : public testing::Test {
 protected:
  /// Whether so many changes were told, before some seconds have gone.
  bool comes_to(int count) {
    std::unique_lock lock(mutex_);
    return told_.wait_for(lock, std::chrono::seconds(20), [&] { return count_ >= count; });
  }
  int count_after_a_while() {
    std::this_thread::sleep_for(milliseconds(100));
    const std::lock_guard lock(mutex_);
    return count_;
  }
  static FileWatch::Time now() { return std::chrono::system_clock::now(); }

  const TestFolder folder_;
  const std::string file_ = folder_ / "part.csg";

 private:
  std::mutex mutex_;
  std::condition_variable told_;
  int count_ = 0;

 protected:
  FileWatch watch_{[this] {
    const std::lock_guard lock(mutex_);
    ++count_;
    told_.notify_all();
  }};
};

TEST_F(FileWatchTest, AFileOfTheFutureIsToldOnce) {
  save(file_, "cube(1);");
  std::filesystem::last_write_time(
      file_, std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
  watch_.watch({file_}, now());
  EXPECT_TRUE(comes_to(1));
  watch_.watch({file_}, now());
  EXPECT_EQ(count_after_a_while(), 1);
}

TEST_F(FileWatchTest, WritingInPlaceIsTold) {
  save(file_, "cube(1);");
  watch_.watch({file_}, now());
  EXPECT_EQ(count_after_a_while(), 0);
  save(file_, "cube(2);");
  EXPECT_TRUE(comes_to(1));
  save(file_, "cube(33);");
  EXPECT_TRUE(comes_to(2));
}

TEST_F(FileWatchTest, RenamingOverIsTold) {
  save(file_, "cube(1);");
  watch_.watch({file_}, now());
  save(folder_ / "part.csg~", "cube(2);");
  EXPECT_EQ(count_after_a_while(), 0);
  std::filesystem::rename(folder_ / "part.csg~", file_);
  EXPECT_TRUE(comes_to(1));
}

TEST_F(FileWatchTest, OtherFilesAreNotTold) {
  save(file_, "cube(1);");
  watch_.watch({file_}, now());
  save(folder_ / "other.csg", "cube(2);");
  EXPECT_EQ(count_after_a_while(), 0);
}

TEST_F(FileWatchTest, AFileThatGoesIsToldWhenItIsThereAgain) {
  save(file_, "cube(1);");
  watch_.watch({file_}, now());
  std::filesystem::remove(file_);
  EXPECT_EQ(count_after_a_while(), 0);
  save(file_, "cube(2);");
  EXPECT_TRUE(comes_to(1));
}

TEST_F(FileWatchTest, WhatALinkPointsAtIsWatched) {
  save(file_, "cube(1);");
  std::filesystem::create_directory(folder_ / "elsewhere");
  const std::string link = folder_ / "elsewhere/link.csg";
  std::filesystem::create_symlink(file_, link);
  watch_.watch({link}, now());
  save(file_, "cube(2);");
  EXPECT_TRUE(comes_to(1));
}

TEST_F(FileWatchTest, WhatWasWrittenMeanwhileIsTold) {
  const FileWatch::Time before = now() - milliseconds(50);
  save(file_, "cube(1);");
  watch_.watch({file_}, before);
  EXPECT_TRUE(comes_to(1));
  EXPECT_EQ(count_after_a_while(), 1);
}

TEST_F(FileWatchTest, OnlyTheLatestFilesAreWatched) {
  save(file_, "cube(1);");
  save(folder_ / "other.csg", "cube(1);");
  watch_.watch({file_}, now());
  watch_.watch({folder_ / "other.csg"}, now());
  save(file_, "cube(2);");
  EXPECT_EQ(count_after_a_while(), 0);
  save(folder_ / "other.csg", "cube(2);");
  EXPECT_TRUE(comes_to(1));
}

}  // namespace
}  // namespace whittle

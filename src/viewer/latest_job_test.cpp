#include "viewer/latest_job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>

namespace whittle {
namespace {

TEST(LatestJobTest, TellsTheResultOnce) {
  std::binary_semaphore done(0);
  LatestJob<int> job([&] { done.release(); });
  EXPECT_FALSE(job.is_busy());
  job.start([](const std::stop_token&) { return 42; });
  done.acquire();
  EXPECT_FALSE(job.is_busy());
  EXPECT_EQ(job.take(), 42);
  EXPECT_EQ(job.take(), std::nullopt);
}

TEST(LatestJobTest, ANewJobStopsTheOneThatRuns) {
  std::binary_semaphore started(0), done(0);
  std::atomic<int> notified = 0;
  LatestJob<int> job([&] {
    ++notified;
    done.release();
  });
  std::atomic<bool> was_stopped = false;
  job.start([&](const std::stop_token& stop) {
    started.release();
    while (!stop.stop_requested()) std::this_thread::yield();
    was_stopped = true;
    return 1;
  });
  started.acquire();
  EXPECT_TRUE(job.is_busy());
  job.start([](const std::stop_token&) { return 2; });
  done.acquire();
  EXPECT_TRUE(was_stopped);
  EXPECT_EQ(job.take(), 2);
  EXPECT_EQ(notified, 1);
}

TEST(LatestJobTest, OfManyOnlyTheLastOneCounts) {
  std::binary_semaphore done(0);
  std::atomic<int> result = 0;
  LatestJob<int>* jobs = nullptr;
  LatestJob<int> job([&] { done.release(); });
  jobs = &job;
  for (int i = 1; i <= 1000; ++i) job.start([i](const std::stop_token&) { return i; });
  while (result != 1000) {
    done.acquire();
    if (const std::optional<int> got = jobs->take()) result = *got;
  }
  EXPECT_FALSE(job.is_busy());
}

TEST(LatestJobTest, EndsWhileAJobRuns) {
  std::binary_semaphore started(0);
  LatestJob<int> job([] {});
  job.start([&](const std::stop_token& stop) {
    started.release();
    while (!stop.stop_requested()) std::this_thread::yield();
    return 1;
  });
  started.acquire();
}

}  // namespace
}  // namespace whittle

#include "base/workers.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <stdexcept>
#include <thread>

namespace whittle {
namespace {

TEST(Workers, EveryIndexIsDoneOnce) {
  EXPECT_TRUE(rc::check([] {
    const Workers workers(*rc::gen::inRange(0, 9));
    const auto n = *rc::gen::inRange<size_t>(0, 2000), grain = *rc::gen::inRange<size_t>(1, 300);
    std::vector<int> done(n);
    workers.for_parts(n, grain, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) ++done[i];
    });
    RC_ASSERT(std::ranges::count(done, 1) == std::ptrdiff_t(n));
  }));
}

TEST(Workers, AreAsManyAsAskedFor) {
  EXPECT_EQ(Workers(1).count(), 1u);
  EXPECT_EQ(Workers(1000).count(), 1000u);
  EXPECT_GE(Workers(0).count(), 1u);
}

TEST(Workers, AWorkerDoesOnePartAtATime) {
  const Workers workers(7);
  std::vector<std::atomic<int>> busy(workers.count());
  std::atomic<int> wrong = 0;
  workers.for_parts(20000, 1, [&](size_t, size_t, size_t worker) {
    if (worker >= busy.size() || busy[worker]++ != 0)
      ++wrong;
    else
      --busy[worker];
  });
  EXPECT_EQ(wrong, 0);
}

TEST(Workers, ServeThreadsThatAskAtOnce) {
  const Workers workers(3);
  std::atomic<size_t> sum = 0;
  {
    std::vector<std::jthread> askers;
    for (int i = 0; i < 4; ++i)
      askers.emplace_back([&] {
        for (int loop = 0; loop < 50; ++loop)
          workers.for_parts(100, 1,
                            [&](size_t first, size_t last, size_t) { sum += last - first; });
      });
  }
  EXPECT_EQ(sum, 4u * 50 * 100);
}

TEST(Workers, AllAreNeededWhereEachWaitsForTheOthers) {
  const Workers workers(4);
  for (int loop = 0; loop < 20; ++loop) {
    std::barrier together(4);
    workers.for_parts(4, 1, [&](size_t, size_t, size_t) { together.arrive_and_wait(); });
  }
}

TEST(Workers, WhatABodyThrowsArrives) {
  const Workers workers(3);
  const auto failing = [&] {
    workers.for_parts(100, 1, [](size_t first, size_t last, size_t) {
      if (first <= 50 && 50 < last) throw std::runtime_error("fifty");
    });
  };
  EXPECT_THROW(failing(), std::runtime_error);
}

TEST(PerWorker, EachHasItsOwnFromLoopToLoop) {
  const Workers workers(5);
  PerWorker<size_t> sums(workers);
  for (int loop = 0; loop < 3; ++loop) {
    workers.for_parts(1000, 7, [&](size_t first, size_t last, size_t worker) {
      size_t& sum = sums.of(worker, 0);
      for (size_t i = first; i < last; ++i) sum += i;
    });
  }
  size_t count = 0, sum = 0;
  sums.for_each([&](size_t of_one) { ++count, sum += of_one; });
  EXPECT_EQ(sum, 3u * 999 * 1000 / 2);
  EXPECT_GE(count, 1u);
  EXPECT_LE(count, workers.count());
}

}  // namespace
}  // namespace whittle

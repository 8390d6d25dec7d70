#include "image/block_sums.h"

#include <gtest/gtest.h>

#include <vector>

#include "image/edge_lanes.h"

namespace whittle {
namespace {

constexpr size_t kBlockSumsSide = 100, kBlock = 8;

TEST(BlockSums, NumbersTellRaysAndShares) {
  const uint32_t sum = BlockSums::packed(0.5, 1) + BlockSums::packed(0.25, 1);
  EXPECT_EQ(BlockSums::rays_of(sum), 2u);
  EXPECT_EQ(BlockSums::mean(sum, 7), 0.375);
  EXPECT_EQ(BlockSums::mean(0, 7), 7);
}

TEST(BlockSums, AllDirectionsAreInEveryBlock) {
  const std::vector<uint8_t> connected(kBlockSumsSide * kBlockSumsSide);
  const Workers workers(2);
  std::vector<uint32_t> numbers(kBlockSumsSide * kBlockSumsSide);
  // Every place of a block has a share of its own.
  for (size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = BlockSums::packed(
        double(i % kBlockSumsSide % kBlock * kBlock + i / kBlockSumsSide % kBlock) / 64, 1);
  BlockSums(kBlockSumsSide, kBlockSumsSide, connected, kBlock, workers).add_up(numbers);
  for (const uint32_t number : numbers) {
    EXPECT_EQ(BlockSums::rays_of(number), kBlock * kBlock);
    EXPECT_EQ(BlockSums::mean(number, 0), 31.5 / 64) << "at the picture's edges, too";
  }
}

TEST(BlockSums, NothingIsAddedAcrossAnEdge) {
  // Light on the left of column 50, dark on its right.
  std::vector<uint8_t> differences(kBlockSumsSide * kBlockSumsSide);
  std::vector<uint32_t> numbers(kBlockSumsSide * kBlockSumsSide);
  for (size_t y = 0; y < kBlockSumsSide; ++y) {
    differences[y * kBlockSumsSide + 49] = kRight;
    for (size_t x = 0; x < kBlockSumsSide; ++x)
      numbers[y * kBlockSumsSide + x] = BlockSums::packed(x < 50 ? 1 : 0, 1);
  }
  const Workers workers(1);
  BlockSums(kBlockSumsSide, kBlockSumsSide, differences, kBlock, workers).add_up(numbers);
  for (size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(BlockSums::mean(numbers[i], 0.5), i % kBlockSumsSide < 50 ? 1 : 0);
    EXPECT_EQ(BlockSums::rays_of(numbers[i]), kBlock * kBlock);
  }
}

}  // namespace
}  // namespace whittle

// SPDX-License-Identifier: MIT
#include "pvs/bit_matrix.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "split_world.hpp"

namespace hallway::pvs {
namespace {

TEST(BitMatrix, KeepMutualKeepsWhatIsSeenBothWays) {
  for (const std::size_t size : {2u, 62u, 64u, 66u, 130u, 300u}) {
    test::Dice dice(size);
    BitMatrix matrix(size, size);
    for (std::size_t p = 0; p < size; ++p) {
      for (std::size_t q = 0; q < size; ++q) {
        if (dice.chance(0.6)) set_bit(matrix.row(p), q);
      }
    }
    for (const unsigned threads : {1u, 3u}) {
      BitMatrix kept = matrix;
      keep_mutual(kept, threads);
      for (std::size_t p = 0; p < size; ++p) {
        for (std::size_t q = 0; q < size; ++q) {
          ASSERT_EQ(test_bit(kept.row(p), q),
                    test_bit(matrix.row(p), q) && test_bit(matrix.row(q ^ 1u), p ^ 1u))
              << size << ": " << p << " " << q;
        }
      }
    }
  }
}

TEST(BitMatrix, VisitsAndCountsSetBits) {
  BitMatrix matrix(2, 200);
  const std::vector<std::size_t> bits = {0, 63, 64, 127, 199};
  for (const std::size_t bit : bits) set_bit(matrix.row(1), bit);
  std::vector<std::size_t> visited;
  for_each_bit(matrix.row(1), matrix.words(), [&](std::size_t bit) { visited.push_back(bit); });
  EXPECT_EQ(visited, bits);
  EXPECT_EQ(count_bits(matrix.row(1), matrix.words()), bits.size());
  clear_bit(matrix.row(1), 64);
  EXPECT_FALSE(test_bit(matrix.row(1), 64));
  EXPECT_EQ(count_bits(matrix.row(1), matrix.words()), bits.size() - 1);
  EXPECT_EQ(count_bits(matrix.row(0), matrix.words()), 0u);
}

}  // namespace
}  // namespace hallway::pvs

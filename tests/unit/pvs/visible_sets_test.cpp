// SPDX-License-Identifier: MIT
#include "pvs/visible_sets.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "split_world.hpp"
#include "support/errors.hpp"

namespace hallway::pvs {
namespace {

using Rows = std::vector<std::vector<std::uint8_t>>;

Rows random_rows(std::size_t clusters, double share, std::uint64_t seed) {
  test::Dice dice(seed);
  Rows rows(clusters, std::vector<std::uint8_t>((clusters + 7) / 8));
  for (auto& row : rows) {
    for (std::size_t i = 0; i < clusters; ++i) {
      if (dice.chance(share)) row[i / 8] = static_cast<std::uint8_t>(row[i / 8] | 1u << (i % 8));
    }
  }
  return rows;
}

bool has(const std::vector<std::uint8_t>& row, std::size_t bit) {
  return (row[bit / 8] >> (bit % 8) & 1) != 0;
}

TEST(VisibleSets, GiveBackTheRows) {
  for (const std::size_t clusters : {1u, 7u, 8u, 9u, 65u, 300u, 2'500u}) {
    for (const double share : {0.0, 0.001, 0.05, 0.5, 1.0}) {
      const Rows rows = random_rows(clusters, share, clusters);
      const VisibleSets sets(rows);
      ASSERT_EQ(sets.clusters(), clusters);
      std::size_t pairs = 0;
      for (std::uint32_t from = 0; from<clusters; from += clusters> 100 ? 37 : 1) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t to = 0; to < clusters; ++to) {
          if (has(rows[from], to)) expected.push_back(to);
          if (to % 5 == 0) {
            ASSERT_EQ(sets.visible(from, to), has(rows[from], to)) << from << " " << to;
          }
        }
        ASSERT_EQ(sets.visible_from(from), expected);
      }
      for (std::uint32_t from = 0; from < clusters; ++from) pairs += sets.visible_from(from).size();
      EXPECT_DOUBLE_EQ(sets.mean_share(), static_cast<double>(pairs) / static_cast<double>(clusters) /
                                              static_cast<double>(clusters));
    }
  }
}

TEST(VisibleSets, RunsOfZeroBytesTakeTwoBytes) {
  // 16'000 clusters: rows of 2000 bytes, eight runs of at most 255 zero bytes each.
  const VisibleSets sets(Rows(16'000, std::vector<std::uint8_t>(2'000)));
  EXPECT_EQ(sets.bytes(), 16'000 * 8 * 2 + 16'001 * sizeof(std::uint64_t));
}

TEST(VisibleSets, OfNothing) {
  const VisibleSets sets;
  EXPECT_EQ(sets.clusters(), 0u);
  EXPECT_EQ(sets.mean_share(), 0.0);
  EXPECT_EQ(VisibleSets(Rows{}).clusters(), 0u);
}

TEST(VisibleSets, RefuseWrongRowsAndClusters) {
  const auto refused = [](const Rows& rows) {
    const auto error = hallway::test::error_of([&] { VisibleSets{rows}; });
    return error && error->code() == ErrorCode::kInternal;
  };
  EXPECT_TRUE(refused({{}}));
  EXPECT_TRUE(refused({{1, 0}}));
  EXPECT_TRUE(refused({{2}})) << "a bit for a second cluster of one";
  EXPECT_TRUE(refused({{3}, {4}}));
  const VisibleSets sets(Rows{{3}, {3}});
  EXPECT_TRUE(hallway::test::error_of([&] { static_cast<void>(sets.visible(0, 2)); }));
  EXPECT_TRUE(hallway::test::error_of([&] { static_cast<void>(sets.visible(2, 0)); }));
  EXPECT_TRUE(hallway::test::error_of([&] { static_cast<void>(sets.visible_from(2)); }));
}

}  // namespace
}  // namespace hallway::pvs

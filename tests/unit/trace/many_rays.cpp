// SPDX-License-Identifier: MIT
//
// Rays without end: the answers keep coming, and memory does not grow with their number.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "support/long_mode.hpp"
#include "trace/scene.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::trace {
namespace {

/// Pages of memory in use.
long resident_pages() {
  std::ifstream file("/proc/self/statm");
  long size = 0;
  long resident = 0;
  file >> size >> resident;
  return resident;
}

TEST(ManyRays, UseNoMemory) {
  test::Draw draw(51);
  const Scene scene(test::mesh_of(test::clutter(draw, 3, 10.0, Vec3::Zero())), Backend::kEmbree);
  constexpr std::size_t kChunk = 1 << 16;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < kChunk; ++i) points.push_back(draw.point(10.0));
  std::vector<std::uint8_t> answers(kChunk);
  scene.occluded_from(Vec3(20, 0, 0), points, answers);
  const long hidden = std::count(answers.begin(), answers.end(), 1);
  const long before = resident_pages();
  const long chunks = test::sized(20, 1'000'000'000 / static_cast<int>(kChunk) + 1);
  long sum = 0;
  for (long i = 0; i < chunks; ++i) {
    scene.occluded_from(Vec3(20, 0, 0), points, answers);
    sum += std::count(answers.begin(), answers.end(), 1);
  }
  EXPECT_EQ(sum, chunks * hidden);
  EXPECT_GT(hidden, 0);
  EXPECT_LT(resident_pages() - before, 1000);
}

}  // namespace
}  // namespace hallway::trace

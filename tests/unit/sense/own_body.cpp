// SPDX-License-Identifier: MIT
#include "sense/own_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/trace/shapes.hpp"

namespace hallway::sense {
namespace {

OwnBody round_body() {
  return {.middle = {0.1, 0.0}, .radius_m = 0.3, .bottom_m = -0.2, .top_m = 0.4};
}

OwnBody square_body() {
  return {.corners = {{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}}, .bottom_m = 0.0, .top_m = 0.5};
}

TEST(OwnBody, IsMetWhereABeamEntersIt) {
  EXPECT_DOUBLE_EQ(round_body().entry_m({1.4, 0, 0}, {-1, 0, 0}), 1.0);
  EXPECT_DOUBLE_EQ(round_body().entry_m({0.1, 0, 1.0}, {0, 0, -1}), 0.6);
  EXPECT_DOUBLE_EQ(square_body().entry_m({2.3, 0.1, 0.2}, {-1, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(square_body().entry_m({0.2, 0.1, 0.7}, {0, 0, -1}), 0.2);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(square_body().entry_m({2.3, 0.3, 0.2}, {-1, 0, 0}), infinity) << "beside it";
  EXPECT_EQ(square_body().entry_m({2.3, 0.0, 0.2}, {1, 0, 0}), infinity) << "behind the ray";
  EXPECT_EQ(square_body().entry_m({0.0, 0.0, 0.2}, {1, 0, 0}), infinity) << "out of the housing";
}

/// Against small steps along the ray.
TEST(OwnBody, AgreesWithAWalkAlongTheRay) {
  test::Draw draw(7);
  int met = 0;
  for (int i = 0; i < 4000; ++i) {
    const OwnBody body = i % 2 == 0 ? round_body() : square_body();
    const Vec3 origin = draw.point(1.0), direction = draw.direction();
    if (body.contains(origin)) continue;
    const double entry = body.entry_m(origin, direction);
    double found = std::numeric_limits<double>::infinity();
    for (double way = 0.0; way < 4.0; way += 1e-3) {
      if (!body.contains(origin + way * direction)) continue;
      found = way;
      break;
    }
    if (std::isinf(found)) {
      // A chord shorter than a step may be passed over.
      if (std::isfinite(entry)) {
        EXPECT_FALSE(body.contains(origin + (entry + 1.1e-3) * direction)) << "ray " << i;
      }
      continue;
    }
    ++met;
    EXPECT_LE(entry, found) << "ray " << i;
    EXPECT_GE(entry, found - 1.001e-3) << "ray " << i;
  }
  EXPECT_GT(met, 150);
}

}  // namespace
}  // namespace hallway::sense

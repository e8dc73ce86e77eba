// SPDX-License-Identifier: MIT
#include "editor/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"
#include "map/writer.hpp"
#include "support/long_mode.hpp"

namespace hallway::editor {
namespace {

using test::sized;

const Random kRandom(7, stream_id("test.editor.shapes"));

double volume(const map::Brush& brush) {
  const auto body = body_of(brush);
  EXPECT_TRUE(body.has_value());
  return body ? volume_of(*body) : 0.0;
}

double volume(const std::vector<map::Brush>& brushes) {
  double sum = 0.0;
  for (const map::Brush& brush : brushes) sum += volume(brush);
  return sum;
}

/// How deep a point is in a brush; below 0 outside.
double depth(const map::Brush& brush, const Vec3& point) {
  double least = 1e300;
  for (const map::Face& face : brush.faces) least = std::min(least, -plane_of(face)->distance(point));
  return least;
}

std::size_t holders(const std::vector<map::Brush>& brushes, const Vec3& point, double inset) {
  return static_cast<std::size_t>(std::count_if(
      brushes.begin(), brushes.end(), [&](const map::Brush& brush) { return depth(brush, point) > inset; }));
}

Vec3 random_point(std::uint32_t step, std::uint64_t index, double reach) {
  return {kRandom.uniform(step, 3 * index, -reach, reach),
          kRandom.uniform(step, 3 * index + 1, -reach, reach),
          kRandom.uniform(step, 3 * index + 2, -reach, reach)};
}

/// A convex body: a box with corners cut off.
map::Brush random_brush(std::uint32_t step) {
  map::Brush brush = box_brush(Vec3(-50, -60, -40) + random_point(step, 900, 10.0),
                               Vec3(50, 60, 40) + random_point(step, 901, 10.0), "wall");
  for (std::uint64_t i = 0; i < 4; ++i) {
    const Vec3 normal = random_point(step, 910 + i, 1.0).normalized();
    const Halves parts = halves(brush, face_on({normal, 35.0}, Vec3::Zero(), "cut"));
    if (parts.behind) brush = *parts.behind;
  }
  return brush;
}

/// A polygon around the origin with corners at random distances, so that most are concave.
std::vector<Vec3> random_star(std::uint32_t step, std::size_t corners) {
  std::vector<Vec3> polygon;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi *
                         (static_cast<double>(i) + kRandom.uniform(step, i, 0.0, 0.8)) /
                         static_cast<double>(corners);
    const double radius = kRandom.uniform(step, 100 + i, 10.0, 100.0);
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle), 5.0});
  }
  return polygon;
}

bool in_polygon(const std::vector<Vec3>& polygon, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > y) != (b.y() > y) && x < a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

double area_of(const std::vector<Vec3>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2.0;
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    return error.what();
  }
  return {};
}

TEST(Shapes, ABoxHasItsVolumeWhicheverCornersAreGiven) {
  EXPECT_NEAR(volume(box_brush({4, 5, 6}, {1, 1, 1}, "wall")), 60.0, 1e-9);
  EXPECT_NE(refusal([] { box_brush({0, 0, 0}, {1, 0, 1}, "wall"); }), "");
}

TEST(Shapes, AnExtrusionHoldsWhatIsOverItsBase) {
  for (std::uint32_t step = 0; step < sized(30u, 1000u); ++step) {
    // A convex polygon: points on an ellipse, either way round.
    std::vector<Vec3> base;
    const std::size_t n = 3 + step % 9;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi *
                           (static_cast<double>(i) + kRandom.uniform(step, i, 0.0, 0.7)) /
                           static_cast<double>(n);
      base.push_back({70.0 * std::cos(angle), 40.0 * std::sin(angle), 3.0});
    }
    if (std::abs(area_of(base)) < 50.0) continue;
    const auto polygon = base;
    if (step % 2 == 1) std::reverse(base.begin(), base.end());
    const Vec3 way(kRandom.uniform(step, 50, -20, 20), kRandom.uniform(step, 51, -20, 20),
                   step % 3 == 0 ? -30.0 : 25.0);
    const map::Brush brush = extrusion(base, way, "wall");
    EXPECT_NEAR(volume(brush), area_of(polygon) * std::abs(way.z()), 1e-9 * volume(brush));
    for (std::uint64_t i = 100; i < 200; ++i) {
      const Vec3 point = random_point(step, i, 80.0);
      const double part = (point.z() - 3.0) / way.z();
      const bool inside = part > 0.0 && part < 1.0 &&
                          in_polygon(polygon, point.x() - part * way.x(), point.y() - part * way.y());
      if (std::abs(depth(brush, point)) > 1e-6) {
        EXPECT_EQ(depth(brush, point) > 0.0, inside) << step;
      }
    }
  }
}

TEST(Shapes, AnExtrusionRefusesWhatIsNoConvexPolygon) {
  const std::vector<Vec3> dart{{0, 0, 0}, {10, 0, 0}, {2, 2, 0}, {0, 10, 0}};
  EXPECT_NE(refusal([&] { extrusion(dart, Vec3(0, 0, 5), "wall"); }), "");
  const std::vector<Vec3> bent{{0, 0, 0}, {10, 0, 0}, {10, 10, 4}, {0, 10, 0}};
  EXPECT_NE(refusal([&] { extrusion(bent, Vec3(0, 0, 5), "wall"); }), "");
  const std::vector<Vec3> square{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  EXPECT_NE(refusal([&] { extrusion(square, Vec3(5, 5, 0), "wall"); }), "");
  EXPECT_NE(refusal([&] { extrusion(std::span(square).first(2), Vec3(0, 0, 5), "wall"); }), "");
}

TEST(Shapes, AColumnMayEndInAnEdgeOrAPoint) {
  const std::vector<Vec3> base{{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}};
  const std::vector<Vec3> wedge{{0, 0, 0}, {6, 0, 3}, {6, 4, 3}, {0, 4, 0}};
  EXPECT_NEAR(volume(column(base, wedge, "wall")), 36.0, 1e-9);
  const std::vector<Vec3> edge{{0, 2, 3}, {6, 2, 3}, {6, 2, 3}, {0, 2, 3}};
  EXPECT_NEAR(volume(column(base, edge, "wall")), 36.0, 1e-9);
  const std::vector<Vec3> top{{3, 2, 3}, {3, 2, 3}, {3, 2, 3}, {3, 2, 3}};
  EXPECT_NEAR(volume(column(base, top, "wall")), 24.0, 1e-9);
  // The first corners of the top are one: its plane is that of the others.
  const std::vector<Vec3> triangle{{1, 2, 3}, {1, 2, 3}, {5, 4, 3}, {1, 4, 3}};
  EXPECT_NE(refusal([&] { column(base, triangle, "wall"); }), "");  // its sides are not flat
}

TEST(Shapes, AColumnWithATwistedSideIsRefused) {
  const std::vector<Vec3> base{{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}};
  const std::vector<Vec3> turned{{3, -1, 5}, {7, 3, 5}, {3, 7, 5}, {-1, 3, 5}};
  EXPECT_NE(refusal([&] { column(base, turned, "wall"); }), "");
}

TEST(Shapes, ConvexPartsCoverAPolygonOnce) {
  for (std::uint32_t step = 0; step < sized(200u, 5000u); ++step) {
    const auto polygon = random_star(step, 4 + step % 13);
    auto given = polygon;
    if (step % 2 == 1) std::reverse(given.begin(), given.end());
    const auto parts = convex_parts(given);
    double sum = 0.0;
    std::vector<map::Brush> brushes;
    for (const auto& part : parts) {
      EXPECT_GT(area_of(part), 0.0);
      sum += area_of(part);
      brushes.push_back(extrusion(part, Vec3(0, 0, 10), "wall"));  // refuses what is not convex
    }
    EXPECT_NEAR(sum, area_of(polygon), 1e-6 * area_of(polygon)) << step;
    EXPECT_LE(parts.size(), polygon.size() - 2);
    for (std::uint64_t i = 300; i < 330; ++i) {
      const Vec3 point(kRandom.uniform(step, i, -100, 100), kRandom.uniform(step, i + 100, -100, 100), 10.0);
      if (holders(brushes, point, -1e-6) != holders(brushes, point, 1e-6)) continue;
      EXPECT_EQ(holders(brushes, point, 0.0), in_polygon(polygon, point.x(), point.y()) ? 1u : 0u) << step;
    }
  }
}

TEST(Shapes, ConvexPartsOfAConvexPolygonIsIt) {
  const std::vector<Vec3> square{{0, 0, 0}, {5, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  const auto parts = convex_parts(square);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts.front().size(), 4u);  // the one on a straight edge is left out
  const std::vector<Vec3> angle{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  EXPECT_EQ(convex_parts(angle).size(), 2u);
}

TEST(Shapes, ConvexPartsRefusesPolygonsThatMeetThemselves) {
  const std::vector<Vec3> bow{{0, 0, 0}, {10, 10, 0}, {10, 0, 0}, {0, 10, 0}};
  EXPECT_NE(refusal([&] { convex_parts(bow); }), "");
  const std::vector<Vec3> touching{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {5, 0, 0}, {0, 10, 0}};
  EXPECT_NE(refusal([&] { convex_parts(touching); }), "");
  const std::vector<Vec3> spike{{0, 0, 0}, {20, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  EXPECT_NE(refusal([&] { convex_parts(spike); }), "");
  const std::vector<Vec3> line{{0, 0, 0}, {5, 0, 0}, {10, 0, 0}};
  EXPECT_NE(refusal([&] { convex_parts(line); }), "");
  EXPECT_NE(refusal([&] { convex_parts(std::span(line).first(2)); }), "");
}

TEST(Shapes, HalvesAreTheBrushAndMeetInThePlane) {
  for (std::uint32_t step = 0; step < sized(100u, 3000u); ++step) {
    const map::Brush brush = random_brush(step);
    const Plane plane{random_point(step, 1, 1.0).normalized(), kRandom.uniform(step, 10, -45, 45)};
    const Halves parts = halves(brush, face_on(plane, Vec3::Zero(), "cut"));
    std::vector<map::Brush> both;
    if (parts.behind) both.push_back(*parts.behind);
    if (parts.in_front) both.push_back(*parts.in_front);
    EXPECT_NEAR(volume(both), volume(brush), 1e-4) << step;
    for (std::uint64_t i = 20; i < 60; ++i) {
      const Vec3 point = random_point(step, i, 60.0);
      if (std::abs(plane.distance(point)) < 1e-5 || std::abs(depth(brush, point)) < 1e-5) continue;
      const bool inside = depth(brush, point) > 0.0;
      EXPECT_EQ(parts.behind && depth(*parts.behind, point) > 0.0, inside && plane.distance(point) < 0.0);
      EXPECT_EQ(parts.in_front && depth(*parts.in_front, point) > 0.0, inside && plane.distance(point) > 0.0);
    }
  }
}

TEST(Shapes, AnIntersectionHoldsWhatBothHold) {
  int common = 0;
  for (std::uint32_t step = 0; step < sized(100u, 3000u); ++step) {
    const map::Brush a = random_brush(2 * step);
    map::Brush b = random_brush(2 * step + 1);
    const Vec3 shift = random_point(step, 700, 70.0);
    for (map::Face& face : b.faces) {
      for (Vec3& point : face.points) point += shift;
    }
    const auto both = intersection(a, b);
    common += both ? 1 : 0;
    for (std::uint64_t i = 20; i < 60; ++i) {
      const Vec3 point = random_point(step, i, 60.0);
      const double least = std::min(depth(a, point), depth(b, point));
      if (std::abs(least) < 1e-5) continue;
      EXPECT_EQ(both && depth(*both, point) > 0.0, least > 0.0) << step;
    }
  }
  EXPECT_GT(common, 20);
}

TEST(Shapes, HollowedWallsAreTheBrushWithoutItsInside) {
  for (const Joint joint : {Joint::kMitred, Joint::kSlabs}) {
    for (std::uint32_t step = 0; step < sized(60u, 2000u); ++step) {
      const map::Brush brush = random_brush(step);
      const double thickness = kRandom.uniform(step, 5, 1.0, 12.0);
      const auto walls = hollowed(brush, thickness, joint, "inside");
      for (std::uint64_t i = 20; i < 120; ++i) {
        const Vec3 point = random_point(step, i, 60.0);
        const double deep = depth(brush, point);
        if (std::abs(deep) < 1e-5 || std::abs(deep - thickness) < 1e-5) continue;
        if (holders(walls, point, -1e-5) != holders(walls, point, 1e-5)) continue;  // on a joint
        EXPECT_EQ(holders(walls, point, 0.0), deep > 0.0 && deep < thickness ? 1u : 0u)
            << step << " at depth " << deep;
      }
      for (std::size_t i = 0; i < walls.size(); ++i) {
        for (std::size_t j = i + 1; j < walls.size(); ++j) {
          const auto common = intersection(walls[i], walls[j]);
          EXPECT_LT(common ? volume(*common) : 0.0, 1e-3) << step;
        }
      }
    }
  }
}

TEST(Shapes, AHollowBoxHasSixWalls) {
  const map::Brush box = box_brush({0, 0, 0}, {10, 20, 30}, "wall");
  for (const Joint joint : {Joint::kMitred, Joint::kSlabs}) {
    const auto walls = hollowed(box, 1.0, joint, "plaster");
    EXPECT_EQ(walls.size(), 6u);
    EXPECT_NEAR(volume(walls), 6000.0 - 8.0 * 18.0 * 28.0, 1e-6);
    for (const map::Brush& wall : walls) {
      EXPECT_TRUE(std::any_of(wall.faces.begin(), wall.faces.end(),
                              [](const map::Face& face) { return face.material == "plaster"; }));
    }
  }
  EXPECT_NE(refusal([&] { hollowed(box, 5.0, Joint::kMitred, ""); }), "");
  EXPECT_NE(refusal([&] { hollowed(map::Brush{}, 1.0, Joint::kMitred, ""); }), "");
}

TEST(Shapes, HalvesRefusesNoBodyAndNoPlane) {
  const map::Brush box = box_brush({0, 0, 0}, {10, 20, 30}, "wall");
  EXPECT_NE(refusal([&] { halves(box, face_through({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, "cut")); }), "");
  EXPECT_NE(refusal([&] { halves(map::Brush{}, box.faces.front()); }), "");
}

TEST(Shapes, TidiedTakesAwayRoundingOnly) {
  EXPECT_EQ(tidied({0.1 + 0.2, 1.0 - 1e-12, -5e-13}), Vec3(0.3, 1.0, 0.0));
  const Vec3 fine(0.1234567891, 1.0 / 3.0, -2e-8);
  EXPECT_EQ(tidied(fine), fine);
}

}  // namespace
}  // namespace hallway::editor

// SPDX-License-Identifier: MIT
//
// Embree's tree and the brute-force oracle give the same answer to every ray, bit by bit: also to those
// through edges and vertices, beside them, along faces, and from inside of solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "support/long_mode.hpp"
#include "trace/scene.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::trace {
namespace {

struct Place {
  const char* name;
  double size;  ///< metres
  Vec3 centre;
};

class Agreement : public testing::TestWithParam<Place> {
 protected:
  Agreement() {
    // A floor and two long thin walls along the axes, then prisms of all kinds.
    const double s = size();
    const Vec3 c = GetParam().centre;
    bodies_ = test::clutter(draw_, 60, s, c);
    bodies_.push_back(test::box(c + Vec3(-s, -s, -0.3 * s), c + Vec3(s, s, -0.299 * s)));
    bodies_.push_back(test::box(c + Vec3(-s, 0.1 * s, -s), c + Vec3(s, 0.1 * s + 0.002, s)));
    bodies_.push_back(test::box(c + Vec3(-0.2 * s, -s, -s), c + Vec3(-0.2 * s + 0.002, s, s)));
    mesh_ = test::mesh_of(bodies_);
    embree_.emplace(mesh_, Backend::kEmbree);
    oracle_.emplace(mesh_, Backend::kBruteForce);
  }

  double size() const { return GetParam().size; }
  Vec3 anywhere() { return GetParam().centre + draw_.point(1.3 * size()); }
  std::array<Vec3, 3> any_triangle() {
    const auto& corner = mesh_.triangles[draw_.index(mesh_.triangles.size())];
    return {mesh_.vertices[corner[0]], mesh_.vertices[corner[1]], mesh_.vertices[corner[2]]};
  }
  /// A point of an edge of the mesh; every third is one of its ends.
  Vec3 any_edge_point() {
    const auto v = any_triangle();
    const std::size_t i = draw_.index(3);
    return v[i] + (draw_.index(3) == 0 ? 0.0 : draw_.uniform(0.0, 1.0)) * (v[(i + 1) % 3] - v[i]);
  }

  void expect_same(const Ray& ray, const std::string& what) {
    const auto expected = oracle_->first_hit(ray);
    const auto got = embree_->first_hit(ray);
    ASSERT_EQ(got.has_value(), expected.has_value()) << what;
    hits_ += expected ? 1 : 0;
    if (!expected) return;
    ASSERT_EQ(got->triangle, expected->triangle) << what;
    ASSERT_EQ(got->distance, expected->distance) << what;
  }
  void expect_same(const Vec3& from, const Vec3& to, const std::string& what) {
    ASSERT_EQ(embree_->occluded(from, to), oracle_->occluded(from, to)) << what;
  }
  /// All lines from one point at once, in both orders: as they come, and as neighbours that Embree traces together.
  void expect_same(const Vec3& eye, std::vector<Vec3> points, const std::string& what) {
    std::vector<std::uint8_t> got(points.size());
    for (const bool sorted : {false, true}) {
      if (sorted) {
        std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
          return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
        });
      }
      embree_->occluded_from(eye, points, got);
      for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(got[i] != 0, oracle_->occluded(eye, points[i])) << what << ", point " << i;
        hits_ += got[i] != 0 ? 1 : 0;
      }
    }
  }

  test::Draw draw_{21};
  std::vector<test::Body> bodies_;
  TriangleMesh mesh_;
  std::optional<Scene> embree_;
  std::optional<Scene> oracle_;
  int hits_ = 0;
};

TEST_P(Agreement, OnRandomRays) {
  const int rays = test::sized(25000, 300000);
  for (int i = 0; i < rays; ++i) {
    expect_same({anywhere(), draw_.direction(), draw_.uniform(0.1, 4.0) * size()},
                "ray " + std::to_string(i));
    expect_same(anywhere(), anywhere(), "segment " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(hits_, rays / 4);
  EXPECT_LT(hits_, rays);
}

/// Rays as a scanner has them, beside each other and from places that follow each other, with some among them that hit nothing by definition.
TEST_P(Agreement, OnManyRaysAtOnce) {
  const int fans = test::sized(150, 3000);
  for (int fan = 0; fan < fans; ++fan) {
    const Vec3 origin = anywhere(), step = draw_.direction() * draw_.uniform(0.0, 0.002) * size();
    Vec3 direction = fan % 3 == 0 ? Vec3(any_edge_point() - origin) : draw_.direction();
    const Vec3 turn = draw_.direction() * (fan % 2 == 0 ? 0.01 : 1.0);
    std::vector<Ray> rays;
    for (std::size_t i = 0, n = draw_.index(150); i < n; ++i, direction += turn) {
      rays.push_back({origin + static_cast<double>(i) * step, direction, 4.0 * size()});
      if (draw_.index(10) == 0) rays.back().max_distance = -1.0;
      if (draw_.index(10) == 0) rays.back().direction.setZero();
      if (draw_.index(10) == 0) rays.back().origin += Vec3(9.0, 0.0, 0.0) * size();
    }
    std::vector<std::optional<Hit>> got(rays.size(), Hit{-1.0, 0});
    embree_->first_hits(rays, got);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto expected = oracle_->first_hit(rays[i]);
      ASSERT_EQ(got[i].has_value(), expected.has_value()) << "fan " << fan << ", ray " << i;
      hits_ += expected ? 1 : 0;
      if (!expected) continue;
      ASSERT_EQ(got[i]->triangle, expected->triangle) << "fan " << fan << ", ray " << i;
      ASSERT_EQ(got[i]->distance, expected->distance) << "fan " << fan << ", ray " << i;
    }
  }
  EXPECT_GT(hits_, 5 * fans);
  std::vector<std::optional<Hit>> few(1);
  EXPECT_THROW(embree_->first_hits(std::vector<Ray>(2), few), Error);
  std::vector<Ray> bad(1);
  bad[0].direction.x() = std::nan("");
  EXPECT_THROW(embree_->first_hits(bad, few), Error);
}

TEST_P(Agreement, OnRaysThroughEdgesAndVertices) {
  const int rays = test::sized(5000, 100000);
  for (int i = 0; i < rays; ++i) {
    const Vec3 origin = anywhere();
    const Vec3 target = any_edge_point();
    expect_same({origin, target - origin, 4.0 * size()}, "ray " + std::to_string(i));
    expect_same(origin, origin + 1.5 * (target - origin), "segment " + std::to_string(i));
    expect_same(origin, target, "segment that ends there " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Agreement, OnRaysJustBesideEdges) {
  const int rays = test::sized(5000, 100000);
  for (int i = 0; i < rays; ++i) {
    const Vec3 origin = anywhere();
    const Vec3 target = any_edge_point() + draw_.direction() * draw_.uniform(0.00005, 0.0002);
    expect_same({origin, target - origin, 4.0 * size()}, "ray " + std::to_string(i));
    expect_same(origin, origin + 1.5 * (target - origin), "segment " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Agreement, OnRaysAlongFacesAndEdges) {
  const int rays = test::sized(5000, 100000);
  for (int i = 0; i < rays; ++i) {
    const auto v = any_triangle();
    const Vec3 from =
        v[0] + draw_.uniform(-1.0, 2.0) * (v[1] - v[0]) + draw_.uniform(-1.0, 2.0) * (v[2] - v[0]);
    const Vec3 to = v[draw_.index(3)] + draw_.direction() * (draw_.index(2) == 0 ? 0.0 : 1e-6 * size());
    expect_same({from, to - from, 4.0 * size()}, "ray " + std::to_string(i));
    expect_same(from, to, "segment " + std::to_string(i));
    const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(draw_.index(3)));
    expect_same({v[0], axis, 4.0 * size()}, "ray along an axis " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Agreement, OnRaysFromFarOutside) {
  const int rays = test::sized(3000, 50000);
  for (int i = 0; i < rays; ++i) {
    const double farthest = std::min(5000.0, 8e7 / size());
    const Vec3 away = draw_.direction() * size() * draw_.uniform(2.0, farthest);
    const Vec3 target = draw_.index(2) == 0 ? any_edge_point() : anywhere();
    const Vec3 origin = target + away;
    expect_same({origin, target - origin, 1e9}, "ray " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Agreement, OnManyLinesFromOnePoint) {
  const int eyes = test::sized(60, 1500);
  int lines = 0;
  for (int i = 0; i < eyes; ++i) {
    // Every third eye in the plane of a face, every sixth on an edge, where lines graze.
    const auto v = any_triangle();
    const Vec3 eye = i % 6 == 0   ? any_edge_point()
                     : i % 3 == 0 ? Vec3(v[0] + draw_.uniform(-2.0, 2.0) * (v[1] - v[0]))
                                  : anywhere();
    const double spread = draw_.uniform(0.0, 0.3) * size();
    const Vec3 middle = anywhere();
    std::vector<Vec3> points = {eye, v[0], 0.5 * (v[0] + v[1]), eye + Vec3(1e-9, 0.0, 0.0)};
    for (int j = 0; j < 37; ++j) {
      points.push_back(middle + draw_.point(spread));
      if (j % 5 == 0) points.push_back(any_edge_point());
      if (j % 9 == 0) points.push_back(2.0 * any_edge_point() - eye);
    }
    lines += 2 * static_cast<int>(points.size());
    expect_same(eye, points, "eye " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(hits_, lines / 20);
  EXPECT_LT(hits_, lines);
}

TEST_P(Agreement, OnLinesWithinRoundingOfAFace) {
  const int lines = test::sized(5000, 100000);
  for (int i = 0; i < lines; ++i) {
    // Both ends above or below a face by 1e-16 ... 1e-1 of the scene's size: nearly parallel to it, crossing or not.
    const auto v = any_triangle();
    const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
    const auto near_face = [&] {
      const double height =
          size() * std::pow(10.0, draw_.uniform(-16.0, -1.0)) * (draw_.index(2) == 0 ? 1 : -1);
      return Vec3(v[0] + draw_.uniform(-0.5, 1.0) * (v[1] - v[0]) + draw_.uniform(-0.5, 1.0) * (v[2] - v[0]) +
                  height * normal);
    };
    const Vec3 from = near_face();
    const Vec3 to = near_face();
    expect_same(from, to, "segment " + std::to_string(i));
    expect_same({from, to - from, 4.0 * size()}, "ray " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Agreement, OnVeryShortLines) {
  const int lines = test::sized(2000, 50000);
  for (int i = 0; i < lines; ++i) {
    const Vec3 from =
        any_edge_point() + draw_.direction() * size() * std::pow(10.0, draw_.uniform(-16.0, -5.0));
    const Vec3 to = from + draw_.direction() * size() * std::pow(10.0, draw_.uniform(-16.0, -5.0));
    expect_same(from, to, "segment " + std::to_string(i));
    expect_same({from, draw_.direction(), (to - from).norm()}, "ray " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Places, Agreement,
                         testing::Values(Place{"Room", 10.0, Vec3(0.0, 0.0, 0.0)},
                                         Place{"RoomFarAway", 10.0, Vec3(1e4, -1e4, 9e3)},
                                         Place{"Desk", 0.3, Vec3(100.0, 20.0, 0.0)},
                                         Place{"Speck", 1e-4, Vec3(0.1, 0.2, 0.3)},
                                         Place{"SpeckFarAway", 1e-3, Vec3(-9e6, 9e6, 9e6)},
                                         Place{"Planet", 4e6, Vec3(1e5, 0.0, 0.0)},
                                         Place{"Landscape", 1e4, Vec3(0.0, 0.0, 0.0)}),
                         [](const auto& place) { return std::string(place.param.name); });

}  // namespace
}  // namespace hallway::trace

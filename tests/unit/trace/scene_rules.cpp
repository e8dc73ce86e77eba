// SPDX-License-Identifier: MIT
//
// What a scene answers, one rule at a time, on the backend that HALLWAY_TEST_BACKEND names.
#include <gtest/gtest.h>

#include <limits>
#include <thread>
#include <vector>

#include "support/errors.hpp"
#include "trace/scene.hpp"
#include "unit/trace/backend_under_test.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::trace {
namespace {

using test::error_of;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A square wall of 2 m in the plane x = 5, as the triangles 0 (y < z) and 1.
TriangleMesh wall() {
  TriangleMesh mesh;
  mesh.vertices = {{5, -1, -1}, {5, 1, 1}, {5, -1, 1}, {5, 1, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  return mesh;
}

Scene unit_box() {
  return Scene(test::mesh_of({test::box({-1, -1, -1}, {1, 1, 1})}), kBackend);
}

TEST(FirstHit, GivesDistanceAndTriangle) {
  const Scene scene(wall(), kBackend);
  const auto upper = scene.first_hit({{0, -0.5, 0.5}, {1, 0, 0}, 100.0});
  ASSERT_TRUE(upper);
  EXPECT_EQ(upper->distance, 5.0);
  EXPECT_EQ(upper->triangle, 0u);
  const auto lower = scene.first_hit({{0, 0.5, -0.5}, {1, 0, 0}, 100.0});
  ASSERT_TRUE(lower);
  EXPECT_EQ(lower->triangle, 1u);
}

TEST(FirstHit, MissesBesideTheWall) {
  const Scene scene(wall(), kBackend);
  EXPECT_FALSE(scene.first_hit({{0, 0, 1.0001}, {1, 0, 0}, 100.0}));
  EXPECT_FALSE(scene.first_hit({{0, 0, 0}, {-1, 0, 0}, 100.0}));
}

TEST(FirstHit, SeesTrianglesFromBothSides) {
  const Scene scene(wall(), kBackend);
  EXPECT_TRUE(scene.first_hit({{10, -0.5, 0.5}, {-1, 0, 0}, 100.0}));
}

TEST(FirstHit, StopsAtTheGivenDistanceInclusive) {
  const Scene scene(wall(), kBackend);
  EXPECT_TRUE(scene.first_hit({{0, 0, 0.5}, {1, 0, 0}, 5.0}));
  EXPECT_FALSE(scene.first_hit({{0, 0, 0.5}, {1, 0, 0}, 4.9999999}));
  EXPECT_TRUE(scene.first_hit({{0, 0, 0.5}, {1, 0, 0}, kInfinity}));
  EXPECT_FALSE(scene.first_hit({{0, 0, 0.5}, {1, 0, 0}, -1.0}));
}

TEST(FirstHit, StartsOnASurfaceAtDistanceZero) {
  const Scene scene(wall(), kBackend);
  const auto hit = scene.first_hit({{5, -0.5, 0.5}, {1, 0, 0}, 0.0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->distance, 0.0);
}

TEST(FirstHit, MeasuresInMetresWhateverTheDirectionsLength) {
  const Scene scene(wall(), kBackend);
  for (const double length : {1e-310, 1e-200, 0.001, 3.0, 1e200}) {
    const auto hit = scene.first_hit({{0, -0.5, 0.5}, {length, 0, 0}, 100.0});
    ASSERT_TRUE(hit) << length;
    EXPECT_EQ(hit->distance, 5.0);
  }
}

TEST(FirstHit, HasNothingAlongAZeroDirection) {
  EXPECT_FALSE(Scene(wall(), kBackend).first_hit({{5, 0, 0}, {0, 0, 0}, 100.0}));
}

TEST(FirstHit, TakesTheLowestIndexAmongEqualDistances) {
  TriangleMesh mesh = wall();
  const auto first = mesh.triangles[0];
  for (int copies = 0; copies < 40; ++copies) mesh.triangles.push_back(first);
  const Scene scene(mesh, kBackend);
  EXPECT_EQ(scene.first_hit({{0, -0.5, 0.5}, {1, 0, 0}, 100.0})->triangle, 0u);
  EXPECT_EQ(scene.first_hit({{0, 0, 0}, {1, 0, 0}, 100.0})->triangle, 0u) << "the edge of triangles 0 and 1";
}

TEST(FirstHit, TakesTheNearerOfTwoWallsAHairApart) {
  TriangleMesh mesh = wall();
  for (Vec3& v : mesh.vertices) v.x() = 5.0 + 1e-9;
  for (const Vec3& v : wall().vertices) mesh.vertices.push_back(v);
  mesh.triangles.push_back({4, 5, 6});
  const auto hit = Scene(mesh, kBackend).first_hit({{0, -0.5, 0.5}, {1, 0, 0}, 100.0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 2u);
  EXPECT_EQ(hit->distance, 5.0);
}

TEST(FirstHit, StartsInsideASolid) {
  const auto hit = unit_box().first_hit({{0.25, 0.1, 0.2}, {1, 0, 0}, 100.0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->distance, 0.75);
}

TEST(FirstHit, SlipsThroughNoEdgeOrVertexOfAClosedBody) {
  const Scene scene = unit_box();
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 target(x, y, z);  // vertices, middles of edges, middles of faces (on the fan's diagonal)
        const auto hit = scene.first_hit({Vec3::Zero(), target, 10.0});
        ASSERT_TRUE(hit) << target.transpose();
        EXPECT_NEAR(hit->distance, target.norm(), 1e-15);
      }
    }
  }
}

TEST(FirstHit, RunsAlongAFaceWithoutHittingIt) {
  const Scene scene(wall(), kBackend);
  EXPECT_FALSE(scene.first_hit({{5, -10, 0.3}, {0, 1, 0}, 100.0}));
  // A closed body's face is entered through the neighbours' edge.
  const auto hit = unit_box().first_hit({{-5, 0.3, 1}, {1, 0, 0}, 100.0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->distance, 4.0);
}

TEST(FirstHit, NeverHitsATriangleWithoutArea) {
  TriangleMesh mesh;
  mesh.vertices = {{5, 0, -1}, {5, 0, 0}, {5, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 2}, {1, 1, 1}};
  EXPECT_FALSE(Scene(mesh, kBackend).first_hit({{0, 0, 0}, {1, 0, 0}, 100.0}));
}

TEST(FirstHit, ReachesASmallSceneFromFarAway) {
  const Scene scene(wall(), kBackend);
  const auto hit = scene.first_hit({{-1e8, -0.5, 0.5}, {1, 0, 0}, kInfinity});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->distance, 1e8 + 5.0);
}

TEST(FirstHit, IsExactFarFromTheOrigin) {
  TriangleMesh mesh = wall();
  const Vec3 far(10000.0, -10000.0, 10000.0);
  for (Vec3& v : mesh.vertices) v += far;
  const Scene scene(mesh, kBackend);
  const auto hit = scene.first_hit({far + Vec3(4.9999, -0.5, 0.5), {1, 0, 0}, 1.0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 0.0001, 1e-11);
  EXPECT_FALSE(scene.first_hit({far + Vec3(0, 0, 1.0001), {1, 0, 0}, 100.0}));
}

TEST(FirstHit, FindsNothingInAnEmptyScene) {
  const Scene scene(TriangleMesh{}, kBackend);
  EXPECT_FALSE(scene.first_hit({{0, 0, 0}, {1, 0, 0}, kInfinity}));
  EXPECT_FALSE(scene.occluded({0, 0, 0}, {1, 0, 0}));
}

TEST(Occluded, HasAWallBetween) {
  const Scene scene(wall(), kBackend);
  EXPECT_TRUE(scene.occluded({0, 0, 0.5}, {10, 0, 0.5}));
  EXPECT_FALSE(scene.occluded({0, 0, 0.5}, {4.999, 0, 0.5}));
  EXPECT_FALSE(scene.occluded({5.001, 0, 0.5}, {10, 0, 0.5}));
  EXPECT_FALSE(scene.occluded({0, 0, 1.5}, {10, 0, 1.5}));
}

TEST(Occluded, IsFalseWithoutLength) {
  EXPECT_FALSE(Scene(wall(), kBackend).occluded({5, -0.5, 0.5}, {5, -0.5, 0.5}));
}

TEST(Occluded, IsTheSameFromBothEnds) {
  test::Draw draw(3);
  const std::vector<test::Body> bodies = test::clutter(draw, 20, 10.0, Vec3::Zero());
  const Scene scene(test::mesh_of(bodies), kBackend);
  for (int i = 0; i < 2000; ++i) {
    const Polygon& face = bodies[draw.index(bodies.size())].front();
    // From a vertex through a point of the same face: decided by rounding alone.
    const Vec3& from = face.vertices[draw.index(face.vertices.size())];
    const Vec3 to =
        face.vertices[draw.index(face.vertices.size())] + draw.direction() * draw.uniform(0.0, 1.0);
    ASSERT_EQ(scene.occluded(from, to), scene.occluded(to, from)) << i;
  }
}

TEST(OccludedFrom, AnswersLikeOccludedForAnyNumberOfPoints) {
  test::Draw draw(5);
  const Scene scene(test::mesh_of(test::clutter(draw, 10, 10.0, Vec3::Zero())), kBackend);
  for (std::size_t count = 0; count < 70; ++count) {
    const Vec3 eye = draw.point(12.0);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(draw.point(count % 2 == 0 ? 12.0 : 3.0));
    std::vector<std::uint8_t> answers(count, 7);
    scene.occluded_from(eye, points, answers);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(answers[i], scene.occluded(eye, points[i]) ? 1 : 0) << count << " " << i;
    }
  }
}

TEST(OccludedFrom, FindsNothingInAnEmptyScene) {
  const Scene scene(TriangleMesh{}, kBackend);
  const std::vector<Vec3> points(40, Vec3(1, 2, 3));
  std::vector<std::uint8_t> answers(40, 1);
  scene.occluded_from({0, 0, 0}, points, answers);
  EXPECT_EQ(answers, std::vector<std::uint8_t>(40, 0));
}

TEST(OccludedFrom, SeesNothingOutsideFromInsideASolid) {
  const Scene scene = unit_box();
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.push_back({0.1 * i - 5.0, 3.0, 0.02 * i - 1.0});
  std::vector<std::uint8_t> answers(100);
  scene.occluded_from({0.2, 0.3, -0.1}, points, answers);
  EXPECT_EQ(answers, std::vector<std::uint8_t>(100, 1));
}

TEST(OccludedFrom, RefusesBadPointsAndLengths) {
  const Scene scene(wall(), kBackend);
  std::vector<Vec3> points(20, Vec3(1, 2, 3));
  std::vector<std::uint8_t> answers(20);
  points[17].y() = kNan;
  EXPECT_TRUE(error_of([&] { scene.occluded_from({0, 0, 0}, points, answers); }));
  points[17].y() = 0.0;
  EXPECT_TRUE(error_of([&] { scene.occluded_from({0, kInfinity, 0}, points, answers); }));
  answers.resize(19);
  EXPECT_TRUE(error_of([&] { scene.occluded_from({0, 0, 0}, points, answers); }));
}

TEST(Scene, RefusesAVertexThatDoesNotExist) {
  TriangleMesh mesh = wall();
  mesh.triangles.push_back({0, 4, 1});
  const auto error = error_of([&] { Scene(mesh, kBackend); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_STREQ(error->what(), "triangle 2: uses vertex 4, but there are only 4");
}

TEST(Scene, RefusesCoordinatesThatAreNotFiniteOrTooFar) {
  for (const double bad : {kNan, kInfinity, -1.1e7}) {
    TriangleMesh mesh = wall();
    mesh.vertices[3].y() = bad;
    const auto error = error_of([&] { Scene(mesh, kBackend); });
    ASSERT_TRUE(error) << bad;
    EXPECT_EQ(error->where().element, "vertex 3");
  }
}

TEST(Scene, RefusesRaysThatAreNotFiniteOrTooFar) {
  const Scene scene(wall(), kBackend);
  const std::vector<Ray> bad = {{{kNan, 0, 0}, {1, 0, 0}, 1.0},      {{0, kInfinity, 0}, {1, 0, 0}, 1.0},
                                {{0, 0, 1.1e8}, {1, 0, 0}, 1.0},     {{0, 0, 0}, {kNan, 0, 0}, 1.0},
                                {{0, 0, 0}, {kInfinity, 0, 0}, 1.0}, {{0, 0, 0}, {1, 0, 0}, kNan}};
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto error = error_of([&] { static_cast<void>(scene.first_hit(bad[i])); });
    ASSERT_TRUE(error) << i;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
  EXPECT_TRUE(error_of([&] { static_cast<void>(scene.occluded({0, 0, 0}, {kNan, 0, 0})); }));
  EXPECT_TRUE(error_of([&] { static_cast<void>(scene.occluded({0, 0, kInfinity}, {0, 0, 0})); }));
}

TEST(Scene, AnswersAreTheSameOnManyThreads) {
  test::Draw draw(4);
  const Scene scene(test::mesh_of(test::clutter(draw, 10, 10.0, Vec3::Zero())), kBackend);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) rays.push_back({draw.point(12.0), draw.direction(), 30.0});
  const auto distances = [&] {
    std::vector<double> all;
    for (const Ray& ray : rays) {
      const auto hit = scene.first_hit(ray);
      all.push_back(hit ? hit->distance : -1.0);
    }
    return all;
  };
  const std::vector<double> expected = distances();
  std::vector<std::vector<double>> got(4);
  std::vector<std::thread> threads;
  for (auto& mine : got) threads.emplace_back([&distances, &mine] { mine = distances(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& mine : got) EXPECT_EQ(mine, expected);
}

TEST(TriangleMesh, FansAPolygon) {
  TriangleMesh mesh;
  mesh.add_polygon({{{0, 0, 0}, {1, 0, 0}}, {}});
  EXPECT_TRUE(mesh.triangles.empty());
  mesh.add_polygon({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 2, 0}, {0, 1, 0}}, {}});
  mesh.add_polygon({{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, {}});
  const std::vector<std::array<std::uint32_t, 3>> expected = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {5, 6, 7}};
  EXPECT_EQ(mesh.triangles, expected);
  EXPECT_EQ(mesh.vertices.size(), 8u);
}

}  // namespace
}  // namespace hallway::trace

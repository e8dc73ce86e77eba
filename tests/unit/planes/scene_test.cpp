// SPDX-License-Identifier: MIT
#include "planes/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "planes/fit.hpp"
#include "planes/rectangle.hpp"
#include "planes/scene_files.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::planes {
namespace {

namespace test = hallway::test;

TEST(Scenes, AreThoseOfTheirSeedAndNumber) {
  const Scene scene = make_scene(7, 3, {});
  EXPECT_EQ(print_scene_points(make_scene(7, 3, {})), print_scene_points(scene));
  EXPECT_NE(print_scene_points(make_scene(7, 4, {})), print_scene_points(scene));
  EXPECT_NE(print_scene_points(make_scene(8, 3, {})), print_scene_points(scene));
}

TEST(Scenes, KeepToTheirRanges) {
  const SceneOptions options{.planes = {3, 12}, .points = {300, 3000}, .noise = {0.005, 0.05}};
  std::set<std::size_t> planes;
  for (std::uint32_t index = 0; index < 60; ++index) {
    const Scene scene = make_scene(1, index, options);
    planes.insert(scene.rectangles.size());
    EXPECT_GE(scene.rectangles.size(), 3u);
    EXPECT_LE(scene.rectangles.size(), 12u);
    EXPECT_GE(scene.points.size(), 300u);
    EXPECT_LE(scene.points.size(), 3000u);
    ASSERT_EQ(scene.labels.size(), scene.points.size());
    for (const SceneRectangle& rectangle : scene.rectangles) {
      EXPECT_GE(rectangle.noise, 0.005);
      EXPECT_LE(rectangle.noise, 0.05);
      EXPECT_GE(rectangle.points, 20u);
      EXPECT_EQ(
          static_cast<std::size_t>(std::count(scene.labels.begin(), scene.labels.end(), rectangle.label)),
          rectangle.points);
      for (const Vec3& corner : corners_of(rectangle)) {
        EXPECT_GE(corner.minCoeff(), 0);
        EXPECT_LE(corner.maxCoeff(), 10);
      }
    }
  }
  EXPECT_GE(planes.size(), 8u);
}

TEST(Scenes, PointsLieOnTheirRectanglesWithinTheNoise) {
  const Scene scene =
      make_scene(2, 0, {.planes = {10, 10}, .points = {20'000, 20'000}, .noise = {0.01, 0.01}});
  for (const SceneRectangle& rectangle : scene.rectangles) {
    const Vec3 v = rectangle.normal.cross(rectangle.u);
    double squares = 0;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      if (scene.labels[i] != rectangle.label) continue;
      const Vec3 d = scene.points[i] - rectangle.centre;
      squares += std::pow(d.dot(rectangle.normal), 2);
      EXPECT_LE(std::abs(d.dot(rectangle.u)), rectangle.half_u + 0.06);
      EXPECT_LE(std::abs(d.dot(v)), rectangle.half_v + 0.06);
    }
    EXPECT_NEAR(std::sqrt(squares / rectangle.points), 0.01, 0.01 * 5 / std::sqrt(2.0 * rectangle.points));
  }
}

TEST(Scenes, HaveParallelAndAttachedPairsAndSomeOutliers) {
  std::size_t clean = 0;
  for (std::uint32_t index = 0; index < 40; ++index) {
    const Scene scene = make_scene(3, index, {.planes = {8, 8}, .points = {3000, 3000}});
    const Truth truth = truth_of(scene);
    std::size_t parallel = 0, attached = 0;
    for (std::size_t a = 0; a < 8; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const SceneRectangle &p = scene.rectangles[a], &q = scene.rectangles[b];
        const double gap = rectangle_distance(*truth.planes[a].corners, *truth.planes[b].corners);
        const double cosine = std::abs(p.normal.dot(q.normal));
        parallel += cosine > 1 - 1e-12 && gap > 3.9 * p.noise && gap < 28.1 * p.noise ? 1u : 0u;
        attached += cosine < 1e-9 && gap < 1e-9 ? 1u : 0u;
      }
    }
    EXPECT_GE(parallel, 1u) << index;
    EXPECT_GE(attached, 1u) << index;
    clean += std::count(scene.labels.begin(), scene.labels.end(), kNoLabel) == 0 ? 1u : 0u;
  }
  EXPECT_GT(clean, 8u);
  EXPECT_LT(clean, 32u);
}

TEST(Scenes, ThatCannotBeAreRefused) {
  for (const SceneOptions& options :
       {SceneOptions{.planes = {0, 3}}, SceneOptions{.planes = {5, 3}},
        SceneOptions{.planes = {9, 9}, .points = {5, 30}}, SceneOptions{.noise = {0, 0.1}},
        SceneOptions{.noise = {0.1, 3}}, SceneOptions{.half_size = {0, 1}}, SceneOptions{.half_size = {1, 6}},
        SceneOptions{.outliers = 1}}) {
    const auto error = test::error_of([&] { make_scene(1, 0, options); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kUsage);
  }
}

TEST(Scenes, GoThroughFiles) {
  const test::TempFolder folder;
  const Scene scene = make_scene(4, 2, {.planes = {5, 5}, .points = {500, 500}});
  folder.write("b.csv", print_scene_points(scene));
  folder.write("b_planes.csv", print_scene_planes(scene));
  folder.write("a.csv", print_scene_points(scene));
  const std::vector<SceneFile> files = list_scenes(folder.path());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "a");
  const LabelledCloud back = read_scene(files[1]);
  const LabelledCloud made = as_read(scene);
  EXPECT_EQ(back.cloud.points, made.cloud.points);
  EXPECT_EQ(back.cloud.rows, made.cloud.rows);
  EXPECT_EQ(back.truth.labels, made.truth.labels);
  ASSERT_EQ(back.truth.planes.size(), 5u);
  EXPECT_EQ(back.truth.noise, made.truth.noise);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_LT((back.truth.planes[i].plane.normal - made.truth.planes[i].plane.normal).norm(), 1e-15);
  // Without the file of planes they are those of the points, as near as the noise lets them be.
  const LabelledCloud fitted = read_scene(files[0]);
  ASSERT_EQ(fitted.truth.planes.size(), 5u);
  EXPECT_FALSE(fitted.truth.planes[0].corners);
  EXPECT_GT(std::abs(fitted.truth.planes[0].plane.normal.dot(scene.rectangles[0].normal)), 0.99);
}

TEST(Scenes, DamagedFilesAreNamedWithTheirLine) {
  const test::TempFolder folder;
  folder.write("s.csv", "x,y,z,label\n0,0,0,1\n1,0,0,1\n0,1,0,2\n");
  const auto line_of = [&](const std::string& planes) {
    folder.write("s_planes.csv", "label,cx,cy,cz,nx,ny,nz,ux,uy,uz,half_u,half_v,points,sigma\n" + planes);
    const auto error = test::error_of([&] { read_scene(list_scenes(folder.path()).front()); });
    return error ? error->where().line : -1;
  };
  const std::string one = "1,0,0,0,0,0,1,1,0,0,1,1,2,0\n", two = "2,0,0,0,0,0,1,1,0,0,1,1,2,0\n";
  EXPECT_EQ(line_of(one + two), -1);
  EXPECT_EQ(line_of(one + one), 3);
  EXPECT_EQ(line_of(one), 2) << "label 2 has no plane";
  EXPECT_EQ(line_of(one + "2,0,0,0,0,0,2,1,0,0,1,1,2,0\n"), 3) << "a normal of length 2";
  EXPECT_EQ(line_of(one + "2,0,0\n"), 3);
}

TEST(Scenes, SharedOnesAreRead) {
  HALLWAY_DATA_OR_SKIP(data, "em_scenes");
  const std::vector<SceneFile> files = list_scenes(data);
  ASSERT_EQ(files.size(), 20u);
  std::size_t planes = 0;
  for (const SceneFile& file : files) planes += read_scene(file).truth.planes.size();
  EXPECT_EQ(planes, 228u);
}

}  // namespace
}  // namespace hallway::planes

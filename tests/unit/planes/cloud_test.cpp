// SPDX-License-Identifier: MIT
#include "planes/cloud.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "planes/fit.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/gray_png.hpp"
#include "support/temp_folder.hpp"

namespace hallway::planes {
namespace {

namespace test = hallway::test;
using Rows = std::vector<std::uint64_t>;
using Labels = std::vector<std::int64_t>;

class Clouds : public testing::Test {
 protected:
  Cloud read(const std::string& name, const std::string& content, const CloudOptions& options = {}) {
    return read_cloud(folder_.write(name, content), options);
  }
  Error refused(const std::string& name, const std::string& content, const CloudOptions& options = {}) {
    const auto error = test::error_of([&] { read(name, content, options); });
    EXPECT_TRUE(error) << content;
    return error ? *error : Error(ErrorCode::kInternal, "taken");
  }
  test::TempFolder folder_;
};

TEST_F(Clouds, CsvOfPoints) {
  const Cloud cloud = read("a.csv", "x,y,z\n1,2,3\n4,5,6\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.rows, (Rows{0, 1}));
  EXPECT_TRUE(cloud.labels.empty());
  EXPECT_EQ(cloud.n_rows, 2u);
}

TEST_F(Clouds, WhatIsNotFiniteIsLeftOutAndTheRowsKeepTheirNumbers) {
  const Cloud cloud = read("a.csv", "label,x,y,z\n7,1,2,3\n8,nan,0,0\n9,4,5,-inf\n-3,7,8,9\n,1,1,1\n");
  EXPECT_EQ(cloud.rows, (Rows{0, 3, 4}));
  EXPECT_EQ(cloud.labels, (Labels{7, kNoLabel, kNoLabel}));
  EXPECT_EQ(cloud.not_finite, 2u);
  EXPECT_EQ(cloud.n_rows, 5u);
}

TEST_F(Clouds, CsvWithColumnsOfOtherNames) {
  const CloudOptions options{.columns = {"x_m", "up", "z_m", "plane"}, .unlabelled = 0};
  const Cloud cloud = read("a.csv", "x_m,up,z_m,plane\n1,2,3,0\n4,5,6,2\n", options);
  EXPECT_EQ(cloud.points[1], Vec3(4, 5, 6));
  EXPECT_EQ(cloud.labels, (Labels{kNoLabel, 2}));
}

TEST_F(Clouds, VerticesOfObj) {
  const Cloud cloud =
      read("a.obj", "# points\nv 1 2 3\nvn 0 0 1\nv 4 5 6 1.0\nv nan 0 0\nf 1 2 3\nv 7 8 9\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(cloud.rows, (Rows{0, 1, 3}));
}

TEST_F(Clouds, PlyAndPcdAreToldByWhatTheyBeginWith) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n"
      "1 2 3\n4 5 6\n";
  const std::string pcd =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\nnan 2 3\n4 5 6\n";
  EXPECT_EQ(read("a.xyz", ply).points[1], Vec3(4, 5, 6));
  const Cloud cloud = read("a.data", pcd);
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{4, 5, 6}}));
  EXPECT_EQ(cloud.rows, Rows{1});
}

TEST_F(Clouds, DepthImageHasPixelsAsRows) {
  const std::string png = test::gray_png(2, 2, {0, 1000, 2000, 0});
  const CloudOptions options{.camera = import::Camera{2, 2, 0, 0}, .units_per_metre = 1000};
  const Cloud cloud = read("a.png", png, options);
  EXPECT_EQ(cloud.rows, (Rows{1, 2}));
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, -0.5, 0}, {2, 0, -1}}));
  EXPECT_EQ(cloud.image.width, 2u);
  EXPECT_EQ(cloud.image.height, 2u);
  EXPECT_EQ(cloud.image.pixels, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(refused("a.png", png).code(), ErrorCode::kUsage);
}

TEST_F(Clouds, WhatIsNoneIsRefusedWithFileAndLine) {
  EXPECT_EQ(refused("a.csv", "x,y,z\n1,2,3\n1,2\n").where().line, 3);
  EXPECT_EQ(refused("a.csv", "x,y,z\n1,two,3\n").where().line, 2);
  EXPECT_EQ(refused("a.csv", "x,y,z,label\n1,2,3,1.5\n").where().line, 2);
  EXPECT_EQ(refused("a.csv", "x,y\n1,2\n").code(), ErrorCode::kBadInput);
  EXPECT_EQ(refused("a.obj", "v 1 2\n").where().line, 1);
  EXPECT_EQ(refused("a.obj", "v 1 2 3").where().line, 1) << "cut off";
  EXPECT_NE(refused("a.txt", "1 2 3\n").where().file, "");
  EXPECT_NE(refused("a.csv", "").where().file, "");
  EXPECT_NE(refused("a.png", "no png", {.camera = import::Camera{}}).where().file, "");
}

TEST_F(Clouds, FilesWithoutPointsAreClouds) {
  EXPECT_TRUE(read("a.csv", "x,y,z\n").points.empty());
  EXPECT_TRUE(read("a.obj", "f 1 2 3\n").points.empty());
}

TEST_F(Clouds, LabelsStandInAFileOfTheirOwn) {
  const Cloud cloud = read("a.csv", "x,y,z\n1,2,3\nnan,0,0\n4,5,6\n");
  const auto labels = [&](const std::string& text) {
    return read_labels(folder_.write("labels.txt", text), cloud, 0);
  };
  EXPECT_EQ(labels("label\n3\n4\n5\n"), (Labels{3, 5}));
  EXPECT_EQ(labels("0\n4\n-2\n"), (Labels{kNoLabel, kNoLabel}));
  for (const char* text : {"3\n4\n", "3\nx\n5\n", "3\n4\n5", "", "label\nlabel\n1\n2\n3\n"})
    EXPECT_TRUE(test::error_of([&] { labels(text); })) << text;
}

TEST_F(Clouds, PlanesOfLabelsAreTheNearest) {
  const Cloud cloud =
      read("a.csv", "x,y,z,label\n0,0,1,5\n1,0,1,5\n0,1,1,5\n1,1,1,5\n9,9,9,-1\n0,0,0,2\n0,1,0,2\n0,0,1,2\n");
  const Truth truth = truth_of_labels(cloud);
  ASSERT_EQ(truth.planes.size(), 2u);
  EXPECT_EQ(truth.planes[0].label, 2);
  EXPECT_NEAR(std::abs(truth.planes[0].plane.normal.x()), 1, 1e-12);
  EXPECT_NEAR(std::abs(truth.planes[1].plane.normal.z()), 1, 1e-12);
  EXPECT_NEAR(std::abs(truth.planes[1].plane.offset), 1, 1e-12);
}

TEST(Fit, IsTheLeastSquaresPlane) {
  // Two points above and two below, each by 0.1: no plane is nearer than the one between them.
  const std::vector<Vec3> points{{0, 0, 1.1}, {2, 0, 0.9}, {2, 2, 1.1}, {0, 2, 0.9}};
  const Plane plane = least_squares_plane(points);
  EXPECT_NEAR(std::abs(plane.normal.z()), 1, 1e-12);
  for (const Vec3& point : points) EXPECT_NEAR(std::abs(plane.distance(point)), 0.1, 1e-12);
  const Plane of_one = least_squares_plane(std::vector<Vec3>{{1, 2, 3}});
  EXPECT_NEAR(of_one.distance(Vec3(1, 2, 3)), 0, 1e-12);
  EXPECT_NEAR(of_one.normal.norm(), 1, 1e-12);
}

TEST(RealClouds, AreRead) {
  HALLWAY_DATA_OR_SKIP(data, "clouds");
  const Cloud icl =
      read_cloud(data / "icl0_xyz_label.csv",
                 {.columns = {"x_m", "y_up_m", "z_fwd_m", "plane_label(0=none)"}, .unlabelled = 0});
  EXPECT_EQ(truth_of_labels(icl).planes.size(), 17u);
  EXPECT_GT(icl.points.size(), 200'000u);
  const Cloud kinect = read_cloud(data / "kinect_table_learn0.pcd", {});
  EXPECT_EQ(kinect.n_rows, 307'200u);
  EXPECT_EQ(kinect.points.size() + kinect.not_finite, kinect.n_rows);
}

}  // namespace
}  // namespace hallway::planes

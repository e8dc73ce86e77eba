// SPDX-License-Identifier: MIT
#include "import/tum_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/tum_scene.hpp"

namespace hallway::import {
namespace {

using test::TumScene;

/// How far a point is from the nearest surface of the room.
double off_surface(const Vec3& point) {
  return std::min({std::abs(point.x() - 4.0), std::abs(point.y() - 3.0), std::abs(point.z())});
}

class TumFolder : public testing::Test {
 protected:
  void SetUp() override { TumScene::write(folder_.path()); }
  TumOptions options() const {
    TumOptions options;
    options.camera = TumScene::kCamera;
    options.truth_within_ns = 60'000'000;
    return options;
  }
  std::string error_text(const TumOptions& chosen) const {
    const auto error = test::error_of([&] {
      const auto recording = open_tum(folder_.path(), chosen);
      Frame frame;
      for (std::uint32_t i = 0; i < recording->frames(); ++i) recording->read(i, frame);
    });
    return error ? error->what() : "none";
  }
  test::TempFolder folder_;
};

TEST_F(TumFolder, PointsLieOnTheRoomsSurfacesInTheWorld) {
  const auto recording = open_tum(folder_.path(), options());
  ASSERT_EQ(recording->frames(), TumScene::kFrames);
  EXPECT_TRUE(recording->has_truth());
  EXPECT_EQ(recording->period_ns(), 250'000'000);
  Frame frame;
  for (std::uint32_t i = 0; i < recording->frames(); ++i) {
    recording->read(i, frame);
    EXPECT_EQ(frame.t_ns, 100'000'000'000 + 250'000'000 * std::int64_t{i});
    const auto image = TumScene::image(i);
    const auto seen = static_cast<std::size_t>(
        image.size() - static_cast<std::size_t>(std::count(image.begin(), image.end(), 0)));
    EXPECT_EQ(frame.points.size(), seen);
    EXPECT_GT(seen, 300u);
    ASSERT_TRUE(frame.T_world_body);
    EXPECT_TRUE(frame.orientation_known);
    for (const auto& [x, y, z] : frame.points) {
      EXPECT_GT(x, 0.0) << "x is forward";
      // Depth comes in steps of 0.2 mm, and the true pose from two others of the same motion.
      EXPECT_LT(off_surface(*frame.T_world_body * Vec3(x, y, z)), 5e-4);
    }
  }
}

TEST_F(TumFolder, TheTruthIsThePoseOfABodyThatLooksAlongX) {
  Frame frame;
  open_tum(folder_.path(), options())->read(2, frame);
  const Pose T_world_optical = TumScene::camera_pose(0.5);
  EXPECT_LT((frame.T_world_body->t - T_world_optical.t).norm(), 1e-9);
  EXPECT_LT((frame.T_world_body->q * Vec3::UnitX() - T_world_optical.q * Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((frame.T_world_body->q * Vec3::UnitY() + T_world_optical.q * Vec3::UnitX()).norm(), 1e-9);
  EXPECT_LT((frame.T_world_body->q * Vec3::UnitZ() + T_world_optical.q * Vec3::UnitY()).norm(), 1e-9);
}

TEST_F(TumFolder, StrideTakesEachNthPixelOfEachNthRow) {
  TumOptions thin = options();
  thin.stride = 7;
  Frame frame;
  open_tum(folder_.path(), thin)->read(1, frame);
  const auto image = TumScene::image(1);
  PointList expected;
  std::vector<std::uint32_t> pixels;
  const std::uint32_t columns = (TumScene::kWidth + 6) / 7;
  for (std::uint32_t v = 0; v < TumScene::kHeight; v += 7) {
    for (std::uint32_t u = 0; u < TumScene::kWidth; u += 7) {
      const double z = image[v * TumScene::kWidth + u] / 5000.0;
      if (z == 0.0) continue;
      pixels.push_back(v / 7 * columns + u / 7);
      expected.push_back({z, -((u - 19.25) * z / 35.0), -((v - 14.5) * z / 36.0)});
    }
  }
  EXPECT_EQ(frame.points, expected);
  EXPECT_EQ(frame.image.width, columns);
  EXPECT_EQ(frame.image.height, (TumScene::kHeight + 6) / 7);
  EXPECT_EQ(frame.image.pixels, pixels);
}

TEST_F(TumFolder, FramesFarFromAllPosesHaveNone) {
  TumOptions strict = options();
  strict.truth_within_ns = 10'000'000;
  Frame frame;
  open_tum(folder_.path(), strict)->read(0, frame);
  EXPECT_FALSE(frame.T_world_body);
  std::filesystem::remove(folder_ / "groundtruth.txt");
  EXPECT_FALSE(open_tum(folder_.path(), options())->has_truth());
}

TEST_F(TumFolder, AssociationsNameTheDepthImageInEitherPlace) {
  std::filesystem::remove(folder_ / "depth.txt");
  const std::string image = "depth/100.250000.png";
  for (const std::string& line :
       {"100.25 " + image + " 100.24 rgb/1.png\n", "100.24 rgb/1.png 100.25 " + image + "\n"}) {
    folder_.write("associations.txt", line);
    Frame frame;
    open_tum(folder_.path(), options())->read(0, frame);
    EXPECT_EQ(frame.t_ns, 100'250'000'000);
    EXPECT_GT(frame.points.size(), 300u);
  }
  folder_.write("associations.txt", "100.24 rgb/1.png 100.25 ir/1.png\n");
  EXPECT_NE(error_text(options()).find("associations.txt:1: of two files exactly one"), std::string::npos);
}

TEST_F(TumFolder, ErrorsNameTheFile) {
  EXPECT_NE(error_text({}).find(".png: has 40 x 30 pixels; the default camera is for 640 x 480"),
            std::string::npos);
  folder_.write("depth/100.000000.png", "");
  EXPECT_NE(error_text(options()).find("depth/100.000000.png: cannot be read as PNG"), std::string::npos);
  std::filesystem::remove(folder_ / "depth/100.000000.png");
  EXPECT_NE(error_text(options()).find("100.000000.png: cannot open"), std::string::npos);
  folder_.write("groundtruth.txt", "1 2 3\n");
  EXPECT_NE(error_text(options()).find("groundtruth.txt:1:"), std::string::npos);
  folder_.write("groundtruth.txt", "1305031102175304000 0 0 0 0 0 0 1\n");
  EXPECT_NE(error_text(options()).find("is not from 0 to 9e9 seconds"), std::string::npos);
  std::filesystem::remove(folder_ / "depth.txt");
  EXPECT_NE(error_text(options()).find("has neither depth.txt nor associations.txt"), std::string::npos);
}

}  // namespace
}  // namespace hallway::import

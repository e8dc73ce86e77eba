// SPDX-License-Identifier: MIT
#include "log/map_landmarks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/file.hpp"
#include "support/errors.hpp"
#include "support/random_doubles.hpp"
#include "support/table_readers.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

const std::vector<MapLandmark> kMap = {{7, {1, -2.5, 0.1}, 12, LandmarkStatus::kMapped},
                                       {2, {0, 0, 0}, 1, LandmarkStatus::kTemporary},
                                       {kNoLandmark - 1, {4, 5, 6}, kNoLandmark, LandmarkStatus::kDynamic}};

TEST(MapLandmarks, ArePrintedInTheDocumentedForm) {
  EXPECT_EQ(print_map_landmarks(kMap),
            "id,x,y,z,observations,status\n"
            "7,1,-2.5,0.1,12,mapped\n"
            "2,0,0,0,1,temporary\n"
            "18446744073709551614,4,5,6,18446744073709551615,dynamic\n");
}

TEST(MapLandmarks, ReadBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(900, 5);
  std::vector<MapLandmark> map;
  for (std::size_t i = 0; i < 300; ++i) {
    map.push_back({i * i, {values[3 * i], values[3 * i + 1], values[3 * i + 2]}, i, LandmarkStatus(i % 3)});
  }
  const std::vector<MapLandmark> back = parse_map_landmarks(print_map_landmarks(map), "landmarks.csv");
  ASSERT_EQ(back.size(), map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_EQ(back[i].id, map[i].id);
    EXPECT_TRUE(std::equal(back[i].position_m.begin(), back[i].position_m.end(), map[i].position_m.begin(),
                           test::same_bits));
    EXPECT_EQ(back[i].observations, map[i].observations);
    EXPECT_EQ(back[i].status, map[i].status);
  }
}

TEST(MapLandmarks, CovariancesStandInColumnsOfTheirOwnWhereAnyIsTold) {
  std::vector<MapLandmark> map = kMap;
  map[1].covariance = {1, 0.5, 0, 2, -0.25, 1.0 / 3.0};
  const std::string text = print_map_landmarks(map);
  EXPECT_EQ(text.substr(0, text.find("\n2,0,0,0")),
            "id,x,y,z,observations,status,cov_xx,cov_xy,cov_xz,cov_yy,cov_yz,cov_zz\n"
            "7,1,-2.5,0.1,12,mapped,,,,,,");
  const std::vector<MapLandmark> back = parse_map_landmarks(text, "landmarks.csv");
  ASSERT_EQ(back.size(), map.size());
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_EQ(back[i].covariance, map[i].covariance);
}

TEST(MapLandmarks, APartOfACovarianceIsRefused) {
  const std::string header = "id,x,y,z,observations,status,cov_xx,cov_xy,cov_xz,cov_yy,cov_yz";
  for (const std::string& text : {header + "\n", header + ",cov_zz\n7,1,2,3,4,mapped,1,,,2,,3\n"}) {
    const auto error = test::error_of([&] { parse_map_landmarks(text, "landmarks.csv"); });
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput) << text;
  }
}

TEST(PoseCovariances, ReadBackToTheSameBits) {
  std::array<double, 36> matrix{};
  for (std::size_t i = 0; i < 36; ++i)
    matrix[i] = 1.0 / (1.0 + static_cast<double>(std::min(6 * (i / 6) + i % 6, 6 * (i % 6) + i / 6)));
  RowWriter out(',');
  out.word(kPoseCovarianceColumns).end_row();
  add_row(out, IterationCovariance{3, upper_triangle(matrix)});
  add_row(out, IterationCovariance{9, PoseCovariance{1.0}});
  const std::vector<IterationCovariance> back =
      test::parse_pose_covariances(out.take(), "pose_covariances.csv");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].iteration, 3u);
  EXPECT_EQ(back[0].covariance, upper_triangle(matrix));
  EXPECT_EQ(back[0].covariance[6], matrix[7]) << "yy";
  EXPECT_EQ(back[0].covariance[20], matrix[35]) << "cc";
  EXPECT_EQ(back[1].covariance, PoseCovariance{1.0});
}

TEST(LandmarkStatus, NamesReadBack) {
  for (const auto status : {LandmarkStatus::kTemporary, LandmarkStatus::kMapped, LandmarkStatus::kDynamic}) {
    EXPECT_EQ(landmark_status(landmark_status_name(status)), status);
  }
  EXPECT_EQ(landmark_status("Mapped"), std::nullopt);
  EXPECT_EQ(landmark_status(""), std::nullopt);
}

TEST(LandmarksPly, IsAnAsciiPointCloud) {
  EXPECT_EQ(print_landmarks_ply(kMap),
            "ply\n"
            "format ascii 1.0\n"
            "comment landmarks in the map frame, metres\n"
            "comment status: 0 temporary, 1 mapped, 2 dynamic\n"
            "element vertex 3\n"
            "property double x\n"
            "property double y\n"
            "property double z\n"
            "property uint id\n"
            "property uint observations\n"
            "property uchar status\n"
            "end_header\n"
            "1 -2.5 0.1 7 12 1\n"
            "0 0 0 2 1 0\n"
            "4 5 6 4294967295 4294967295 2\n");
}

TEST(LandmarksPly, OfNothingHasNoVertex) {
  EXPECT_NE(print_landmarks_ply({}).find("element vertex 0\n"), std::string::npos);
}

TEST(MapLandmarks, GoThroughFiles) {
  const test::TempFolder folder;
  write_map_landmarks(folder / "landmarks.csv", kMap);
  write_landmarks_ply(folder / "landmarks.ply", kMap);
  EXPECT_EQ(print_map_landmarks(read_map_landmarks(folder / "landmarks.csv")), print_map_landmarks(kMap));
  EXPECT_EQ(read_file(folder / "landmarks.ply"), print_landmarks_ply(kMap));
}

}  // namespace
}  // namespace hallway::log

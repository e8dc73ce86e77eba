// SPDX-License-Identifier: MIT
#include "import/landmark_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "import/kind.hpp"
#include "import/point_table.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::import {
namespace {

constexpr std::int64_t kTenth_ns = 100'000'000;

class LandmarkTables : public testing::Test {
 protected:
  std::string stereo_error(const std::string& text) const {
    const std::string path = folder_.write("bad_obs3d.csv", text);
    const auto error = test::error_of([&] { open_stereo_tracks(path, {}); });
    return error ? error->what() : "none";
  }
  test::TempFolder folder_;
};

TEST_F(LandmarkTables, StereoTracksWithPosesOfTheCamera) {
  const std::string path = folder_.write("a_obs3d.csv",
                                         "frame,t_s,id,x_right_m,y_down_m,z_fwd_m,uL\n"
                                         "0,0.5,7,1,2,10,99\n0,0.5,3,-1,0.5,20,98\n2,0.75,3,0,0,19,97\n");
  // At frame 2 the camera is 2 m ahead and looks to the right by a quarter turn.
  folder_.write("a_ins_campose.csv",
                "frame,t_s,r00,r01,r02,tx,r10,r11,r12,ty,r20,r21,r22,tz\n"
                "0,0.5,1,0,0,0,0,1,0,0,0,0,1,0\n2,0.75,0,0,1,0,0,1,0,0,-1,0,0,2\n");
  EXPECT_EQ(tell_kind(path), Kind::kStereoTracks);
  const auto recording = open_stereo_tracks(path, {});
  ASSERT_EQ(recording->frames(), 3u);
  EXPECT_TRUE(recording->has_tracks());
  EXPECT_FALSE(recording->has_identities());
  EXPECT_TRUE(recording->has_truth());
  Frame frame;
  recording->read(0, frame);
  EXPECT_EQ(frame.t_ns, 500'000'000);
  EXPECT_EQ(frame.points, (PointList{{10, -1, -2}, {20, 1, -0.5}}));
  EXPECT_EQ(frame.tracks, (std::vector<log::TrackId>{7, 3}));
  EXPECT_TRUE(frame.identities.empty());
  recording->read(1, frame);
  EXPECT_EQ(frame.t_ns, 625'000'000) << "in the middle";
  EXPECT_TRUE(frame.points.empty());
  EXPECT_FALSE(frame.T_world_body);
  recording->read(2, frame);
  EXPECT_EQ(frame.tracks, std::vector<log::TrackId>{3});
  ASSERT_TRUE(frame.T_world_body);
  EXPECT_NEAR((frame.T_world_body->t - Vec3(2, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((*frame.T_world_body * Vec3(1, 0, 0) - Vec3(2, -1, 0)).norm(), 0.0, 1e-12)
      << "it looks to the right";
}

TEST_F(LandmarkTables, RangeAndBearingWithTruthOfMrptsForm) {
  const std::string path =
      folder_.write("b_obs.csv",
                    "frame,t_s,id,range_m,yaw_rad,pitch_rad\n"
                    "0,10,5,2,0,0\n0,10,6,3,1.5707963267948966,0\n1,11,5,4,0,0.5235987755982988\n");
  folder_.write("b_ground_truth_robot_path.txt",
                "% x y z yaw pitch roll\n0 0 0 0 0 0\n1 0 0 1.5707963267948966 0 0\n");
  folder_.write("b_ground_truth.txt", "2 0 0 5 0 0.0 5\n0 3 0 5 0 0.0 6 \n");
  EXPECT_EQ(tell_kind(path), Kind::kRangeBearing);
  const auto recording = open_range_bearing(path, {});
  ASSERT_EQ(recording->frames(), 2u);
  EXPECT_TRUE(recording->has_identities());
  EXPECT_FALSE(recording->has_tracks());
  Frame frame;
  recording->read(0, frame);
  ASSERT_EQ(frame.points.size(), 2u);
  EXPECT_EQ(frame.points[0], (std::array<double, 3>{2, 0, 0}));
  EXPECT_NEAR(frame.points[1][1], 3.0, 1e-12) << "to the left";
  EXPECT_EQ(frame.identities, (std::vector<log::LandmarkId>{5, 6}));
  recording->read(1, frame);
  EXPECT_NEAR(frame.points[0][0], 4.0 * std::cos(0.5235987755982988), 1e-12);
  EXPECT_NEAR(frame.points[0][2], -2.0, 1e-12) << "downwards";
  ASSERT_TRUE(frame.T_world_body);
  EXPECT_NEAR((*frame.T_world_body * Vec3(1, 0, 0) - Vec3(1, 1, 0)).norm(), 0.0, 1e-12);
  ASSERT_TRUE(recording->true_landmarks());
  ASSERT_EQ(recording->true_landmarks()->size(), 2u);
  EXPECT_EQ((*recording->true_landmarks())[1].id, 6u);
  EXPECT_EQ((*recording->true_landmarks())[1].position_m, (std::array<double, 3>{0, 3, 0}));
}

TEST_F(LandmarkTables, WithoutTimesAFrameAPeriod) {
  const PointTable table = parse_point_table("id,frame,z_fwd_m,x_right_m,y_down_m\n1,2,3,4,5\n", "a.csv",
                                             PointColumns::kCamera, kTenth_ns);
  EXPECT_EQ(table.t_ns, (std::vector<std::int64_t>{200'000'000, 200'000'000, 200'000'000}));
  EXPECT_EQ(table.points, (PointList{{3, -4, -5}}));
}

TEST_F(LandmarkTables, ATableIsToldByItsFirstLineAlone) {
  EXPECT_EQ(point_columns_of("frame,id,x_right_m,y_down_m,z_fwd_m\r"), PointColumns::kCamera);
  EXPECT_EQ(point_columns_of("range_m,pitch_rad,yaw_rad,id,frame"), PointColumns::kSpherical);
  EXPECT_FALSE(point_columns_of("iteration,x,y,z"));
  EXPECT_FALSE(point_columns_of(""));
  EXPECT_FALSE(tell_kind(folder_.write("obs.csv", "iteration,landmark_id,x,y,z\n0,1,2,3,4\n")));
}

TEST_F(LandmarkTables, BadLinesAreErrorsWithTheLine) {
  const std::string head = "frame,t_s,id,x_right_m,y_down_m,z_fwd_m\n";
  const std::pair<std::string, std::string> cases[] = {
      {head, "has no points"},
      {head + "1,0,0,0,0,1\n0,0,0,0,0,1\n", "obs3d.csv:3: column frame: a frame not below 1"},
      {head + "0,0,4,0,0,1\n0,0,4,0,0,1\n", "obs3d.csv:3: column id"},
      {head + "0,1,4,0,0,1\n0,2,5,0,0,1\n", "obs3d.csv:3: column t_s"},
      {head + "0,1,4,0,0,1\n1,0.5,4,0,0,1\n", "obs3d.csv:3: column t_s"},
      {head + "0,1e10,4,0,0,1\n", "obs3d.csv:2: column t_s"},
      {head + "0,1,-4,0,0,1\n", "obs3d.csv:2: column id"},
      {head + "0,1,4,0,nan,1\n", "obs3d.csv:2: column y_down_m"},
      {head + "90000000,1,4,0,0,1\n", "obs3d.csv:2: column frame: a frame at most 1000 above the last"},
      {"frame,t_s,id,x_right_m,y_down_m\n", "has no column \"z_fwd_m\""},
  };
  for (const auto& [text, words] : cases) {
    EXPECT_NE(stereo_error(text).find(words), std::string::npos) << stereo_error(text);
  }
  const std::string table = folder_.write("c_obs.csv", "frame,id,range_m,yaw_rad,pitch_rad\n0,0,1,0,0\n");
  const std::pair<const char*, const char*> truths[] = {
      {"1 2 3 4 5\n", "path.txt:1: 6 to 6 numbers"},
      {"% a\n1 2 3 4 5 x\n", "path.txt:2: a number is needed"},
      {"1 2 3 4 5 nan\n", "path.txt:1: a number is needed"}};
  for (const auto& [text, words] : truths) {
    const std::string poses = folder_.write("path.txt", text);
    const auto error = test::error_of([&] { open_range_bearing(table, {.true_poses = poses}); });
    ASSERT_TRUE(error);
    EXPECT_NE(std::string(error->what()).find(words), std::string::npos) << error->what();
  }
  const std::string twice = folder_.write("twice.txt", "1 2 3 9\n1 2 3 9\n");
  EXPECT_TRUE(test::error_of([&] { open_range_bearing(table, {.true_landmarks = twice}); }));
}

TEST_F(LandmarkTables, APoseThatIsNoRotationIsAnError) {
  const std::string head = "frame,r00,r01,r02,tx,r10,r11,r12,ty,r20,r21,r22,tz\n";
  const std::string table = folder_.write("d_obs3d.csv", "frame,id,x_right_m,y_down_m,z_fwd_m\n0,0,1,0,5\n");
  for (const char* row : {"0,1,0,0,0,0,1,0,0,0,0,2,0\n", "0,1,0,0,0,0,1,0,0,0,0,-1,0\n"}) {
    folder_.write("d_ins_campose.csv", head + row);
    const auto error = test::error_of([&] { open_stereo_tracks(table, {}); });
    ASSERT_TRUE(error);
    EXPECT_NE(std::string(error->what()).find("d_ins_campose.csv:2"), std::string::npos) << error->what();
  }
}

TEST_F(LandmarkTables, PosesOfFramesBeyondTheTableTakeNoMemory) {
  const std::string table = folder_.write("e_obs3d.csv", "frame,id,x_right_m,y_down_m,z_fwd_m\n0,0,1,0,5\n");
  folder_.write("e_ins_campose.csv",
                "frame,r00,r01,r02,tx,r10,r11,r12,ty,r20,r21,r22,tz\n"
                "0,1,0,0,0,0,1,0,0,0,0,1,7\n99999999,1,0,0,0,0,1,0,0,0,0,1,0\n");
  const auto recording = open_stereo_tracks(table, {});
  EXPECT_EQ(recording->frames(), 1u);
  Frame frame;
  recording->read(0, frame);
  ASSERT_TRUE(frame.T_world_body);
  EXPECT_EQ(frame.T_world_body->t.x(), 7.0);
}

TEST(LandmarkTablesData, TheDemosPointsLieOnItsTrueLandmarks) {
  HALLWAY_DATA_OR_SKIP(folder, "landmarks");
  const auto recording = open_range_bearing(folder / "kf-slam_6D_demo_obs.csv", {});
  ASSERT_EQ(recording->frames(), 600u);
  Frame frame;
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t i = 0; i < recording->frames(); ++i) {
    recording->read(i, frame);
    ASSERT_TRUE(frame.T_world_body);
    for (std::size_t k = 0; k < frame.points.size(); ++k) {
      const auto& landmarks = *recording->true_landmarks();
      const auto truth = std::find_if(landmarks.begin(), landmarks.end(),
                                      [&](const log::Landmark& l) { return l.id == frame.identities[k]; });
      ASSERT_NE(truth, landmarks.end());
      const auto& p = frame.points[k];
      const auto& t = truth->position_m;
      sum += (*frame.T_world_body * Vec3(p[0], p[1], p[2]) - Vec3(t[0], t[1], t[2])).squaredNorm();
      ++count;
    }
  }
  EXPECT_EQ(count, 5824);
  EXPECT_NEAR(std::sqrt(sum / count), 0.0189, 1e-4) << "its noise";
}

}  // namespace
}  // namespace hallway::import

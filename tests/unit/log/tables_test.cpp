// SPDX-License-Identifier: MIT
// The small tables: poses, true landmarks, pairs of ids, times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/file.hpp"
#include "base/random.hpp"
#include "log/command_file.hpp"
#include "log/id_pairs.hpp"
#include "log/landmarks.hpp"
#include "log/map_landmarks.hpp"
#include "log/plane_landmarks.hpp"
#include "log/plane_observations.hpp"
#include "log/pose_errors.hpp"
#include "log/poses.hpp"
#include "log/row_file.hpp"
#include "log/submap_poses.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/random_doubles.hpp"
#include "support/table_readers.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

using test::error_of;
using test::same_bits;

template <std::size_t N>
bool same(const std::array<double, N>& a, const std::array<double, N>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), same_bits);
}

/// A unit quaternion with full mantissas.
std::array<double, 4> random_orientation(std::uint32_t step) {
  const Random random(7, stream_id("test.orientation"));
  std::array<double, 4> q{random.normal(step, 0), random.normal(step, 1), random.normal(step, 2),
                          random.normal(step, 3)};
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& value : q) value /= norm;
  return q;
}

TEST(Poses, ReadBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(900, 2);
  std::vector<IterationPose> poses;
  for (std::uint32_t i = 0; i < 300; ++i) {
    poses.push_back({i * i, {values[3 * i], values[3 * i + 1], values[3 * i + 2]}, random_orientation(i)});
  }
  const std::vector<IterationPose> back = parse_poses(print_poses(poses), "poses.csv");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].iteration, poses[i].iteration);
    EXPECT_TRUE(same(back[i].position_m, poses[i].position_m)) << i;
    EXPECT_TRUE(same(back[i].orientation, poses[i].orientation)) << i;
  }
}

TEST(Poses, ArePrintedInTheDocumentedForm) {
  const std::vector<IterationPose> poses = {{3, {1, 2.5, -3}, {0.6, 0, 0, -0.8}}};
  EXPECT_EQ(print_poses(poses), "iteration,x,y,z,qw,qx,qy,qz\n3,1,2.5,-3,0.6,0,0,-0.8\n");
}

TEST(Poses, ColumnsMayStandInAnyOrder) {
  const auto poses = parse_poses("qz,qy,qx,qw,z,y,x,iteration\n-0.8,0,0,0.6,3,2,1,9\n", "poses.csv");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].iteration, 9u);
  EXPECT_TRUE(same(poses[0].position_m, {1, 2, 3}));
  EXPECT_TRUE(same(poses[0].orientation, {0.6, 0, 0, -0.8}));
}

TEST(Poses, MayBePositionsAlone) {
  const std::string text = "iteration,x,y,z\n2,1,2.5,-3\n";
  const auto poses = parse_poses(text, "poses.csv");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_FALSE(poses[0].orientation_known);
  EXPECT_TRUE(same(poses[0].position_m, {1, 2.5, -3}));
  EXPECT_EQ(print_poses(poses), text);
}

TEST(PlaneLandmarks, ReadBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(40, 5);
  std::vector<PlaneLandmark> planes(2);
  std::size_t next = 0;
  const auto three = [&] {
    next += 3;
    return std::array{values[next - 3], values[next - 2], values[next - 1]};
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes[i] = {.id = kNoLandmark - 1 - i,
                 .observations = 7 + i,
                 .status = i == 0 ? LandmarkStatus::kDynamic : LandmarkStatus::kMapped,
                 .normal = three(),
                 .offset_m = values[39 - i]};
    for (std::size_t k = 0; k < 4 - i; ++k) planes[i].outline.push_back({three(), k == 1});
  }
  EXPECT_EQ(parse_plane_landmarks(print_plane_landmarks(planes), "mapped_planes.csv"), planes);
}

TEST(PlaneLandmarks, ArePrintedInTheDocumentedForm) {
  const std::string text =
      "plane_id,observations,status,nx,ny,nz,offset_m,corner,x,y,z,edge_certain\n"
      "4,9,mapped,0,0,1,2,0,0,0,2,0\n4,9,mapped,0,0,1,2,1,1,0,2,1\n4,9,mapped,0,0,1,2,2,1,1,2,0\n";
  EXPECT_EQ(print_plane_landmarks(parse_plane_landmarks(text, "mapped_planes.csv")), text);
}

TEST(PlaneLandmarks, AreRefusedWhereTheirCornersAreNotInARow) {
  const std::string header = "plane_id,observations,status,nx,ny,nz,offset_m,corner,x,y,z,edge_certain\n";
  const auto row = [](int plane, int corner) {
    return std::to_string(plane) + ",9,mapped,0,0,1,2," + std::to_string(corner) + ",0,0,2,0\n";
  };
  const std::string whole = row(4, 0) + row(4, 1) + row(4, 2);
  EXPECT_FALSE(error_of([&] { parse_plane_landmarks(header + whole, "t"); }));
  for (const std::string& rows :
       {row(4, 1), row(4, 0) + row(4, 2), row(4, 0) + row(4, 1), whole + row(5, 3), whole + whole,
        row(4, 0) + row(4, 1) + row(5, 0), whole + "5,9,gone,0,0,1,2,0,0,0,2,0\n"}) {
    EXPECT_TRUE(error_of([&] { parse_plane_landmarks(header + rows, "t"); })) << rows;
  }
}

TEST(SubmapPoses, ReadBackToTheSameBits) {
  const std::vector<SubmapPose> poses{{5, {0.1, -1e-300, 1.0 / 3.0}, {0.5, -0.5, 0.5, -0.5}}, {0, {1, 2, 3}}};
  EXPECT_EQ(parse_submap_poses(print_submap_poses(poses), "submap_poses.csv"), poses);
  EXPECT_TRUE(error_of(
      [] { parse_submap_poses("submap_id,x,y,z,qw,qx,qy,qz\n1,0,0,0,2,0,0,0\n", "submap_poses.csv"); }));
}

TEST(PoseErrors, ArePrintedInTheDocumentedForm) {
  EXPECT_EQ(print_pose_errors(std::vector<PoseErrorRow>{{3, 0.5, -0.25}}),
            "iteration,position_m,heading_deg\n3,0.5,-0.25\n");
}

TEST(IdPairs, ReadBackToTheSameValues) {
  const std::vector<IdPair> pairs = {{3, 9}, {3, kNoLandmark - 1}, {0, 9}};
  const std::string text = print_id_pairs(pairs, kSubmapColumns);
  EXPECT_EQ(text, "submap_id,landmark_id\n3,9\n3,18446744073709551614\n0,9\n");
  EXPECT_EQ(print_id_pairs(parse_id_pairs(text, "submaps.csv", kSubmapColumns), kSubmapColumns), text);
}

TEST(IdPairs, RefuseATableOfOtherColumns) {
  const std::string text = print_id_pairs({}, kMatchColumns);
  EXPECT_EQ(text, "landmark_id,true_landmark_id\n");
  EXPECT_TRUE(error_of([&] { parse_id_pairs(text, "submaps.csv", kSubmapColumns); }));
}

TEST(Landmarks, ReadBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(900, 3);
  std::vector<Landmark> landmarks;
  for (std::size_t i = 0; i < 300; ++i) {
    landmarks.push_back({kNoLandmark - 1 - i, {values[3 * i], values[3 * i + 1], values[3 * i + 2]}});
  }
  const std::vector<Landmark> back = parse_landmarks(print_landmarks(landmarks), "landmarks.csv");
  ASSERT_EQ(back.size(), landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    EXPECT_EQ(back[i].id, landmarks[i].id);
    EXPECT_TRUE(same(back[i].position_m, landmarks[i].position_m)) << i;
  }
}

TEST(Landmarks, ThatMoveAreMarkedInAColumnThatIsThereForThem) {
  const std::vector<Landmark> landmarks{{5, {1, 2, 0.1}}, {6, {0, 0, 0}, true}};
  const std::string text = print_landmarks(landmarks);
  EXPECT_EQ(text, "landmark_id,x,y,z,moving\n5,1,2,0.1,0\n6,0,0,0,1\n");
  const std::vector<Landmark> back = parse_landmarks(text, "landmarks.csv");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_FALSE(back[0].moving);
  EXPECT_TRUE(back[1].moving);
}

TEST(Landmarks, ArePrintedInTheDocumentedForm) {
  EXPECT_EQ(print_landmarks(std::vector<Landmark>{{5, {1, 2, 0.1}}}), "landmark_id,x,y,z\n5,1,2,0.1\n");
}

TEST(Timing, ReadsBackToTheSameBits) {
  std::vector<IterationTime> times;
  const std::vector<double> values = test::random_doubles(600, 4);
  for (std::uint32_t i = 0; i < 300; ++i) {
    times.push_back({i, std::abs(values[2 * i]), std::abs(values[2 * i + 1])});
  }
  const std::vector<IterationTime> back =
      test::parse_timing(print_table(kTimingColumns, times), "timing.csv");
  ASSERT_EQ(back.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(back[i].iteration, times[i].iteration);
    EXPECT_TRUE(same_bits(back[i].wall_ms, times[i].wall_ms));
    EXPECT_TRUE(same_bits(back[i].cpu_ms, times[i].cpu_ms));
  }
}

TEST(Timing, IsPrintedInTheDocumentedForm) {
  EXPECT_EQ(print_table(kTimingColumns, std::vector<IterationTime>{{2, 0.25, 0.125}}),
            "iteration,wall_ms,cpu_ms\n2,0.25,0.125\n");
}

TEST(Commands, ReadBackToTheSameBits) {
  std::vector<IterationCommand> commands;
  const std::vector<double> values = test::random_doubles(600, 9);
  for (std::uint32_t i = 0; i < 200; ++i)
    commands.push_back({3 * i, values[3 * i], values[3 * i + 1], values[3 * i + 2]});
  const std::vector<IterationCommand> back = test::parse_commands(print_commands(commands), "commands.csv");
  ASSERT_EQ(back.size(), commands.size());
  for (std::size_t i = 0; i < commands.size(); ++i) {
    EXPECT_EQ(back[i].iteration, commands[i].iteration);
    EXPECT_TRUE(same_bits(back[i].linear_m_s, commands[i].linear_m_s));
    EXPECT_TRUE(same_bits(back[i].angular_rad_s, commands[i].angular_rad_s));
    EXPECT_TRUE(same_bits(back[i].lateral_m_s, commands[i].lateral_m_s));
  }
}

TEST(Commands, ArePrintedInTheDocumentedForm) {
  const std::vector<IterationCommand> ahead{{2, 0.25, -0.5}};
  EXPECT_EQ(print_commands(ahead), "iteration,linear_m_s,angular_rad_s\n2,0.25,-0.5\n");
  const std::vector<IterationCommand> sideways{{2, 0.25, -0.5}, {3, 0, 0, 0.125}};
  EXPECT_EQ(print_commands(sideways),
            "iteration,linear_m_s,angular_rad_s,lateral_m_s\n2,0.25,-0.5,0\n3,0,0,0.125\n");
}

TEST(Commands, AFileThatGrowsHasTheBytesOfTheTable) {
  const test::TempFolder folder;
  for (const std::size_t first_sideways : {0u, 1u, 9'000u, 20'000u}) {
    std::vector<IterationCommand> commands;
    const std::filesystem::path path = folder / std::to_string(first_sideways);
    CommandFile file(path);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      commands.push_back({i, 0.1 * i, -1.0 / (i + 1), i >= first_sideways && i % 3 == 0 ? 0.01 * i + 1 : 0});
      file.add(commands.back());
    }
    file.close();
    EXPECT_EQ(read_file(path), print_commands(commands));
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".narrow"));
  }
}

TEST(Commands, WhatIsWrongIsNamedWithItsLine) {
  const std::string head = "iteration,linear_m_s,angular_rad_s\n0,1,0\n";
  for (const char* row : {"0,1,0\n", "1,nan,0\n", "1,1\n", "1,1,x\n", "1,1,0"}) {
    const auto error = test::error_of([&] { test::parse_commands(head + row, "c.csv"); });
    ASSERT_TRUE(error) << row;
    EXPECT_EQ(error->where().line, 3) << row;
  }
}

TEST(PlaneTable, ReadBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(100 * 21, 9);
  std::vector<IterationPlane> planes;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const double* v = &values[21 * i];
    planes.push_back(
        {i / 3,
         {.id = UINT64_MAX - i,
          .normal = {v[0], v[1], v[2]},
          .offset_m = v[3],
          .centroid_m = {v[4], v[5], v[6]},
          .corners_m =
              {{{v[7], v[8], v[9]}, {v[10], v[11], v[12]}, {v[13], v[14], v[15]}, {v[16], v[17], v[18]}}},
          .points = i,
          .rms_m = v[19],
          .exclusive_share = v[20]}});
  }
  const std::string text = print_table(kPlaneColumns, planes);
  const std::vector<IterationPlane> back = parse_planes(text, "planes.csv");
  ASSERT_EQ(back.size(), planes.size());
  EXPECT_EQ(print_table(kPlaneColumns, back), text);
  EXPECT_EQ(back[50].iteration, 16u);
  EXPECT_EQ(back[50].plane.id, UINT64_MAX - 50);
  EXPECT_TRUE(same_bits(back[50].plane.normal[1], values[21 * 50 + 1]));
  EXPECT_TRUE(same_bits(back[50].plane.corners_m[3][2], values[21 * 50 + 18]));
  EXPECT_TRUE(same_bits(back[50].plane.exclusive_share, values[21 * 50 + 20]));
}

TEST(PlaneTable, WhatIsWrongIsNamedWithItsLine) {
  const std::string good = print_table(kPlaneColumns, std::vector<IterationPlane>{{2, {.id = 1}}});
  const std::string row = good.substr(good.find('\n') + 1);
  EXPECT_EQ(parse_planes(good + row, "p.csv").size(), 2u) << "several of one iteration";
  for (const std::string& bad : {"1" + row.substr(1), "x" + row.substr(1), row.substr(0, row.size() - 1),
                                 row.substr(0, row.size() - 3) + "\n"}) {
    const auto error = test::error_of([&] { parse_planes(good + bad, "p.csv"); });
    ASSERT_TRUE(error) << bad;
    EXPECT_EQ(error->where().line, 3) << bad;
  }
}

TEST(RowFile, HoldsMoreRowsThanItsMemory) {
  const test::TempFolder folder;
  RowFile file(folder / "commands.csv", ',', kCommandColumns);
  std::vector<IterationCommand> commands;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    commands.push_back({i, 0.1 * i, -0.3 * i});
    add_row(file.next_row(), commands.back());
  }
  file.close();
  EXPECT_EQ(read_file(folder / "commands.csv"), print_table(kCommandColumns, commands));
  EXPECT_EQ(test::parse_commands(read_file(folder / "commands.csv"), "commands.csv").size(), commands.size());
}

TEST(Tables, GoThroughFiles) {
  const test::TempFolder folder;
  write_poses(folder / "poses.csv", std::vector<IterationPose>{{1, {1, 2, 3}, {1, 0, 0, 0}}});
  write_landmarks(folder / "landmarks.csv", std::vector<Landmark>{{4, {1, 2, 3}}});
  RowFile times(folder / "timing.csv", ',', kTimingColumns);
  add_row(times.next_row(), IterationTime{6, 1.5, 0.5});
  times.close();
  EXPECT_EQ(read_poses(folder / "poses.csv").at(0).iteration, 1u);
  EXPECT_EQ(read_landmarks(folder / "landmarks.csv").at(0).id, 4u);
  EXPECT_EQ(test::parse_timing(read_file(folder / "timing.csv"), "timing.csv").at(0).wall_ms, 1.5);
}

TEST(Tables, ReadTheTruthOfARecordedLog) {
  HALLWAY_DATA_OR_SKIP(folder, "landmark_logs/figure8_d25");
  EXPECT_EQ(read_poses(folder / "gt_poses.csv").size(), 7600u);
  EXPECT_EQ(read_landmarks(folder / "gt_landmarks.csv").size(), 286u);
}

struct BadTable {
  std::string name;
  std::function<void(const std::string&)> parse;
  std::string text;
  std::string message;  ///< the whole of what()
};

class BadTables : public testing::TestWithParam<BadTable> {};

TEST_P(BadTables, GiveFileLineAndCause) {
  const auto error = error_of([] { GetParam().parse(GetParam().text); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_STREQ(error->what(), GetParam().message.c_str());
}

void poses(const std::string& text) {
  parse_poses(text, "t.csv");
}
void landmarks(const std::string& text) {
  parse_landmarks(text, "t.csv");
}
void map_landmarks(const std::string& text) {
  parse_map_landmarks(text, "t.csv");
}
void timing(const std::string& text) {
  test::parse_timing(text, "t.csv");
}

const std::string kPoses = "iteration,x,y,z,qw,qx,qy,qz\n4,0,0,0,1,0,0,0\n";
const std::string kLandmarks = "landmark_id,x,y,z\n4,0,0,0\n";
const std::string kMap = "id,x,y,z,observations,status\n4,0,0,0,9,mapped\n";
const std::string kTiming = "iteration,wall_ms,cpu_ms\n4,1,1\n";
const std::string kCutOff = "t.csv:3: the last line has no line end: the file seems to be cut off here";

INSTANTIATE_TEST_SUITE_P(
    Tables, BadTables,
    testing::Values(
        BadTable{"pose_missing_column", poses, "iteration,x,y\n",
                 "t.csv:1: the header has no column \"z\"; needed: iteration,x,y,z (optional: "
                 "qw,qx,qy,qz); it is: "
                 "iteration,x,y"},
        BadTable{"pose_part_of_quaternion", poses, "iteration,x,y,z,qw,qx,qy\n",
                 "t.csv:1: the header has a part of the columns qw,qx,qy,qz; give all or none"},
        BadTable{"pose_repeated", poses, kPoses + "4,0,0,0,1,0,0,0\n",
                 "t.csv:3: column iteration: an iteration above 4 is needed, \"4\" found"},
        BadTable{"pose_backwards", poses, kPoses + "3,0,0,0,1,0,0,0\n",
                 "t.csv:3: column iteration: an iteration above 4 is needed, \"3\" found"},
        BadTable{"pose_zero_quaternion", poses, kPoses + "5,0,0,0,0,0,0,0\n",
                 "t.csv:3: the quaternion qw,qx,qy,qz does not have unit length"},
        BadTable{"pose_long_quaternion", poses, kPoses + "5,0,0,0,1,0,0,0.2\n",
                 "t.csv:3: the quaternion qw,qx,qy,qz does not have unit length"},
        BadTable{"pose_huge_quaternion", poses, kPoses + "5,0,0,0,1e308,1e308,1e308,1e308\n",
                 "t.csv:3: the quaternion qw,qx,qy,qz does not have unit length"},
        BadTable{"pose_nan", poses, kPoses + "5,0,nan,0,1,0,0,0\n",
                 "t.csv:3: column y: a finite number is needed, \"nan\" found"},
        BadTable{"pose_cut_off", poses, kPoses + "5,0,0,0,1,0,0,0", kCutOff},
        BadTable{"landmark_twice", landmarks, kLandmarks + "4,1,1,1\n",
                 "t.csv:3: landmark 4 stands here for the second time"},
        BadTable{"landmark_negative", landmarks, kLandmarks + "-1,1,1,1\n",
                 "t.csv:3: column landmark_id: a whole number from 0 to 18446744073709551614 is needed, "
                 "\"-1\" found"},
        BadTable{"landmark_infinite", landmarks, kLandmarks + "5,1,1,inf\n",
                 "t.csv:3: column z: a finite number is needed, \"inf\" found"},
        BadTable{"landmark_moving_twice", landmarks, "landmark_id,x,y,z,moving\n4,0,0,0,2\n",
                 "t.csv:2: column moving: a whole number from 0 to 1 is needed, \"2\" found"},
        BadTable{"landmark_cut_off", landmarks, kLandmarks + "5,1,1,1", kCutOff},
        BadTable{"map_given_as_truth", landmarks, kMap,
                 "t.csv:1: the header has no column \"landmark_id\"; needed: landmark_id,x,y,z (optional: "
                 "moving); it is: "
                 "id,x,y,z,observations,status"},
        BadTable{"map_twice", map_landmarks, kMap + "4,1,1,1,1,mapped\n",
                 "t.csv:3: landmark 4 stands here for the second time"},
        BadTable{
            "map_status", map_landmarks, kMap + "5,1,1,1,1,maped\n",
            "t.csv:3: column status: \"temporary\", \"mapped\" or \"dynamic\" is needed, \"maped\" found"},
        BadTable{"map_observations", map_landmarks, kMap + "5,1,1,1,-1,mapped\n",
                 "t.csv:3: column observations: a whole number from 0 to 18446744073709551615 is needed, "
                 "\"-1\" found"},
        BadTable{"map_cut_off", map_landmarks, kMap + "5,1,1,1,1,mapped", kCutOff},
        BadTable{"time_negative", timing, kTiming + "5,-1,1\n",
                 "t.csv:3: column wall_ms: a time from 0 on is needed, \"-1\" found"},
        BadTable{"time_repeated", timing, kTiming + "4,1,1\n",
                 "t.csv:3: column iteration: an iteration above 4 is needed, \"4\" found"},
        BadTable{"time_cut_off", timing, kTiming + "5,1,1", kCutOff}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace hallway::log

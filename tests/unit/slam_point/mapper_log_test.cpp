// SPDX-License-Identifier: MIT
// The mapper on recorded logs, against what batch maximum likelihood reaches on the same log.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "slam_point/core/mapper.hpp"
#include "support/data.hpp"
#include "support/dense.hpp"
#include "support/long_mode.hpp"

namespace hallway::slam_point {
namespace {

struct Row {
  int iteration = 0;
  int truth = -1;
  Vec3 point = Vec3::Zero();
};

std::vector<std::vector<Row>> read_frames(const std::filesystem::path& file, bool with_truth, int steps) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<Row>> frames;
  while (std::getline(in, line)) {
    Row row;
    const int read = with_truth ? std::sscanf(line.c_str(), "%d,%d,%lf,%lf,%lf", &row.iteration, &row.truth,
                                              &row.point[0], &row.point[1], &row.point[2])
                                : std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &row.iteration, &row.point[0],
                                              &row.point[1], &row.point[2]);
    EXPECT_EQ(read, with_truth ? 5 : 4) << line;
    if (row.iteration >= steps) break;
    if (static_cast<std::size_t>(row.iteration) >= frames.size())
      frames.resize(static_cast<std::size_t>(row.iteration) + 1);
    frames[static_cast<std::size_t>(row.iteration)].push_back(row);
  }
  return frames;
}

std::map<int, Vec3> read_landmarks(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::map<int, Vec3> landmarks;
  while (std::getline(in, line)) {
    int id = 0;
    Vec3 p;
    EXPECT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &id, &p[0], &p[1], &p[2]), 4) << line;
    landmarks[id] = p;
  }
  return landmarks;
}

double aligned_rmse(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const auto n = static_cast<double>(a.size());
  Vec3 mean_a = Vec3::Zero();
  Vec3 mean_b = Vec3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / n;
    mean_b += b[i] / n;
  }
  Mat3 cross = Mat3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) cross += (a[i] - mean_a) * (b[i] - mean_b).transpose();
  const Mat3 r = dense::nearest_rotation(cross);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a - r * (b[i] - mean_b)).squaredNorm();
  return std::sqrt(sum / n);
}

double map_rmse(const Map& map, const std::map<LandmarkId, int>& truth_of,
                const std::map<int, Vec3>& landmarks) {
  std::vector<Vec3> truth;
  std::vector<Vec3> estimate;
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.status != LandmarkStatus::mapped) continue;
    truth.push_back(landmarks.at(truth_of.at(landmark.id)));
    estimate.push_back(landmark.position);
  }
  return aligned_rmse(truth, estimate);
}

struct Expected {
  const char* log;
  int steps;
  double maximum_likelihood_m;  ///< aligned landmark RMSE of the batch solution, from the data's README
  bool everyday;
};

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.log << ' ' << expected.steps;
}

class MapperLog : public testing::TestWithParam<Expected> {};

TEST_P(MapperLog, IsMappedAlmostAsWellAsTheNoiseAllows) {
  HALLWAY_DATA_OR_SKIP(folder, std::string("landmark_logs/") + GetParam().log);
  if (!GetParam().everyday && !test::long_mode()) GTEST_SKIP() << "only with HALLWAY_TEST_LONG=1";
  const std::map<int, Vec3> landmarks = read_landmarks(folder / "gt_landmarks.csv");
  Mapper mapper{Options()};
  std::map<LandmarkId, int> truth_of;
  std::map<int, LandmarkId> landmark_of;
  int errors = 0;
  for (const std::vector<Row>& frame : read_frames(folder / "obs.csv", true, GetParam().steps)) {
    std::vector<Vec3> points;
    for (const Row& row : frame) points.push_back(row.point);
    const Answer& answer = mapper.process(points);
    ASSERT_TRUE(answer.has_pose) << "iteration " << frame.front().iteration;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const LandmarkId id = answer.associations[i];
      if (id == kNoLandmark) continue;
      if (truth_of.try_emplace(id, frame[i].truth).first->second != frame[i].truth) ++errors;
      if (landmark_of.try_emplace(frame[i].truth, id).first->second != id) ++errors;
    }
  }
  EXPECT_EQ(errors, 0) << "observations given to another's landmark or to a second one";
  EXPECT_LE(map_rmse(mapper.map(), truth_of, landmarks), 0.05);
  EXPECT_LE(map_rmse(mapper.refined_map(), truth_of, landmarks), 1.2 * GetParam().maximum_likelihood_m);
}

INSTANTIATE_TEST_SUITE_P(Logs, MapperLog,
                         testing::Values(Expected{"figure8_d25", 3800, 0.01175, true},
                                         Expected{"figure8_d25", 7600, 0.00618, true},
                                         Expected{"figure8_3d_d25", 3800, 0.00856, true},
                                         Expected{"line_d25", 1000, 0.01033, true},
                                         Expected{"stationary_d25", 1000, 0.00262, true},
                                         Expected{"line_d100", 1000, 0.01132, false},
                                         Expected{"stationary_d100", 1000, 0.00293, false},
                                         Expected{"figure8_d100", 3800, 0.00603, false},
                                         Expected{"figure8_d100_r40", 3800, 0.04418, false}));

class VictoriaPark : public testing::TestWithParam<const char*> {};

TEST_P(VictoriaPark, EveryScanHasAPoseAndEachTreeOneLandmark) {
  HALLWAY_DATA_OR_SKIP(folder, std::string("landmark_logs_real/") + GetParam());
  Options options;
  options.noise_m = 0.25;
  options.overlap = 0.3;
  options.separation_m = 2.5;
  Mapper mapper(options);
  Pose last;
  for (const std::vector<Row>& frame : read_frames(folder / "obs.csv", false, 100000)) {
    std::vector<Vec3> points;
    for (const Row& row : frame) points.push_back(row.point);
    const Answer& answer = mapper.process(points);
    ASSERT_TRUE(answer.has_pose) << "scan " << frame.front().iteration;
    // The car makes at most 0.7 m a scan; more than three metres is a break.
    EXPECT_LT((answer.T_map_sensor.t - last.t).norm(), 3.0) << "scan " << frame.front().iteration;
    last = answer.T_map_sensor;
  }
  const Map map = mapper.map();
  int mapped = 0;
  for (const Landmark& a : map.landmarks) {
    mapped += a.status == LandmarkStatus::mapped ? 1 : 0;
    for (const Landmark& b : map.landmarks) {
      if (b.id >= a.id || a.status != LandmarkStatus::mapped || b.status != LandmarkStatus::mapped) continue;
      EXPECT_GT((a.position - b.position).norm(), options.separation_m) << a.id << " and " << b.id;
    }
  }
  EXPECT_GT(mapped, 80);
}

INSTANTIATE_TEST_SUITE_P(Intervals, VictoriaPark,
                         testing::Values("victoria_1181_1641", "victoria_4220_4633"));

}  // namespace
}  // namespace hallway::slam_point

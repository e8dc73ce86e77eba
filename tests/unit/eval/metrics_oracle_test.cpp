// SPDX-License-Identifier: MIT
// Random runs, scored here and by metrics_oracle.py (numpy, written from the definitions alone).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/random.hpp"
#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
#include "random_motion.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/python.hpp"
#include "support/temp_folder.hpp"

namespace hallway::eval {
namespace {

using Json = nlohmann::ordered_json;
using log::kNoLandmark;
using log::LandmarkId;
using log::LandmarkStatus;
using log::MapLandmark;
using Ids = std::vector<LandmarkId>;

struct RandomIteration {
  std::optional<Pose> truth;
  std::optional<Pose> estimate;
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  Ids associations;
  Ids identities;
  std::vector<Vec3> points;
  std::optional<double> wall_ms;
};

struct RandomRun {
  Truth truth;
  std::vector<RandomIteration> iterations;
  std::vector<MapLandmark> online;
  std::optional<std::vector<MapLandmark>> refined;
};

/// A run with everything that can go wrong: frames without truth, lost ones, wrong and missing associations, split and
/// merged landmarks, clutter, landmarks of unknown place, and now and then no truth at all.
class RunMaker {
 public:
  explicit RunMaker(std::uint64_t seed)
      : random_(seed, stream_id("test.run")), T_map_world_(random_motion(seed)) {}

  RandomRun make() {
    RandomRun run;
    landmarks_ = 1 + below(30);
    run.truth.has_identities = !chance(0.15);
    if (!chance(0.15)) run.truth.landmarks = true_landmarks();
    const std::uint32_t iterations = below(40);  // 0 to 2 of them among others
    for (std::uint32_t i = 0; i < iterations; ++i)
      run.iterations.push_back(iteration(run.truth.has_identities));
    run.online = map();
    if (chance(0.7)) run.refined = map();
    return run;
  }

 private:
  double next() { return random_.uniform(0, index_++); }
  bool chance(double probability) { return next() < probability; }
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(next() * end); }
  Vec3 noise(double sigma) {
    const std::uint64_t at = index_;
    index_ += 3;
    return sigma * Vec3(random_.normal(1, at), random_.normal(1, at + 1), random_.normal(1, at + 2));
  }

  std::vector<log::Landmark> true_landmarks() {
    std::vector<log::Landmark> landmarks;
    for (std::uint32_t id = 0; id < landmarks_; ++id) {
      if (chance(0.05)) continue;
      const Vec3 place = position(id);
      landmarks.push_back({id, {place.x(), place.y(), place.z()}});
    }
    return landmarks;
  }

  Vec3 position(LandmarkId id) const {
    return random_point(random_, static_cast<std::uint32_t>(100 + id), 40.0);
  }

  /// Each true landmark has two map landmarks, of which the second is rarely used.
  static LandmarkId map_id(LandmarkId true_id, bool second) { return 1000 + 37 * true_id + (second ? 1 : 0); }

  RandomIteration iteration(bool has_identities) {
    RandomIteration result;
    const Pose truth = random_motion(77, static_cast<std::uint32_t>(index_));
    if (!chance(0.1)) result.truth = truth;
    const Quat wobble = from_yaw_pitch_roll(0.1 * next(), 0.1 * next(), 0.1 * next());
    if (!chance(0.1)) result.estimate = T_map_world_ * truth * Pose{wobble, noise(0.3)};
    if (chance(0.8)) result.covariance = covariance<6>(false);
    if (!chance(0.1)) result.wall_ms = 0.01 * below(50);
    for (std::uint32_t count = below(12); count > 0; --count) {
      const LandmarkId identity = below(landmarks_);
      const LandmarkId taken_for = chance(0.1) ? below(landmarks_) : identity;
      result.associations.push_back(chance(0.1) ? kNoLandmark : map_id(taken_for, chance(0.2)));
      if (has_identities) result.identities.push_back(chance(0.05) ? kNoLandmark : identity);
      result.points.push_back(truth.inverse() * position(identity) + noise(0.1));
    }
    return result;
  }

  std::vector<MapLandmark> map() {
    std::vector<MapLandmark> landmarks;
    for (LandmarkId id = landmarks_; id-- > 0;) {
      for (const bool second : {false, true}) {
        if (chance(second ? 0.6 : 0.1)) continue;
        const Vec3 place = T_map_world_ * position(id) + noise(0.2);
        const auto status = chance(0.15) ? LandmarkStatus(2 * below(2)) : LandmarkStatus::kMapped;
        landmarks.push_back({map_id(id, second), {place.x(), place.y(), place.z()}, 1 + below(20), status});
        if (!chance(0.7)) continue;
        const Eigen::Matrix3d c = covariance<3>(chance(0.2));
        landmarks.back().covariance = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
      }
    }
    return landmarks;
  }

  /// `flat`: nothing moves along z.
  template <int N>
  Eigen::Matrix<double, N, N> covariance(bool flat) {
    Eigen::Matrix<double, N, N> root;
    for (double& entry : root.reshaped()) entry = next() - 0.5;
    if (flat) root.row(2).setZero();
    Eigen::Matrix<double, N, N> result = root * root.transpose();
    for (int i = 0; i < N; ++i) result(i, i) += flat && i == 2 ? 0.0 : 0.01;
    return result;
  }

  Random random_;
  Pose T_map_world_;
  std::uint64_t index_ = 0;
  std::uint32_t landmarks_ = 0;
};

Metrics evaluate(const RandomRun& run) {
  Evaluator evaluator(run.truth);
  for (const RandomIteration& iteration : run.iterations) {
    Iteration entry;
    entry.T_world_body = iteration.truth;
    entry.T_map_body = iteration.estimate;
    entry.associations = iteration.associations;
    entry.identities = iteration.identities;
    entry.pose_covariance = iteration.covariance;
    entry.points = iteration.points;
    entry.wall_ms = iteration.wall_ms;
    if (iteration.wall_ms) entry.cpu_ms = *iteration.wall_ms / 3;
    evaluator.add(entry);
  }
  return evaluator.metrics(run.online, run.refined);
}

Json to_json(const std::optional<Pose>& pose) {
  if (!pose) return nullptr;
  return {pose->t.x(), pose->t.y(), pose->t.z(), pose->q.w(), pose->q.x(), pose->q.y(), pose->q.z()};
}

Json to_json(const Ids& ids) {
  Json array = Json::array();
  for (const LandmarkId id : ids) array.push_back(id == kNoLandmark ? Json(-1) : Json(id));
  return array;
}

template <int N>
Json rows_of(const Eigen::Matrix<double, N, N>& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < N; ++row) {
    rows.push_back(Json::array());
    for (int column = 0; column < N; ++column) rows.back().push_back(matrix(row, column));
  }
  return rows;
}

Json to_json(const std::vector<MapLandmark>& map) {
  Json array = Json::array();
  for (const MapLandmark& landmark : map) {
    Json entry;
    entry["id"] = landmark.id;
    entry["position"] = landmark.position_m;
    entry["status"] = log::landmark_status_name(landmark.status);
    entry["observations"] = landmark.observations;
    entry["covariance"] = nullptr;
    if (const auto& c = landmark.covariance) {
      Eigen::Matrix3d matrix;
      matrix << (*c)[0], (*c)[1], (*c)[2], (*c)[1], (*c)[3], (*c)[4], (*c)[2], (*c)[4], (*c)[5];
      entry["covariance"] = rows_of(matrix);
    }
    array.push_back(entry);
  }
  return array;
}

Json to_json(const RandomRun& run) {
  Json document;
  document["has_identities"] = run.truth.has_identities;
  document["landmarks"] = run.truth.landmarks ? Json::object() : Json(nullptr);
  if (run.truth.landmarks) {
    for (const log::Landmark& landmark : *run.truth.landmarks) {
      document["landmarks"][std::to_string(landmark.id)] = landmark.position_m;
    }
  }
  document["online"] = to_json(run.online);
  document["refined"] = run.refined ? to_json(*run.refined) : Json(nullptr);
  document["iterations"] = Json::array();
  for (const RandomIteration& iteration : run.iterations) {
    Json entry;
    entry["truth"] = to_json(iteration.truth);
    entry["estimate"] = to_json(iteration.estimate);
    entry["associations"] = to_json(iteration.associations);
    entry["identities"] = to_json(iteration.identities);
    entry["covariance"] = iteration.covariance ? rows_of(*iteration.covariance) : Json(nullptr);
    entry["points"] = Json::array();
    for (const Vec3& point : iteration.points) entry["points"].push_back({point.x(), point.y(), point.z()});
    entry["wall_ms"] = iteration.wall_ms ? Json(*iteration.wall_ms) : Json(nullptr);
    entry["cpu_ms"] = iteration.wall_ms ? Json(*iteration.wall_ms / 3) : Json(nullptr);
    document["iterations"].push_back(entry);
  }
  return document;
}

/// The same members, counts and nulls alike, and numbers but for rounding.
void expect_alike(const Json& ours, const Json& oracle, const std::string& place) {
  if (ours.is_object()) {
    ASSERT_TRUE(oracle.is_object()) << place;
    EXPECT_EQ(ours.size(), oracle.size()) << place;
    for (const auto& [key, value] : ours.items()) {
      ASSERT_TRUE(oracle.contains(key)) << place << '.' << key;
      expect_alike(value, oracle.at(key), place + '.' + key);
    }
  } else if (ours.is_number_float() && oracle.is_number()) {
    const double expected = oracle.get<double>();
    EXPECT_NEAR(ours.get<double>(), expected, 1e-9 * (1.0 + std::abs(expected))) << place;
  } else {
    EXPECT_EQ(ours, oracle) << place;
  }
}

TEST(MetricsOracle, AgreesOnRandomRuns) {
  const auto python = test::python_with_numpy();
  if (!python) GTEST_SKIP() << "no Python 3 with numpy (the environment variable HALLWAY_PYTHON names one)";
  const test::TempFolder folder;
  std::vector<RandomRun> runs;
  Json inputs = Json::array();
  const std::uint64_t count = test::sized<std::uint64_t>(200, 5000);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    runs.push_back(RunMaker(seed).make());
    inputs.push_back(to_json(runs.back()));
  }
  const auto input = folder.write("runs.json", inputs.dump());
  const auto script = test::source_folder() / "tests" / "unit" / "eval" / "metrics_oracle.py";
  ASSERT_EQ(test::run_python(*python, {script, input, folder / "metrics.json"}), 0);
  const Json oracle = Json::parse(read_file(folder / "metrics.json"));
  ASSERT_EQ(oracle.size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    expect_alike(to_json(evaluate(runs[i])), oracle[i], "run " + std::to_string(i + 1));
  }
}

}  // namespace
}  // namespace hallway::eval

// SPDX-License-Identifier: MIT
// Noise that differs along the ray to a point and across it, as of stereo cameras, and of range and bearing.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/fit/directional_fit.hpp"
#include "slam_point/core/mapper.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point::directional {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

Options stereo() {
  Options options;
  options.noise_m = 0.02;
  options.noise_per_m2 = 0.001;
  options.noise_across_per_m = 0.0006;
  options.association = Association::sensor;
  return options;
}

/// Ranges are inexact, bearings are not. That the noise does not grow with the range keeps weights from depending on errors.
Options range_and_bearing() {
  Options options;
  options.noise_m = 0.2;
  options.noise_across_per_m = 0.001;
  options.association = Association::sensor;
  return options;
}

RayWeight weight_of(const Options& options, const Vec3& point) {
  const double along = options.noise_m / options.noise_at(point.norm());
  const double across = options.noise_m / options.noise_across_at(point.norm());
  return {along * along, across * across};
}

/// What the sensor of `options` makes of a point that is at p.
Vec3 seen(const Options& options, const Vec3& p, scenes::Random& random) {
  const Vec3 ray = p.normalized();
  const Vec3 noise(random.normal(), random.normal(), random.normal());
  const Vec3 along = noise.dot(ray) * ray;
  return p + options.noise_at(p.norm()) * along + options.noise_across_at(p.norm()) * (noise - along);
}

Vec3 anywhere(scenes::Random& random) {
  return {random.uniform(12.0, 60.0), random.uniform(-15.0, 15.0), random.uniform(-3.0, 6.0)};
}

/// Points as one frame and a mean of `count` others saw them, from T.
std::vector<DirectionalPair> pairs_of(const Pose& T, double count, std::uint64_t seed) {
  scenes::Random random(seed);
  const Options options = stereo();
  std::vector<DirectionalPair> pairs;
  for (int i = 0; i < 40; ++i) {
    const Vec3 p = anywhere(random);
    DirectionalPair pair;
    pair.point = seen(options, p, random);
    pair.weight = weight_of(options, pair.point);
    pair.reference = T * p;
    pair.known = count * ray_information(T.q * p, pair.weight);
    pair.plain_weight = pair_weight(count * pair.weight.along, pair.weight.along);
    pairs.push_back(pair);
  }
  return pairs;
}

const Pose kMoved{rotation_exp(Vec3(0.02, -0.01, 0.1)), Vec3(0.8, -0.1, 0.05)};

TEST(DirectionalFit, IsThePlainOneWhereDirectionsAreAlike) {
  std::vector<DirectionalPair> pairs = pairs_of(kMoved, 3.0, 1);
  std::vector<Pair> plain;
  for (DirectionalPair& pair : pairs) {
    pair.weight.across = pair.weight.along;
    pair.known = 3.0 * pair.weight.along * Mat3::Identity();
    plain.push_back({pair.reference, pair.point, pair.plain_weight, pair.weight.along});
  }
  const FitRules rules{false, 0.0, kNoLimit};
  Pose directional;
  Pose expected;
  ASSERT_TRUE(directional_fit(pairs, rules, directional));
  ASSERT_TRUE(robust_fit(plain, rules, expected));
  EXPECT_LT(directional.q.angularDistance(expected.q), 1e-9);
  EXPECT_LT((directional.t - expected.t).norm(), 1e-8);
}

TEST(DirectionalFit, IsWhereTheWeightedSquaresAreLeast) {
  const std::vector<DirectionalPair> pairs = pairs_of(kMoved, 2.0, 2);
  Pose fitted;
  ASSERT_TRUE(directional_fit(pairs, {false, 0.0, kNoLimit}, fitted));
  const auto squares = [&](const Pose& T) {
    double sum = 0.0;
    for (const DirectionalPair& pair : pairs) {
      const Mat3 noise = pair.known.inverse() + ray_information(fitted.q * pair.point, pair.weight).inverse();
      const Vec3 residual = T * pair.point - pair.reference;
      sum += residual.dot(noise.inverse() * residual);
    }
    return sum;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const double size : {-1e-4, 1e-4}) {
      const Vec3 off = size * Vec3::Unit(axis);
      EXPECT_GT(squares({fitted.q, fitted.t + off}), squares(fitted));
      EXPECT_GT(squares({rotation_exp(off) * fitted.q, fitted.t}), squares(fitted));
    }
  }
}

TEST(DirectionalFit, IsNotMovedByOutliers) {
  std::vector<DirectionalPair> pairs = pairs_of(kMoved, 3.0, 3);
  for (std::size_t i = 0; i < pairs.size(); i += 5) pairs[i].reference.y() += 2.0;
  Pose fitted;
  ASSERT_TRUE(directional_fit(pairs, {false, 0.0, 4.0 * stereo().noise_m}, fitted));
  EXPECT_LT(fitted.q.angularDistance(kMoved.q), 2e-3);
  EXPECT_LT((fitted.t - kMoved.t).norm(), 0.05);
}

TEST(DirectionalFit, SaysWhenARotationIsOpen) {
  std::vector<DirectionalPair> pairs = pairs_of(Pose{}, 3.0, 4);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Vec3 on_a_line(10.0 + static_cast<double>(i), 0.0, 0.0);
    pairs[i].point = pairs[i].reference = on_a_line;
  }
  Pose fitted = kMoved;
  EXPECT_FALSE(directional_fit(pairs, {false, 1e-3, kNoLimit}, fitted));
  EXPECT_EQ(fitted.t, kMoved.t);
}

/// A sensor that drives, and what it sees.
struct Drive {
  std::vector<Vec3> landmarks;
  std::vector<Pose> poses;
  std::vector<std::vector<scenes::Seen>> frames;
};

void look(Drive& drive, scenes::Random& random) {
  for (const Pose& pose : drive.poses) {
    drive.frames.emplace_back();
    for (std::size_t l = 0; l < drive.landmarks.size(); ++l) {
      const Vec3 p = seen(range_and_bearing(), pose.inverse() * drive.landmarks[l], random);
      drive.frames.back().push_back({p, static_cast<std::int64_t>(l)});
    }
  }
}

/// On a bend, among points ahead.
Drive ahead(std::uint64_t seed) {
  scenes::Random random(seed);
  Drive drive;
  for (int i = 0; i < 24; ++i) drive.landmarks.push_back(anywhere(random));
  for (int f = 0; f < 20; ++f)
    drive.poses.push_back(scenes::heading(Vec3(0.4 * f, 0.01 * f * f, 0.0), 0.02 * f));
  look(drive, random);
  return drive;
}

/// Part of the way round some points: what one frame does not know of a point another does.
Drive around(std::uint64_t seed) {
  scenes::Random random(seed);
  Drive drive;
  for (int i = 0; i < 24; ++i) {
    drive.landmarks.push_back(
        Vec3(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), random.uniform(-3.0, 3.0)));
  }
  for (int f = 0; f < 20; ++f) {
    const double angle = 0.08 * f;
    drive.poses.push_back(scenes::heading(20.0 * Vec3(-std::cos(angle), -std::sin(angle), 0.0), angle));
  }
  look(drive, random);
  return drive;
}

Pose rigid_fit(const std::vector<Vec3>& to, const std::vector<Vec3>& from) {
  const auto matrix = [](const std::vector<Vec3>& points) {
    Eigen::Matrix3Xd m(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) m.col(static_cast<Eigen::Index>(i)) = points[i];
    return m;
  };
  const Eigen::Matrix4d T = dense::rigid_motion(matrix(from), matrix(to));
  return {Eigen::Quaterniond(Mat3(T.topLeftCorner<3, 3>())), T.topRightCorner<3, 1>()};
}

/// Sum of squared distances from the truth after the best rigid fit.
double aligned_squares(const std::vector<Vec3>& truth, const std::vector<Vec3>& estimate) {
  const Pose T = rigid_fit(truth, estimate);
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (T * estimate[i] - truth[i]).squaredNorm();
  return sum;
}

/// All poses but the first and all landmarks at once, by dense Gauss-Newton steps from near the truth: maximum likelihood.
std::vector<Vec3> batch(const Drive& drive) {
  std::vector<Vec3> landmarks = drive.landmarks;
  std::vector<Pose> poses;
  for (const auto& frame : drive.frames) {
    std::vector<Vec3> points;
    for (const scenes::Seen& point : frame) points.push_back(point.point);
    poses.push_back(rigid_fit(landmarks, points));
  }
  const auto unknowns = static_cast<Eigen::Index>(6 * poses.size() + 3 * landmarks.size());
  for (int step = 0; step < 6; ++step) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(unknowns);
    normal.topLeftCorner<6, 6>().diagonal().array() += 1e6;
    for (std::size_t f = 0; f < poses.size(); ++f) {
      for (const scenes::Seen& point : drive.frames[f]) {
        const Vec3 y = poses[f].q * point.point;
        const Mat3 information = ray_information(y, weight_of(range_and_bearing(), point.point));
        Eigen::Matrix<double, 3, 9> derivative;
        derivative << Mat3::Identity(), -skew(y), -Mat3::Identity();
        const Vec3 residual = y + poses[f].t - landmarks[static_cast<std::size_t>(point.truth)];
        const Eigen::Matrix<double, 9, 9> block = derivative.transpose() * information * derivative;
        const Eigen::Matrix<double, 9, 1> pull = derivative.transpose() * information * residual;
        const auto p = static_cast<Eigen::Index>(6 * f);
        const auto l = static_cast<Eigen::Index>(6 * poses.size()) + 3 * point.truth;
        normal.block<6, 6>(p, p) += block.topLeftCorner<6, 6>();
        normal.block<6, 3>(p, l) += block.topRightCorner<6, 3>();
        normal.block<3, 6>(l, p) += block.bottomLeftCorner<3, 6>();
        normal.block<3, 3>(l, l) += block.bottomRightCorner<3, 3>();
        gradient.segment<6>(p) += pull.head<6>();
        gradient.segment<3>(l) += pull.tail<3>();
      }
    }
    const Eigen::VectorXd move = -dense::solve_symmetric(normal, gradient);
    for (std::size_t f = 0; f < poses.size(); ++f) {
      const auto p = static_cast<Eigen::Index>(6 * f);
      poses[f].t += move.segment<3>(p);
      poses[f].q = (rotation_exp(move.segment<3>(p + 3)) * poses[f].q).normalized();
    }
    for (std::size_t l = 0; l < landmarks.size(); ++l)
      landmarks[l] += move.segment<3>(static_cast<Eigen::Index>(6 * poses.size() + 3 * l));
  }
  return landmarks;
}

struct Mapped {
  double squares = 0.0;  ///< aligned_squares() of the map at the end
  double nees = 0.0;     ///< mean normalised squared error of its landmarks, for each degree of freedom
};

Mapped map_of(const Drive& drive, const Options& options) {
  Mapper mapper(options);
  for (const auto& frame : drive.frames) {
    std::vector<Vec3> points;
    std::vector<TrackId> tracks;
    for (const scenes::Seen& point : frame) {
      points.push_back(point.point);
      tracks.push_back(static_cast<TrackId>(point.truth));
    }
    EXPECT_TRUE(mapper.process(points, tracks).has_pose);
  }
  const Map map = mapper.refined_map();
  EXPECT_EQ(map.landmarks.size(), drive.landmarks.size());
  std::vector<Vec3> places;
  for (const Landmark& landmark : map.landmarks) places.push_back(landmark.position);
  if (places.size() != drive.landmarks.size()) return {};
  const Pose T = rigid_fit(places, drive.landmarks);
  Mapped mapped{aligned_squares(drive.landmarks, places), 0.0};
  for (std::size_t l = 0; l < places.size(); ++l) {
    EXPECT_TRUE(map.landmarks[l].covariance);
    if (!map.landmarks[l].covariance) return {};
    const Vec3 error = T * drive.landmarks[l] - places[l];
    mapped.nees += error.dot(map.landmarks[l].covariance->inverse() * error) /
                   (3.0 * static_cast<double>(places.size()));
  }
  return mapped;
}

/// Errors of all landmarks of ten runs, as ratios to those of maximum likelihood.
struct Ratios {
  double directional = 0.0;
  double plain = 0.0;  ///< of a mapper that is not told of directions
  double nees = 0.0;
};

Ratios ratios_of(Drive (*drive)(std::uint64_t)) {
  Options alike = range_and_bearing();
  alike.noise_across_per_m = 0.0;
  double best = 0.0;
  Ratios ratios;
  constexpr int kRuns = 10;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const Drive log = drive(seed);
    const Mapped mapped = map_of(log, range_and_bearing());
    best += aligned_squares(log.landmarks, batch(log));
    ratios.directional += mapped.squares;
    ratios.nees += mapped.nees / kRuns;
    ratios.plain += map_of(log, alike).squares;
  }
  ratios.directional = std::sqrt(ratios.directional / best);
  ratios.plain = std::sqrt(ratios.plain / best);
  return ratios;
}

TEST(DirectionalNoise, MakesTheMapThatMaximumLikelihoodMakes) {
  const Ratios ratios = ratios_of(ahead);
  EXPECT_LT(ratios.directional, 1.03);
  EXPECT_NEAR(ratios.nees, 1.0, 0.25);
}

TEST(DirectionalNoise, MakesTheMostOfDifferentSides) {
  const Ratios ratios = ratios_of(around);
  EXPECT_LT(ratios.directional, 1.1);
  EXPECT_NEAR(ratios.nees, 1.0, 0.3);
  EXPECT_GT(ratios.plain, 2.0) << "directions make no difference here";
}

TEST(DirectionalNoise, IsTheSameInAllDirectionsByDefault) {
  const Options options;
  EXPECT_FALSE(options.is_directional());
  EXPECT_EQ(options.noise_across_at(30.0), options.noise_at(30.0));
}

}  // namespace
}  // namespace hallway::slam_point::directional

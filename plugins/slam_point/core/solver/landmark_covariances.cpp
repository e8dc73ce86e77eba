// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/landmark_covariances.hpp"

#include <Eigen/LU>
#include <limits>

#include "geometry/symmetric.hpp"
#include "slam_point/core/fit/directional_fit.hpp"
#include "slam_point/core/solver/block_cholesky.hpp"
#include "slam_point/core/solver/reduced_system.hpp"

namespace hallway::slam_point {
namespace {

using Mat36 = Eigen::Matrix<double, 3, 6>;
using Mat6 = BlockCholesky::Block;

/// How a point y from a pose's origin moves with the pose: [I, -[y]x].
Mat36 motion_of(const Vec3& y) {
  Mat36 motion;
  motion << Mat3::Identity(), skew(-y);
  return motion;
}

/// How a landmark moves with one of the submaps that hold it.
struct Lever {
  Index slot = 0;
  Mat36 motion;  // weighted by the share of the submap's evidence in the landmark's
};

/// Works through one graph.
class LandmarkCovariances {
 public:
  LandmarkCovariances(const SubmapGraph& graph, const std::vector<bool>& in_gauge)
      : graph_(graph), in_gauge_(in_gauge) {}

  std::vector<std::optional<Mat3>> compute();

 private:
  bool factorise();
  bool fit_gauge();
  bool counts(Index landmark) const { return in_gauge_[landmark] && evidence(landmark) > 0.0; }
  double evidence(Index landmark) const;
  Mat3 noise(Index landmark) const;
  std::vector<Lever> levers(Index landmark) const;
  Mat36 gauge_motion(Index landmark) const { return motion_of(positions_[landmark] - centre_); }
  Mat3 held_covariance(Index landmark) const;
  Mat3 covariance(Index landmark) const;

  const SubmapGraph& graph_;
  const std::vector<bool>& in_gauge_;
  ReducedSystem system_;
  BlockCholesky factor_;
  std::vector<Vec3> positions_;  // landmark -> map frame
  Vec3 centre_ = Vec3::Zero();
  Mat6 fit_ = Mat6::Zero();                                 // motion of all landmarks -> motion of the fit
  std::vector<std::vector<BlockCholesky::Vec6>> response_;  // column of the gauge's motion -> slot -> vector
  Mat6 spread_ = Mat6::Zero();                              // G^T C G
};

double LandmarkCovariances::evidence(Index landmark) const {
  double weight = 0.0;
  for (const Membership& at : graph_.landmarks[landmark].memberships)
    weight += graph_.submaps[at.submap].members[at.member].weight();
  return weight;
}

/// Covariance of a landmark in the submaps that hold it, for observations of variance 1.
Mat3 LandmarkCovariances::noise(Index landmark) const {
  if (!graph_.is_directional()) return Mat3::Identity() / evidence(landmark);
  Mat3 whole = Mat3::Zero();
  for (const Membership& at : graph_.landmarks[landmark].memberships)
    whole += graph_.evidence(at, graph_.poses[at.submap]).information;
  return whole.inverse();
}

std::vector<Lever> LandmarkCovariances::levers(Index landmark) const {
  std::vector<Lever> result;
  const Mat3 noise = graph_.is_directional() ? this->noise(landmark) : Mat3(Mat3::Zero());
  const double whole = evidence(landmark);
  for (const Membership& at : graph_.landmarks[landmark].memberships) {
    const Member& member = graph_.submaps[at.submap].members[at.member];
    if (system_.row_of(at.submap) == kNone || member.count == 0) continue;
    const Vec3 y = graph_.poses[at.submap].q * member.mean;
    Mat36 motion = motion_of(y);
    if (graph_.is_directional()) {
      motion = noise * graph_.evidence(at, graph_.poses[at.submap]).information * motion;
    } else {
      motion *= member.weight() / whole;
    }
    result.push_back({system_.row_of(at.submap), motion});
  }
  return result;
}

bool LandmarkCovariances::factorise() {
  system_.take_all(graph_, factor_);
  if (system_.free().empty()) return true;
  double plenty = std::numeric_limits<double>::max();
  if (factor_.advance(plenty) != BlockCholesky::State::done) return false;
  factor_.invert();
  return true;
}

/// Finds how the fit follows the landmarks, and how the landmarks' errors go into it.
bool LandmarkCovariances::fit_gauge() {
  positions_.assign(graph_.landmarks.size(), Vec3::Zero());
  double number = 0.0;
  for (Index l = 0; l < positions_.size(); ++l) {
    if (evidence(l) > 0.0) positions_[l] = graph_.mean_position(l);
    if (!counts(l)) continue;
    centre_ += positions_[l];
    number += 1.0;
  }
  if (number < 3.0) return false;
  centre_ /= number;
  const std::size_t slots = system_.free().size();
  Mat6 normal = Mat6::Zero();
  std::vector<Mat6> load(slots, Mat6::Zero());  // slot -> sum over landmarks of lever^T gauge motion
  for (Index l = 0; l < positions_.size(); ++l) {
    if (!counts(l)) continue;
    const Mat36 motion = gauge_motion(l);
    normal += motion.transpose() * motion;
    spread_ += motion.transpose() * noise(l) * motion;
    for (const Lever& lever : levers(l)) load[lever.slot] += lever.motion.transpose() * motion;
  }
  const Ldlt<6> factors(normal);
  if (!(factors.least_pivot() > 1e-9 * factors.largest_pivot())) return false;
  fit_ = factors.solve_all(Mat6::Identity());
  response_.assign(6, std::vector<BlockCholesky::Vec6>(slots));
  for (Eigen::Index column = 0; column < 6; ++column) {
    std::vector<BlockCholesky::Vec6>& response = response_[static_cast<std::size_t>(column)];
    for (std::size_t slot = 0; slot < slots; ++slot) response[slot] = load[slot].col(column);
    if (slots > 0) factor_.solve(response);
    for (std::size_t slot = 0; slot < slots; ++slot)
      spread_.col(column) += load[slot].transpose() * response[slot];
  }
  return true;
}

/// The covariance with submap 0 held.
Mat3 LandmarkCovariances::held_covariance(Index landmark) const {
  Mat3 sum = noise(landmark);
  const std::vector<Lever> levers = this->levers(landmark);
  for (std::size_t a = 0; a < levers.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const Mat3 part = levers[a].motion * factor_.inverse_block(levers[a].slot, levers[b].slot) *
                        levers[b].motion.transpose();
      sum += part;
      if (a != b) sum += part.transpose();
    }
  }
  return sum;
}

Mat3 LandmarkCovariances::covariance(Index landmark) const {
  const Mat36 motion = gauge_motion(landmark);
  Mat36 joint = Mat36::Zero();  // covariance of this landmark with G^T times all that count
  if (counts(landmark)) joint = noise(landmark) * motion;
  for (const Lever& lever : levers(landmark)) {
    for (Eigen::Index column = 0; column < 6; ++column)
      joint.col(column) += lever.motion * response_[static_cast<std::size_t>(column)][lever.slot];
  }
  const Mat3 cross = motion * fit_ * joint.transpose();
  return held_covariance(landmark) - cross - cross.transpose() +
         motion * fit_ * spread_ * fit_ * motion.transpose();
}

std::vector<std::optional<Mat3>> LandmarkCovariances::compute() {
  std::vector<std::optional<Mat3>> result(graph_.landmarks.size());
  if (graph_.submaps.empty() || !factorise() || !fit_gauge()) return result;
  for (Index l = 0; l < result.size(); ++l) {
    if (evidence(l) == 0.0) continue;
    Mat3 c = covariance(l);
    if (graph_.planar) {
      c.row(2).setZero();
      c.col(2).setZero();
    }
    if (c.allFinite() && c.diagonal().minCoeff() >= 0.0) result[l] = 0.5 * (c + c.transpose());
  }
  return result;
}

}  // namespace

std::vector<std::optional<Mat3>> landmark_covariances(const SubmapGraph& graph,
                                                      const std::vector<bool>& in_gauge) {
  return LandmarkCovariances(graph, in_gauge).compute();
}

}  // namespace hallway::slam_point

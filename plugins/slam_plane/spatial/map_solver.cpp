// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/symmetric.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kEdgeHuber_m = 0.1;  // edges that are farther off count less
constexpr double kSettled = 1e-9;     // relative decrease of the sum below which no further step is taken
constexpr double kDamping = 1e-9;     // of the diagonal

using Mat46 = Eigen::Matrix<double, 4, 6>;
using Mat63 = Eigen::Matrix<double, 6, 3>;

/// What one submap tells of one feature.
struct Term {
  Index submap;
  const Mat4* evidence;
};

/// A plane or an edge with all that was seen of it.
struct Observed {
  const Feature* feature;
  bool is_edge;
  std::vector<Term> terms;
};

class Problem {
 public:
  Problem(const PlaneMap& map, const std::vector<Index>& free) : map_(map), slot_(map.submaps.size(), kNone) {
    for (Index i = 0; i < free.size(); ++i) slot_[free[i]] = i;
    const auto n = static_cast<Eigen::Index>(6 * free.size());
    h_ = Eigen::MatrixXd::Zero(n, n);
    g_ = Eigen::VectorXd::Zero(n);
  }

  /// Adds a feature's terms, with the feature eliminated.
  void add(const Observed& observed) {
    const Feature& feature = *observed.feature;
    Mat3 own = Mat3::Zero();
    Vec3 own_g = Vec3::Zero();
    std::vector<std::pair<Index, Mat63>> coupled;
    for (const Term& term : observed.terms) {
      const Mat4 g = plane_transform(map_.submaps[term.submap].T_map_submap);
      const Vec4 plane = g * feature.plane;
      const Mat4 q = weight(*term.evidence, plane, observed.is_edge) * *term.evidence;
      const Eigen::Matrix<double, 4, 3> tangent = g * feature.tangent;
      own += tangent.transpose() * q * tangent;
      own_g += tangent.transpose() * (q * plane);
      if (slot_[term.submap] == kNone) continue;
      const Mat46 turn = pose_gradient(plane);
      const auto at = static_cast<Eigen::Index>(6 * slot_[term.submap]);
      h_.block<6, 6>(at, at) += turn.transpose() * q * turn;
      g_.segment<6>(at) += turn.transpose() * (q * plane);
      coupled.emplace_back(slot_[term.submap], turn.transpose() * q * tangent);
    }
    if (observed.is_edge) own(2, 2) = 1.0;  // an edge has two directions
    const Mat3 inverse = inverse_of_positive<3>(own).matrix;
    if (!inverse.allFinite()) return;
    for (const auto& [i, a] : coupled) {
      const Mat63 share = a * inverse;
      g_.segment<6>(static_cast<Eigen::Index>(6 * i)) -= share * own_g;
      for (const auto& [k, b] : coupled)
        h_.block<6, 6>(static_cast<Eigen::Index>(6 * i), static_cast<Eigen::Index>(6 * k)) -=
            share * b.transpose();
    }
  }

  /// The steps of the free poses, one after the other: a shift and a turn in each submap's frame.
  Eigen::VectorXd step() const {
    Eigen::MatrixXd h = h_;
    h.diagonal() *= 1.0 + kDamping;
    return Ldlt<Eigen::Dynamic>(h).solve(-g_);
  }

  static double weight(const Mat4& evidence, const Vec4& plane, bool is_edge) {
    if (!is_edge) return 1.0;
    const double rms = std::sqrt(std::max(plane.dot(evidence * plane) / evidence(3, 3), 0.0));
    return rms > kEdgeHuber_m ? kEdgeHuber_m / rms : 1.0;
  }

 private:
  /// How a plane in a submap's frame changes as the submap moves.
  static Mat46 pose_gradient(const Vec4& plane) {
    Mat46 gradient = Mat46::Zero();
    const Vec3 n = plane.head<3>();
    gradient(0, 4) = -n.z();
    gradient(0, 5) = n.y();
    gradient(1, 3) = n.z();
    gradient(1, 5) = -n.x();
    gradient(2, 3) = -n.y();
    gradient(2, 4) = n.x();
    gradient.bottomLeftCorner<1, 3>() = -n.transpose();
    return gradient;
  }

  const PlaneMap& map_;
  std::vector<Index> slot_;
  Eigen::MatrixXd h_;
  Eigen::VectorXd g_;
};

std::vector<Index> landmarks_of(const PlaneMap& map, const std::vector<Index>& free) {
  std::vector<Index> landmarks;
  for (const Index submap : free) {
    for (const Member& member : map.submaps[submap].members) {
      if (member.landmark != kNone) landmarks.push_back(member.landmark);
    }
  }
  make_set(landmarks);
  return landmarks;
}

/// The plane and the certain edges of a plane.
void collect(const PlaneMap& map, const PlaneRecord& landmark, std::vector<Observed>& all) {
  Observed plane{&landmark.plane, false, {}};
  for (const Membership& at : landmark.members)
    plane.terms.push_back({at.submap, &map.submaps[at.submap].members[at.member].evidence});
  all.push_back(std::move(plane));
  for (const EdgeRecord& edge : landmark.edges) {
    if (!map.is_certain(edge)) continue;
    Observed line{&edge.line, true, {}};
    for (const Membership& at : landmark.members) {
      for (const EdgeSum& sum : map.submaps[at.submap].members[at.member].edges) {
        if (sum.id == edge.id) line.terms.push_back({at.submap, &sum.evidence});
      }
    }
    all.push_back(std::move(line));
  }
}

double cost_of(const PlaneMap& map, const std::vector<Observed>& all) {
  double cost = 0.0;
  for (const Observed& observed : all) {
    for (const Term& term : observed.terms) {
      const Vec4 plane = plane_transform(map.submaps[term.submap].T_map_submap) * observed.feature->plane;
      const double square = plane.dot(*term.evidence * plane);
      const double weight = Problem::weight(*term.evidence, plane, observed.is_edge);
      const double bound = kEdgeHuber_m * kEdgeHuber_m * (*term.evidence)(3, 3);
      cost += weight == 1.0 ? square : 2.0 * std::sqrt(square * bound) - bound;
    }
  }
  return cost;
}

}  // namespace

int solve(PlaneMap& map, const std::vector<Index>& free, int steps) {
  if (free.empty()) return 0;
  const std::vector<Index> landmarks = landmarks_of(map, free);
  for (const Index landmark : landmarks) map.update(landmark);
  int taken = 0;
  for (; taken < steps; ++taken) {
    std::vector<Observed> all;
    for (const Index landmark : landmarks) collect(map, map.landmarks[landmark], all);
    const double before = cost_of(map, all);
    Problem problem(map, free);
    for (const Observed& observed : all) problem.add(observed);
    const Eigen::VectorXd step = problem.step();
    if (!step.allFinite()) break;
    std::vector<Pose> old;
    for (Index i = 0; i < free.size(); ++i) {
      Pose& T = map.submaps[free[i]].T_map_submap;
      old.push_back(T);
      const Vec6 move = step.segment<6>(static_cast<Eigen::Index>(6 * i));
      T = T * Pose{rotation_by(move.tail<3>()), move.head<3>()};
    }
    for (const Index landmark : landmarks) map.update(landmark);
    const double after = cost_of(map, all);
    if (after <= before) {
      if (before - after > kSettled * before) continue;
      ++taken;
      break;
    }
    for (Index i = 0; i < free.size(); ++i) map.submaps[free[i]].T_map_submap = old[i];
    break;
  }
  for (const Index landmark : landmarks) map.rebuild(landmark);
  return taken;
}

}  // namespace hallway::slam_plane::spatial

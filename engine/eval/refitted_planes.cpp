// SPDX-License-Identifier: MIT
#include "eval/refitted_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "geom/symmetric.hpp"

namespace hallway::eval {
namespace {

using Vec6 =
    Eigen::Matrix<double, 6, 1>;  // a small motion: step [m], then turn about the body's origin [rad]
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr int kSteps = 5;            // of Gauss and Newton, at most
constexpr double kLeastStep = 1e-7;  // [m, rad]
constexpr int kRounds = 2;           // of weighing
constexpr double kGateSigmas = 4.0;
constexpr double kLeastSigma = 1e-4;
constexpr double kUpright = 1e-3;  // largest z of the normal of an upright plane
constexpr double kHold = 1e-6;     // of what nothing determines [1/m^2]
constexpr double kLeastLeft =
    0.1;  // share of a residual's variance that the fit must leave, for it to tell its size
constexpr double kMadToSigma = 1.4826;  // of normal noise

/// What is compared, in the order of their standard deviations.
enum Kind : std::size_t { kTurn, kOffset, kEnd, kKinds };
using Sigmas = std::array<double, kKinds>;
/// What the first round is weighed by, wide enough for most sensors [rad, m, m].
constexpr Sigmas kFirst = {0.02, 0.05, 0.03};

/// An edge at which a plane of the map truly ends.
struct Edge {
  Vec3 place;      ///< on it
  Vec3 direction;  ///< unit, within the plane, outwards
};

struct Target {
  Vec3 normal, tangent[2];
  double offset = 0.0;
  std::vector<Edge> edges;
};

Target target_of(const log::MappedPlane& plane) {
  Target target;
  target.normal = Vec3(plane.normal.data());
  target.offset = plane.offset_m;
  target.tangent[0] = target.normal.unitOrthogonal();
  target.tangent[1] = target.normal.cross(target.tangent[0]);
  const std::size_t n = plane.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!plane.outline[i].edge_certain) continue;
    const Vec3 a = Vec3(plane.outline[i].position_m.data()),
               b = Vec3(plane.outline[(i + 1) % n].position_m.data());
    target.edges.push_back({a, (b - a).cross(target.normal).normalized()});
  }
  return target;
}

/// A plane that was given, beside the one of the map.
struct Match {
  Vec3 normal, middle;
  std::span<const Vec3> bounds;
  const Target* target = nullptr;
  bool level = false;  ///< the map is of upright planes alone: the body moves and turns in the level
};

Vec6 row_of(const Vec3& step, const Vec3& turn) {
  Vec6 row;
  row << step, turn;
  return row;
}

/// Calls `take(kind, residual, row)` with all that is compared at a pose.
template <typename Take>
void compare(const Match& match, const Pose& T, Take take_any) {
  const auto take = [&](Kind kind, double residual, Vec6 row) {
    if (match.level) row.segment<3>(2).setZero();  // height, and turns out of the vertical
    if (!row.isZero()) take_any(kind, residual, row);
  };
  const Target& target = *match.target;
  const Vec3 normal = T.q * match.normal, middle = T.q * match.middle;
  for (const Vec3& tangent : target.tangent)
    take(kTurn, tangent.dot(normal), row_of(Vec3::Zero(), normal.cross(tangent)));
  take(kOffset, target.normal.dot(middle + T.t) - target.offset,
       row_of(target.normal, middle.cross(target.normal)));
  for (const Edge& edge : target.edges) {
    Vec3 farthest = middle;
    for (const Vec3& bound : match.bounds) {
      const Vec3 p = T.q * bound;
      if (edge.direction.dot(p) > edge.direction.dot(farthest)) farthest = p;
    }
    take(kEnd, edge.direction.dot(farthest + T.t - edge.place),
         row_of(edge.direction, farthest.cross(edge.direction)));
  }
}

bool counts(Kind kind, double residual, const Sigmas& sigmas) {
  return std::abs(residual) <= kGateSigmas * sigmas[kind];
}

Mat6 information(const std::vector<Match>& matches, const Pose& T, const Sigmas& sigmas, Vec6& gradient) {
  Mat6 h = Mat6::Zero();
  gradient.setZero();
  for (const Match& match : matches) {
    compare(match, T, [&](Kind kind, double residual, const Vec6& row) {
      if (!counts(kind, residual, sigmas)) return;
      const double weight = 1.0 / (sigmas[kind] * sigmas[kind]);
      h += weight * row * row.transpose();
      gradient -= weight * residual * row;
    });
  }
  return h;
}

/// Moves a pose to where the planes lie best; not in directions that they leave open.
Pose fitted(const std::vector<Match>& matches, Pose T, const Sigmas& sigmas) {
  const double least = 1.0 / (RefittedPlanes::kUndetermined_m * RefittedPlanes::kUndetermined_m);
  for (int i = 0; i < kSteps; ++i) {
    Vec6 gradient;
    const Spectrum<6> free = spectrum<6>(information(matches, T, sigmas, gradient));
    Vec6 x = Vec6::Zero();
    for (int k = 0; k < 6; ++k) {
      const Vec6 axis = free.vectors.col(k);
      if (free.values(k) >= least) x += axis.dot(gradient) / free.values(k) * axis;
    }
    const Vec3 turn = x.tail<3>();
    T.t += x.head<3>();
    T.q = (Quat(Eigen::AngleAxisd(turn.norm(), turn.norm() > 0.0 ? Vec3(turn.normalized()) : Vec3::UnitZ())) *
           T.q)
              .normalized();
    if (x.norm() < kLeastStep) break;
  }
  return T;
}

/// Whether the planes tell the position, but for the height where all of them are upright.
bool is_determined(const std::vector<Match>& matches, const Pose& T, const Sigmas& sigmas) {
  Vec6 gradient;
  const Mat6 h = information(matches, T, sigmas, gradient);
  Eigen::Matrix3d turns = h.bottomRightCorner<3, 3>();
  turns.diagonal().array() += kHold;
  const Eigen::Matrix3d position =
      h.topLeftCorner<3, 3>() - h.topRightCorner<3, 3>() * symmetric_inverse<3>(turns) * h.bottomLeftCorner<3, 3>();
  const bool level = matches.empty() || matches.front().level;
  const double worst =
      level ? spectrum<2>(position.topLeftCorner<2, 2>()).values(0) : spectrum<3>(position).values(0);
  return worst * RefittedPlanes::kUndetermined_m * RefittedPlanes::kUndetermined_m >= 1.0;
}

/// Calls `take(kind, size)` with what is left of each residual that counts at a fitted pose, as large as it would be had it not taken part in the fit.
template <typename Take>
void visit_errors(const std::vector<Match>& matches, const Pose& T, const Sigmas& sigmas, Take take) {
  Vec6 gradient;
  Mat6 h = information(matches, T, sigmas, gradient);
  h.diagonal().array() += kHold;
  const Mat6 covariance = symmetric_inverse<6>(h);
  for (const Match& match : matches) {
    compare(match, T, [&](Kind kind, double residual, const Vec6& row) {
      if (!counts(kind, residual, sigmas)) return;
      const double left = 1.0 - row.dot(covariance * row) / (sigmas[kind] * sigmas[kind]);
      if (left > kLeastLeft) take(kind, std::abs(residual) / std::sqrt(left));
    });
  }
}

/// The standard deviation of what is normal but for some that is not.
double scatter(std::vector<double>& sizes, double otherwise) {
  if (sizes.empty()) return otherwise;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastSigma, kMadToSigma * *middle);
}

}  // namespace

void RefittedPlanes::add(std::uint32_t iteration, const Pose& T_map_body, std::span<const GivenPlane> given) {
  if (!complete_) return;
  for (const GivenPlane& plane : given) {
    if (plane.taken_for == log::kNoLandmark || plane.normal.isZero()) continue;
    bounds_.insert(bounds_.end(), plane.bounds.begin(), plane.bounds.end());
    sights_.push_back({plane.taken_for, plane.normal, plane.middle, bounds_.size()});
  }
  frames_.push_back({iteration, T_map_body, sights_.size()});
  if (bounds_.size() <= kMaxPoints) return;
  complete_ = false;
  bounds_ = {};
  sights_ = {};
  frames_ = {};
}

std::vector<RefittedPlanes::Placed> RefittedPlanes::place(std::span<const log::MappedPlane> map) const {
  std::unordered_map<log::LandmarkId, Target> targets;
  bool level = true;
  for (const log::MappedPlane& plane : map) {
    if (plane.status != log::LandmarkStatus::kMapped) continue;
    targets.emplace(plane.id, target_of(plane));
    level = level && std::abs(plane.normal[2]) < kUpright;
  }
  std::vector<std::vector<Match>> matches(frames_.size());
  std::vector<Placed> all;
  for (std::size_t f = 0, s = 0, b = 0; f < frames_.size(); ++f) {
    for (; s < frames_[f].end; b = sights_[s++].end) {
      const auto found = targets.find(sights_[s].plane);
      if (found == targets.end()) continue;
      const std::span<const Vec3> bounds = std::span(bounds_).subspan(b, sights_[s].end - b);
      matches[f].push_back({sights_[s].normal, sights_[s].middle, bounds, &found->second, level});
    }
    all.push_back({frames_[f].iteration, frames_[f].T_map_body});
  }
  Sigmas sigmas = kFirst;
  for (int round = 0; round <= kRounds; ++round) {
    std::array<std::vector<double>, kKinds> sizes;
    for (std::size_t f = 0; f < all.size(); ++f) {
      all[f].T_map_body = fitted(matches[f], all[f].T_map_body, sigmas);
      if (round == kRounds) continue;
      visit_errors(matches[f], all[f].T_map_body, sigmas,
                   [&](Kind kind, double size) { sizes[kind].push_back(size); });
    }
    if (round == kRounds) break;
    for (std::size_t kind = 0; kind < kKinds; ++kind) sigmas[kind] = scatter(sizes[kind], kFirst[kind]);
  }
  std::vector<Placed> placed;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (is_determined(matches[f], all[f].T_map_body, sigmas)) placed.push_back(all[f]);
  }
  return placed;
}

}  // namespace hallway::eval

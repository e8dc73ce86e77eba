// SPDX-License-Identifier: MIT
#include "eval/refitted_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "geometry/symmetric.hpp"

namespace hallway::eval {
namespace {

using Vec6 =
    Eigen::Matrix<double, 6, 1>;  // a small motion: step [m], then turn about the body's origin [rad]
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr int kRefitSteps = 5;       // of Gauss and Newton, at most, in each stage of a fit
constexpr double kLeastStep = 1e-7;  // [m, rad]
constexpr int kRounds = 2;           // of weighing
constexpr double kGateSigmas = 4.0;
constexpr double kLeastSigma = 1e-4;
constexpr double kUpright = 1e-3;  // largest z of the normal of an upright plane
constexpr double kHold = 1e-6;     // of what nothing determines [1/m^2]
constexpr double kLeastLeft =
    0.1;  // share of a residual's variance that the fit must leave, for it to tell its size
constexpr double kMadToSigma = 1.4826;  // of normal noise
constexpr double kSameNormal = 0.985;   // cosine between a plane and what has become of it
constexpr double kSamePlane_m = 0.2;    // likewise, distance
constexpr std::size_t kLeastVotes = 5;  // sights that tell what has become of a plane

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
  double from[2], to[2];  // along the tangents
  std::vector<Edge> edges;
};

Target target_of(const log::PlaneLandmark& plane) {
  Target target;
  target.normal = Vec3(plane.normal.data());
  target.offset = plane.offset_m;
  target.tangent[0] = target.normal.unitOrthogonal();
  target.tangent[1] = target.normal.cross(target.tangent[0]);
  const std::size_t n = plane.outline.size();
  for (int k = 0; k < 2; ++k) {
    target.from[k] = std::numeric_limits<double>::max();
    target.to[k] = std::numeric_limits<double>::lowest();
    for (const log::OutlineCorner& corner : plane.outline) {
      const double place = target.tangent[k].dot(Vec3(corner.position_m.data()));
      target.from[k] = std::min(target.from[k], place);
      target.to[k] = std::max(target.to[k], place);
    }
  }
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

/// How far a fit has come. What is a plane is told by itself, what is an end by where the planes put the frame: of the ends there some are cuts.
enum class Stage { planes, doubted, gated };

/// What a residual counts for: less the farther off it is, and in the end not at all beyond the gate.
double weight_of(Kind kind, double residual, const Sigmas& sigmas, Stage stage) {
  const double sigma = sigmas[kind];
  const double ratio = std::abs(residual) / (kGateSigmas * sigma);
  if (stage == Stage::gated) return ratio <= 1.0 ? 1.0 / (sigma * sigma) : 0.0;
  if (stage == Stage::planes && kind == kEnd) return 0.0;
  const double widest = std::hypot(std::max(sigma, kFirst[kind]), kind == kEnd ? sigmas[kOffset] : 0.0);
  if (std::abs(residual) > kGateSigmas * widest) return 0.0;
  return 1.0 / (sigma * sigma * (1.0 + ratio * ratio));
}

Mat6 information(const std::vector<Match>& matches, const Pose& T, const Sigmas& sigmas, Stage stage,
                 Vec6& gradient) {
  Mat6 h = Mat6::Zero();
  gradient.setZero();
  for (const Match& match : matches) {
    compare(match, T, [&](Kind kind, double residual, const Vec6& row) {
      const double weight = weight_of(kind, residual, sigmas, stage);
      h += weight * row * row.transpose();
      gradient -= weight * residual * row;
    });
  }
  return h;
}

/// Moves a pose to where the planes lie best; not in directions that they leave open.
void fit(const std::vector<Match>& matches, const Sigmas& sigmas, Stage stage, Pose& T) {
  const double least = 1.0 / (RefittedPlanes::kUndetermined_m * RefittedPlanes::kUndetermined_m);
  for (int i = 0; i < kRefitSteps; ++i) {
    Vec6 gradient;
    const Spectrum<6> free = spectrum<6>(information(matches, T, sigmas, stage, gradient));
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
}

Pose fitted(const std::vector<Match>& matches, Pose T, const Sigmas& sigmas) {
  for (const Stage stage : {Stage::planes, Stage::doubted, Stage::gated}) fit(matches, sigmas, stage, T);
  return T;
}

/// Whether this information tells the position, but for the height where the body stays level.
bool tells_position(const Mat6& h, bool level) {
  Eigen::Matrix3d turns = h.bottomRightCorner<3, 3>();
  turns.diagonal().array() += kHold;
  const Eigen::Matrix3d position = h.topLeftCorner<3, 3>() - h.topRightCorner<3, 3>() *
                                                                 Ldlt<3>(turns).inverse() *
                                                                 h.bottomLeftCorner<3, 3>();
  const double worst =
      level ? spectrum<2>(position.topLeftCorner<2, 2>()).values(0) : spectrum<3>(position).values(0);
  return worst * RefittedPlanes::kUndetermined_m * RefittedPlanes::kUndetermined_m >= 1.0;
}

/// Whether the planes tell the position. One end alone does not: whether a plane ends there or something cuts it there, nothing else in the frame says.
bool is_determined(const std::vector<Match>& matches, const Pose& T, const Sigmas& sigmas) {
  if (matches.empty()) return false;
  const bool level = matches.front().level;
  Vec6 gradient;
  const Mat6 h = information(matches, T, sigmas, Stage::gated, gradient);
  bool determined = tells_position(h, level);
  for (const Match& match : matches) {
    compare(match, T, [&](Kind kind, double residual, const Vec6& row) {
      const double weight = weight_of(kind, residual, sigmas, Stage::gated);
      if (kind != kEnd || weight == 0.0 || !determined) return;
      determined = tells_position(h - weight * row * row.transpose(), level);
    });
  }
  return determined;
}

/// Calls `take(kind, size)` with what is left of each residual that counts at a fitted pose, as large as it would be had it not taken part in the fit.
template <typename Take>
void visit_errors(const std::vector<Match>& matches, const Pose& T, const Sigmas& sigmas, Take take) {
  Vec6 gradient;
  Mat6 h = information(matches, T, sigmas, Stage::gated, gradient);
  h.diagonal().array() += kHold;
  const Mat6 covariance = Ldlt<6>(h).inverse();
  for (const Match& match : matches) {
    compare(match, T, [&](Kind kind, double residual, const Vec6& row) {
      if (weight_of(kind, residual, sigmas, Stage::gated) == 0.0) return;
      const double left = 1.0 - row.dot(covariance * row) / (sigmas[kind] * sigmas[kind]);
      if (left > kLeastLeft) take(kind, std::abs(residual) / std::sqrt(left));
    });
  }
}

/// How far a plane that was seen lies from one of the map, if it may be that.
std::optional<double> distance(const Target& target, const Vec3& normal, const Vec3& middle) {
  if (target.normal.dot(normal) < kSameNormal) return std::nullopt;
  for (int k = 0; k < 2; ++k) {
    const double place = target.tangent[k].dot(middle);
    if (place < target.from[k] || place > target.to[k]) return std::nullopt;
  }
  const double off = std::abs(target.normal.dot(middle) - target.offset);
  return off < kSamePlane_m ? std::optional(off) : std::nullopt;
}

/// The standard deviation of what is normal but for some that is not.
double scatter(std::vector<double>& sizes, double otherwise) {
  if (sizes.empty()) return otherwise;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastSigma, kMadToSigma * *middle);
}

}  // namespace

void RefittedPlanes::add(std::uint32_t iteration, const Pose& T_map_body,
                         std::span<const AssociatedPlane> observations) {
  if (!complete_) return;
  for (const AssociatedPlane& plane : observations) {
    if (plane.landmark == log::kNoLandmark || plane.normal.isZero()) continue;
    bounds_.insert(bounds_.end(), plane.bounds.begin(), plane.bounds.end());
    sights_.push_back({plane.landmark, plane.normal, plane.centroid, bounds_.size()});
  }
  frames_.push_back({iteration, T_map_body, sights_.size()});
  if (bounds_.size() <= kMaxPoints) return;
  complete_ = false;
  bounds_ = {};
  sights_ = {};
  frames_ = {};
}

std::map<log::LandmarkId, log::LandmarkId> RefittedPlanes::heirs_in(
    std::span<const log::PlaneLandmark> map) const {
  std::map<log::LandmarkId, Target> targets;
  std::set<log::LandmarkId> there;
  for (const log::PlaneLandmark& plane : map) {
    there.insert(plane.id);
    if (plane.status == log::LandmarkStatus::kMapped) targets.emplace(plane.id, target_of(plane));
  }
  struct Votes {
    std::size_t sights = 0;
    std::map<log::LandmarkId, std::size_t> of;
  };
  std::map<log::LandmarkId, Votes> gone;
  for (std::size_t f = 0, s = 0; f < frames_.size(); ++f) {
    const Pose& T = frames_[f].T_map_body;
    for (; s < frames_[f].end; ++s) {
      if (there.contains(sights_[s].plane)) continue;
      Votes& votes = gone[sights_[s].plane];
      ++votes.sights;
      const Vec3 normal = T.q * sights_[s].normal, middle = T * sights_[s].middle;
      std::optional<double> nearest;
      log::LandmarkId heir = 0;
      for (const auto& [id, target] : targets) {
        const std::optional<double> off = distance(target, normal, middle);
        if (!off || (nearest && *off >= *nearest)) continue;
        nearest = off;
        heir = id;
      }
      if (nearest) ++votes.of[heir];
    }
  }
  std::map<log::LandmarkId, log::LandmarkId> heirs;
  for (const auto& [id, votes] : gone) {
    for (const auto& [heir, count] : votes.of) {
      if (count >= kLeastVotes && 2 * count > votes.sights) heirs.emplace(id, heir);
    }
  }
  return heirs;
}

std::vector<RefittedPlanes::Placed> RefittedPlanes::place(std::span<const log::PlaneLandmark> map) const {
  std::map<log::LandmarkId, Target> targets;
  bool level = true;
  for (const log::PlaneLandmark& plane : map) {
    if (plane.status != log::LandmarkStatus::kMapped) continue;
    targets.emplace(plane.id, target_of(plane));
    level = level && std::abs(plane.normal[2]) < kUpright;
  }
  const std::map<log::LandmarkId, log::LandmarkId> heirs = heirs_in(map);
  std::vector<std::vector<Match>> matches(frames_.size());
  std::vector<Placed> all;
  for (std::size_t f = 0, s = 0, b = 0; f < frames_.size(); ++f) {
    for (; s < frames_[f].end; b = sights_[s++].end) {
      const auto heir = heirs.find(sights_[s].plane);
      const auto found = targets.find(heir == heirs.end() ? sights_[s].plane : heir->second);
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
      all[f].T_map_body = fitted(matches[f], frames_[f].T_map_body, sigmas);
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

// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kLeastShare = 0.5;       // of the smaller outline
constexpr double kDuplicateShare = 0.15;  // what lies in one plane and overlaps is one; less may be noise
constexpr double kRivalShare = 0.2;       // two parts of one plane share less than that of the smaller one
constexpr double kTrailShare = 0.8;       // of the bound, that a plane that moves may have gone since
constexpr double kTouch_m = 0.05;         // and are farther apart than noise may bring them
constexpr double kLeastArea_m2 = 1e-4;
constexpr double kSlack_m = 1e-6;       // of rounding
constexpr double kDuplicates_m = 0.06;  // farthest that two planes lie from each other's planes that are one

/// Area that two outlines share, as a share of the smaller one.
double shared(const Convex& a, const Convex& b) {
  const double least = std::min(area(a), area(b));
  return least < kLeastArea_m2 ? 0.0 : overlap_area(a, b) / least;
}

double area_of(const AssociatedObservation& observation) {
  return area(PlaneAxes(observation.normal).flat(observation.outline));
}

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

PlaneMatcher::PlaneMatcher(const Options& options)
    : near_bound_(options.match_bound_m),
      map_bound_(options.map_bound_m),
      cosine_(std::cos(radians(options.match_angle_deg))),
      sine_(std::sin(radians(options.match_angle_deg))) {}

/// The box about all points of planes that an observation may be of. Where outlines overlap in the landmark's plane, the observation lies above the plane by no more than the bound and
/// what the largest angle between them makes of its extent.
Box PlaneMatcher::about(const AssociatedObservation& observation, const Pose& T, double bound) const {
  double bent = 0.0, reach = 0.0;  // a hull need not lie in its plane
  for (const Vec3& p : observation.outline) {
    bent = std::max(bent, std::abs(observation.normal.dot(p) - observation.offset()));
    reach = std::max(reach, (p - observation.centre).norm());
  }
  Box box = box_of(observation.outline, T);
  const Vec3 margin = Vec3::Constant(bound + bent + reach * sine_ + kSlack_m);
  return {box.min() - margin, box.max() + margin};
}

double PlaneMatcher::score(const PlaneRecord& landmark, const AssociatedObservation& observation,
                           const Pose& T, double bound) const {
  return landmark.outline.size() < 3 ? 0.0 : score(landmark.plane, landmark.outline, observation, T, bound);
}

double PlaneMatcher::score(const Feature& plane, const std::vector<Vec3>& outline,
                           const AssociatedObservation& observation, const Pose& T, double bound) const {
  const double agreement = plane.normal().dot(T.q * observation.normal);
  if (agreement < cosine_) return 0.0;
  const double offset = std::abs(plane.distance(T * observation.centre));
  if (offset > bound) return 0.0;
  const PlaneAxes axes(plane.normal());
  const Convex known = axes.flat(outline), seen = axes.flat(observation.outline, T);
  if (shared(known, seen) < kLeastShare) return 0.0;
  return overlap_area(known, seen) / area(seen) * (1.1 - offset / bound);
}

void PlaneMatcher::find_candidates(const PlaneMap& map, std::uint64_t since, double bound, const Pose& T,
                                   const AssociatedObservation& observation) {
  map.find_near(about(observation, T, bound), near_);
  for (const Index f : near_) {
    const PlaneRecord& landmark = map.landmarks[f];
    if (landmark.last_seen < since) continue;
    const double found = score(landmark, observation, T, bound);
    if (found > 0.0) candidates_.push_back({found, f, landmark.is_dynamic});
  }
}

/// Planes that lay beside their places just before and have gone on from there.
void PlaneMatcher::find_displaced(const PlaneMap& map, const Pose& T,
                                  const AssociatedObservation& observation) {
  for (const Index f : map.displaced()) {
    const PlaneRecord& landmark = map.landmarks[f];
    if (score(landmark, observation, T, near_bound_) > 0.0) continue;
    const double found =
        score(landmark.trail.plane(), landmark.trail.outline(), observation, T, kTrailShare * near_bound_);
    if (found > 0.0) candidates_.push_back({found, f, true});
  }
}

/// Largest first: of two neighbours in one plane the larger one tells which plane it is, and a sliver of the other is then not taken for the same.
void PlaneMatcher::match(const PlaneMap& map, const Search& search, const Pose& T,
                         std::vector<AssociatedObservation>& frame) {
  std::vector<std::pair<double, Index>> order;
  for (Index i = 0; i < frame.size(); ++i) {
    if (frame[i].landmark == kNone) order.emplace_back(-area_of(frame[i]), i);
  }
  std::ranges::sort(order);
  for (const auto& [size, i] : order) {
    candidates_.clear();
    find_candidates(map, search.since, search.bound_m, T, frame[i]);
    if (search.follow) find_displaced(map, T, frame[i]);
    std::ranges::sort(candidates_, [](const Candidate& a, const Candidate& b) {
      return std::tie(b.score, a.landmark) < std::tie(a.score, b.landmark);
    });
    for (const Candidate& candidate : candidates_) {
      if (is_taken(map.landmarks[candidate.landmark], candidate.landmark, frame, i, T)) continue;
      frame[i].landmark = candidate.landmark;
      frame[i].outlier = candidate.outlier;
      break;
    }
  }
}

/// Whether another observation is a plane, and lies where this one would be the same part of it, or next to it: what one frame sees as two that touch is two.
bool PlaneMatcher::is_taken(const PlaneRecord& landmark, Index index,
                            const std::vector<AssociatedObservation>& frame, Index own, const Pose& T) const {
  const PlaneAxes axes(landmark.plane.normal());
  Convex part;
  for (Index k = 0; k < frame.size(); ++k) {
    if (k == own || frame[k].landmark != index) continue;
    if (part.empty()) part = axes.flat(frame[own].outline, T);
    const Convex other = axes.flat(frame[k].outline, T);
    if (shared(part, other) >= kRivalShare || distance(part, other) <= kTouch_m) return true;
  }
  return false;
}

void PlaneMatcher::match_recent(const PlaneMap& map, std::uint64_t since, const Pose& T_map_robot,
                                std::vector<AssociatedObservation>& frame) {
  match(map, {since, near_bound_, true}, T_map_robot, frame);
}

void PlaneMatcher::match_map(const PlaneMap& map, const Pose& T_map_robot,
                             std::vector<AssociatedObservation>& frame) {
  match(map, {0, map_bound_, false}, T_map_robot, frame);
}

bool PlaneMatcher::on_one_plane(const PlaneRecord& a, const PlaneRecord& b) const {
  return a.plane.normal().dot(b.plane.normal()) >= cosine_ &&
         std::abs(a.plane.distance(middle_of(b.outline))) <= kDuplicates_m &&
         std::abs(b.plane.distance(middle_of(a.outline))) <= kDuplicates_m;
}

bool PlaneMatcher::are_duplicates(const PlaneMap& map, Index a, Index b) const {
  const PlaneRecord& one = map.landmarks[a];
  const PlaneRecord& other = map.landmarks[b];
  if (one.is_dynamic || other.is_dynamic) return false;
  if (one.outline.size() < 3 || other.outline.size() < 3 || map.are_apart(a, b)) return false;
  if (!on_one_plane(one, other)) return false;
  const PlaneAxes axes(one.plane.normal());
  return shared(axes.flat(one.outline), axes.flat(other.outline)) >= kDuplicateShare;
}

std::vector<Index> PlaneMatcher::duplicates_of(const PlaneMap& map, Index landmark) const {
  const std::vector<Vec3>& outline = map.landmarks[landmark].outline;
  if (outline.size() < 3) return {};
  const Vec3 middle = middle_of(outline);
  double reach = 0.0;
  for (const Vec3& p : outline) reach = std::max(reach, (p - middle).norm());
  // The middle lies near the other's plane, which is tilted by the largest angle at most.
  const Vec3 margin = Vec3::Constant((kDuplicates_m + reach * sine_) / cosine_ + kSlack_m);
  const Box box = box_of(outline);
  std::vector<Index> duplicates;
  map.find_near({box.min() - margin, box.max() + margin}, duplicates);
  std::erase_if(duplicates,
                [&](Index other) { return other == landmark || !are_duplicates(map, landmark, other); });
  return duplicates;
}

}  // namespace hallway::slam_plane::spatial

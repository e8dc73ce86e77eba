// SPDX-License-Identifier: MIT
#include "eval/plane_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "eval/plane_alignment.hpp"
#include "eval/point_error.hpp"
#include "geom/arrays.hpp"
#include "geometry/rigid_fit.hpp"

namespace hallway::eval {
namespace {

using log::LandmarkStatus;
using log::PlaneLandmark;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kLevel = 1e-3;  ///< largest z of the normal of an upright plane

/// Errors of one kind, one after the other.
class Errors {
 public:
  void add(double error) {
    const double size = std::abs(error);
    ++summary_.count;
    sum_ += size;
    squares_ += size * size;
    summary_.max = std::max(summary_.max, size);
  }
  std::optional<ErrorSummary> summary() const {
    if (summary_.count == 0) return std::nullopt;
    ErrorSummary summary = summary_;
    const auto n = static_cast<double>(summary.count);
    summary.mean = sum_ / n;
    summary.rms = std::sqrt(squares_ / n);
    return summary;
  }

 private:
  ErrorSummary summary_;
  double sum_ = 0.0;
  double squares_ = 0.0;
};

/// A line through a point in a direction, which is unit.
struct Line {
  Vec3 point = Vec3::Zero();
  Vec3 direction = Vec3::Zero();

  Vec3 nearest(const Vec3& p) const { return point + direction.dot(p - point) * direction; }
};

/// An end of a mapped plane that is said to be certain, by its middle, and the true end that it stands for.
struct End {
  Vec3 middle = Vec3::Zero();  ///< map frame
  Line truth;                  ///< world
  Vec3 true_middle = Vec3::Zero();
};

/// The middle of the edge from a corner of a landmark's outline to the next one.
Vec3 middle_of_edge(const PlaneLandmark& plane, std::size_t i) {
  const std::vector<log::OutlineCorner>& outline = plane.outline;
  return 0.5 * (to_vec3(outline[i].position_m) + to_vec3(outline[(i + 1) % outline.size()].position_m));
}

std::vector<End> certain_ends(const PlaneLandmark& plane, const std::vector<Vec3>& corners) {
  std::vector<End> ends;
  const std::size_t n = plane.outline.size();
  if (n != corners.size()) return ends;
  for (std::size_t i = 0; i < n; ++i) {
    if (!plane.outline[i].edge_certain) continue;
    const Vec3 &a = corners[i], &b = corners[(i + 1) % n];
    const Vec3 middle = middle_of_edge(plane, i);
    ends.push_back({middle, {a, (b - a).normalized()}, 0.5 * (a + b)});
  }
  return ends;
}

/// The certain edges of a plane that lies as it likes, each with the edge of its true plane that is nearest.
std::vector<End> certain_edges(const PlaneLandmark& plane, const std::vector<Vec3>& corners,
                               const Pose& T_world_map) {
  std::vector<End> edges;
  const std::size_t n = plane.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!plane.outline[i].edge_certain) continue;
    const Vec3 middle = middle_of_edge(plane, i);
    const Vec3 placed = T_world_map * middle;
    End edge{middle, {}, Vec3::Zero()};
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
      if (!((b - a).norm() > 0.0)) continue;  // of a triangle
      const Line line{a, (b - a).normalized()};
      const double distance = (placed - line.nearest(placed)).norm();
      if (distance >= least) continue;
      least = distance;
      edge.truth = line;
      edge.true_middle = line.nearest(placed);
    }
    edges.push_back(edge);
  }
  return edges;
}

Vec3 middle_of(const PlaneLandmark& plane) {
  Vec3 middle = Vec3::Zero();
  for (const log::OutlineCorner& corner : plane.outline)
    middle += to_vec3(corner.position_m) / static_cast<double>(plane.outline.size());
  return middle;
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A range along a plane.
struct Range {
  double from = 0.0;
  double to = 0.0;

  double length() const { return to - from; }
  double common(const Range& other) const {
    return std::max(std::min(to, other.to) - std::max(from, other.from), 0.0);
  }
};

/// Ranges that overlap as one, ascending.
std::vector<Range> joined(std::vector<Range> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.from < b.from; });
  std::vector<Range> joined;
  for (const Range& range : ranges) {
    if (!joined.empty() && range.from <= joined.back().to) {
      joined.back().to = std::max(joined.back().to, range.to);
    } else {
      joined.push_back(range);
    }
  }
  return joined;
}

/// What ranges have in common with another one, as a share of what either covers.
double iou(const std::vector<Range>& ranges, const Range& other) {
  double both = 0.0, either = other.length();
  for (const Range& range : joined(ranges)) {
    both += range.common(other);
    either += range.length() - range.common(other);
  }
  return either > 0.0 ? both / either : 0.0;
}

/// How many of the ranges lie where one before them does.
std::uint64_t doubled(const std::vector<Range>& ranges, double share) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    bool again = false;
    for (std::size_t k = 0; k < i; ++k)
      again =
          again || ranges[i].common(ranges[k]) >= share * std::min(ranges[i].length(), ranges[k].length());
    count += again ? 1u : 0u;
  }
  return count;
}

double heading_of(const Quat& q) {
  const Vec3 forward = q * Vec3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

log::PoseErrorRow error_of(std::uint32_t iteration, const Pose& estimate, const Pose& truth) {
  const double turn = heading_of(estimate.q) - heading_of(truth.q);
  return {iteration, (estimate.t - truth.t).norm(), kDegrees * std::remainder(turn, 2.0 * std::numbers::pi)};
}

}  // namespace

PlaneScore::PlaneScore(std::span<const log::TruePlane> planes) {
  for (const log::TruePlane& plane : planes) {
    ScoredPlane truth;
    for (const auto& corner : plane.corners_m) truth.corners.push_back(to_vec3(corner));
    for (const auto& corner : plane.outline()) truth.outline.push_back(to_vec3(corner));
    const Vec3 along = truth.corners[1] - truth.corners[0];
    truth.length_m = along.norm();
    if (!(truth.length_m > 0.0)) continue;
    truth.along = along / truth.length_m;
    truth.normal = truth.along.cross(truth.corners[3] - truth.corners[0]).normalized();
    truth.from_m = truth.length_m;
    true_planes_.emplace(plane.id, std::move(truth));
  }
}

void PlaneScore::add(std::span<const AssociatedPlane> observations, const std::optional<Pose>& T_world_body,
                     std::span<const TruePlanePoint> points) {
  std::vector<log::LandmarkId> landmarks, true_planes;
  for (const AssociatedPlane& plane : observations) {
    landmarks.push_back(plane.landmark);
    true_planes.push_back(plane.true_plane);
  }
  associations_.add(landmarks, true_planes);
  if (!T_world_body) return;
  std::map<log::LandmarkId, std::pair<double, double>> seen;
  for (const TruePlanePoint& seen_point : points) {
    const auto found = true_planes_.find(seen_point.true_plane);
    if (found == true_planes_.end()) continue;
    const ScoredPlane& truth = found->second;
    const double s =
        std::clamp(truth.along.dot(*T_world_body * seen_point.point - truth.corners[0]), 0.0, truth.length_m);
    const auto [entry, is_new] = seen.try_emplace(seen_point.true_plane, s, s);
    entry->second = {std::min(entry->second.first, s), std::max(entry->second.second, s)};
  }
  for (const auto& [id, extent] : seen) {
    ScoredPlane& truth = true_planes_.at(id);
    truth.from_m = std::min(truth.from_m, extent.first);
    truth.to_m = std::max(truth.to_m, extent.second);
    if (extent.second - extent.first >= kLeastLength_m) ++truth.frames;
  }
}

void PlaneScore::add_pose(std::uint32_t iteration, const Pose& T_world_body, const Pose& T_map_body,
                          std::span<const AssociatedPlane> observations) {
  poses_.push_back({iteration, T_world_body, T_map_body});
  refitted_.add(iteration, T_map_body, observations);
}

void PlaneScore::keep_poses(const std::function<bool(std::uint32_t)>& is_in_map) {
  for (TwoPoses& poses : poses_) poses.in_map = is_in_map(poses.iteration);
}

const PlaneScore::TwoPoses* PlaneScore::first_poses() const {
  const auto first =
      std::find_if(poses_.begin(), poses_.end(), [](const TwoPoses& poses) { return poses.in_map; });
  return first == poses_.end() ? nullptr : &*first;
}

std::optional<Pose> PlaneScore::first_pose_frame() const {
  const TwoPoses* first = first_poses();
  if (first == nullptr) return std::nullopt;
  return first->T_world_body * first->T_map_body.inverse();
}

std::vector<PlaneScore::Pair> PlaneScore::pairs_of(std::span<const PlaneLandmark> map) const {
  const AssociationScore::Ownership ownership = associations_.ownership();
  std::vector<Pair> pairs;
  for (const PlaneLandmark& plane : map) {
    const auto owner = ownership.owner.find(plane.id);
    if (plane.status != LandmarkStatus::kMapped || owner == ownership.owner.end()) continue;
    if (const auto truth = true_planes_.find(owner->second); truth != true_planes_.end())
      pairs.push_back({&plane, &truth->second});
  }
  return pairs;
}

bool PlaneScore::are_level(const std::vector<Pair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const Pair& pair) {
    return std::abs(pair.plane->normal[2]) < kLevel && std::abs(pair.truth->normal.z()) < kLevel;
  });
}

/// By the planes, from where the first pose puts the map.
std::optional<Pose> PlaneScore::spatial_alignment(const std::vector<Pair>& pairs, bool& by_planes) const {
  by_planes = false;
  const std::optional<Pose> first = first_pose_frame();
  if (!first) return std::nullopt;
  std::vector<PointOnPlane> points;
  for (const Pair& pair : pairs) {
    const Plane plane{pair.truth->normal, pair.truth->normal.dot(pair.truth->corners[0])};
    for (const log::OutlineCorner& corner : pair.plane->outline)
      points.push_back({to_vec3(corner.position_m), plane});
  }
  const std::optional<Pose> aligned = align_to_planes(points, *first);
  by_planes = aligned.has_value();
  return aligned ? aligned : first;
}

std::optional<Pose> PlaneScore::alignment(const std::vector<Pair>& pairs, bool& by_corners) const {
  if (!are_level(pairs)) return spatial_alignment(pairs, by_corners);
  std::vector<Vec3> from, to;
  for (const Pair& pair : pairs) {
    for (const End& end : certain_ends(*pair.plane, pair.truth->corners)) {
      from.push_back(end.middle);
      to.push_back(end.true_middle);
    }
  }
  for (std::vector<Vec3>* points : {&from, &to}) {
    for (Vec3& point : *points) point.z() = 0.0;
  }
  by_corners = determine_a_pose(from) && determine_a_pose(to);
  if (by_corners) {
    Pose T_world_map = *rigid_fit(from, to);
    const TwoPoses* first = first_poses();
    if (first != nullptr) T_world_map.t.z() = first->T_world_body.t.z() - first->T_map_body.t.z();
    return T_world_map;
  }
  return first_pose_frame();
}

std::optional<Pose> PlaneScore::alignment(std::span<const PlaneLandmark> map) const {
  bool by_corners = false;
  return alignment(pairs_of(map), by_corners);
}

void PlaneScore::count(std::span<const PlaneLandmark> map, PlaneMapMetrics& metrics) const {
  const AssociationScore::Ownership ownership = associations_.ownership();
  std::set<log::LandmarkId> owners;
  for (const PlaneLandmark& plane : map) {
    if (plane.status != LandmarkStatus::kMapped) continue;
    ++metrics.mapped;
    const auto owner = ownership.owner.find(plane.id);
    if (owner == ownership.owner.end()) {
      ++metrics.unmatched;
    } else if (!owners.insert(owner->second).second) {
      ++metrics.parts;
    }
  }
  for (const auto& [id, truth] : true_planes_) {
    if (is_asked_for(truth)) ++(owners.contains(id) ? metrics.walls_mapped : metrics.walls_missing);
  }
}

void PlaneScore::score_extents(const std::vector<Pair>& pairs, const Pose& T_world_map,
                               PlaneMapMetrics& metrics) {
  std::map<const ScoredPlane*, std::vector<Range>> extents;
  std::vector<const ScoredPlane*> truths;  // in the order of the pairs: that of pointers is none
  for (const auto& [plane, truth] : pairs) {
    Range extent{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (const log::OutlineCorner& corner : plane->outline) {
      const double s = truth->along.dot(T_world_map * to_vec3(corner.position_m) - truth->corners[0]);
      extent = {std::min(extent.from, s), std::max(extent.to, s)};
    }
    std::vector<Range>& of_truth = extents[truth];
    if (of_truth.empty()) truths.push_back(truth);
    of_truth.push_back(extent);
  }
  double sum = 0.0;
  for (const ScoredPlane* truth : truths) {
    const std::uint64_t again = doubled(extents.at(truth), kDoubled);
    metrics.duplicated += again;
    metrics.parts -= again;
    const bool seen = truth->to_m > truth->from_m;
    const double share = seen ? iou(extents.at(truth), {truth->from_m, truth->to_m}) : 0.0;
    sum += share;
    metrics.extent_iou_least = std::min(metrics.extent_iou_least.value_or(1.0), share);
  }
  if (!truths.empty()) metrics.extent_iou_mean = sum / static_cast<double>(truths.size());
}

PlaneMapMetrics PlaneScore::score(std::span<const PlaneLandmark> map) const {
  PlaneMapMetrics metrics;
  count(map, metrics);
  const std::vector<Pair> pairs = pairs_of(map);
  const std::optional<Pose> T_world_map = alignment(pairs, metrics.aligned);
  if (!T_world_map) return metrics;
  const bool level = are_level(pairs);
  Errors angles, offsets, corners;
  for (const auto& [plane, truth] : pairs) {
    angles.add(angle_deg(T_world_map->q * to_vec3(plane->normal), truth->normal));
    offsets.add(truth->normal.dot(*T_world_map * middle_of(*plane) - truth->corners[0]));
    for (const End& end :
         level ? certain_ends(*plane, truth->corners) : certain_edges(*plane, truth->outline, *T_world_map)) {
      const Vec3 middle = *T_world_map * end.middle;
      corners.add((middle - end.truth.nearest(middle)).norm());
    }
  }
  metrics.angle_deg = angles.summary();
  metrics.offset_m = offsets.summary();
  metrics.corner_m = corners.summary();
  score_extents(pairs, *T_world_map, metrics);
  return metrics;
}

std::vector<log::PoseErrorRow> PlaneScore::pose_errors(std::span<const PlaneLandmark> map) const {
  std::vector<log::PoseErrorRow> errors;
  const std::optional<Pose> T_world_map = alignment(map);
  if (!T_world_map) return errors;
  for (const TwoPoses& poses : poses_) {
    if (!poses.in_map) continue;
    errors.push_back(error_of(poses.iteration, *T_world_map * poses.T_map_body, poses.T_world_body));
  }
  return errors;
}

std::vector<log::PoseErrorRow> PlaneScore::refitted_errors(std::span<const PlaneLandmark> map) const {
  std::vector<log::PoseErrorRow> errors;
  const std::optional<Pose> T_world_map = alignment(map);
  if (!T_world_map) return errors;
  auto poses = poses_.begin();  // in the order in which they were added, as those that are placed
  for (const RefittedPlanes::Placed& placed : refitted_.place(map)) {
    while (poses->iteration != placed.iteration) ++poses;
    errors.push_back(error_of(placed.iteration, *T_world_map * placed.T_map_body, poses->T_world_body));
  }
  return errors;
}

PlaneMetrics PlaneScore::metrics(std::span<const PlaneLandmark> online,
                                 std::span<const PlaneLandmark> refined) const {
  PlaneMetrics metrics;
  metrics.observations = associations_.observations();
  metrics.associations_none = associations_.none();
  metrics.association_errors = associations_.ownership().errors;
  for (const auto& [id, truth] : true_planes_) metrics.walls_true += is_asked_for(truth) ? 1u : 0u;
  metrics.online = score(online);
  metrics.refined = score(refined);
  const auto summarize = [](const std::vector<log::PoseErrorRow>& errors,
                            std::optional<ErrorSummary>& position_m,
                            std::optional<ErrorSummary>& heading_deg) {
    Errors positions, headings;
    for (const log::PoseErrorRow& error : errors) {
      positions.add(error.position_m);
      headings.add(error.heading_deg);
    }
    position_m = positions.summary();
    heading_deg = headings.summary();
  };
  summarize(pose_errors(online), metrics.position_m, metrics.heading_deg);
  summarize(refitted_errors(refined), metrics.position_refitted_m, metrics.heading_refitted_deg);
  return metrics;
}

}  // namespace hallway::eval

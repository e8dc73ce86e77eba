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
#include "geometry/rigid_fit.hpp"

namespace hallway::eval {
namespace {

using log::LandmarkStatus;
using log::MappedPlane;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kLevel = 1e-3;  ///< largest z of the normal of an upright plane

Vec3 vector_of(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

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

std::vector<End> certain_ends(const MappedPlane& plane, const std::vector<Vec3>& corners) {
  std::vector<End> ends;
  const std::size_t n = plane.outline.size();
  if (n != corners.size()) return ends;
  for (std::size_t i = 0; i < n; ++i) {
    if (!plane.outline[i].edge_certain) continue;
    const Vec3 &a = corners[i], &b = corners[(i + 1) % n];
    const Vec3 middle =
        0.5 * (vector_of(plane.outline[i].position_m) + vector_of(plane.outline[(i + 1) % n].position_m));
    ends.push_back({middle, {a, (b - a).normalized()}, 0.5 * (a + b)});
  }
  return ends;
}

/// The certain edges of a plane that lies as it likes, each with the edge of its face that is nearest.
std::vector<End> certain_edges(const MappedPlane& plane, const std::vector<Vec3>& corners,
                               const Pose& T_world_map) {
  std::vector<End> edges;
  const std::size_t n = plane.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!plane.outline[i].edge_certain) continue;
    const Vec3 middle =
        0.5 * (vector_of(plane.outline[i].position_m) + vector_of(plane.outline[(i + 1) % n].position_m));
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

Vec3 middle_of(const MappedPlane& plane) {
  Vec3 middle = Vec3::Zero();
  for (const log::MappedCorner& corner : plane.outline)
    middle += vector_of(corner.position_m) / static_cast<double>(plane.outline.size());
  return middle;
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A range along a wall.
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

PlaneScore::PlaneScore(std::span<const log::TrueWall> walls) {
  for (const log::TrueWall& wall : walls) {
    Face face;
    for (const auto& corner : wall.corners_m) face.corners.push_back(vector_of(corner));
    for (const auto& corner : wall.hull_m) face.outline.push_back(vector_of(corner));
    if (face.outline.empty()) face.outline = face.corners;
    const Vec3 along = face.corners[1] - face.corners[0];
    face.length_m = along.norm();
    if (!(face.length_m > 0.0)) continue;
    face.along = along / face.length_m;
    face.normal = face.along.cross(face.corners[3] - face.corners[0]).normalized();
    face.from_m = face.length_m;
    faces_.emplace(wall.id, std::move(face));
  }
}

void PlaneScore::add(std::span<const GivenPlane> given, const std::optional<Pose>& T_world_body,
                     std::span<const WallPlace> places) {
  std::vector<log::LandmarkId> taken_for, walls;
  for (const GivenPlane& plane : given) {
    taken_for.push_back(plane.taken_for);
    walls.push_back(plane.wall);
  }
  associations_.add(taken_for, walls);
  if (!T_world_body) return;
  std::map<log::LandmarkId, std::pair<double, double>> seen;
  for (const WallPlace& place : places) {
    const auto found = faces_.find(place.wall);
    if (found == faces_.end()) continue;
    const Face& face = found->second;
    const double s =
        std::clamp(face.along.dot(*T_world_body * place.place - face.corners[0]), 0.0, face.length_m);
    const auto [entry, is_new] = seen.try_emplace(place.wall, s, s);
    entry->second = {std::min(entry->second.first, s), std::max(entry->second.second, s)};
  }
  for (const auto& [wall, extent] : seen) {
    Face& face = faces_.at(wall);
    face.from_m = std::min(face.from_m, extent.first);
    face.to_m = std::max(face.to_m, extent.second);
    if (extent.second - extent.first >= kLeastLength_m) ++face.frames;
  }
}

void PlaneScore::add_pose(std::uint32_t iteration, const Pose& T_world_body, const Pose& T_map_body,
                          std::span<const GivenPlane> given) {
  poses_.push_back({iteration, T_world_body, T_map_body});
  refitted_.add(iteration, T_map_body, given);
}

void PlaneScore::keep_poses(const std::function<bool(std::uint32_t)>& is_in_map) {
  for (TwoPoses& poses : poses_) poses.in_map = is_in_map(poses.iteration);
}

std::optional<Pose> PlaneScore::first_pose_frame() const {
  const auto first =
      std::find_if(poses_.begin(), poses_.end(), [](const TwoPoses& poses) { return poses.in_map; });
  if (first == poses_.end()) return std::nullopt;
  return first->T_world_body * first->T_map_body.inverse();
}

std::vector<PlaneScore::Pair> PlaneScore::pairs_of(std::span<const MappedPlane> map) const {
  const AssociationScore::Ownership ownership = associations_.ownership();
  std::vector<Pair> pairs;
  for (const MappedPlane& plane : map) {
    const auto owner = ownership.owner.find(plane.id);
    if (plane.status != LandmarkStatus::kMapped || owner == ownership.owner.end()) continue;
    if (const auto face = faces_.find(owner->second); face != faces_.end())
      pairs.push_back({&plane, &face->second});
  }
  return pairs;
}

bool PlaneScore::are_level(const std::vector<Pair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const Pair& pair) {
    return std::abs(pair.plane->normal[2]) < kLevel && std::abs(pair.face->normal.z()) < kLevel;
  });
}

/// By the planes, from where the first pose puts the map.
std::optional<Pose> PlaneScore::spatial_alignment(const std::vector<Pair>& pairs, bool& by_planes) const {
  by_planes = false;
  const std::optional<Pose> first = first_pose_frame();
  if (!first) return std::nullopt;
  std::vector<PointOnPlane> points;
  for (const Pair& pair : pairs) {
    const Plane plane{pair.face->normal, pair.face->normal.dot(pair.face->corners[0])};
    for (const log::MappedCorner& corner : pair.plane->outline)
      points.push_back({vector_of(corner.position_m), plane});
  }
  const std::optional<Pose> aligned = align_to_planes(points, *first);
  by_planes = aligned.has_value();
  return aligned ? aligned : first;
}

std::optional<Pose> PlaneScore::alignment(const std::vector<Pair>& pairs, bool& by_corners) const {
  if (!are_level(pairs)) return spatial_alignment(pairs, by_corners);
  std::vector<Vec3> from, to;
  for (const Pair& pair : pairs) {
    for (const End& end : certain_ends(*pair.plane, pair.face->corners)) {
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
    const auto first =
        std::find_if(poses_.begin(), poses_.end(), [](const TwoPoses& poses) { return poses.in_map; });
    if (first != poses_.end()) T_world_map.t.z() = first->T_world_body.t.z() - first->T_map_body.t.z();
    return T_world_map;
  }
  return first_pose_frame();
}

std::optional<Pose> PlaneScore::alignment(std::span<const MappedPlane> map) const {
  bool by_corners = false;
  return alignment(pairs_of(map), by_corners);
}

void PlaneScore::count(std::span<const MappedPlane> map, PlaneMapMetrics& metrics) const {
  const AssociationScore::Ownership ownership = associations_.ownership();
  std::set<log::LandmarkId> owners;
  for (const MappedPlane& plane : map) {
    if (plane.status != LandmarkStatus::kMapped) continue;
    ++metrics.mapped;
    const auto owner = ownership.owner.find(plane.id);
    if (owner == ownership.owner.end()) {
      ++metrics.unmatched;
    } else if (!owners.insert(owner->second).second) {
      ++metrics.parts;
    }
  }
  for (const auto& [wall, face] : faces_) {
    if (is_asked_for(face)) ++(owners.contains(wall) ? metrics.walls_mapped : metrics.walls_missing);
  }
}

void PlaneScore::score_extents(const std::vector<Pair>& pairs, const Pose& T_world_map,
                               PlaneMapMetrics& metrics) {
  std::map<const Face*, std::vector<Range>> extents;
  std::vector<const Face*> faces;  // in the order of the pairs: that of pointers is none
  for (const auto& [plane, face] : pairs) {
    Range extent{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (const log::MappedCorner& corner : plane->outline) {
      const double s = face->along.dot(T_world_map * vector_of(corner.position_m) - face->corners[0]);
      extent = {std::min(extent.from, s), std::max(extent.to, s)};
    }
    std::vector<Range>& of_face = extents[face];
    if (of_face.empty()) faces.push_back(face);
    of_face.push_back(extent);
  }
  double sum = 0.0;
  for (const Face* face : faces) {
    const std::uint64_t again = doubled(extents.at(face), kDoubled);
    metrics.duplicated += again;
    metrics.parts -= again;
    const bool seen = face->to_m > face->from_m;
    const double share = seen ? iou(extents.at(face), {face->from_m, face->to_m}) : 0.0;
    sum += share;
    metrics.extent_iou_least = std::min(metrics.extent_iou_least.value_or(1.0), share);
  }
  if (!faces.empty()) metrics.extent_iou_mean = sum / static_cast<double>(faces.size());
}

PlaneMapMetrics PlaneScore::score(std::span<const MappedPlane> map) const {
  PlaneMapMetrics metrics;
  count(map, metrics);
  const std::vector<Pair> pairs = pairs_of(map);
  const std::optional<Pose> T_world_map = alignment(pairs, metrics.aligned);
  if (!T_world_map) return metrics;
  const bool level = are_level(pairs);
  Errors angles, offsets, corners;
  for (const auto& [plane, face] : pairs) {
    angles.add(angle_deg(T_world_map->q * vector_of(plane->normal), face->normal));
    offsets.add(face->normal.dot(*T_world_map * middle_of(*plane) - face->corners[0]));
    for (const End& end :
         level ? certain_ends(*plane, face->corners) : certain_edges(*plane, face->outline, *T_world_map)) {
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

std::vector<log::PoseErrorRow> PlaneScore::pose_errors(std::span<const MappedPlane> map) const {
  std::vector<log::PoseErrorRow> errors;
  const std::optional<Pose> T_world_map = alignment(map);
  if (!T_world_map) return errors;
  for (const TwoPoses& poses : poses_) {
    if (!poses.in_map) continue;
    errors.push_back(error_of(poses.iteration, *T_world_map * poses.T_map_body, poses.T_world_body));
  }
  return errors;
}

std::vector<log::PoseErrorRow> PlaneScore::refitted_errors(std::span<const MappedPlane> map) const {
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

PlaneMetrics PlaneScore::metrics(std::span<const MappedPlane> online,
                                 std::span<const MappedPlane> refined) const {
  PlaneMetrics metrics;
  metrics.observations = associations_.observations();
  metrics.associations_none = associations_.none();
  metrics.association_errors = associations_.ownership().errors;
  for (const auto& [wall, face] : faces_) metrics.walls_true += is_asked_for(face) ? 1u : 0u;
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

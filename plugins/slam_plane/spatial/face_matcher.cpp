// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/face_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kLeastShare = 0.5;  // of the smaller outline
constexpr double kTwinShare = 0.15;  // what lies in one plane and overlaps is one; less may be noise
constexpr double kRivalShare = 0.2;  // two parts of one face share less than that of the smaller one
constexpr double kTrailShare = 0.8;  // of the bound, that a face that moves may have gone since
constexpr double kTouch_m = 0.05;    // and are farther apart than noise may bring them
constexpr double kLeastArea_m2 = 1e-4;
constexpr double kSlack_m = 1e-6;  // of rounding
constexpr double kTwins_m = 0.06;  // farthest that two faces lie from each other's planes that are one

/// Area that two outlines share, as a share of the smaller one.
double shared(const Polygon& a, const Polygon& b) {
  const double least = std::min(area(a), area(b));
  return least < kLeastArea_m2 ? 0.0 : overlap_area(a, b) / least;
}

Polygon laid_flat(const std::vector<Vec3>& points, const Pose3& T, const PlaneAxes& axes) {
  Polygon flat;
  for (const Vec3& p : points) flat.push_back(axes.flat(T * p));
  return flat;
}

double area_of(const Sighting& sighting) {
  return area(flattened(sighting.outline, PlaneAxes(sighting.normal)));
}

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

FaceMatcher::FaceMatcher(const Options& options)
    : near_bound_(options.match_bound_m),
      map_bound_(options.map_bound_m),
      cosine_(std::cos(options.match_angle_deg * std::numbers::pi / 180.0)),
      sine_(std::sin(options.match_angle_deg * std::numbers::pi / 180.0)) {}

/// The box about all points of faces that a sighting may be of. Where outlines overlap in the face's plane, the sighting lies above the face by no more than the bound and
/// what the largest angle between them makes of its extent.
Box FaceMatcher::about(const Sighting& sighting, const Pose3& T, double bound) const {
  double bent = 0.0, reach = 0.0;  // a hull need not lie in its plane
  for (const Vec3& p : sighting.outline) {
    bent = std::max(bent, std::abs(sighting.normal.dot(p) - sighting.offset()));
    reach = std::max(reach, (p - sighting.centre).norm());
  }
  Box box = box_of(sighting.outline, T);
  const Vec3 margin = Vec3::Constant(bound + bent + reach * sine_ + kSlack_m);
  return {box.min() - margin, box.max() + margin};
}

double FaceMatcher::score(const FaceRecord& face, const Sighting& sighting, const Pose3& T,
                          double bound) const {
  return face.outline.size() < 3 ? 0.0 : score(face.plane, face.outline, sighting, T, bound);
}

double FaceMatcher::score(const Feature& plane, const std::vector<Vec3>& outline, const Sighting& sighting,
                          const Pose3& T, double bound) const {
  const double agreement = plane.normal().dot(T.q * sighting.normal);
  if (agreement < cosine_) return 0.0;
  const double offset = std::abs(plane.distance(T * sighting.centre));
  if (offset > bound) return 0.0;
  const PlaneAxes axes(plane.normal());
  const Polygon known = laid_flat(outline, Pose3{}, axes), seen = laid_flat(sighting.outline, T, axes);
  if (shared(known, seen) < kLeastShare) return 0.0;
  return overlap_area(known, seen) / area(seen) * (1.1 - offset / bound);
}

void FaceMatcher::find_candidates(const FaceMap& map, std::uint64_t since, double bound, const Pose3& T,
                                  const Sighting& sighting) {
  map.find_near(about(sighting, T, bound), near_);
  for (const Index f : near_) {
    const FaceRecord& face = map.faces[f];
    if (face.last_seen < since) continue;
    const double found = score(face, sighting, T, bound);
    if (found > 0.0) candidates_.push_back({found, f, face.is_dynamic});
  }
}

/// Faces that lay beside their places just before and have gone on from there.
void FaceMatcher::find_strayed(const FaceMap& map, const Pose3& T, const Sighting& sighting) {
  for (const Index f : map.strayed()) {
    const FaceRecord& face = map.faces[f];
    if (score(face, sighting, T, near_bound_) > 0.0) continue;
    const double found =
        score(face.trail.plane(), face.trail.outline(), sighting, T, kTrailShare * near_bound_);
    if (found > 0.0) candidates_.push_back({found, f, true});
  }
}

/// Largest first: of two neighbours in one plane the larger one tells which face it is, and a sliver of the other is then not taken for the same.
void FaceMatcher::match(const FaceMap& map, const Search& search, const Pose3& T,
                        std::vector<Sighting>& frame) {
  std::vector<std::pair<double, Index>> order;
  for (Index i = 0; i < frame.size(); ++i) {
    if (frame[i].face == kNone) order.emplace_back(-area_of(frame[i]), i);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [size, i] : order) {
    candidates_.clear();
    find_candidates(map, search.since, search.bound_m, T, frame[i]);
    if (search.follow) find_strayed(map, T, frame[i]);
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return std::tie(b.score, a.face) < std::tie(a.score, b.face);
    });
    for (const Candidate& candidate : candidates_) {
      if (is_taken(map.faces[candidate.face], candidate.face, frame, i, T)) continue;
      frame[i].face = candidate.face;
      frame[i].stray = candidate.stray;
      break;
    }
  }
}

/// Whether another sighting is a face, and lies where this one would be the same part of it, or next to it: what one frame sees as two that touch is two.
bool FaceMatcher::is_taken(const FaceRecord& face, Index index, const std::vector<Sighting>& frame, Index own,
                           const Pose3& T) const {
  const PlaneAxes axes(face.plane.normal());
  Polygon part;
  for (Index k = 0; k < frame.size(); ++k) {
    if (k == own || frame[k].face != index) continue;
    if (part.empty()) part = laid_flat(frame[own].outline, T, axes);
    const Polygon other = laid_flat(frame[k].outline, T, axes);
    if (shared(part, other) >= kRivalShare || distance(part, other) <= kTouch_m) return true;
  }
  return false;
}

void FaceMatcher::match_recent(const FaceMap& map, std::uint64_t since, const Pose3& T_map_robot,
                               std::vector<Sighting>& frame) {
  match(map, {since, near_bound_, true}, T_map_robot, frame);
}

void FaceMatcher::match_map(const FaceMap& map, const Pose3& T_map_robot, std::vector<Sighting>& frame) {
  match(map, {0, map_bound_, false}, T_map_robot, frame);
}

bool FaceMatcher::on_one_plane(const FaceRecord& a, const FaceRecord& b) const {
  return a.plane.normal().dot(b.plane.normal()) >= cosine_ &&
         std::abs(a.plane.distance(middle_of(b.outline))) <= kTwins_m &&
         std::abs(b.plane.distance(middle_of(a.outline))) <= kTwins_m;
}

bool FaceMatcher::are_twins(const FaceMap& map, Index a, Index b) const {
  const FaceRecord& one = map.faces[a];
  const FaceRecord& other = map.faces[b];
  if (one.is_dynamic || other.is_dynamic) return false;
  if (one.outline.size() < 3 || other.outline.size() < 3 || map.are_apart(a, b)) return false;
  if (!on_one_plane(one, other)) return false;
  const PlaneAxes axes(one.plane.normal());
  return shared(laid_flat(one.outline, Pose3{}, axes), laid_flat(other.outline, Pose3{}, axes)) >= kTwinShare;
}

std::vector<Index> FaceMatcher::twins_of(const FaceMap& map, Index face) const {
  const std::vector<Vec3>& outline = map.faces[face].outline;
  if (outline.size() < 3) return {};
  const Vec3 middle = middle_of(outline);
  double reach = 0.0;
  for (const Vec3& p : outline) reach = std::max(reach, (p - middle).norm());
  // The middle lies near the other's plane, which is tilted by the largest angle at most.
  const Vec3 margin = Vec3::Constant((kTwins_m + reach * sine_) / cosine_ + kSlack_m);
  const Box box = box_of(outline);
  std::vector<Index> twins;
  map.find_near({box.min() - margin, box.max() + margin}, twins);
  std::erase_if(twins, [&](Index other) { return other == face || !are_twins(map, face, other); });
  return twins;
}

}  // namespace hallway::slam_plane::spatial

// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/face_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kLeastShare = 0.5;  // of the smaller outline
constexpr double kTwinShare = 0.15;  // what lies in one plane and overlaps is one; less may be noise
constexpr double kRivalShare = 0.2;  // two parts of one face share less than that of the smaller one
constexpr double kLeastArea_m2 = 1e-4;
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

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

FaceMatcher::FaceMatcher(const Options& options)
    : near_bound_(options.match_bound_m),
      map_bound_(options.map_bound_m),
      cosine_(std::cos(options.match_angle_deg * std::numbers::pi / 180.0)) {}

double FaceMatcher::score(const FaceRecord& face, const Sighting& sighting, const Pose3& T,
                          double bound) const {
  const double agreement = face.plane.normal().dot(T.q * sighting.normal);
  if (agreement < cosine_) return 0.0;
  const double offset = std::abs(face.plane.distance(T * sighting.centre));
  if (offset > bound) return 0.0;
  const PlaneAxes axes(face.plane.normal());
  const double share = shared(laid_flat(face.outline, Pose3{}, axes), laid_flat(sighting.outline, T, axes));
  return share < kLeastShare ? 0.0 : share * (1.1 - offset / bound);
}

void FaceMatcher::match(const FaceMap& map, std::uint64_t since, double bound, const Pose3& T,
                        std::vector<Sighting>& frame) {
  scores_.assign(frame.size(), 0.0);
  for (Index i = 0; i < frame.size(); ++i) {
    Sighting& sighting = frame[i];
    if (sighting.face != kNone) {
      scores_[i] =
          score(map.faces[sighting.face], sighting, T, bound) + 1.0;  // stays before those that come now
      continue;
    }
    for (Index f = 0; f < map.faces.size(); ++f) {
      const FaceRecord& face = map.faces[f];
      if (!face.alive() || face.last_seen < since || face.outline.size() < 3) continue;
      const double found = score(face, sighting, T, bound);
      if (found <= scores_[i]) continue;
      scores_[i] = found;
      sighting.face = f;
    }
  }
  resolve_rivals(map, T, frame);
}

/// Of two sightings that would be the same part of one face the better one is it.
void FaceMatcher::resolve_rivals(const FaceMap& map, const Pose3& T, std::vector<Sighting>& frame) {
  for (Index i = 0; i < frame.size(); ++i) {
    for (Index k = i + 1; k < frame.size(); ++k) {
      if (frame[i].face == kNone || frame[i].face != frame[k].face) continue;
      const PlaneAxes axes(map.faces[frame[i].face].plane.normal());
      if (shared(laid_flat(frame[i].outline, T, axes), laid_flat(frame[k].outline, T, axes)) < kRivalShare)
        continue;
      (scores_[i] < scores_[k] ? frame[i] : frame[k]).face = kNone;
    }
  }
}

void FaceMatcher::match_recent(const FaceMap& map, std::uint64_t since, const Pose3& T_map_robot,
                               std::vector<Sighting>& frame) {
  match(map, since, near_bound_, T_map_robot, frame);
}

void FaceMatcher::match_map(const FaceMap& map, const Pose3& T_map_robot, std::vector<Sighting>& frame) {
  match(map, 0, map_bound_, T_map_robot, frame);
}

bool FaceMatcher::on_one_plane(const FaceRecord& a, const FaceRecord& b) const {
  return a.plane.normal().dot(b.plane.normal()) >= cosine_ &&
         std::abs(a.plane.distance(middle_of(b.outline))) <= kTwins_m &&
         std::abs(b.plane.distance(middle_of(a.outline))) <= kTwins_m;
}

bool FaceMatcher::are_twins(const FaceMap& map, Index a, Index b) const {
  const FaceRecord& one = map.faces[a];
  const FaceRecord& other = map.faces[b];
  if (one.outline.size() < 3 || other.outline.size() < 3 || map.are_apart(a, b)) return false;
  if (!on_one_plane(one, other)) return false;
  const PlaneAxes axes(one.plane.normal());
  return shared(laid_flat(one.outline, Pose3{}, axes), laid_flat(other.outline, Pose3{}, axes)) >= kTwinShare;
}

}  // namespace hallway::slam_plane::spatial

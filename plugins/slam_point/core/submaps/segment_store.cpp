// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/segment_store.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/fit/robust_fit.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kLeastNoiseFreedom = 100.0;  // below, the noise is not estimated
constexpr double kOverlap = 0.9;              // of what a frame sees with its segment's first frame, at least
constexpr std::size_t kMostSegments = 64;     // of one submap; from then on frames go where they fit best

constexpr double kMostSide_rad = 0.1;  // that the view of a segment's points may turn by
constexpr double kLeastRange_m = 1e-3;

}  // namespace

void SegmentStore::add_frame(Index submap, const Pose& T_submap_sensor, const FitRules& rules,
                             const Sightings& sightings) {
  ++frames_;
  observations_ += sightings.size();
  for (const Sighting& sighting : sightings) {
    if (sighting.landmark >= seen_.size()) {
      seen_.resize(sighting.landmark + 1u, 0);
      place_.resize(sighting.landmark + 1u, kNone);
      placed_.resize(sighting.landmark + 1u, kNone);
    }
    seen_[sighting.landmark] = frames_;
  }
  if (directional_) take_view(T_submap_sensor, sightings);
  const Index chosen = choose(submap, sightings);
  if (chosen == kNone) {
    open(start(submap, sightings));
    average(T_submap_sensor, rules.planar, sightings);
  } else {
    if (chosen != open_) open(chosen);
    const Pose aligned = directional_ ? align_directional(T_submap_sensor, rules, sightings)
                                      : align(T_submap_sensor, rules, sightings);
    average(aligned, rules.planar, sightings);
  }
  ++segments_[open_].frames;
}

void SegmentStore::take_view(const Pose& T_submap_sensor, const Sightings& sightings) {
  Vec3 sum = Vec3::Zero();
  double nearness = 0.0;
  for (const Sighting& sighting : sightings) {
    const double range = std::max(sighting.point.norm(), kLeastRange_m);
    sum += sighting.point / range;
    nearness += 1.0 / range;
  }
  origin_ = T_submap_sensor.t;
  sight_ = T_submap_sensor.q * sum.normalized();
  range_ = nearness > 0.0 ? static_cast<double>(sightings.size()) / nearness : 0.0;
}

/// Whether the frame being added sees points from about the side that the segment's first frame saw them from: what noise leaves open
/// there it leaves open here.
bool SegmentStore::is_from_here(const Segment& segment) const {
  if (!directional_) return true;
  const Vec3 way = origin_ - segment.origin;
  return (way - way.dot(sight_) * sight_).norm() <= kMostSide_rad * range_;
}

/// The segment that a frame belongs to; kNone for a new one.
Index SegmentStore::choose(Index submap, const Sightings& sightings) {
  if (open_ != kNone && segments_[open_].submap == submap && is_from_here(segments_[open_]) &&
      overlap(segments_[open_], sightings.size()) >= kOverlap) {
    return open_;
  }
  if (submap >= of_submap_.size()) of_submap_.resize(submap + 1u);
  Index best = kNone;
  double best_overlap = -1.0;
  for (const Index segment : of_submap_[submap]) {
    const bool alike = is_from_here(segments_[segment]);
    const double shared = alike ? overlap(segments_[segment], sightings.size()) : 0.0;
    if (shared <= best_overlap) continue;
    best = segment;
    best_overlap = shared;
  }
  return best_overlap >= kOverlap || of_submap_[submap].size() >= kMostSegments ? best : kNone;
}

/// Jaccard overlap of what the frame sees, `seen` landmarks, and what the segment's first frame saw.
double SegmentStore::overlap(const Segment& segment, std::size_t seen) const {
  std::size_t shared = 0;
  for (const SegmentMember& member : segment.members)
    shared += member.in_first_frame && seen_[member.landmark] == frames_ ? 1u : 0u;
  return static_cast<double>(shared) / static_cast<double>(seen + segment.first_frame_size - shared);
}

Index SegmentStore::start(Index submap, const Sightings& sightings) {
  const auto index = static_cast<Index>(segments_.size());
  Segment segment;
  segment.submap = submap;
  segment.first_frame_size = static_cast<std::uint32_t>(sightings.size());
  for (const Sighting& sighting : sightings)
    segment.members.push_back({sighting.landmark, 0, 0.0, true, Vec3::Zero()});
  segment.origin = origin_;
  if (directional_) segment.informations.assign(sightings.size(), Mat3::Zero());
  segments_.push_back(std::move(segment));
  of_submap_[submap].push_back(index);
  return index;
}

void SegmentStore::open(Index segment) {
  open_ = segment;
  const std::vector<SegmentMember>& members = segments_[segment].members;
  for (Index m = 0; m < members.size(); ++m) {
    place_[members[m].landmark] = m;
    placed_[members[m].landmark] = segment;
  }
}

Pose SegmentStore::align(const Pose& T_submap_sensor, const FitRules& rules,
                         const Sightings& sightings) const {
  const std::vector<SegmentMember>& members = segments_[open_].members;
  Alignment alignment(T_submap_sensor);
  for (const Sighting& sighting : sightings) {
    if (placed_[sighting.landmark] != open_) continue;
    const SegmentMember& member = members[place_[sighting.landmark]];
    alignment.add(member.mean, sighting.point, pair_weight(member.weight, sighting.weight));
  }
  Pose aligned = T_submap_sensor;
  alignment.solve(rules, aligned);
  return aligned;
}

Pose SegmentStore::align_directional(const Pose& T_submap_sensor, const FitRules& rules,
                                     const Sightings& sightings) {
  const Segment& segment = segments_[open_];
  pairs_.clear();
  for (const Sighting& sighting : sightings) {
    if (placed_[sighting.landmark] != open_) continue;
    const Index place = place_[sighting.landmark];
    pairs_.push_back({segment.members[place].mean, segment.informations[place], sighting.point,
                      sighting.weights(), pair_weight(segment.members[place].weight, sighting.weight)});
  }
  Pose aligned = T_submap_sensor;
  directional_fit(pairs_, rules.without_outliers(), aligned);
  return aligned;
}

/// Averages a sighting at `p` (submap frame) into its member; `ray` leads there from the sensor.
void SegmentStore::average_directional(const Vec3& p, const Vec3& ray, const Sighting& sighting) {
  const Index place = place_[sighting.landmark];
  SegmentMember& member = segments_[open_].members[place];
  Mat3& known = segments_[open_].informations[place];
  const Mat3 information = ray_information(ray, sighting.weights());
  const Vec3 off = p - member.mean;
  if (member.count > 0) scatter_m2_ += off.dot(pair_information(known, information) * off);
  ++member.count;
  member.weight += sighting.weight;
  known += information;
  member.mean = member.count == 1 ? p : Vec3(member.mean + known.inverse() * (information * off));
}

void SegmentStore::average(const Pose& T_submap_sensor, bool planar, const Sightings& sightings) {
  std::vector<SegmentMember>& members = segments_[open_].members;
  const PointMotion to_submap(T_submap_sensor);
  std::size_t known = 0;
  for (const Sighting& sighting : sightings) {
    if (placed_[sighting.landmark] != open_) {
      place_[sighting.landmark] = static_cast<Index>(members.size());
      placed_[sighting.landmark] = open_;
      members.push_back({sighting.landmark, 0, 0.0, false, Vec3::Zero()});
      if (directional_) segments_[open_].informations.emplace_back(Mat3::Zero());
    }
    SegmentMember& member = members[place_[sighting.landmark]];
    if (directional_) {
      if (member.count > 0) ++known;
      average_directional(to_submap * sighting.point, to_submap.turned(sighting.point), sighting);
      continue;
    }
    const Vec3 off = to_submap * sighting.point - member.mean;
    const double before = member.weight;
    ++member.count;
    member.weight += sighting.weight;
    const double share = sighting.weight / member.weight;
    member.mean += share * off;
    if (member.count == 1) continue;
    scatter_m2_ += before * share * off.squaredNorm();
    ++known;
  }
  freedom_ +=
      std::max(0.0, planar ? 2.0 * static_cast<double>(known) - 3.0 : 3.0 * static_cast<double>(known) - 6.0);
}

double SegmentStore::noise2_m2() const {
  return freedom_ >= kLeastNoiseFreedom ? scatter_m2_ / freedom_ : 0.0;
}

void SegmentStore::clear() {
  *this = SegmentStore(directional_);
}

}  // namespace hallway::slam_point

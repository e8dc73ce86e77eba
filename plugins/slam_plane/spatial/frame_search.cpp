// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/frame_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geometry/rigid_fit.hpp"
#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr std::size_t kMostTriples = 4;  // of the frame that are tried
constexpr std::size_t kLargest = 8;      // of these planes of it
constexpr double kLeastVolume = 0.4;     // that three normals span
constexpr double kAngleSigmas = 5.0;     // by which angles between normals may differ, and
constexpr double kAngle_rad = 0.01;      // what the map may be wrong by
constexpr double kSamePlace_m = 0.3;     // poses so near to each other are one place
constexpr double kSamePlace_rad = 0.15;
constexpr double kMostSigmas = 6.0;  // between an observation and the plane on which it lies
constexpr double kGoesOn_m = 0.1;    // and 4 sigma: a plane that goes on so far beyond a certain edge
constexpr double kGoesOnSigmas = 4.0;
constexpr PoseFit::EdgeBounds kEdge{.distance_m = 0.05, .angle_rad = 0.02};
constexpr int kLeastPlanes = 5;  // that agree where a frame is believed to have been made,
constexpr int kLeastEdges = 4;
constexpr double kLeastAgreeing = 0.7;  // and of all that it saw
constexpr double kMostRival = 0.7;      // that any other place reaches of it

double extent_of(const AssociatedObservation& observation) {
  return area(PlaneAxes(observation.normal).flat(observation.outline));
}

bool same_place(const Pose& a, const Pose& b) {
  return (a.t - b.t).norm() < kSamePlace_m && a.q.angularDistance(b.q) < kSamePlace_rad;
}

}  // namespace

FrameSearch::FrameSearch(const Options& options)
    : matcher_(options),
      fit_(options),
      bound_(options.map_bound_m),
      angle_(kAngle_rad + kAngleSigmas * options.noise().angle),
      least_observations_(static_cast<std::uint32_t>(options.min_observations)) {}

/// Those of large planes that span most.
std::vector<FrameSearch::Triple> FrameSearch::triples(const std::vector<AssociatedObservation>& frame) {
  std::vector<std::pair<double, Index>> sizes;
  for (Index i = 0; i < frame.size(); ++i) sizes.emplace_back(-extent_of(frame[i]), i);
  std::ranges::sort(sizes);
  if (sizes.size() > kLargest) sizes.resize(kLargest);
  std::vector<std::pair<double, Triple>> ranked;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (std::size_t j = i + 1; j < sizes.size(); ++j) {
      for (std::size_t k = j + 1; k < sizes.size(); ++k) {
        const Triple triple{sizes[i].second, sizes[j].second, sizes[k].second};
        const double volume =
            std::abs(frame[triple[0]].normal.cross(frame[triple[1]].normal).dot(frame[triple[2]].normal));
        if (volume >= kLeastVolume) ranked.emplace_back(volume * sizes[k].first, triple);
      }
    }
  }
  std::ranges::sort(ranked);
  if (ranked.size() > kMostTriples) ranked.resize(kMostTriples);
  std::vector<Triple> triples;
  for (const auto& [rank, triple] : ranked) triples.push_back(triple);
  return triples;
}

/// Planes that share a submap with one, ascending.
std::vector<Index> FrameSearch::seen_about(const PlaneMap& map, Index landmark) {
  std::vector<Index> about;
  for (const Membership& at : map.landmarks[landmark].members) {
    for (const Member& member : map.submaps[at.submap].members) {
      if (member.landmark != kNone && member.landmark != landmark) about.push_back(member.landmark);
    }
  }
  make_set(about);
  return about;
}

/// Lays three observations on all planes of the map whose normals make the same
/// angles.
void FrameSearch::lay(const PlaneMap& map, const std::vector<AssociatedObservation>& frame,
                      const Triple& seen) {
  const auto normal = [&](int i) -> const Vec3& { return frame[seen[static_cast<std::size_t>(i)]].normal; };
  const auto known = [&](Index landmark) { return map.landmarks[landmark].plane.normal(); };
  const auto usable = [&](Index landmark) {
    return map.landmarks[landmark].alive() && map.landmarks[landmark].observations >= least_observations_;
  };
  const auto turned = [&](const Vec3& a, const Vec3& b, int i, int k) {
    return std::abs(std::acos(std::clamp(a.dot(b), -1.0, 1.0)) -
                    std::acos(std::clamp(normal(i).dot(normal(k)), -1.0, 1.0))) > angle_;
  };
  const double side = normal(0).cross(normal(1)).dot(normal(2));
  for (Index first = 0; first < map.landmarks.size(); ++first) {
    if (!usable(first)) continue;
    const std::vector<Index> about = seen_about(map, first);
    for (const Index second : about) {
      if (!usable(second) || turned(known(first), known(second), 0, 1)) continue;
      for (const Index third : about) {
        if (!usable(third) || turned(known(first), known(third), 0, 2) ||
            turned(known(second), known(third), 1, 2) ||
            known(first).cross(known(second)).dot(known(third)) * side < 0.0)
          continue;
        try_place(map, frame, seen, {first, second, third});
      }
    }
  }
}

void FrameSearch::try_place(const PlaneMap& map, const std::vector<AssociatedObservation>& frame,
                            const Triple& seen, const Triple& known) {
  Mat3 sum = Mat3::Zero(), normals;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    normals.row(i) = map.landmarks[known[at]].plane.normal().transpose();
    sum += map.landmarks[known[at]].plane.normal() * frame[seen[at]].normal.transpose();
  }
  // nearest_rotation() takes the sign of the determinant. This is 1 or -1 but for rounding, which the last digits of poses rest on.
  const Singular svd = singular(sum);
  Mat3 right = Mat3::Identity();
  right(2, 2) = (svd.left * svd.right.transpose()).determinant();
  Pose T;
  T.q = Quat(svd.left * right * svd.right.transpose()).normalized();
  Vec3 offsets;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    offsets(i) = -map.landmarks[known[at]].plane.distance(T.q * frame[seen[at]].centre);
  }
  T.t = normals.partialPivLu().solve(offsets);
  for (std::size_t i = 0; i < 3; ++i) {
    if (matcher_.score(map.landmarks[known[i]], frame[seen[i]], T, bound_) == 0.0) return;
  }
  if (std::ranges::any_of(tried_, [&](const Pose& other) { return same_place(other, T); })) return;
  tried_.push_back(T);
  if (const auto place = judge(map, frame, T)) places_.push_back(*place);
}

bool FrameSearch::fit(const PlaneMap& map, const std::vector<AssociatedObservation>& frame, Pose& T) {
  fit_.clear();
  for (const AssociatedObservation& observation : frame) {
    if (observation.is_evidence())
      fit_.add(observation, map.landmarks[observation.landmark].plane,
               map.lines(observation.landmark, false));
  }
  return fit_.solve(T).determined();
}

/// What agrees if the frame was made there.
std::optional<FrameSearch::Place> FrameSearch::judge(const PlaneMap& map,
                                                     const std::vector<AssociatedObservation>& frame,
                                                     const Pose& T) {
  Place place{.T = T};
  std::vector<AssociatedObservation> laid = frame;
  for (int round = 0; round < 2; ++round) {
    dissociate(laid);
    matcher_.match_map(map, place.T, laid);
    if (!fit(map, laid, place.T)) return std::nullopt;
  }
  for (const AssociatedObservation& observation : laid) {
    if (observation.is_evidence()) count(map, observation, place);
  }
  return place;
}

void FrameSearch::count(const PlaneMap& map, const AssociatedObservation& observation, Place& place) const {
  const PlaneRecord& landmark = map.landmarks[observation.landmark];
  if (fit_.distance2(observation, landmark.plane, place.T) > kMostSigmas * kMostSigmas) return;
  const std::vector<const Feature*> lines = map.lines(observation.landmark, false);
  for (const Feature* line : lines) {
    if (line == nullptr) continue;
    for (const Vec3& p : observation.outline) {
      const Vec3 at = place.T * p;
      if (line->distance(at) <= kGoesOn_m + kGoesOnSigmas * std::sqrt(line->variance_at(at))) continue;
      ++place.contradictions;
      return;
    }
  }
  ++place.planes;
  const std::vector<Index> found = fit_.find_edges(observation, lines, place.T, kEdge);
  place.edges += static_cast<int>(std::ranges::count_if(found, [](Index edge) { return edge != kNone; }));
}

std::optional<Pose> FrameSearch::find(const PlaneMap& map, const std::vector<AssociatedObservation>& frame) {
  tried_.clear();
  places_.clear();
  for (const Triple& triple : triples(frame)) lay(map, frame, triple);
  const auto better = [](const Place& a, const Place& b) { return a.score() < b.score(); };
  const auto best = std::ranges::max_element(places_, better);
  if (best == places_.end() || best->planes < kLeastPlanes || best->edges < kLeastEdges ||
      best->planes < kLeastAgreeing * static_cast<double>(frame.size()))
    return std::nullopt;
  for (const Place& other : places_) {
    if (!same_place(other.T, best->T) && other.score() > kMostRival * best->score()) return std::nullopt;
  }
  return best->T;
}

}  // namespace hallway::slam_plane::spatial

// SPDX-License-Identifier: MIT
#include "eval/refitted_path.hpp"

#include <unordered_map>
#include <vector>

#include "base/error.hpp"
#include "eval/point_error.hpp"
#include "geom/arrays.hpp"
#include "geometry/rigid_fit.hpp"

namespace hallway::eval {
namespace {

/// The points of one frame beside the landmarks that they were taken for.
struct Matches {
  std::vector<Vec3> points;
  std::vector<Vec3> landmarks;
  std::vector<double> weights;

  void clear() {
    points.clear();
    landmarks.clear();
    weights.clear();
  }
};

}  // namespace

void RefittedPath::add(const Vec3& true_position, std::span<const Vec3> points,
                       std::span<const log::LandmarkId> associations) {
  if (points.size() != associations.size())
    throw hallway::Error(ErrorCode::kInternal, "refitted path: points and associations differ in number");
  if (!complete_) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (associations[i] != log::kNoLandmark && points[i].allFinite())
      sights_.push_back({associations[i], to_array(points[i])});
  }
  frames_.push_back({to_array(true_position), sights_.size()});
  if (sights_.size() <= kMaxPoints) return;
  complete_ = false;
  sights_.clear();
  frames_.clear();
}

std::optional<RefittedPath::Error> RefittedPath::error(std::span<const log::MapLandmark> map) const {
  if (!complete_) return std::nullopt;
  std::unordered_map<log::LandmarkId, const log::MapLandmark*> mapped;
  for (const log::MapLandmark& landmark : map) {
    if (landmark.status == log::LandmarkStatus::kMapped) mapped.emplace(landmark.id, &landmark);
  }
  using Places = std::array<std::array<double, 3>, 2>;  // true and estimated
  SpillList<Places> placed(folder_);
  Matches matches;
  std::uint64_t read = 0;
  SpillList<Sight>::Reader sights(sights_);
  SpillList<Frame>::Reader frames(frames_);
  while (const Frame* frame = frames.next()) {
    matches.clear();
    for (; read < frame->end; ++read) {
      const Sight& sight = *sights.next();
      const auto found = mapped.find(sight.landmark);
      if (found == mapped.end()) continue;
      const double n = static_cast<double>(found->second->observations);
      matches.points.emplace_back(sight.point.data());
      matches.landmarks.emplace_back(found->second->position_m.data());
      matches.weights.push_back(n / (n + 1.0));
    }
    if (!determine_a_pose(matches.points) || !determine_a_pose(matches.landmarks)) continue;
    const std::optional<Pose> T_map_body = rigid_fit(matches.points, matches.landmarks, matches.weights);
    if (T_map_body) placed.push_back({frame->true_position, to_array(T_map_body->t)});
  }
  const Sequence<PointPair> pairs(placed.size(), [&] {
    return [places = SpillList<Places>::Reader(placed), pair = PointPair()]() mutable -> const PointPair* {
      const Places* next = places.next();
      if (next == nullptr) return nullptr;
      pair = {Vec3((*next)[0].data()), Vec3((*next)[1].data())};
      return &pair;
    };
  });
  return Error{placed.size(), aligned_rmse(pairs)};
}

}  // namespace hallway::eval

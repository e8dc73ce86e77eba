// SPDX-License-Identifier: MIT
#include "eval/refitted_path.hpp"

#include <unordered_map>

#include "base/error.hpp"
#include "eval/point_error.hpp"
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
      sights_.push_back({associations[i], points[i]});
  }
  frames_.push_back({true_position, sights_.size()});
  if (sights_.size() <= kMaxPoints) return;
  complete_ = false;
  sights_ = {};
  frames_ = {};
}

std::optional<RefittedPath::Error> RefittedPath::error(std::span<const log::MapLandmark> map) const {
  if (!complete_) return std::nullopt;
  std::unordered_map<log::LandmarkId, const log::MapLandmark*> mapped;
  for (const log::MapLandmark& landmark : map) {
    if (landmark.status == log::LandmarkStatus::kMapped) mapped.emplace(landmark.id, &landmark);
  }
  std::vector<Vec3> truth;
  std::vector<Vec3> estimate;
  Matches matches;
  std::size_t next = 0;
  for (const Frame& frame : frames_) {
    matches.clear();
    for (; next < frame.end; ++next) {
      const auto found = mapped.find(sights_[next].landmark);
      if (found == mapped.end()) continue;
      const double n = static_cast<double>(found->second->observations);
      matches.points.push_back(sights_[next].point);
      matches.landmarks.emplace_back(found->second->position_m.data());
      matches.weights.push_back(n / (n + 1.0));
    }
    if (!determine_a_pose(matches.points) || !determine_a_pose(matches.landmarks)) continue;
    const std::optional<Pose> T_map_body = rigid_fit(matches.points, matches.landmarks, matches.weights);
    if (!T_map_body) continue;
    truth.push_back(frame.true_position);
    estimate.push_back(T_map_body->t);
  }
  return Error{truth.size(), aligned_rmse(truth, estimate)};
}

}  // namespace hallway::eval

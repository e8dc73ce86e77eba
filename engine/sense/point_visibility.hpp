// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sense/field_of_view.hpp"
#include "sense/landmark_index.hpp"
#include "sense/moving_landmarks.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {

/// A landmark that is seen.
struct VisiblePoint {
  std::uint32_t landmark = 0;
  Vec3 point = Vec3::Zero();  ///< sensor frame, metres
};

/// Finds the landmarks that are in a field of view and that no triangle hides: exactly those for which
/// FieldOfView::contains() is true and trace::Scene::occluded() false. Visible sets, blocks and batches only save the asking.
class PointVisibility {
 public:
  /// Keeps references to `index` and `scene`, which must outlive it.
  PointVisibility(const FieldOfView& field_of_view, const LandmarkIndex& index, const trace::Scene& scene)
      : field_of_view_(field_of_view), index_(index), scene_(scene) {}

  /// Replaces `visible` by what is seen. The order is that of the index's blocks, on any number of threads; it differs
  /// between indices with and without visible sets. O(blocks in sight + points in view * log(triangles)).
  ///
  /// @param T_world_sensor  finite, within Scene::kMaxRayCoordinate (Error{kBadInput} otherwise)
  /// @param threads         at least 1
  void find(const Pose& T_world_sensor, unsigned threads, std::vector<VisiblePoint>& visible) const;

  /// The same while some landmarks are elsewhere than the index has them; those stand behind the others.
  /// @param moved  where those are, by rising number; Error{kBadInput} for one that the scene takes no rays from
  void find(const Pose& T_world_sensor, std::span<const LandmarkPlace> moved, unsigned threads,
            std::vector<VisiblePoint>& visible) const;

 private:
  void find_moved(const Pose& T_world_sensor, std::span<const LandmarkPlace> moved,
                  std::vector<VisiblePoint>& visible) const;

  FieldOfView field_of_view_;
  const LandmarkIndex& index_;
  const trace::Scene& scene_;
};

}  // namespace hallway::sense

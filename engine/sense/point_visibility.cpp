// SPDX-License-Identifier: MIT
#include "sense/point_visibility.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "sense/view_volume.hpp"

namespace hallway::sense {
namespace {

/// Looks at blocks of landmarks from one pose. Keeps its memory from block to block.
class BlockLook {
 public:
  BlockLook(const FieldOfView& field_of_view, const LandmarkIndex& index, const trace::Scene& scene,
            const Pose& T_world_sensor)
      : field_of_view_(field_of_view),
        index_(index),
        scene_(scene),
        eye_(T_world_sensor.t),
        to_sensor_(T_world_sensor.q.conjugate().toRotationMatrix()) {}

  void look_at(const LandmarkIndex::Block& block, std::vector<VisiblePoint>& visible) {
    in_view_.clear();
    ends_.clear();
    for (std::uint32_t i = block.first; i < block.first + block.count; ++i) {
      const Vec3& landmark = index_.points()[i];
      const Vec3 point = to_sensor_ * (landmark - eye_);
      if (!field_of_view_.contains(point)) continue;
      in_view_.push_back({index_.numbers()[i], point});
      ends_.push_back(landmark);
    }
    hidden_.resize(ends_.size());
    scene_.occluded_from(eye_, ends_, hidden_);
    for (std::size_t i = 0; i < in_view_.size(); ++i) {
      if (hidden_[i] == 0) visible.push_back(in_view_[i]);
    }
  }

 private:
  const FieldOfView& field_of_view_;
  const LandmarkIndex& index_;
  const trace::Scene& scene_;
  Vec3 eye_;
  Eigen::Matrix3d to_sensor_;
  std::vector<VisiblePoint> in_view_;
  std::vector<Vec3> ends_;
  std::vector<std::uint8_t> hidden_;
};

}  // namespace

void PointVisibility::find(const Pose& T_world_sensor, unsigned threads,
                           std::vector<VisiblePoint>& visible) const {
  constexpr std::size_t kGrain = 4;  // blocks
  std::vector<std::uint32_t> blocks;
  index_.blocks_from(T_world_sensor.t, blocks);
  const ViewVolume volume(field_of_view_, T_world_sensor);
  std::erase_if(blocks, [&](std::uint32_t b) { return !volume.may_contain(index_.blocks()[b].box); });

  std::vector<std::vector<VisiblePoint>> parts((blocks.size() + kGrain - 1) / kGrain);
  parallel_for(blocks.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    BlockLook look(field_of_view_, index_, scene_, T_world_sensor);
    for (std::size_t i = begin; i < end; ++i) {
      look.look_at(index_.blocks()[blocks[i]], parts[begin / kGrain]);
    }
  });
  visible.clear();
  for (const auto& part : parts) visible.insert(visible.end(), part.begin(), part.end());
}

void PointVisibility::find(const Pose& T_world_sensor, std::span<const LandmarkPlace> moved, unsigned threads,
                           std::vector<VisiblePoint>& visible) const {
  find(T_world_sensor, threads, visible);
  if (moved.empty()) return;
  const auto before = [](const LandmarkPlace& a, std::uint32_t landmark) { return a.landmark < landmark; };
  std::erase_if(visible, [&](const VisiblePoint& point) {
    const auto at = std::lower_bound(moved.begin(), moved.end(), point.landmark, before);
    return at != moved.end() && at->landmark == point.landmark;
  });
  find_moved(T_world_sensor, moved, visible);
}

void PointVisibility::find_moved(const Pose& T_world_sensor, std::span<const LandmarkPlace> moved,
                                 std::vector<VisiblePoint>& visible) const {
  const Eigen::Matrix3d to_sensor = T_world_sensor.q.conjugate().toRotationMatrix();
  std::vector<VisiblePoint> in_view;
  std::vector<Vec3> ends;
  for (const LandmarkPlace& at : moved) {
    check_landmark(at.place, at.landmark);
    const Vec3 point = to_sensor * (at.place - T_world_sensor.t);
    if (!field_of_view_.contains(point)) continue;
    in_view.push_back({at.landmark, point});
    ends.push_back(at.place);
  }
  std::vector<std::uint8_t> hidden(ends.size());
  scene_.occluded_from(T_world_sensor.t, ends, hidden);
  for (std::size_t i = 0; i < in_view.size(); ++i) {
    if (hidden[i] == 0) visible.push_back(in_view[i]);
  }
}

}  // namespace hallway::sense

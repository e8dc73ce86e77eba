// SPDX-License-Identifier: MIT
#include "sense/point_visibility.hpp"

#include <algorithm>
#include <span>

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

}  // namespace hallway::sense

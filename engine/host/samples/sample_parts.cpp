// SPDX-License-Identifier: MIT
#include "host/samples/sample_parts.hpp"

#include "host/samples/frame_parts.hpp"

namespace hallway::host {

std::optional<std::uint64_t> count_elements(const hw_sample_t& sample) {
  if (sample.kind == HW_SAMPLE_POINTS) return static_cast<const hw_points_t*>(sample.payload)->count;
  if (sample.kind == HW_SAMPLE_PLANES) return static_cast<const hw_planes_t*>(sample.payload)->count;
  return std::nullopt;
}

hw_planes_t refer_to_sample(const hw_planes_t& planes, std::uint32_t sample,
                            std::vector<hw_plane_t>& storage) {
  hw_planes_t copy = known_part(planes);
  copy.sample = sample;
  if (sample != HW_NO_SAMPLE || planes.n_members == 0) return copy;
  storage.clear();
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    storage.push_back(*hw_plane_at(&planes, i));
    storage.back().first_member = 0;
    storage.back().n_members = 0;
  }
  copy.stride = sizeof(hw_plane_t);
  copy.planes = storage.data();
  copy.n_members = 0;
  return copy;
}

}  // namespace hallway::host

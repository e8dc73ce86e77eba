// SPDX-License-Identifier: MIT
#include "sense/moving_landmarks.hpp"

#include <algorithm>

#include "map/entities.hpp"
#include "map/path.hpp"
#include "sense/cloud_landmarks.hpp"

namespace hallway::sense {

MovingLandmarks::MovingLandmarks(const map::Document& document, const std::vector<Vec3>& landmarks,
                                 std::size_t first_cloud) {
  moves_.resize(landmarks.size(), 0);
  std::size_t first = first_cloud;
  for (const map::LandmarkCloud& cloud : map::landmark_clouds(document)) {
    const std::uint64_t count = cloud_size(document, cloud);
    const Random choice(cloud.seed, stream_id("landmarks.moving"));
    const Random ways(cloud.seed, stream_id("landmarks.way"));
    const std::uint32_t name = stream_id(cloud.name);
    const bool grouped = cloud.motion == map::CloudMotion::kGroup;
    const std::size_t first_way = ways_.size();
    for (std::uint64_t g = 0; grouped && cloud.moving_share > 0.0 && g < cloud.groups; ++g)
      ways_.emplace_back(ways, name, g, cloud.speed_m_s);
    for (std::uint64_t i = 0; i < count; ++i) {
      if (choice.uniform(name, 2 * i) >= cloud.moving_share) continue;
      const std::size_t landmark = first + i;
      moves_[landmark] = 1;
      std::size_t way = ways_.size();
      if (grouped) {
        const double drawn = choice.uniform(name, 2 * i + 1, 0.0, static_cast<double>(cloud.groups));
        way = first_way + std::min<std::size_t>(static_cast<std::size_t>(drawn), cloud.groups - 1);
      } else {
        ways_.emplace_back(ways, name, i, cloud.speed_m_s);
      }
      moving_.push_back({{static_cast<std::uint32_t>(landmark), landmarks[landmark]}, way});
    }
    first += count;
  }
}

void MovingLandmarks::places_at(double t_s, std::vector<LandmarkPlace>& places) const {
  std::vector<Vec3> offsets;
  offsets.reserve(ways_.size());
  for (const SmoothMotion& way : ways_) offsets.push_back(way.offset(t_s));
  places.clear();
  for (const Moving& moving : moving_)
    places.push_back({moving.start.landmark, moving.start.place + offsets[moving.way]});
}

}  // namespace hallway::sense

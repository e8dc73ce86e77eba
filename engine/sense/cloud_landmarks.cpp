// SPDX-License-Identifier: MIT
#include "sense/cloud_landmarks.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "base/random.hpp"
#include "map/entities.hpp"
#include "map/entity_keys.hpp"
#include "map/path.hpp"
#include "sense/landmarks.hpp"

namespace hallway::sense {
namespace {

double count_along(double length_m, const map::LandmarkCloud& cloud) {
  return std::round(length_m * cloud.per_100m / 100.0);
}

void check_count(const map::Document& document, const map::LandmarkCloud& cloud, double count) {
  if (count <= static_cast<double>(kMaxLandmarks)) return;
  const map::Entity& entity = document.entities[static_cast<std::size_t>(cloud.entity)];
  throw map::EntityKeys(document, entity)
      .error("the map would have more than " + std::to_string(kMaxLandmarks) + " landmarks", "per_100m");
}

}  // namespace

std::uint64_t cloud_size(const map::Document& document, const map::LandmarkCloud& cloud) {
  const double count = count_along(map::find_path(document, cloud.path).length_m(), cloud);
  check_count(document, cloud, count);
  return static_cast<std::uint64_t>(count);
}

void add_cloud_landmarks(const map::Document& document, std::vector<Vec3>& landmarks) {
  for (const map::LandmarkCloud& cloud : map::landmark_clouds(document)) {
    const map::Path path = map::find_path(document, cloud.path);
    const double length_m = path.length_m();
    const double wanted = count_along(length_m, cloud);
    check_count(document, cloud, wanted + static_cast<double>(landmarks.size()));
    const auto count = static_cast<std::uint64_t>(wanted);
    const Random random(cloud.seed, stream_id("landmarks.cloud"));
    const std::uint32_t name = stream_id(cloud.name);
    for (std::uint64_t i = 0; i < count; ++i) {
      const Pose beside = path.at(random.uniform(name, 3 * i, 0.0, length_m));
      const double sideways = random.uniform(name, 3 * i + 1, -cloud.sideways_m, cloud.sideways_m);
      const double up = random.uniform(name, 3 * i + 2, -cloud.height_m, cloud.height_m);
      landmarks.push_back(beside * Vec3(0.0, sideways, 0.0) + Vec3(0.0, 0.0, up));
    }
  }
}

}  // namespace hallway::sense

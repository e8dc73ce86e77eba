// SPDX-License-Identifier: MIT
#include "sense/mesh_landmarks.hpp"

#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "base/random.hpp"
#include "sense/face_landmarks.hpp"
#include "sense/landmarks.hpp"

namespace hallway::sense {

void add_mesh_landmarks(const mesh::PlacedMesh& mesh, std::uint32_t placement, double per_m2,
                        std::uint64_t seed, std::vector<Vec3>& landmarks) {
  const Random random(seed, stream_id("landmarks.mesh"));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec3 across = (b - a).cross(c - a);
    const double area = 0.5 * across.norm();
    if (!(area > 0.0)) continue;
    const std::uint64_t key = std::uint64_t{t} << 32;
    const double wanted = per_m2 * area;
    const double count =
        std::floor(wanted) + (random.uniform(placement, key) < wanted - std::floor(wanted) ? 1.0 : 0.0);
    if (static_cast<double>(landmarks.size()) + count > static_cast<double>(kMaxLandmarks)) {
      throw Error(ErrorCode::kBadInput,
                  "the map asks for more than " + std::to_string(kMaxLandmarks) + " landmarks",
                  {.element = "model " + std::to_string(placement)});
    }
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
      double u = random.uniform(placement, key + 2 * i + 1);
      double v = random.uniform(placement, key + 2 * i + 2);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      landmarks.push_back(a + u * (b - a) + v * (c - a) + kFaceClearance_m * across.normalized());
    }
  }
}

}  // namespace hallway::sense

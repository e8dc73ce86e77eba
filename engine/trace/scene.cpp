// SPDX-License-Identifier: MIT
#include "trace/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "trace/query_backend.hpp"

namespace hallway::trace {
namespace {

std::unique_ptr<const QueryBackend> make_backend(TriangleSet triangles, Backend backend) {
  return backend == Backend::kEmbree ? make_embree_backend(std::move(triangles))
                                     : make_brute_force_backend(std::move(triangles));
}

void check_point(const Vec3& point) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() <= Scene::kMaxRayCoordinate) return;
  throw Error(ErrorCode::kBadInput,
              "a ray starts or ends at a point that is not finite or too far from the origin");
}

/// Empty for a ray that by its definition hits nothing.
std::optional<SightLine> sight_line(const Vec3& origin, const Vec3& direction, double max_distance) {
  check_point(origin);
  if (!direction.allFinite() || std::isnan(max_distance)) {
    throw Error(ErrorCode::kBadInput, "a ray's direction or length is not a number");
  }
  const double largest = direction.cwiseAbs().maxCoeff();
  if (largest == 0.0 || max_distance < 0.0) return std::nullopt;
  return SightLine{origin, (direction / largest).normalized(), max_distance};
}

std::optional<SightLine> sight_line_between(const Vec3& one, const Vec3& other) {
  check_point(other);
  // Starting at the lesser point makes the answer the same from both ends, also where rounding decides.
  const bool ordered = std::lexicographical_compare(one.begin(), one.end(), other.begin(), other.end());
  const Vec3& from = ordered ? one : other;
  const Vec3& to = ordered ? other : one;
  return sight_line(from, to - from, (to - from).norm());
}

}  // namespace

Scene::Scene(const TriangleMesh& mesh, Backend backend)
    : backend_(make_backend(TriangleSet(mesh), backend)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::optional<Hit> Scene::first_hit(const Ray& ray) const {
  const auto line = sight_line(ray.origin, ray.direction, ray.max_distance);
  return line ? backend_->first_hit(*line) : std::nullopt;
}

bool Scene::occluded(const Vec3& from, const Vec3& to) const {
  const auto line = sight_line_between(from, to);
  return line && backend_->any_hit(*line);
}

std::string backend_description(Backend backend) {
  return backend == Backend::kEmbree ? embree_description() : "brute force, double precision";
}

}  // namespace hallway::trace

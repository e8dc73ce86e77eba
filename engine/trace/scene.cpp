// SPDX-License-Identifier: MIT
#include "trace/scene.hpp"

#include <array>
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

[[noreturn]] void refuse_point() {
  throw Error(ErrorCode::kBadInput,
              "a ray starts or ends at a point that is not finite or too far from the origin");
}

inline void check_point(const Vec3& point) {
  if (!Scene::takes(point)) refuse_point();
}

std::optional<SightLine> checked_line(const Ray& ray) {
  check_point(ray.origin);
  if (!ray.direction.allFinite() || std::isnan(ray.max_distance))
    throw Error(ErrorCode::kBadInput, "a ray's direction or length is not a number");
  return sight_line(ray.origin, ray.direction, ray.max_distance);
}

}  // namespace

Scene::Scene(const TriangleMesh& mesh, Backend backend)
    : backend_(make_backend(TriangleSet(mesh), backend)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::optional<Hit> Scene::first_hit(const Ray& ray) const {
  const auto line = checked_line(ray);
  return line ? backend_->first_hit(*line) : std::nullopt;
}

void Scene::first_hits(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const {
  if (rays.size() != hits.size())
    throw Error(ErrorCode::kInternal, "as many answers as rays must be asked for");
  // Lines that a ray has not are left out of a packet, so that the others still go together.
  std::array<SightLine, QueryBackend::kMostLines> lines;
  std::array<std::optional<Hit>, QueryBackend::kMostLines> answers;
  std::array<std::size_t, QueryBackend::kMostLines> place{};
  std::size_t n = 0;
  const auto ask = [&] {
    backend_->first_hits({lines.data(), n}, {answers.data(), n});
    for (std::size_t i = 0; i < n; ++i) hits[place[i]] = answers[i];
    n = 0;
  };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto line = checked_line(rays[i]);
    if (!line) {
      hits[i].reset();
      continue;
    }
    lines[n] = *line;
    place[n++] = i;
    if (n == lines.size()) ask();
  }
  ask();
}

bool Scene::occluded(const Vec3& from, const Vec3& to) const {
  check_point(from);
  check_point(to);
  return backend_->occluded(from, to);
}

void Scene::occluded_from(const Vec3& eye, std::span<const Vec3> points,
                          std::span<std::uint8_t> occluded_points) const {
  if (points.size() != occluded_points.size()) {
    throw Error(ErrorCode::kInternal, "as many answers as points must be asked for");
  }
  check_point(eye);
  for (const Vec3& point : points) check_point(point);
  backend_->occluded_from(eye, points, occluded_points);
}

std::string backend_description(Backend backend) {
  return backend == Backend::kEmbree ? embree_description() : "brute force, double precision";
}

}  // namespace hallway::trace

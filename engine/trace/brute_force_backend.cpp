// SPDX-License-Identifier: MIT
#include <utility>

#include "trace/query_backend.hpp"

namespace hallway::trace {
namespace {

class BruteForceBackend final : public QueryBackend {
 public:
  explicit BruteForceBackend(TriangleSet triangles) : triangles_(std::move(triangles)) {}

  std::optional<Hit> first_hit(const SightLine& line) const override {
    std::optional<Hit> nearest;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const auto distance = triangles_.hit(i, line);
      if (distance && (!nearest || *distance < nearest->distance)) nearest = Hit{*distance, i};
    }
    return nearest;
  }

  void first_hits(std::span<const SightLine> lines, std::span<std::optional<Hit>> hits) const override {
    for (std::size_t i = 0; i < lines.size(); ++i) hits[i] = first_hit(lines[i]);
  }

  bool occluded(const Vec3& from, const Vec3& to) const override {
    const auto line = sight_line_between(from, to);
    if (!line) return false;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (triangles_.hit(i, *line)) return true;
    }
    return false;
  }

  void occluded_from(const Vec3& eye, std::span<const Vec3> points,
                     std::span<std::uint8_t> answers) const override {
    for (std::size_t i = 0; i < points.size(); ++i) answers[i] = occluded(eye, points[i]) ? 1 : 0;
  }

 private:
  TriangleSet triangles_;
};

}  // namespace

std::unique_ptr<const QueryBackend> make_brute_force_backend(TriangleSet triangles) {
  return std::make_unique<BruteForceBackend>(std::move(triangles));
}

}  // namespace hallway::trace

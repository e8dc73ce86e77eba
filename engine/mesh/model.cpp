// SPDX-License-Identifier: MIT
#include "mesh/model.hpp"

#include <cmath>

#include "base/error.hpp"

namespace hallway::mesh {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kBadInput, message);
}

void check_count(std::uint64_t count, std::uint64_t most, const char* what) {
  if (count > most) {
    refuse("has " + std::to_string(count) + " " + what + "; at most " + std::to_string(most) + " are read");
  }
}

void check_counts(const Model& model, const ModelLimits& limits) {
  if (model.triangles.empty()) refuse("holds no triangles");
  check_count(model.triangles.size(), limits.triangles, "triangles");
  check_count(model.vertices.size(), limits.vertices, "vertices");
  check_count(model.materials.size(), limits.materials, "materials");
  check_count(model.images.size(), limits.images, "images");
  check_count(model.files.size(), kMaxNotes, "files");
  check_count(model.warnings.size(), kMaxNotes, "warnings");
  if (!model.uv.empty() && model.uv.size() != model.vertices.size()) {
    refuse("has " + std::to_string(model.uv.size()) + " texture coordinates for " +
           std::to_string(model.vertices.size()) + " vertices");
  }
}

void check_numbers(const Model& model) {
  for (std::size_t i = 0; i < model.vertices.size(); ++i) {
    // The comparison is false for what is not a number, too.
    if (!(model.vertices[i].cwiseAbs().maxCoeff() <= kMaxCoordinate_m) || !model.vertices[i].allFinite()) {
      refuse("vertex " + std::to_string(i) + " is not finite or beyond 1e9 m");
    }
  }
  for (std::size_t i = 0; i < model.uv.size(); ++i) {
    for (const float value : model.uv[i]) {
      if (!(std::abs(value) <= kMaxTextureCoordinate))
        refuse("the texture coordinates of vertex " + std::to_string(i) + " are not finite or beyond 1e9");
    }
  }
  if (!(model.metres_per_unit > 0.0) || !std::isfinite(model.metres_per_unit))
    refuse("has a bad unit of length");
}

void check_triangles(const Model& model) {
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const Triangle& triangle = model.triangles[i];
    for (const std::uint32_t vertex : triangle.vertices) {
      if (vertex >= model.vertices.size()) {
        refuse("triangle " + std::to_string(i) + " names vertex " + std::to_string(vertex) + " of " +
               std::to_string(model.vertices.size()));
      }
    }
    if (triangle.material >= model.materials.size())
      refuse("triangle " + std::to_string(i) + " names a material that is not there");
  }
}

void check_materials(const Model& model) {
  for (const Material& material : model.materials) {
    for (const float channel : material.base_colour) {
      if (!(channel >= 0.0F && channel <= 1.0F)) refuse("a material's colour is outside [0, 1]");
    }
    if (material.image && *material.image >= model.images.size())
      refuse("a material names an image that is not there");
  }
}

void check_images(const Model& model, const ModelLimits& limits) {
  std::uint64_t total = 0;
  for (const Image& image : model.images) {
    const std::uint64_t bytes = std::uint64_t{4} * image.width * image.height;
    if (bytes == 0 || bytes != image.rgba.size()) refuse("an image's size is not that of its pixels");
    total += bytes;
  }
  if (total > limits.image_bytes) {
    refuse("has images of " + std::to_string(total) + " bytes; at most " +
           std::to_string(limits.image_bytes) + " are read");
  }
}

}  // namespace

void check_model(const Model& model, const ModelLimits& limits) {
  check_counts(model, limits);
  check_numbers(model);
  check_triangles(model);
  check_materials(model);
  check_images(model, limits);
}

Box bounds_of(const Model& model) {
  Box box;
  for (const Triangle& triangle : model.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) box.extend(model.vertices[vertex]);
  }
  return box;
}

}  // namespace hallway::mesh

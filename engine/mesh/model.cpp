// SPDX-License-Identifier: MIT
#include "mesh/model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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

/// Gives the numbers of the images in the model.
std::vector<std::uint32_t> add_images(Model& model, std::vector<Image> images) {
  std::vector<std::uint32_t> numbers;
  for (Image& image : images) {
    const auto same = std::ranges::find(model.images, image);
    numbers.push_back(static_cast<std::uint32_t>(same - model.images.begin()));
    if (same == model.images.end()) model.images.push_back(std::move(image));
  }
  return numbers;
}

}  // namespace

void check_model(const Model& model, const ModelLimits& limits) {
  check_counts(model, limits);
  check_numbers(model);
  check_triangles(model);
  check_materials(model);
  check_images(model, limits);
}

bool shows_image(const Model& model, const Material& material) {
  return material.image.has_value() && !model.uv.empty();
}

void append(Model& model, Model other) {
  const auto first_vertex = static_cast<std::uint32_t>(model.vertices.size());
  const auto first_material = static_cast<std::uint32_t>(model.materials.size());
  if (!model.uv.empty() || !other.uv.empty()) {
    model.uv.resize(model.vertices.size());
    other.uv.resize(other.vertices.size());
  }
  for (Triangle& triangle : other.triangles) {
    for (std::uint32_t& vertex : triangle.vertices) vertex += first_vertex;
    triangle.material += first_material;
  }
  const std::vector<std::uint32_t> image_of = add_images(model, std::move(other.images));
  for (Material& material : other.materials) {
    if (material.image) material.image = image_of[*material.image];
  }
  const auto move_all = [](auto& from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move_all(other.vertices, model.vertices);
  move_all(other.uv, model.uv);
  move_all(other.triangles, model.triangles);
  move_all(other.materials, model.materials);
}

Box bounds_of(const Model& model) {
  Box box;
  for (const Triangle& triangle : model.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) box.extend(model.vertices[vertex]);
  }
  return box;
}

}  // namespace hallway::mesh

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geom/box.hpp"
#include "geometry/se3.hpp"

namespace hallway::mesh {

/// A decoded picture: rows from the top, four bytes (red, green, blue, alpha; sRGB as in the file) a pixel. Where alpha is
/// below one half there is a hole, elsewhere it is opaque.
struct Image {
  std::string name{};
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba{};  ///< 4 * width * height bytes
  friend bool operator==(const Image&, const Image&) = default;
};

struct Material {
  std::string name{};
  std::array<float, 4> base_colour{1.0F, 1.0F, 1.0F,
                                   1.0F};  ///< red, green, blue, alpha as the file says, in [0, 1]
  std::optional<std::uint32_t> image{};    ///< multiplies the base colour; index in Model::images
};

/// Three vertices, counter-clockwise seen from the front. May have no area.
struct Triangle {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t material = 0;
};

/// What a model file shows, as plain data: one mesh with all node transforms applied and all instances written out, in
/// metres with z up.
struct Model {
  std::vector<Vec3> vertices{};
  /// Texture coordinates, one for each vertex or none at all; (0, 0) is the image's top left corner, (1, 1) its bottom right
  /// one, and the image repeats beyond.
  std::vector<std::array<float, 2>> uv{};
  std::vector<Triangle> triangles{};
  std::vector<Material> materials{};
  std::vector<Image> images{};
  /// Metres in one unit of the file, already applied to the vertices; 1 where the file does not say.
  double metres_per_unit = 1.0;
  std::vector<std::string> files{};     ///< read for this: paths relative to the root folder, sorted
  std::vector<std::string> warnings{};  ///< what was left out of the file and why, safe to print
};

/// How large a model may be; beyond these load_model() refuses it.
struct ModelLimits {
  std::uint64_t triangles = 10'000'000;
  std::uint64_t vertices = 30'000'000;
  std::uint64_t materials = 65'536;
  std::uint64_t images = 4'096;
  std::uint64_t image_bytes = std::uint64_t{256} << 20;  ///< of all images, decoded
  std::uint64_t file_bytes = std::uint64_t{512} << 20;   ///< of all files read
};

inline constexpr double kMaxCoordinate_m = 1e9;        ///< of a vertex
inline constexpr float kMaxTextureCoordinate = 1e9F;   ///< of Model::uv
inline constexpr std::uint64_t kMaxNotes = 10'000;     ///< files or warnings
inline constexpr std::uint64_t kMaxNameBytes = 4'096;  ///< of a name, file or warning

/// Throws Error{kBadInput} saying what is wrong, if anything: a count over its limit or zero triangles, an index out of
/// range, a number that is not finite or out of range, an image whose size is not that of its pixels. O(size).
void check_model(const Model& model, const ModelLimits& limits);

/// Whether a material shows its image: it has one, and the model has texture coordinates.
bool shows_image(const Model& model, const Material& material);

/// Adds another model's triangles and materials, and the images that are not there yet. O(size of both), and number of the images times
/// that of the others.
void append(Model& model, Model other);

/// The box around the vertices that triangles use, metres.
Box bounds_of(const Model& model);

}  // namespace hallway::mesh

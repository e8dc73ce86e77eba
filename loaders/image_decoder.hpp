// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "mesh/model.hpp"

namespace hallway::loaders {

/// Decodes PNG, JPEG, BMP and TGA images as long as there is room for them.
class ImageDecoder {
 public:
  /// @param byte_limit  of all images together, decoded
  explicit ImageDecoder(std::uint64_t byte_limit) : bytes_left_(byte_limit) {}

  /// The image, or why it cannot be decoded. Throws Error{kBadInput} for one that its header makes larger than what is left
  /// of the limit, before any of it is decoded.
  std::variant<mesh::Image, std::string> decode(std::string_view bytes, const std::string& name);

  /// Takes room for an image of that size. Throws as decode() does.
  void reserve(std::uint64_t width, std::uint64_t height, const std::string& name);

 private:
  void check_room(std::uint64_t width, std::uint64_t height, const std::string& name) const;

  std::uint64_t bytes_left_;
};

}  // namespace hallway::loaders

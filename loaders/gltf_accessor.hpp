// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "loaders/gltf_document.hpp"

namespace hallway::loaders::gltf {

/// Reads accessors of a document whose every number may be a lie. Functions throw Error{kBadInput} naming the accessor and
/// what is wrong; nothing is allocated before the range is known to be inside its buffer and `most` to be kept.
class AccessorReader {
 public:
  explicit AccessorReader(const Document& document) : document_(document) {}

  /// Vectors of three or two numbers. Whole numbers are divided by their largest value where the accessor is normalized.
  std::vector<std::array<float, 3>> vectors3(std::int64_t accessor, std::uint64_t most) const;
  std::vector<std::array<float, 2>> vectors2(std::int64_t accessor, std::uint64_t most) const;
  /// Unsigned whole numbers.
  std::vector<std::uint32_t> indices(std::int64_t accessor, std::uint64_t most) const;
  /// The bytes of a buffer view.
  std::string_view view_bytes(std::int64_t view) const;
  /// Number of elements that the accessor says it has. Throws if there is no such accessor.
  std::uint64_t count(std::int64_t accessor) const { return find(accessor).count; }

 private:
  template <std::size_t N>
  std::vector<std::array<float, N>> vectors(std::int64_t accessor, std::uint64_t most) const;
  template <std::size_t N>
  void replace_sparse(const Accessor& accessor, std::vector<std::array<float, N>>& values) const;
  const Accessor& find(std::int64_t accessor) const;

  const Document& document_;
};

}  // namespace hallway::loaders::gltf

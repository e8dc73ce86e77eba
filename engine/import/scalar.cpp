// SPDX-License-Identifier: MIT
#include "import/scalar.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "base/bytes.hpp"

namespace hallway::import {
namespace {

template <typename T>
double read_as(const char* bytes, ByteOrder order) {
  auto copy = load<std::array<char, sizeof(T)>>(bytes);
  if (order == ByteOrder::kBig) std::reverse(copy.begin(), copy.end());
  return static_cast<double>(std::bit_cast<T>(copy));
}

}  // namespace

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

double read_scalar(const char* bytes, Scalar type, ByteOrder order) {
  switch (type) {
    case Scalar::kInt8:
      return read_as<std::int8_t>(bytes, order);
    case Scalar::kUint8:
      return read_as<std::uint8_t>(bytes, order);
    case Scalar::kInt16:
      return read_as<std::int16_t>(bytes, order);
    case Scalar::kUint16:
      return read_as<std::uint16_t>(bytes, order);
    case Scalar::kInt32:
      return read_as<std::int32_t>(bytes, order);
    case Scalar::kUint32:
      return read_as<std::uint32_t>(bytes, order);
    case Scalar::kInt64:
      return read_as<std::int64_t>(bytes, order);
    case Scalar::kUint64:
      return read_as<std::uint64_t>(bytes, order);
    case Scalar::kFloat32:
      return read_as<float>(bytes, order);
    case Scalar::kFloat64:
      break;
  }
  return read_as<double>(bytes, order);
}

}  // namespace hallway::import

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

/// How a kind of number is read.
struct Reading {
  std::size_t size = 0;
  double (*read)(const char* bytes, ByteOrder order) = nullptr;
};

template <typename... T>
constexpr std::array<Reading, sizeof...(T)> readings_of() {
  return {{{sizeof(T), read_as<T>}...}};
}

/// In the order of Scalar.
constexpr auto kReadings = readings_of<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                                       std::uint32_t, std::int64_t, std::uint64_t, float, double>();

}  // namespace

std::size_t size_of(Scalar type) {
  return kReadings[static_cast<std::size_t>(type)].size;
}

double read_scalar(const char* bytes, Scalar type, ByteOrder order) {
  return kReadings[static_cast<std::size_t>(type)].read(bytes, order);
}

}  // namespace hallway::import

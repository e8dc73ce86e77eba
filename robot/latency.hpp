// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

namespace hallway::robot {

/// How long answers took, in memory that does not grow: counts in classes whose width is 1/32 of their value.
class Latency {
 public:
  void add(std::chrono::nanoseconds duration);

  std::uint64_t count() const { return count_; }
  std::chrono::nanoseconds worst() const { return worst_; }
  /// What a share of the answers did not exceed, to 1/32; 0 where there are none.
  /// @param share  of 0 to 1
  std::chrono::nanoseconds quantile(double share) const;

 private:
  static constexpr unsigned kBits = 5;
  static std::size_t class_of(std::uint64_t ns);
  static std::uint64_t upper_end(std::size_t index);

  std::array<std::uint64_t, (64 - kBits + 1) << kBits> classes_{};
  std::uint64_t count_ = 0;
  std::chrono::nanoseconds worst_{0};
};

}  // namespace hallway::robot

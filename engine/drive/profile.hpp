// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hallway::drive {

/// How fast a number may change, per second.
struct Rates {
  double growing = 0.0;    ///< while its magnitude grows
  double shrinking = 0.0;  ///< while its magnitude shrinks
};

/// A number over time that goes to its target: constant before its first vertex and after its last one, linear between them. A change takes a whole number
/// of nanoseconds, rounded up, so that no rate is exceeded by more than 1e-3 ns in its duration.
class Profile {
 public:
  /// Constant 0.
  Profile() = default;
  /// From `value` at `t_ns` to `target` as fast as the rates allow, by way of 0 where the sign changes.
  Profile(std::int64_t t_ns, double value, double target, const Rates& rates);

  /// One line from `value` at `t_ns` to `target` at `end_ns`.
  static Profile line(std::int64_t t_ns, double value, double target, std::int64_t end_ns);

  double at(std::int64_t t_ns) const;
  /// The first vertex after a time; the greatest number where there is none.
  std::int64_t next_vertex(std::int64_t t_ns) const;
  std::int64_t end_ns() const { return vertices_[count_ - 1].t_ns; }
  double target() const { return vertices_[count_ - 1].value; }

 private:
  struct Vertex {
    std::int64_t t_ns = 0;
    double value = 0.0;
  };

  void add(std::int64_t t_ns, double value);

  std::array<Vertex, 3> vertices_{};
  std::size_t count_ = 1;
};

/// The time that one line from `value` to `target` takes at the lowest of the rates that it needs [ns].
std::int64_t line_duration_ns(double value, double target, const Rates& rates);

}  // namespace hallway::drive

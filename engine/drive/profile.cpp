// SPDX-License-Identifier: MIT
#include "drive/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drive/motion.hpp"

namespace hallway::drive {
namespace {

constexpr double kRoundingNs = 1e-3;  // so that (0.8 - 0.1) / 0.7 s is not one nanosecond more

std::int64_t duration_ns(double change, double rate) {
  if (change == 0.0) return 0;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(change / rate * 1e9 - kRoundingNs)));
}

}  // namespace

Profile::Profile(std::int64_t t_ns, double value, double target, const Rates& rates) {
  vertices_[0] = {t_ns, value};
  if (value * target < 0.0) {
    add(t_ns + duration_ns(std::abs(value), rates.shrinking), 0.0);
    add(end_ns() + duration_ns(std::abs(target), rates.growing), target);
  } else {
    add(t_ns + line_duration_ns(value, target, rates), target);
  }
}

Profile Profile::line(std::int64_t t_ns, double value, double target, std::int64_t end_ns) {
  Profile profile;
  profile.vertices_[0] = {t_ns, value};
  profile.add(end_ns, target);
  return profile;
}

void Profile::add(std::int64_t t_ns, double value) {
  vertices_[count_++] = {t_ns, value};
}

double Profile::at(std::int64_t t_ns) const {
  for (std::size_t i = 1; i < count_; ++i) {
    const Vertex& begin = vertices_[i - 1];
    const Vertex& end = vertices_[i];
    if (t_ns < end.t_ns) {
      return t_ns <= begin.t_ns ? begin.value
                                : between(begin.value, end.value, t_ns - begin.t_ns, end.t_ns - begin.t_ns);
    }
  }
  return target();
}

std::int64_t Profile::next_vertex(std::int64_t t_ns) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (vertices_[i].t_ns > t_ns) return vertices_[i].t_ns;
  }
  return std::numeric_limits<std::int64_t>::max();
}

std::int64_t line_duration_ns(double value, double target, const Rates& rates) {
  const bool crosses = value * target < 0.0;
  const bool grows = std::abs(target) > std::abs(value);
  const double rate =
      crosses ? std::min(rates.growing, rates.shrinking) : (grows ? rates.growing : rates.shrinking);
  return duration_ns(std::abs(target - value), rate);
}

}  // namespace hallway::drive

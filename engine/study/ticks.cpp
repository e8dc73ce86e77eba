// SPDX-License-Identifier: MIT
#include "study/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hallway::study {
namespace {

/// The smallest of 1, 2, 5, 10, ... (or parts of it) that is at least `value`.
double round_up_125(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= value * (1.0 - 1e-9)) return factor * decade;
  }
  return 10.0 * decade;
}

/// With as many decimals as the step needs.
std::string tick_text(double value, double step) {
  const double size = std::max(std::abs(value), step);
  if (size >= 1e6 || size < 1e-4) return value == 0.0 ? "0" : fmt::format("{:.3g}", value);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

}  // namespace

AxisRange axis_range(const std::vector<double>& values, bool log) {
  AxisRange range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (!std::isfinite(value) || (log && value <= 0.0)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  if (range.low > range.high) return log ? AxisRange{0.1, 1.0} : AxisRange{0.0, 1.0};
  if (log) return {range.low / 1.15, range.high * 1.15};
  if (range.low >= 0.0 && range.low <= 0.5 * range.high) range.low = 0.0;
  const double width = range.high > range.low ? range.high - range.low : std::max(std::abs(range.high), 1.0);
  const double room = 0.04 * width;
  return {range.low == 0.0 ? 0.0 : range.low - room, range.high + room};
}

std::vector<Tick> linear_ticks(const AxisRange& range, int most, double least_step) {
  const double step = std::max(round_up_125((range.high - range.low) / std::max(most - 1, 1)), least_step);
  std::vector<Tick> ticks;
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * step; k += 1.0)
    ticks.push_back({k * step, tick_text(k * step, step)});
  return ticks;
}

std::vector<Tick> log_ticks(const AxisRange& range, int most) {
  const double first = std::floor(std::log10(range.low)), last = std::ceil(std::log10(range.high));
  const double decades = std::log10(range.high / range.low);
  const bool between = decades < 3.0;
  const double stride = std::max(1.0, std::ceil(decades / std::max(most - 1, 1)));
  std::vector<Tick> ticks;
  for (double power = first; power <= last; power += 1.0) {
    if (!between && std::fmod(power - first, stride) != 0.0) continue;
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, power);
      if (value < range.low || value > range.high || (factor != 1.0 && !between)) continue;
      ticks.push_back({value, fmt::format("{:g}", value)});
    }
  }
  return ticks;
}

}  // namespace hallway::study

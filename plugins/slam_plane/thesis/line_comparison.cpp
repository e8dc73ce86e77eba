// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam_plane/thesis/plane_track.hpp"
#include "slam_plane/thesis/stillness.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr Iteration kWindow = 64;
constexpr double kBetween = 6.0;  // largest ratio of the variance between four parts to that within them
constexpr double kWander = 2.0;   // largest ratio of the variance to that of steps

double square(double x) {
  return x * x;
}

/// What one iteration tells, a laid on the x axis with the end at the origin.
struct Line {
  double distance;  // of the end from b's line
  Vec2 middle;      // of what is seen of b
  Vec2 direction;
};

Line line_of(const TimedObservation& a, const TimedObservation& b, int end) {
  const Pose2 turned{Vec2::Zero(), a.direction};
  Line line;
  line.direction = turned.unrotate(b.direction);
  line.middle = turned.unrotate(b.segment.middle() - a.segment.end[end]);
  line.distance = cross(line.direction, line.middle);
  return line;
}

double mean_of(const std::vector<Line>& lines, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += lines[i].distance;
  return sum / static_cast<double>(end - begin);
}

bool stands_still(const std::vector<Line>& lines, double max_deviation_m) {
  const std::size_t n = lines.size();
  if (n < kExactReadings) return false;
  const double mean = mean_of(lines, 0, n);
  double variance = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    variance += square(lines[i].distance - mean);
    if (i > 0) steps += 0.5 * square(lines[i].distance - lines[i - 1].distance);
  }
  const double count = static_cast<double>(n);
  if (variance <= count * square(kNoDeviation_m)) return true;
  if (n < kReadings || variance > count * square(max_deviation_m) || variance > kWander * steps) return false;
  double between = 0.0;
  for (std::size_t part = 0; part < 4; ++part) {
    const std::size_t begin = part * n / 4, end = (part + 1) * n / 4;
    between += static_cast<double>(end - begin) * square(mean_of(lines, begin, end) - mean);
  }
  return between / 3.0 <= kBetween * (variance - between) / (count - 4.0);
}

}  // namespace

Comparison compare_line(const PlaneTrack& a, const PlaneTrack& b, int end_of_a, Iteration now,
                        const CompareOptions& options) {
  Comparison result;
  result.interval = {now - kWindow + 1, now};
  std::vector<Line> lines;
  for_each_shared(a, b, result.interval, [&](const TimedObservation& in_a, const TimedObservation& in_b) {
    if (lines.empty()) result.interval.first = in_a.iteration;
    lines.push_back(line_of(in_a, in_b, end_of_a));
  });
  if (!stands_still(lines, options.max_deviation_m)) return result;
  Vec2 direction = Vec2::Zero(), middle = Vec2::Zero();
  for (const Line& line : lines) {
    direction += line.direction;
    middle += line.middle / static_cast<double>(lines.size());
  }
  result.direction = direction.normalized();
  result.parallel = std::abs(result.direction.y()) <= std::sin(options.parallel_deg * 0.017453292519943295);
  result.size[0] = size_in(a, result.interval, options).size;
  result.size[1] = size_in(b, result.interval, options).size;
  const double half = end_of_a == kEndA ? 0.5 : -0.5;
  result.offset = middle - Vec2(half * result.size[0], 0.0);
  result.key[0] = key_at(end_of_a);
  result.shared = static_cast<int>(lines.size());
  result.deviation = 0.0;
  result.valid = true;
  return result;
}

}  // namespace hallway::slam_plane::thesis

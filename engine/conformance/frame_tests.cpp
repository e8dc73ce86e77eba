// SPDX-License-Identifier: MIT
// Frames as a robot may give them.
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

using Points = std::vector<hw_point3_t>;

constexpr std::uint64_t kBefore = 3;  ///< ordinary frames before the one that a test is about
constexpr std::size_t kManyPoints = 100'000;
constexpr double kSpread = 1e-3;  ///< times up to 10 m

/// Gives the frame that `make` makes of the ordinary walk (of step 0) to a new plugin first, and to another one at step kBefore of the walk, which then
/// goes on. The answers are valid; with `may_fail` they may be failures with a reason.
void try_frame(const Subject& subject, const std::function<Frame(const Walk&)>& make, bool may_fail = false) {
  for (const std::uint64_t before : {std::uint64_t{0}, kBefore}) {
    Active plugin(subject);
    for (std::uint64_t step = 0; step < before; ++step) {
      plugin.step(step).demand_valid();
    }
    Frame frame = make(plugin.ordinary());
    frame.sequence = before;
    frame.t_ns = plugin.ordinary().frame(before).t_ns;
    for (Reading& reading : frame.readings) reading.sequence = before;
    const Answer answer = plugin.process(frame);
    if (may_fail) answer.demand_survived();
    if (!answer.good() && may_fail) continue;
    answer.demand_valid();
    for (std::uint64_t step = before + 1; step < before + 3; ++step) {
      plugin.step(step).demand_valid();
    }
    plugin.report(0).demand_valid();
  }
}

void try_points(const Subject& subject, const Points& points, bool may_fail = false) {
  const auto with_points = [&](const Walk& ordinary) {
    Frame frame = ordinary.frame(0);
    points_in(frame).points = points;
    return frame;
  };
  try_frame(subject, with_points, may_fail);
}

void takes_no_samples(const Subject& subject) {
  try_frame(subject, [](const Walk&) { return Frame(); });
}

void takes_no_elements(const Subject& subject) {
  try_frame(subject, [](const Walk& ordinary) { return ordinary.frame(0, 0); });
}

void takes_one_element(const Subject& subject) {
  try_frame(subject, [](const Walk& ordinary) { return ordinary.frame(0, 1); });
}

/// A close look at the walk's few places, since the ABI does not demand speed: a plugin that compares each point with each landmark gets along.
Points many_points(const Subject& subject) {
  const Points places = walk_points(subject.seed, 1);
  Points points = random_points(subject.seed, stream_id("conformance.many"), kManyPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const hw_point3_t& place = places[i % places.size()];
    points[i] = {place.x + kSpread * points[i].x, place.y + kSpread * points[i].y,
                 place.z + kSpread * points[i].z};
  }
  return points;
}

void takes_many_points(const Subject& subject) {
  Active plugin(subject);
  plugin.step(0).demand_valid();
  Frame frame = plugin.ordinary().frame(1);
  points_in(frame).points = many_points(subject);
  plugin.process(frame).demand_valid();
  plugin.step(2).demand_valid();
  plugin.report(0).demand_valid();
}

void survives_equal_points(const Subject& subject) {
  try_points(subject, Points(10, {1.0, 2.0, 0.5}), true);
  Points twice = walk_points(subject.seed, 0);
  twice.insert(twice.end(), twice.begin(), twice.end());
  try_points(subject, twice, true);
}

void takes_far_points(const Subject& subject) {
  Points far = random_points(subject.seed, stream_id("conformance.far"), 20);
  for (hw_point3_t& point : far) point = {1e5 * point.x, 1e5 * point.y, 1e5 * point.z};  // up to 1e6 m
  far.push_back({1e6, -1e6, 1e6});
  try_points(subject, far);
}

void takes_points_in_a_line(const Subject& subject) {
  Points line;
  for (int i = 0; i < 20; ++i) line.push_back({1.0 + 0.25 * i, 0.0, 0.0});
  try_points(subject, line);
}

void takes_points_in_a_plane(const Subject& subject) {
  Points plane = walk_points(subject.seed, 0);
  for (hw_point3_t& point : plane) point.z = 0.0;
  try_points(subject, plane);
}

void survives_points_that_are_not_finite(const Subject& subject) {
  Points points = walk_points(subject.seed, 0);
  points[1].x = std::numeric_limits<double>::quiet_NaN();
  points[2].y = std::numeric_limits<double>::infinity();
  points[3] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), 0.0};
  try_points(subject, points, true);
}

/// What is put for three frames where each has `extra` before or behind the others, counted as if it had not.
std::string with_extra(const LoadedLibrary& library, const Subject& subject, const Reading* extra,
                       bool before) {
  Active plugin(library, subject, {.counters = false});
  std::string bytes;
  for (std::uint64_t step = 0; step < 3; ++step) {
    Frame frame = plugin.ordinary().frame(step);
    std::vector<std::uint32_t> indices(frame.readings.size());
    std::iota(indices.begin(), indices.end(), 0u);
    if (extra != nullptr) {
      const auto last = static_cast<std::uint32_t>(indices.size());
      indices.insert(before ? indices.begin() : indices.end(), last);
      frame.readings.insert(before ? frame.readings.begin() : frame.readings.end(), *extra);
    }
    InputMemory memory;
    bytes += plugin.process(memory.put_frame(frame), indices).demand_valid().bytes;
  }
  return bytes;
}

void skips_unknown_kinds(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::string expected = with_extra(library, subject, nullptr, false);
  for (const std::uint32_t kind : {0u, 4711u, UINT32_MAX}) {
    const Reading unknown{.kind = kind};
    for (const bool before : {true, false}) {
      const std::string bytes = with_extra(library, subject, &unknown, before);
      demand_same(bytes, expected,
                  "a sample of the unknown kind " + std::to_string(kind) + " changes the answer");
    }
  }
}

/// Frames of the walk, each changed by `change`.
template <typename Change>
void try_walk(const Subject& subject, bool may_fail, Change&& change) {
  Active plugin(subject);
  for (std::uint64_t step = 0; step < 6; ++step) {
    Frame frame = plugin.ordinary().frame(step);
    change(frame);
    const Answer answer = plugin.process(frame);
    if (!may_fail) answer.demand_valid();
    answer.demand_survived();
    if (!answer.good()) return;
  }
  plugin.report(0).demand_valid();
}

void takes_tracks(const Subject& subject) {
  try_walk(subject, false, [](Frame& frame) {
    Reading& reading = points_in(frame);
    for (std::size_t i = 0; i < reading.points.size(); ++i) {
      reading.track.push_back(i % 3 == 0 ? UINT64_MAX - i : (i + 7 * frame.sequence) % kWalkPoints);
    }
  });
}

void takes_pixels(const Subject& subject) {
  try_walk(subject, false, [](Frame& frame) {
    Reading& reading = points_in(frame);
    // Rows of seven, the last points first, with a pixel without a point before every point.
    reading.width = 14;
    reading.height = static_cast<std::uint32_t>(reading.points.size() / 7 + 1);
    for (std::size_t i = 0; i < reading.points.size(); ++i) {
      reading.pixels.push_back(static_cast<std::uint32_t>(2 * (reading.points.size() - 1 - i) + 1));
    }
  });
}

/// Each of the three arrays alone, and all of them.
void takes_point_data(const Subject& subject) {
  constexpr std::int64_t kSweep_ns = 40'000'000;
  for (const unsigned arrays : {1u, 2u, 4u, 7u}) {
    try_walk(subject, false, [&](Frame& frame) {
      Reading& reading = points_in(frame);
      reading.duration_ns = kSweep_ns;
      for (std::size_t i = 0; i < reading.points.size(); ++i) {
        const auto share = static_cast<double>(i) / static_cast<double>(reading.points.size());
        if ((arrays & 1u) != 0)
          reading.t_offset_ns.push_back(static_cast<std::int64_t>(share * static_cast<double>(kSweep_ns)));
        if ((arrays & 2u) != 0)
          reading.intensity.push_back(i % 7 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                                 : static_cast<float>(i));
        if ((arrays & 4u) != 0) reading.ring.push_back(static_cast<std::uint32_t>(i % 4));
      }
    });
  }
}

void takes_equal_times(const Subject& subject) {
  try_walk(subject, false, [](Frame& frame) { frame.t_ns = 1'000'000'000; });
}

void takes_any_time(const Subject& subject) {
  try_walk(subject, false,
           [](Frame& frame) { frame.t_ns = -1'000'000'000 + static_cast<std::int64_t>(frame.sequence); });
  try_walk(subject, false, [](Frame& frame) {
    frame.t_ns = std::numeric_limits<std::int64_t>::max() - 10 + static_cast<std::int64_t>(frame.sequence);
  });
}

void survives_gaps(const Subject& subject) {
  try_walk(subject, true, [](Frame& frame) {
    if (frame.sequence >= 2) frame.sequence += 1'000'000'000'000;
    if (frame.sequence % 2 == 1) frame.sequence += 1;
    for (Reading& reading : frame.readings) reading.sequence = frame.sequence;
  });
}

void survives_unannounced_sensors(const Subject& subject) {
  for (const bool beside_others : {false, true}) {
    const auto unannounced = [&](const Walk& ordinary) {
      Frame frame = ordinary.frame(0);
      const std::vector<Reading> others = frame.readings;
      for (Reading& reading : frame.readings) reading.sensor += 77;
      if (beside_others) frame.readings.insert(frame.readings.end(), others.begin(), others.end());
      return frame;
    };
    try_frame(subject, unannounced, true);
  }
}

void survives_two_readings(const Subject& subject) {
  const auto twice = [](const Walk& ordinary) {
    const Frame once = ordinary.frame(0);
    Frame frame;
    for (const Reading& reading : once.readings) frame.readings.insert(frame.readings.end(), 2, reading);
    return frame;
  };
  try_frame(subject, twice, true);
}

constexpr Test kFrameTests[] = {
    {"frame-no-samples", "A frame without samples is a valid one.", takes_no_samples},
    {"frame-no-points", "A sample without elements is a valid one.", takes_no_elements},
    {"frame-one-point", "A sample of one element is a valid one.", takes_one_element},
    {"frame-many-points", "A sample of 100 000 points is answered.", takes_many_points},
    {"frame-equal-points", "Points that are equal are answered, or refused with a reason.",
     survives_equal_points},
    {"frame-far-points", "Points at 1e6 m are answered.", takes_far_points},
    {"frame-line", "Points in a line are answered.", takes_points_in_a_line},
    {"frame-plane", "Points in a plane are answered.", takes_points_in_a_plane},
    {"frame-not-finite", "Points that are not finite are answered, or refused with a reason.",
     survives_points_that_are_not_finite},
    {"frame-unknown-kind",
     "Samples of an unknown kind are skipped: the answer is that to the frame without them.",
     skips_unknown_kinds},
    {"frame-tracks", "Points may come with the ids under which the sensor follows them.", takes_tracks},
    {"frame-pixels", "Points may come with their places in an image.", takes_pixels},
    {"frame-point-times", "Points may come with times, intensities and rings.", takes_point_data},
    {"frame-equal-times", "Frames may have the same time.", takes_equal_times},
    {"frame-any-time", "The host's clock may begin anywhere, also before 0.", takes_any_time},
    {"frame-gaps", "Sequence numbers with gaps are answered, or refused with a reason.", survives_gaps},
    {"frame-unannounced", "A sample of a sensor that was not announced is skipped, or refused with a reason.",
     survives_unannounced_sensors},
    {"frame-two-readings", "Two samples of one sensor are answered, or refused with a reason.",
     survives_two_readings},
};

}  // namespace

std::span<const Test> frame_tests() {
  return kFrameTests;
}

}  // namespace hallway::conformance

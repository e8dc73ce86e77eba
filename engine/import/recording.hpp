// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "log/landmarks.hpp"
#include "log/observations.hpp"

namespace hallway::import {

/// Points in the sensor's frame (x forward, y left, z up), metres.
using PointList = std::vector<std::array<double, 3>>;

/// The image that points are pixels of.
struct PixelGrid {
  std::uint32_t width = 0;  ///< columns; 0: there is no image
  std::uint32_t height = 0;
  std::vector<std::uint32_t> pixels{};  ///< of each point: row * width + column; without an image empty
};

/// One moment of a recording.
struct Frame {
  std::int64_t t_ns = 0;                      ///< as recorded; not below 0
  PointList points;                           ///< all finite
  std::vector<log::TrackId> tracks{};         ///< empty, or per point under which id the sensor follows it
  std::vector<log::LandmarkId> identities{};  ///< empty, or per point its true landmark
  PixelGrid image{};                          ///< what the points are pixels of, where that is known
  std::uint64_t not_finite = 0;               ///< points that were left out since a coordinate is none
  std::optional<Pose> T_world_body;           ///< the true pose, where it is known
  bool orientation_known = true;              ///< false: only the position of T_world_body is meant
};

/// What other programs have recorded, frame by frame. A frame is a pure function of its number as long as the files stay as they are.
class Recording {
 public:
  virtual ~Recording() = default;

  /// How many frames there are, at least one.
  virtual std::uint32_t frames() const = 0;
  /// Replaces `frame` by frame `index`, below frames(). Times do not decrease from frame to frame. Throws Error{kBadInput, kIo} naming the file.
  virtual void read(std::uint32_t index, Frame& frame) = 0;
  /// Mean time from frame to frame.
  virtual std::int64_t period_ns() const = 0;
  /// What the sensor is called, for people.
  virtual std::string sensor() const = 0;
  /// Whether a true pose is known for any frame.
  virtual bool has_truth() const = 0;
  /// Whether the sensor follows its points.
  virtual bool has_tracks() const { return false; }
  /// Whether the true landmarks of points are known.
  virtual bool has_identities() const { return false; }
  /// Where the true landmarks are (world), if that is known.
  virtual const std::optional<std::vector<log::Landmark>>& true_landmarks() const;
};

/// Mean time between so many frames from the first time to the last; `otherwise` where there is none.
std::int64_t mean_period_ns(std::int64_t first_ns, std::int64_t last_ns, std::uint64_t frames,
                            std::int64_t otherwise);

}  // namespace hallway::import

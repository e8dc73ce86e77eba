// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "contact/part.hpp"

namespace hallway::contact {

/// The motion of a body, part after part without gaps.
class History {
 public:
  /// Begins at a pose and forgets what was.
  void begin(const Pose& pose, std::int64_t at_ns);

  /// Appends a part, which begins when and where the last one ends. Parts in which the body stands become one.
  void add(const Part& part);

  /// Drops the parts that end before a time.
  void forget_before(std::int64_t t_ns);

  /// From the beginning of the oldest part to the end of the newest.
  std::int64_t begin_ns() const { return parts_.empty() ? end_ns_ : parts_.front().begin_ns; }
  std::int64_t end_ns() const { return end_ns_; }
  const std::deque<Part>& parts() const { return parts_; }

  /// The pose at a time, T_world_body; after a drop that happens at it. Throws Error{kInternal} for a time out of range. O(log parts).
  Pose pose_at(std::int64_t t_ns) const;
  /// The twist at a time, in the body's frame; of two parts that meet there, of the later one. Throws as pose_at() does.
  PlanarTwist twist_at(std::int64_t t_ns) const;
  /// How the body moves `after_s` seconds after a time, before or after what jumps there. Throws as pose_at() does.
  PartMotion motion_at(std::int64_t t_ns, double after_s, bool is_after) const;
  /// The times in (begin, end] at which one part meets the next, ascending; each once.
  std::vector<std::int64_t> joints_in(std::int64_t begin_ns, std::int64_t end_ns) const;

 private:
  const Part* part_at(std::int64_t t_ns) const;

  std::deque<Part> parts_;
  Pose last_{};
  std::int64_t end_ns_ = 0;
};

}  // namespace hallway::contact

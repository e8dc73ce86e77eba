// SPDX-License-Identifier: MIT
#include "contact/history.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace hallway::contact {
namespace {

bool is_rest(const Part& part) {
  return part.ramp.duration_ns > 0 && part.ramp.from.is_zero() && part.ramp.to.is_zero() &&
         part.from.t == part.to.t && part.from.q.coeffs() == part.to.q.coeffs();
}

double share_of(const Part& part, std::int64_t t_ns) {
  if (part.ramp.duration_ns == 0) return 1.0;
  return static_cast<double>(t_ns - part.begin_ns) / static_cast<double>(part.ramp.duration_ns);
}

}  // namespace

void History::begin(const Pose& pose, std::int64_t at_ns) {
  parts_.clear();
  last_ = pose;
  end_ns_ = at_ns;
}

void History::add(const Part& part) {
  last_ = part.to;
  end_ns_ = part.end_ns();
  if (!parts_.empty() && is_rest(part) && is_rest(parts_.back())) {
    parts_.back().ramp.duration_ns += part.ramp.duration_ns;
    return;
  }
  parts_.push_back(part);
}

void History::forget_before(std::int64_t t_ns) {
  while (!parts_.empty() && parts_.front().end_ns() < t_ns) parts_.pop_front();
}

const Part* History::part_at(std::int64_t t_ns) const {
  if (t_ns < begin_ns() || t_ns > end_ns_)
    throw Error(ErrorCode::kInternal, "the history of the body does not have this time");
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), t_ns,
                                      [](std::int64_t t, const Part& part) { return t < part.begin_ns; });
  return after == parts_.begin() ? nullptr : &*(after - 1);
}

Pose History::pose_at(std::int64_t t_ns) const {
  const Part* part = part_at(t_ns);
  return part == nullptr ? last_ : pose_in(*part, share_of(*part, t_ns));
}

PlanarTwist History::twist_at(std::int64_t t_ns) const {
  const Part* part = part_at(t_ns);
  return part == nullptr ? PlanarTwist{} : part->ramp.at(share_of(*part, t_ns));
}

PartMotion History::motion_at(std::int64_t t_ns, double after_s, bool is_after) const {
  if (t_ns < begin_ns() || t_ns > end_ns_)
    throw Error(ErrorCode::kInternal, "the history of the body does not have this time");
  // The moment is compared in seconds after t_ns, as joints_in() gives it to callers.
  const auto begins_later = [&](double moment_s, const Part& part) {
    const double begin_s = static_cast<double>(part.begin_ns - t_ns) * 1e-9;
    return is_after ? moment_s < begin_s : moment_s <= begin_s;
  };
  const auto later = std::upper_bound(parts_.begin(), parts_.end(), after_s, begins_later);
  if (later == parts_.begin()) return {.pose = parts_.empty() ? last_ : parts_.front().from};
  const Part& part = *(later - 1);
  return motion_in(part, static_cast<double>(t_ns - part.begin_ns) * 1e-9 + after_s);
}

std::vector<std::int64_t> History::joints_in(std::int64_t begin_ns, std::int64_t end_ns) const {
  std::vector<std::int64_t> joints;
  auto part = std::upper_bound(parts_.begin(), parts_.end(), begin_ns,
                               [](std::int64_t t, const Part& p) { return t < p.begin_ns; });
  for (; part != parts_.end() && part->begin_ns <= end_ns; ++part) {
    if (part != parts_.begin() && (joints.empty() || joints.back() < part->begin_ns))
      joints.push_back(part->begin_ns);
  }
  return joints;
}

}  // namespace hallway::contact

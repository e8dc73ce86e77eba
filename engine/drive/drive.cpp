// SPDX-License-Identifier: MIT
#include "drive/drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace hallway::drive {
namespace {

constexpr std::int64_t kLongestPieceNs = 10'000'000'000;  // where nothing changes

using Numbers = std::array<double, 3>;

Numbers numbers_of(const PlanarTwist& twist) {
  return {twist.forward_m_s, twist.lateral_m_s, twist.angular_rad_s};
}

bool is_finite(const Command& command) {
  return std::isfinite(command.forward_m_s) && std::isfinite(command.lateral_m_s) &&
         std::isfinite(command.angular_rad_s);
}

const DriveSpec& checked(const DriveSpec& spec) {
  check(spec);
  return spec;
}

template <class Parts>
Numbers numbers_at(const Parts& parts, std::int64_t t_ns) {
  return {parts[0].at(t_ns), parts[1].at(t_ns), parts[2].at(t_ns)};
}

/// All parts on one line, at the pace of the slowest.
template <class Parts>
Parts in_step(std::int64_t t_ns, const Numbers& values, const Numbers& targets,
              const std::array<Rates, 3>& rates) {
  std::int64_t duration = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    duration = std::max(duration, line_duration_ns(values[i], targets[i], rates[i]));
  }
  Parts parts;
  for (std::size_t i = 0; i < 3; ++i) parts[i] = Profile::line(t_ns, values[i], targets[i], t_ns + duration);
  return parts;
}

}  // namespace

Drive::Drive(const DriveSpec& spec, std::uint64_t seed) : spec_(checked(spec)), actuation_(spec, seed) {}

Obeyed Drive::command(std::int64_t t_ns, const Command& command) {
  if (!is_finite(command))
    throw Error(ErrorCode::kInternal, "a drive was given a command that is not finite");
  const Pending pending{std::max(present_ns_, t_ns + spec_.latency_ns), limit(spec_, command)};
  const auto later = std::ranges::upper_bound(pending_, pending.acts_from_ns, {}, &Pending::acts_from_ns);
  pending_.insert(later, pending);
  return {pending.limited.command, pending.limited.clamps, pending.acts_from_ns};
}

Obeyed Drive::halt(std::int64_t t_ns) {
  return command(t_ns, {});
}

std::array<Rates, 3> Drive::rates() const {
  const Rates linear{spec_.max_acceleration_m_s2, deceleration_limit(spec_)};
  const double turn = is_steered() ? spec_.max_steering_rate_rad_s : spec_.max_angular_acceleration_rad_s2;
  return {linear, linear, Rates{turn, turn}};
}

PlanarTwist Drive::driven_at(const Parts& parts, std::int64_t t_ns) const {
  const auto [forward, lateral, turn] = numbers_at(parts, t_ns);
  return {forward, lateral, is_steered() ? forward * std::tan(turn) / spec_.axle_distance_m : turn};
}

bool Drive::wheels_stay_within(const Parts& parts) const {
  // The speeds of the wheels are linear between vertices, so their limits hold there if they hold at the vertices.
  return std::ranges::all_of(parts, [&](const Profile& part) {
    std::int64_t t = present_ns_;
    for (; t < part.end_ns(); t = part.next_vertex(t)) {
      if (!wheels_are_within(spec_, driven_at(parts, t))) return false;
    }
    return wheels_are_within(spec_, driven_at(parts, t));
  });
}

void Drive::go_to(const Numbers& targets) {
  const Numbers values = numbers_at(driven_, present_ns_);
  const auto limits = rates();
  for (std::size_t i = 0; i < 3; ++i) driven_[i] = Profile(present_ns_, values[i], targets[i], limits[i]);
  if (!wheels_stay_within(driven_)) driven_ = in_step<Parts>(present_ns_, values, targets, limits);
}

void Drive::act(const LimitedCommand& limited) {
  Numbers targets = numbers_of(limited.command);
  if (is_steered()) targets[2] = limited.steering_rad.value_or(driven_[2].at(present_ns_));
  const auto same = [&](std::size_t i) { return driven_[i].target() == targets[i]; };
  if (same(0) && same(1) && same(2)) return;  // on its way
  cut_plan();
  begin_turn(limited.command.angular_rad_s);
  go_to(targets);
}

void Drive::begin_turn(double angular_rad_s) {
  const int sign = angular_rad_s > 0.0 ? 1 : angular_rad_s < 0.0 ? -1 : 0;
  if (sign != 0 && sign != turn_sign_) actuation_.begin_turn();
  turn_sign_ = sign;
}

void Drive::act_on_pending() {
  const auto later = std::ranges::upper_bound(pending_, present_ns_, {}, &Pending::acts_from_ns);
  if (later == pending_.begin()) return;
  act(std::prev(later)->limited);
  pending_.erase(pending_.begin(), later);
}

Effect Drive::effect_at(std::int64_t t_ns) const {
  return between(plan_.from, plan_.to, t_ns - plan_.begin_ns, plan_.end_ns - plan_.begin_ns);
}

PlanarTwist Drive::body_at(std::int64_t t_ns) const {
  const PlanarTwist body = effect_at(t_ns).body;
  return {body.forward_m_s + push_[0].at(t_ns), body.lateral_m_s + push_[1].at(t_ns),
          body.angular_rad_s + push_[2].at(t_ns)};
}

PlanarTwist Drive::twist() const {
  return body_at(present_ns_);
}

double Drive::steering_rad() const {
  return is_steered() ? driven_[2].at(present_ns_) : 0.0;
}

void Drive::cut_plan() {
  const Effect now = effect_at(present_ns_);
  plan_ = {present_ns_, present_ns_, now, now};
}

void Drive::plan() {
  const bool steers = is_steered() && driven_[2].end_ns() > present_ns_;
  std::int64_t end = present_ns_ + kLongestPieceNs;
  if (steers || !actuation_.is_constant()) end = (present_ns_ / kKnotNs + 1) * kKnotNs;
  for (const Profile& part : driven_) end = std::min(end, part.next_vertex(present_ns_));
  for (const Profile& part : push_) end = std::min(end, part.next_vertex(present_ns_));
  const Effect now = effect_at(present_ns_);
  plan_ = {present_ns_, end, now, actuation_.at(end, driven_at(end))};
}

Motion Drive::piece(std::int64_t end_ns) const {
  const std::int64_t duration = end_ns - present_ns_;
  return {{body_at(present_ns_), body_at(end_ns), duration},
          {effect_at(present_ns_).wheels, effect_at(end_ns).wheels, duration}};
}

std::vector<Motion> Drive::advance(std::int64_t to_ns) {
  if (to_ns < present_ns_) throw Error(ErrorCode::kInternal, "a drive was sent back in time");
  std::vector<Motion> motions;
  while (present_ns_ < to_ns) {
    act_on_pending();
    if (plan_.end_ns == present_ns_) plan();
    std::int64_t end = std::min(to_ns, plan_.end_ns);
    if (!pending_.empty()) end = std::min(end, pending_.front().acts_from_ns);
    motions.push_back(piece(end));
    const PerWheel way = travel(motions.back().wheels);
    for (std::size_t i = 0; i < way.size(); ++i) travel_m_[i] += way[i];
    present_ns_ = end;
  }
  return motions;
}

void Drive::set_twist(const PlanarTwist& twist) {
  cut_plan();
  const Numbers wanted = numbers_of(twist);
  const Numbers wheels = numbers_of(plan_.to.body);
  const Rates linear{spec_.max_acceleration_m_s2, spec_.max_acceleration_m_s2};
  const Rates angular{spec_.max_angular_acceleration_rad_s2, spec_.max_angular_acceleration_rad_s2};
  for (std::size_t i = 0; i < 3; ++i) {
    push_[i] = Profile(present_ns_, wanted[i] - wheels[i], 0.0, i == 2 ? angular : linear);
  }
}

void Drive::stop() {
  Numbers targets = {driven_[0].target(), driven_[1].target(), driven_[2].target()};
  const double turn =
      is_steered() ? driven_[2].at(present_ns_) : 0.0;  // the steering is no motion of wheels over the floor
  driven_ = {Profile(), Profile(), Profile(present_ns_, turn, turn, {})};
  push_ = {};
  plan_ = {present_ns_, present_ns_, {}, {}};
  go_to(targets);
}

}  // namespace hallway::drive

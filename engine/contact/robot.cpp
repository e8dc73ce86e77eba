// SPDX-License-Identifier: MIT
#include "contact/robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace hallway::contact {
namespace {

constexpr std::int64_t kSlice_ns = 100'000'000;
/// Two contacts whose normals differ by less than 30 degrees are one.
constexpr double kSameContact = 0.866;

RobotSpec checked(RobotSpec spec) {
  if (!(spec.shape.bottom() >= kLeastGroundClearance))
    throw Error(ErrorCode::kBadInput, "a body must be at least 2 mm above the plane of its wheels");
  if (!(spec.move.gyration >= 1e-3 && spec.move.gyration <= 1e3))
    throw Error(ErrorCode::kBadInput, "a body's radius of gyration must be between 1 mm and 1000 m");
  spec.ground.may_hang = spec.falls;
  return spec;
}

void require_place(const Vec3& place, double yaw_rad) {
  if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kGreatestCoordinate || !std::isfinite(yaw_rad))
    throw Error(ErrorCode::kBadInput, "a robot's start must be within 1000 km of the origin");
}

TouchKind kind_of(const Press& press) {
  if (!press.fault) return TouchKind::kWall;
  switch (*press.fault) {
    case GroundFault::kStep:
      return TouchKind::kStep;
    case GroundFault::kSlope:
      return TouchKind::kSlope;
    case GroundFault::kLedge:
      break;
  }
  return TouchKind::kLedge;
}

PlanarTwist clamped(const PlanarTwist& twist) {
  return {std::clamp(twist.forward_m_s, -kGreatestSpeed, kGreatestSpeed),
          std::clamp(twist.lateral_m_s, -kGreatestSpeed, kGreatestSpeed),
          std::clamp(twist.angular_rad_s, -kGreatestTurn, kGreatestTurn)};
}

}  // namespace

Robot::Robot(const Obstacles& obstacles, RobotSpec spec)
    : obstacles_(obstacles),
      spec_(checked(std::move(spec))),
      ground_(obstacles, spec_.wheels, spec_.ground),
      mover_(spec_.shape, obstacles_, ground_, spec_.move) {}

/// @param found  the stance; unchanged where there is none
Start Robot::find_stance(const Vec3& place, double yaw_rad, const std::function<bool(const Vec3&)>& is_solid,
                         Pose& found) {
  const Quat level(std::cos(0.5 * yaw_rad), 0.0, 0.0, std::sin(0.5 * yaw_rad));
  const auto stance = stance_below(ground_, {level, place + Vec3(0, 0, 1e-3)}, kDeepestFall);
  if (!stance) return Start::kNoFloor;
  if (stance->fault) return Start::kNoStance;
  found = stance->pose;
  if (!mover_.check().within(found, kLeastStartGap).empty()) return Start::kInObstacle;
  const Vec3 middle =
      found * Vec3(0.5 * (spec_.shape.support(Vec3::UnitZ()) + spec_.shape.support(-Vec3::UnitZ())));
  if (is_solid && is_solid(middle)) return Start::kInSolid;
  return Start::kStands;
}

Start Robot::put(const Vec3& place, double yaw_rad, std::int64_t at_ns,
                 const std::function<bool(const Vec3&)>& is_solid) {
  require_place(place, yaw_rad);
  pose_ = {Quat(std::cos(0.5 * yaw_rad), 0.0, 0.0, std::sin(0.5 * yaw_rad)), place};
  pushes_.clear();
  known_.clear();
  counts_ = {};
  twist_ = {};
  parts_ = 0;
  standing_.reset();
  const Start start = find_stance(place, yaw_rad, is_solid, pose_);
  is_lost_ = start != Start::kStands;
  history_.begin(pose_, at_ns);
  return start;
}

Start Robot::carry(const Vec3& place, double yaw_rad, const std::function<bool(const Vec3&)>& is_solid) {
  require_place(place, yaw_rad);
  Pose found;
  const Start start = find_stance(place, yaw_rad, is_solid, found);
  if (start != Start::kStands) return start;
  history_.add(make_drop(now_ns(), pose_, found));
  pose_ = found;
  pushes_.clear();
  known_.clear();
  twist_ = {};
  standing_.reset();
  is_lost_ = false;
  return start;
}

bool Robot::is_pushed() const {
  return std::ranges::any_of(pushes_, [&](const Push& push) { return push.end_ns > now_ns(); });
}

void Robot::push(const PlanarTwist& twist, std::int64_t duration_ns) {
  check_ramp({twist, twist, duration_ns});
  pushes_.push_back({twist, now_ns() + duration_ns});
}

TwistRamp Robot::with_pushes(TwistRamp ramp) {
  std::erase_if(pushes_, [&](const Push& push) { return push.end_ns <= now_ns(); });
  if (pushes_.empty()) return ramp;
  std::int64_t duration_ns = ramp.duration_ns;
  for (const Push& push : pushes_) duration_ns = std::min(duration_ns, push.end_ns - now_ns());
  ramp.to = ramp.at(static_cast<double>(duration_ns) / static_cast<double>(ramp.duration_ns));
  ramp.duration_ns = duration_ns;
  for (const Push& push : pushes_) {
    ramp.from = ramp.from + push.twist;
    ramp.to = ramp.to + push.twist;
  }
  return {clamped(ramp.from), clamped(ramp.to), duration_ns};
}

Advance Robot::advance(std::span<const TwistRamp> ramps) {
  for (const TwistRamp& ramp : ramps) check_ramp(ramp);
  Advance result;
  for (const TwistRamp& ramp : ramps) drive(ramp, result);
  return result;
}

void Robot::rest(std::int64_t duration_ns) {
  history_.add(make_part(now_ns(), pose_, TwistRamp{{}, {}, duration_ns}, pose_));
  twist_ = {};
}

void Robot::drive(const TwistRamp& ramp, Advance& advance) {
  const std::int64_t begin_ns = now_ns(), end_ns = begin_ns + ramp.duration_ns;
  while (now_ns() < end_ns) {
    if (is_lost_) {
      rest(end_ns - now_ns());
      return;
    }
    const std::int64_t slice = now_ns() / kSlice_ns;
    if (slice != std::exchange(slice_, slice)) parts_ = 0;
    const double share = static_cast<double>(now_ns() - begin_ns) / static_cast<double>(ramp.duration_ns);
    const TwistRamp wanted = with_pushes({ramp.at(share), ramp.to, end_ns - now_ns()});
    if (++parts_ > kMostParts) {
      const std::int64_t left =
          std::clamp((slice + 1) * kSlice_ns - now_ns(), std::int64_t{1}, wanted.duration_ns);
      rest(left);
      counts_.stood_ns += left;
      if (advance.touching.empty()) {
        for (const Known& one : known_) advance.touching.push_back(one.touch);
      }
      continue;
    }
    const bool is_steady = wanted.from == wanted.to;
    if (!is_steady || wanted.from != standing_twist_) standing_.reset();
    // What stands, stands until something else is wanted.
    Move move = standing_ ? *standing_ : mover_.next(pose_, now_ns(), wanted);
    if (standing_) move.part = make_part(now_ns(), pose_, TwistRamp{{}, {}, wanted.duration_ns}, pose_);
    if (is_steady && move.stands) {
      standing_ = move;
      standing_twist_ = wanted.from;
    }
    note(move, advance);
    if (spec_.falls && fall(move, advance)) continue;
    history_.add(move.part);
    ++counts_.parts;
    counts_.distance_m += (move.part.to.t - move.part.from.t).norm();
    if (move.stands) counts_.stood_ns += move.part.ramp.duration_ns;
    pose_ = move.part.to;
    twist_ = move.part.ramp.to;
  }
}

void Robot::note(const Move& move, Advance& advance) {
  advance.touching.clear();
  for (const Press& press : move.pressed) {
    const ContactPoint& contact = press.contact;
    Touch touch{now_ns(),    kind_of(press),  contact.on_body,  contact.normal,
                contact.gap, press.speed_m_s, contact.obstacle, press.wheel};
    const auto same = [&](const Touch& other) {
      return other.kind == touch.kind && other.normal.dot(touch.normal) > kSameContact;
    };
    if (std::any_of(advance.touching.begin(), advance.touching.end(), same)) continue;
    const auto known =
        std::find_if(known_.begin(), known_.end(), [&](const Known& one) { return same(one.touch); });
    if (known == known_.end()) {
      advance.begun.push_back(touch);
      ++counts_.contacts;
      known_.push_back({touch, move.part.end_ns()});
    } else {
      touch.t_ns = known->touch.t_ns;
      *known = {touch, move.part.end_ns()};
    }
    advance.touching.push_back(touch);
  }
  std::erase_if(known_, [&](const Known& one) { return one.last_ns + kSameContact_ns < move.part.end_ns(); });
}

bool Robot::fall(const Move& move, Advance& advance) {
  if (!move.stands || move.pressed.empty() || move.pressed.back().fault != GroundFault::kLedge) return false;
  const Fall found =
      fall_over(spec_.shape, ground_, mover_.check(), pose_, -move.pressed.back().contact.normal);
  is_lost_ = found.is_lost;
  if (found.poses.empty()) return is_lost_;
  for (const Pose& pose : found.poses) {
    history_.add(make_drop(now_ns(), pose_, pose));
    pose_ = pose;
  }
  twist_ = {};
  advance.touching.clear();
  standing_.reset();
  ++counts_.falls;
  advance.falls.push_back({now_ns(), found.height_m});
  return true;
}

}  // namespace hallway::contact

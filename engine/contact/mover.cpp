// SPDX-License-Identifier: MIT
#include "contact/mover.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::contact {
namespace {

/// Trials of one duration.
constexpr int kMostTrials = 24;
/// A body that is nearer than kClearance goes away from it with at most this share of its speed.
constexpr double kRecovery = 0.1;

/// A trial goes against a contact if it comes this much too near, metres; less than what SweepCheck lets a gap shrink.
constexpr double kLeastIntrusion = 1e-10;
/// A corner this far in front of a plane is on it, metres.
constexpr double kBehind = 1e-6;
/// Cosine of the angle up to which two normals are one.
constexpr double kSameNormal = 1.0 - 1e-6;
/// What is left of a motion is none if it is a smaller share of it.
constexpr double kStandingShare = 1e-6;

double seconds_in(const TwistRamp& ramp) {
  return 1e-9 * static_cast<double>(ramp.duration_ns);
}

/// How far points within `radius` of the origin come at most.
double reach_of(const TwistRamp& ramp, double radius) {
  return seconds_in(ramp) *
         (std::max(ramp.from.speed(), ramp.to.speed()) +
          radius * std::max(std::abs(ramp.from.angular_rad_s), std::abs(ramp.to.angular_rad_s)));
}

TwistRamp beginning_of(const TwistRamp& ramp, std::int64_t duration_ns) {
  if (duration_ns >= ramp.duration_ns) return ramp;
  return {ramp.from, ramp.at(static_cast<double>(duration_ns) / static_cast<double>(ramp.duration_ns)),
          duration_ns};
}

/// Whether a triangle is behind the plane that separates the body from another one, so that the other one is met first.
bool lies_behind(const Triangle& triangle, const Separation& front) {
  return std::all_of(triangle.begin(), triangle.end(), [&](const Vec3& corner) {
    return front.normal.dot(corner - front.on_triangle) <= kBehind;
  });
}

/// Adds a contact, or its drift to the same contact if it is greater; false if nothing is new.
bool add_contact(std::vector<ContactPoint>& contacts, const ContactPoint& contact) {
  const auto same = std::find_if(contacts.begin(), contacts.end(), [&](const ContactPoint& one) {
    return one.obstacle == contact.obstacle && (one.on_body - contact.on_body).norm() < 1e-9;
  });
  if (same == contacts.end()) {
    contacts.push_back(contact);
    return true;
  }
  const bool is_new = contact.drift_m_s < same->drift_m_s - 1e-6;
  same->drift_m_s = std::min(same->drift_m_s, contact.drift_m_s);
  return is_new;
}

/// How fast a ramp goes against a limit, at the end where it does so faster.
double approach(const TwistLimit& limit, const TwistRamp& ramp) {
  return -std::min(limit.speed(ramp.from), limit.speed(ramp.to));
}

Move standing(const Pose& pose, std::int64_t begin_ns, std::int64_t duration_ns, bool wanted_more) {
  Move move;
  move.part = make_part(begin_ns, pose, TwistRamp{{}, {}, duration_ns}, pose);
  move.stands = wanted_more;
  return move;
}

}  // namespace

/// What became of a trial: a part that is free, or why there is none.
struct Mover::Trial {
  std::optional<Part> part{};
  Stance stance{};
  std::optional<std::uint32_t> blocker{};
};

std::int64_t Mover::longest(const TwistRamp& wanted) const {
  const double speed = std::max(wanted.from.speed(), wanted.to.speed());
  const double turn = std::max(std::abs(wanted.from.angular_rad_s), std::abs(wanted.to.angular_rad_s));
  const double seconds =
      std::min(kLongestPart / std::max(speed, 1e-9), kGreatestPartTurn / std::max(turn, 1e-9));
  return std::clamp(static_cast<std::int64_t>(seconds * 1e9), std::int64_t{1}, wanted.duration_ns);
}

std::vector<TwistLimit> Mover::limits_of(const std::vector<ContactPoint>& contacts, const Pose& pose,
                                         double seconds, double ease) const {
  std::vector<TwistLimit> limits;
  for (const ContactPoint& contact : contacts) {
    const double spare = contact.gap - kClearance;
    const double least = std::min(-spare / seconds, ease) - (ease > 0.0 ? contact.drift_m_s : 0.0);
    limits.push_back(limit_at(pose, contact.on_body, contact.normal, least));
  }
  return limits;
}

std::optional<TwistRamp> Mover::limited(const TwistRamp& ramp, const std::vector<ContactPoint>& contacts,
                                        const Pose& pose) const {
  if (contacts.empty()) return ramp;
  const double seconds = seconds_in(ramp);
  // With what leads it away from obstacles that are too near; without where it is squeezed between them.
  for (const double ease : {kRecovery * reach_of(ramp, options_.gyration) / seconds, 0.0}) {
    const std::vector<TwistLimit> limits = limits_of(contacts, pose, seconds, ease);
    const auto nearest = [&](const PlanarTwist& twist) {
      return options_.slide ? nearest_twist(twist, limits, options_.gyration)
                            : shortened_twist(twist, limits);
    };
    const auto from = nearest(ramp.from), to = nearest(ramp.to);
    if (from && to) return TwistRamp{*from, *to, ramp.duration_ns};
  }
  return std::nullopt;
}

Mover::Trial Mover::attempt(const Pose& pose, std::int64_t begin_ns, const TwistRamp& ramp, double least) {
  Trial trial;
  trial.stance = ground_.stand(pose * displacement(ramp).level());
  if (trial.stance.fault) return trial;
  const Part part = make_part(begin_ns, pose, ramp, trial.stance.pose);
  trial.blocker = check_.blocker(part, least);
  if (!trial.blocker) trial.part = part;
  return trial;
}

std::vector<ContactPoint> Mover::contacts_with(const Pose& pose, std::uint32_t blocker) {
  std::vector<ContactPoint> found = contact_points(shape_, pose, obstacles_, blocker, kContactRange);
  const double gap = check_.at(pose, blocker).gap;
  bool is_behind = false;
  for (const std::uint32_t other : check_.within(pose, kContactRange)) {
    const Separation& front = check_.at(pose, other);
    if (other == blocker || front.gap > gap || !lies_behind(obstacles_.triangle(blocker), front)) continue;
    if (!std::exchange(is_behind, true)) found.clear();
    for (const std::uint32_t one : {other, blocker}) {
      for (const ContactPoint& contact : contact_points(shape_, pose, obstacles_, one, kContactRange)) {
        if (contact.normal.dot(front.normal) > kSameNormal) found.push_back(contact);
      }
    }
  }
  return found;
}

std::optional<ContactPoint> Mover::next_contact(const Pose& pose, const Pose& end, const TwistRamp& ramp,
                                                std::uint32_t blocker) {
  const double seconds = seconds_in(ramp), fastest = reach_of(ramp, shape_.radius()) / seconds;
  std::optional<ContactPoint> soonest;
  double least = INFINITY;
  for (ContactPoint& contact : contacts_with(pose, blocker)) {
    const TwistLimit limit = limit_at(pose, contact.on_body, contact.normal, 0.0);
    if (Vec3(limit.x, limit.y, 0.0).norm() < 1e-6) continue;  // above or below: no twist leads away
    // First what the twist does by itself; then, of a trial that is within the limits, what else brought it nearer.
    double speed = approach(limit, ramp);
    const double spare = contact.gap - kClearance;
    if (speed * seconds <= spare + kLeastIntrusion) {
      // Of a round body another point may be the nearest then.
      const Vec3 local = shape_.vertices().empty() ? shape_.support(end.q.conjugate() * -contact.normal)
                                                   : pose.inverse() * contact.on_body;
      const Vec3 moved = end * local - contact.on_body;
      const double drift = contact.normal.dot(moved) / seconds - limit.speed(ramp.at(0.5));
      contact.drift_m_s = std::clamp(drift, -fastest, 0.0);
      speed -= contact.drift_m_s;
    }
    if (speed * seconds <= spare + kLeastIntrusion || speed <= 0.0) continue;
    const double time = std::max(0.0, spare) / speed;
    if (time < least) {
      least = time;
      soonest = contact;
    }
  }
  return soonest;
}

std::vector<Press> Mover::pressed_by(const std::vector<ContactPoint>& contacts, const Pose& pose,
                                     const TwistRamp& wanted) const {
  std::vector<Press> pressed;
  for (const ContactPoint& contact : contacts) {
    // What nears it besides the twist counts too: a floor that tilts the body may press it against what no twist leads to.
    const double speed =
        approach(limit_at(pose, contact.on_body, contact.normal, 0.0), wanted) - contact.drift_m_s;
    if (speed > 0.0) pressed.push_back({contact, std::nullopt, 0, speed});
  }
  return pressed;
}

/// A wheel that the floor stops, where it is, with the normal against its way.
Press Mover::press_of_wheel(const Pose& pose, const TwistRamp& ramp, std::size_t wheel,
                            GroundFault fault) const {
  const Vec2& at = ground_.wheels().at[wheel];
  const Vec3 way = pose.q * Vec3(ramp.to.forward_m_s - ramp.to.angular_rad_s * at.y(),
                                 ramp.to.lateral_m_s + ramp.to.angular_rad_s * at.x(), 0.0);
  const double speed = way.norm();
  const Vec3 against = speed > 0.0 ? Vec3(-way / speed) : Vec3::UnitZ();
  const Vec3 where = pose * Vec3(at.x(), at.y(), 0.0);
  return {{where, where, against, 0.0, 0}, fault, wheel, speed};
}

/// The wheel whose height changes most by more than the twist itself does.
std::size_t Mover::stepping_wheel(const Pose& pose, const TwistRamp& way, const Pose& end) const {
  const Pose moved = pose * displacement(way).level();
  std::size_t found = 0;
  double greatest = -1.0;
  for (std::size_t i = 0; i < ground_.wheels().at.size(); ++i) {
    const Vec2& at = ground_.wheels().at[i];
    const Vec3 wheel(at.x(), at.y(), 0.0);
    const double change = std::abs((end * wheel - moved * wheel).z());
    if (change > greatest) {
      greatest = change;
      found = i;
    }
  }
  return found;
}

Move Mover::next(const Pose& pose, std::int64_t begin_ns, const TwistRamp& wanted) {
  if (wanted.from.is_zero() && wanted.to.is_zero())
    return standing(pose, begin_ns, wanted.duration_ns, false);
  std::vector<ContactPoint> contacts;
  int trials = 0;  // of this duration
  std::int64_t duration_ns = longest(wanted);
  const std::int64_t standing_ns = std::min(kStandingPart_ns, wanted.duration_ns);
  while (true) {
    const TwistRamp ramp = beginning_of(wanted, duration_ns);
    const TwistRamp way = limited(ramp, contacts, pose).value_or(TwistRamp{{}, {}, ramp.duration_ns});
    if (reach_of(way, options_.gyration) <= kStandingShare * reach_of(ramp, options_.gyration)) {
      Move move = standing(pose, begin_ns, standing_ns, true);
      move.pressed = pressed_by(contacts, pose, ramp);
      return move;
    }
    const Trial trial = attempt(pose, begin_ns, way, contacts.empty() ? kClearance : 0.5 * kClearance);
    if (trial.part) {
      Move move{*trial.part, false, pressed_by(contacts, pose, ramp)};
      return move;
    }
    if (trial.blocker && ++trials < kMostTrials) {
      const auto contact = next_contact(pose, trial.stance.pose, way, *trial.blocker);
      if (contact && add_contact(contacts, *contact)) continue;
    }
    if (duration_ns > 1 && reach_of(ramp, shape_.radius()) > kShortestPart) {
      duration_ns /= 2;
      trials = 0;
      contacts.clear();  // their drifts were those of the longer trial
      continue;
    }
    Move move = standing(pose, begin_ns, standing_ns, true);
    move.pressed = pressed_by(contacts, pose, ramp);
    if (trial.blocker && check_.at(pose, *trial.blocker).gap <= kContactRange) {
      const Separation& nearest = check_.at(pose, *trial.blocker);
      move.pressed.push_back(
          {{nearest.on_body, nearest.on_triangle, nearest.normal, nearest.gap, *trial.blocker},
           std::nullopt,
           0,
           reach_of(ramp, 0.0) / seconds_in(ramp)});
    } else if (trial.blocker) {
      // So short a part meets nothing that is farther away: a wheel comes to a step that tilts the body into it.
      move.pressed.push_back(
          press_of_wheel(pose, ramp, stepping_wheel(pose, way, trial.stance.pose), GroundFault::kStep));
    } else {
      move.pressed.push_back(press_of_wheel(pose, ramp, trial.stance.wheel, *trial.stance.fault));
      ContactPoint& contact = move.pressed.back().contact;
      contact.on_body = contact.on_obstacle = trial.stance.where;
    }
    return move;
  }
}

}  // namespace hallway::contact

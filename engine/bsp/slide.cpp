// SPDX-License-Identifier: MIT
#include "bsp/slide.hpp"

#include <algorithm>
#include <cstddef>

#include "base/error.hpp"

namespace hallway::bsp {
namespace {

/// Motions that go into a face by less than this share of their length run along it.
constexpr double kAlong = 1e-9;

bool leads_into_any(const Vec3& motion, const std::vector<BodyContact>& contacts) {
  const double limit = -kAlong * motion.norm();
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const BodyContact& contact) { return contact.normal.dot(motion) < limit; });
}

/// The most that is left of a motion if it may not lead into any face: along one of them, else along two.
Vec3 along_faces(const Vec3& motion, const std::vector<BodyContact>& contacts) {
  Vec3 best = Vec3::Zero();
  const auto offer = [&](const Vec3& candidate) {
    if (candidate.squaredNorm() > best.squaredNorm() && !leads_into_any(candidate, contacts))
      best = candidate;
  };
  for (const BodyContact& contact : contacts)
    offer(motion - contact.normal * std::min(0.0, contact.normal.dot(motion)));
  if (!best.isZero(0.0)) return best;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      const Vec3 crease = contacts[i].normal.cross(contacts[j].normal);
      const double length2 = crease.squaredNorm();
      if (length2 > kAlong) offer(crease * (crease.dot(motion) / length2));
    }
  }
  return best;
}

class Slider {
 public:
  Slider(const Tree& tree, const csg::Surface& surface, const Body& body, const SlideOptions& options)
      : tree_(tree), surface_(surface), body_(body), options_(options) {}

  SlideResult slide(const Vec3& from, const Vec3& motion) const {
    SlideResult result;
    result.position = from;
    Vec3 left = motion;
    for (int i = 0; i < options_.most_contacts; ++i) {
      const SweepResult sweep = go(result.position, left);
      result.position = sweep.position;
      result.starts_in_solid = i == 0 && sweep.starts_in_solid;
      if (!sweep.contact) break;
      result.contacts.push_back(*sweep.contact);
      left = along_faces((1.0 - sweep.fraction) * left, result.contacts);
      if (left.dot(motion) <= 0.0) break;
    }
    return result;
  }

  /// Over what is in the way; `level` is what came of going straight.
  SlideResult climb(const Vec3& from, const Vec3& motion, SlideResult level) const {
    const SweepResult up = go(from, {0.0, 0.0, options_.step_m});
    const double height = up.position.z() - from.z();
    SlideResult over = slide(up.position, {motion.x(), motion.y(), 0.0});
    const SweepResult down = go(over.position, {0.0, 0.0, -height});
    if (down.contact && down.contact->normal.z() < options_.floor_z) return level;
    if (!(progress(from, down.position) > progress(from, level.position) + kClearance)) return level;
    over.position = down.position;
    if (down.contact) over.contacts.push_back(*down.contact);
    return over;
  }

  bool is_steep(const BodyContact& contact) const {
    return contact.normal.z() < options_.floor_z && contact.normal.z() > -options_.floor_z;
  }

 private:
  SweepResult go(const Vec3& from, const Vec3& motion) const {
    return sweep_body(tree_, surface_, from, from + motion, body_);
  }

  static double progress(const Vec3& from, const Vec3& to) { return (to - from).head<2>().norm(); }

  const Tree& tree_;
  const csg::Surface& surface_;
  const Body& body_;
  const SlideOptions& options_;
};

}  // namespace

SlideResult slide(const Tree& tree, const csg::Surface& surface, const Vec3& from, const Vec3& to,
                  const Body& body, const SlideOptions& options) {
  if (!(options.step_m >= 0.0))
    throw Error(ErrorCode::kBadInput, "a step's height must be a number of at least 0");
  const Slider slider(tree, surface, body, options);
  SlideResult result = slider.slide(from, to - from);
  const bool obstructed = std::any_of(result.contacts.begin(), result.contacts.end(),
                                      [&](const BodyContact& contact) { return slider.is_steep(contact); });
  if (options.step_m == 0.0 || !obstructed) return result;
  return slider.climb(from, to - from, std::move(result));
}

}  // namespace hallway::bsp

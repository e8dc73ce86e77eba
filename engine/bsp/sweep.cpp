// SPDX-License-Identifier: MIT
#include "bsp/sweep.hpp"

#include <algorithm>
#include <limits>

#include "bsp/contact.hpp"
#include "bsp/number_set.hpp"
#include "bsp/point_location.hpp"
#include "bsp/query_limits.hpp"
#include "bsp/swept_leaves.hpp"

namespace hallway::bsp {
namespace {

/// Contact is where this much of the clearance is used up: a body that rests kClearance above a floor is then not stopped by
/// the edges in the floor, whatever rounding does.
constexpr double kContact = 0.5 * kClearance;

/// The face that is nearest to a resting body.
struct Nearest {
  Gap gap{std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
  std::uint32_t polygon = 0;
};

class Sweep {
 public:
  Sweep(const Tree& tree, const csg::Surface& surface, const Body& body)
      : tree_(tree),
        surface_(surface),
        body_(shape_of(body, 0.0)),
        contact_(shape_of(body, kContact)),
        search_(shape_of(body, 2.0 * kClearance)) {}

  SweepResult run(const Vec3& from, const Vec3& motion) {
    SweepResult result;
    result.position = from;
    const Gap start = nearest(from).gap;
    result.starts_in_contact = start.distance <= kClearance + kRounding;
    result.starts_in_solid = start.distance < -kClearance || is_solid(from + body_.middle());
    if (result.starts_in_solid) {
      result.fraction = 0.0;
      return result;
    }
    if (start.distance < kContact) result.position = settle(from);
    advance(motion, result);
    return result;
  }

 private:
  static constexpr double kRounding = 1e-8;
  static constexpr int kSettleSteps = 16;

  bool is_solid(const Vec3& point) const {
    return tree_.leaves[leaf_at(tree_, point)].content == Content::kSolid;
  }

  /// Calls see(face, polygon) once for every polygon near the way of the body.
  template <typename See>
  void visit_faces(const Vec3& from, const Vec3& motion, const double& limit, See&& see) {
    NumberSet seen;
    visit_swept_leaves(tree_, search_, from, motion, limit, [&](std::uint32_t index) {
      const Leaf& leaf = tree_.leaves[index];
      for (std::uint32_t i = 0; i < leaf.face_count; ++i) {
        const std::uint32_t polygon = tree_.leaf_faces[leaf.first_face + i];
        const csg::SurfacePolygon& face = surface_.polygons[polygon];
        const bool is_against = face.plane.normal.dot(motion) < 0.0 || motion.isZero(0.0);
        if (!is_against || !seen.insert(polygon)) continue;
        if (load(surface_, face, from, face_)) see(polygon);
      }
    });
  }

  Nearest nearest(const Vec3& position) {
    Nearest best;
    const double limit = 1.0;
    visit_faces(position, Vec3::Zero(), limit, [&](std::uint32_t polygon) {
      const Gap at = gap(body_, face_);
      if (at.distance > best.gap.distance) return;
      if (at.distance < best.gap.distance || polygon < best.polygon) best = {at, polygon};
    });
    return best;
  }

  /// The place beside `from` that has the clearance on all sides; `from` itself if there is none.
  Vec3 settle(const Vec3& from) {
    Vec3 place = from;
    for (int i = 0; i < kSettleSteps; ++i) {
      const Gap at = nearest(place).gap;
      if (at.distance >= kClearance - kRounding) return place;
      place += (kClearance - at.distance) * at.normal;
    }
    return nearest(place).gap.distance >= kContact ? place : from;
  }

  void advance(const Vec3& motion, SweepResult& result) {
    if (motion.isZero(0.0)) return;
    Touch first{1.0, Vec3::Zero()};
    visit_faces(result.position, motion, first.fraction, [&](std::uint32_t polygon) {
      const auto touch = first_touch(contact_, face_, motion, first.fraction);
      if (!touch) return;
      const bool tie = result.contact && touch->fraction == first.fraction;
      if (tie && polygon > result.contact->polygon) return;
      first = *touch;
      result.contact = BodyContact{touch->normal, polygon};
    });
    result.fraction = first.fraction;
    if (result.contact) {
      const double back = (kClearance - kContact) / -first.normal.dot(motion);
      result.fraction = std::max(0.0, first.fraction - back);
    }
    result.position += result.fraction * motion;
  }

  const Tree& tree_;
  const csg::Surface& surface_;
  BodyShape body_;
  BodyShape contact_;  ///< with kContact around it
  BodyShape search_;   ///< with a margin for all that matters
  NearFace face_;      ///< the one that is looked at
};

}  // namespace

SweepResult sweep_body(const Tree& tree, const csg::Surface& surface, const Vec3& from, const Vec3& to,
                       const Body& body) {
  check_query_point(from);
  check_query_point(to);
  check_body(body);
  return Sweep(tree, surface, body).run(from, to - from);
}

}  // namespace hallway::bsp

// SPDX-License-Identifier: MIT
#include "bsp/segment.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "bsp/pending_stack.hpp"
#include "bsp/query_limits.hpp"

namespace hallway::bsp {
namespace {

constexpr std::uint32_t kNoPlane = Child::kMost;

/// A part of the segment that lies in a subtree.
struct Part {
  Child at;
  std::uint32_t plane;  ///< the node whose plane it crosses at `begin`; kNoPlane at the segment's start
  double begin;         ///< fractions of the segment
  double end;
};

/// Where the segment is in solid.
struct Found {
  double fraction = 0.0;
  std::uint32_t plane = kNoPlane;
  std::uint32_t leaf = 0;
};

enum class Outcome { kFree, kBlocked, kUndecided };

/// Walks a segment through a tree, nearest leaves first. A node cuts a part of the segment into two that follow each other, so the
/// parts in the leaves always make up the whole segment: each begins where the one before it ends.
///
/// It is undecided where the segment runs in a node's plane. What costs time is going wrong at a branch and waiting for nodes, so
/// that which of its children a part goes to is chosen without a branch, by where on its line the plane is met.
class QuickWalk {
 public:
  QuickWalk(const Tree& tree, const Vec3& from, const Vec3& to) : tree_(tree), from_(from), to_(to) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const double way = to[axis] - from[axis] + 0.0;  // no -0.0: along a plane counts as going forward
      per_way_[axis] = 1.0 / way;
      first_[axis] = way < 0.0 ? 0 : 1;
    }
  }

  Outcome run(Found& found) {
    std::uint32_t plane = kNoPlane;
    double begin = 0.0;
    double end = 1.0;
    Child at = tree_.root;
    bool decided = true;
    std::size_t waiting = 0;
    for (;;) {
      while (!at.is_leaf()) {
        const Node& node = tree_.nodes[at.index()];
        Crossing crossing;
        if (at.axis() != Child::kOblique) {
          cross_axial(node.offset, at.axis(), crossing);
        } else {
          cross_oblique(at.index(), crossing);
        }
        decided &= !std::isnan(crossing.fraction);
        const Child near = node.child[crossing.first];
        const Child far = node.child[1 - crossing.first];
        // A segment that begins or ends on the plane crosses it at 0 or 1, which makes no part.
        const bool near_only = (crossing.fraction >= end) | crossing.ends_on_plane;
        const bool far_only = !near_only & (crossing.fraction <= begin);
        const bool both = !(near_only | far_only);
        rest_[waiting % kWaiting] = {far.bits(), at.index(), end};
        waiting += both ? 1 : 0;
        end = both ? crossing.fraction : end;
        at = far_only ? far : near;
      }
      if (!decided || waiting > kWaiting) return Outcome::kUndecided;
      if (at.is_solid()) {
        found = {begin, plane, at.index()};
        return Outcome::kBlocked;
      }
      if (waiting == 0) return Outcome::kFree;
      begin = end;
      const Later& next = rest_[--waiting];
      at = Child(next.at);
      plane = next.plane;
      end = next.end;
    }
  }

 private:
  struct Crossing {
    double
        fraction;  ///< where the segment's line meets the plane; infinite: nowhere; NaN: the segment lies in the plane
    std::uint32_t first;  ///< the side that the line comes from, or is on
    bool ends_on_plane;   ///< whatever rounding makes of `fraction`
  };

  void cross_axial(double offset, std::uint32_t axis, Crossing& out) const {
    out.fraction = (offset - from_[axis]) * per_way_[axis];
    out.first = first_[axis];
    out.ends_on_plane = to_[axis] == offset;
  }

  void cross_oblique(std::uint32_t index, Crossing& out) const {
    const Plane plane = tree_.plane(index);
    const double begin = plane.distance(from_);
    const double end = plane.distance(to_);
    const bool crosses = (begin < 0.0) != (end < 0.0);
    out.fraction = crosses ? begin / (begin - end) : std::numeric_limits<double>::infinity();
    if (begin == 0.0 && end == 0.0) out.fraction = std::numeric_limits<double>::quiet_NaN();
    out.first = begin < 0.0 ? 1 : 0;
    out.ends_on_plane = false;
  }

  /// A part that is walked later; it begins where the one before it ends.
  struct Later {
    std::uint32_t at;  ///< Child::bits()
    std::uint32_t plane;
    double end;
  };

  static constexpr std::size_t kWaiting = 64;
  const Tree& tree_;
  const Vec3& from_;
  const Vec3& to_;
  std::array<double, 3> per_way_;
  std::array<std::uint32_t, 3> first_;
  std::array<Later, kWaiting> rest_;  // not initialised on purpose: a query must not pay for 64 entries
};

/// The walk for every segment, also one that runs in planes of nodes.
class FullWalk {
 public:
  FullWalk(const Tree& tree, const Vec3& from, const Vec3& to) : tree_(tree), from_(from), to_(to) {}

  std::optional<Found> first() const { return first({tree_.root, kNoPlane, 0.0, 1.0}); }

  /// The node in whose plane the face lies on which the segment starts to go in: that behind which, as the segment goes, it is empty.
  /// kNoPlane if there is none, the start being in solid.
  std::uint32_t face_at_start() const {
    std::uint32_t face = kNoPlane;
    for (Child at = tree_.root; !at.is_leaf();) {
      const Node& node = tree_.nodes[at.index()];
      const double begin = tree_.distance(at, from_);
      const std::size_t side = (begin == 0.0 ? tree_.distance(at, to_) : begin) < 0.0 ? 1 : 0;
      if (begin == 0.0) {
        const auto other = first({node.child[1 - side], kNoPlane, 0.0, 1.0});
        if (!other || other->fraction > 0.0) face = at.index();
      }
      at = node.child[side];
    }
    return face;
  }

 private:
  std::optional<Found> first(Part part) const {
    PendingStack<Part> rest;
    for (;;) {
      if (part.at.is_leaf()) {
        if (part.at.is_solid()) return Found{part.begin, part.plane, part.at.index()};
      } else if (descend(part, rest)) {
        continue;
      } else if (const auto found = along_plane(part)) {
        return found;
      }
      if (rest.empty()) return std::nullopt;
      part = rest.pop();
    }
  }

  /// Goes on to the nearer child. False if the segment lies in the node's plane, which belongs to neither child.
  bool descend(Part& part, PendingStack<Part>& rest) const {
    const Node& node = tree_.nodes[part.at.index()];
    const double begin = tree_.distance(part.at, from_);
    const double end = tree_.distance(part.at, to_);
    const std::size_t near = begin < 0.0 ? 1 : 0;
    const std::size_t far = end < 0.0 ? 1 : 0;
    if (near == far) {
      if (begin == 0.0 && end == 0.0) return false;
      part.at = node.child[near];
      return true;
    }
    // An end on the plane crosses it at 0 or 1, which makes no part.
    const double cross = begin / (begin - end);
    if (cross >= part.end) {
      part.at = node.child[near];
    } else if (cross <= part.begin) {
      part.at = node.child[far];
    } else {
      rest.push({node.child[far], part.at.index(), cross, part.end});
      part.at = node.child[near];
      part.end = cross;
    }
    return true;
  }

  /// The first place of a part in the node's plane where both sides are solid.
  std::optional<Found> along_plane(const Part& part) const {
    const Node& node = tree_.nodes[part.at.index()];
    Found place{part.begin, part.plane, 0};
    int agreed = 0;  // children that are solid at the place
    for (std::size_t side = 0; agreed < 2; side = 1 - side) {
      const auto found = first({node.child[side], kNoPlane, place.fraction, part.end});
      if (!found) return std::nullopt;
      if (found->fraction > place.fraction) {
        place = *found;
        agreed = 1;
      } else {
        ++agreed;
        place.leaf = found->leaf;
        if (place.plane == kNoPlane) place.plane = found->plane;
      }
    }
    return place;
  }

  const Tree& tree_;
  const Vec3& from_;
  const Vec3& to_;
};

/// Where a segment whose ends are places enters solid.
std::optional<Found> find(const Tree& tree, const Vec3& from, const Vec3& to) {
  check_query_point(from);
  check_query_point(to);
  Found found;
  switch (QuickWalk(tree, from, to).run(found)) {
    case Outcome::kFree:
      return std::nullopt;
    case Outcome::kBlocked:
      return found;
    case Outcome::kUndecided:
      break;
  }
  return FullWalk(tree, from, to).first();
}

}  // namespace

std::optional<SegmentHit> first_solid(const Tree& tree, const Vec3& from, const Vec3& to) {
  const auto found = find(tree, from, to);
  if (!found) return std::nullopt;
  SegmentHit hit;
  hit.leaf = found->leaf;
  hit.fraction = found->fraction;
  hit.point = from + found->fraction * (to - from);
  const std::uint32_t face =
      found->plane == kNoPlane ? FullWalk(tree, from, to).face_at_start() : found->plane;
  hit.starts_in_solid = face == kNoPlane;
  if (hit.starts_in_solid) return hit;
  const Plane plane = tree.plane(face);
  hit.normal = plane.distance(to) > plane.distance(from) ? Vec3(-plane.normal) : plane.normal;
  return hit;
}

bool blocked(const Tree& tree, const Vec3& from, const Vec3& to) {
  return find(tree, from, to).has_value();
}

}  // namespace hallway::bsp

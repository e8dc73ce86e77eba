// SPDX-License-Identifier: MIT
#include "bsp/segment.hpp"

#include "bsp/pending_stack.hpp"
#include "bsp/query_limits.hpp"

namespace hallway::bsp {
namespace {

constexpr std::int32_t kNoPlane = -1;

/// A part of the segment that lies in a subtree.
struct Part {
  std::int32_t at = 0;  ///< as Node::child
  std::int32_t plane;   ///< the node whose plane it crosses at `begin`; kNoPlane at the segment's start
  double begin;         ///< fractions of the segment
  double end;
};

/// Where the segment is in solid.
struct Found {
  double fraction;
  std::int32_t plane;
  std::uint32_t leaf;
};

/// Walks a segment through a tree, nearest leaves first. A node cuts a part of the segment into two that follow each other, so the
/// parts in the leaves always make up the whole segment.
class SegmentWalk {
 public:
  SegmentWalk(const Tree& tree, const Vec3& from, const Vec3& to) : tree_(tree), from_(from), to_(to) {}

  std::optional<Found> first() const { return first({root(), kNoPlane, 0.0, 1.0}); }

  std::optional<Found> first(Part part) const {
    PendingStack<Part> rest;
    for (;;) {
      if (part.at < 0) {
        const auto leaf = static_cast<std::uint32_t>(~part.at);
        if (tree_.leaves[leaf].content == Content::kSolid) return Found{part.begin, part.plane, leaf};
      } else if (descend(part, rest)) {
        continue;
      } else if (const auto found = along_plane(part)) {
        return found;
      }
      if (rest.empty()) return std::nullopt;
      part = rest.pop();
    }
  }

  /// The node in whose plane the face lies on which the segment starts to go in: that behind which, as the segment goes, it is empty.
  /// kNoPlane if there is none, the start being in solid.
  std::int32_t face_at_start() const {
    std::int32_t face = kNoPlane;
    for (std::int32_t at = root(); at >= 0;) {
      const Node& node = tree_.nodes[static_cast<std::size_t>(at)];
      const double begin = node.plane.distance(from_);
      const std::size_t side = (begin == 0.0 ? node.plane.distance(to_) : begin) < 0.0 ? 1 : 0;
      if (begin == 0.0) {
        const auto other = first({node.child[1 - side], kNoPlane, 0.0, 1.0});
        if (!other || other->fraction > 0.0) face = at;
      }
      at = node.child[side];
    }
    return face;
  }

  std::int32_t root() const { return tree_.nodes.empty() ? ~0 : 0; }

 private:
  /// Goes on to the nearer child. False if the segment lies in the node's plane, which belongs to neither child.
  bool descend(Part& part, PendingStack<Part>& rest) const {
    const std::int32_t index = part.at;
    const Node& node = tree_.nodes[static_cast<std::size_t>(index)];
    const double begin = node.plane.distance(from_);
    const double end = node.plane.distance(to_);
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
      rest.push({node.child[far], index, cross, part.end});
      part.at = node.child[near];
      part.end = cross;
    }
    return true;
  }

  /// The first place of a part in the node's plane where both sides are solid.
  std::optional<Found> along_plane(const Part& part) const {
    const Node& node = tree_.nodes[static_cast<std::size_t>(part.at)];
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

/// The walk of a segment whose ends are places.
SegmentWalk walk(const Tree& tree, const Vec3& from, const Vec3& to) {
  check_query_point(from);
  check_query_point(to);
  return {tree, from, to};
}

}  // namespace

std::optional<SegmentHit> first_solid(const Tree& tree, const Vec3& from, const Vec3& to) {
  const SegmentWalk segment = walk(tree, from, to);
  const auto found = segment.first();
  if (!found) return std::nullopt;
  SegmentHit hit;
  hit.leaf = found->leaf;
  hit.fraction = found->fraction;
  hit.point = from + found->fraction * (to - from);
  const std::int32_t face = found->plane == kNoPlane ? segment.face_at_start() : found->plane;
  hit.starts_in_solid = face == kNoPlane;
  if (hit.starts_in_solid) return hit;
  const Plane& plane = tree.nodes[static_cast<std::size_t>(face)].plane;
  hit.normal = plane.distance(to) > plane.distance(from) ? Vec3(-plane.normal) : plane.normal;
  return hit;
}

bool blocked(const Tree& tree, const Vec3& from, const Vec3& to) {
  return walk(tree, from, to).first().has_value();
}

}  // namespace hallway::bsp

// SPDX-License-Identifier: MIT
#include "pvs/flood.hpp"

#include <algorithm>

namespace hallway::pvs {
namespace {

/// What is no further than this in front of a plane counts as not in front of it, metres: it keeps portals
/// that share a plane or end at it, up to rounding, apart from those that cross it.
constexpr double kClearance = 1e-9;

/// True if a vertex of `portal` lies more than the clearance in front of the plane of `of` (sign +1) or
/// behind it (-1).
bool has_part(const DirectedPortal& portal, const DirectedPortal& of, double sign) {
  const double middle = sign * of.distance(portal.centre);
  if (middle > kClearance) return true;
  if (middle + portal.radius <= kClearance) return false;
  for (std::size_t i = 0; i < portal.winding.count; ++i) {
    if (sign * of.distance(portal.winding.points[i]) > kClearance) return true;
  }
  return false;
}

}  // namespace

bool in_front(const DirectedPortal& first, const DirectedPortal& second) {
  return has_part(second, first, 1.0) && has_part(first, second, -1.0);
}

Flood::Flood(const DirectedPortals& world)
    : world_(world), met_(world.clusters()), reached_(words_for(world.portals.size())) {}

template <typename Passable>
void Flood::spread(std::uint32_t source, Passable passable, Word* reached) {
  ++floods_;
  const std::uint32_t start = world_.portals[source].to;
  met_[start] = floods_;
  open_.assign(1, start);
  while (!open_.empty()) {
    const std::uint32_t cluster = open_.back();
    open_.pop_back();
    for (const std::uint32_t portal : world_.leaving_from(cluster)) {
      if (!passable(portal)) continue;
      set_bit(reached, portal);
      const std::uint32_t next = world_.portals[portal].to;
      if (met_[next] == floods_) continue;
      met_[next] = floods_;
      open_.push_back(next);
    }
  }
}

void Flood::in_front_of(std::uint32_t source, Word* reached) {
  const DirectedPortal& first = world_.portals[source];
  spread(
      source, [&](std::uint32_t portal) { return in_front(first, world_.portals[portal]); }, reached);
}

void Flood::prune(std::uint32_t source, Word* allowed) {
  std::fill(reached_.begin(), reached_.end(), Word{0});
  spread(
      source, [&](std::uint32_t portal) { return test_bit(allowed, portal); }, reached_.data());
  std::copy(reached_.begin(), reached_.end(), allowed);
}

}  // namespace hallway::pvs

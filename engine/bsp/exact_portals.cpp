// SPDX-License-Identifier: MIT
#include "bsp/exact_portals.hpp"

#include <algorithm>
#include <utility>

namespace hallway::bsp {
namespace {

/// Divides a convex region down a tree and keeps track of what the parts share.
class PortalMaker {
 public:
  PortalMaker(PlaneSet& planes, const ExactTree& tree, double reach, bool stop_at_cells)
      : planes_(planes), tree_(tree), reach_(reach), stop_at_cells_(stop_at_cells) {}

  std::vector<ExactPortal> run(std::int32_t root, const std::vector<OrientedPlane>& rim) {
    const std::int32_t whole = add_region(root);
    for (const OrientedPlane& plane : rim) add_rim(plane, rim, whole);
    for (std::int32_t region = 0; region < static_cast<std::int32_t>(regions_.size()); ++region)
      divide(region);
    for (ExactPortal& portal : portals_) {
      for (std::int32_t& side : portal.region) {
        if (side != ExactPortal::kBeyond) side = name_of(regions_[static_cast<std::size_t>(side)].at);
      }
    }
    return std::move(portals_);
  }

 private:
  struct Region {
    std::int32_t at = 0;  ///< node or ~leaf
    std::vector<std::uint32_t> portals;
  };

  std::int32_t add_region(std::int32_t at) {
    regions_.push_back({at, {}});
    return static_cast<std::int32_t>(regions_.size()) - 1;
  }

  bool is_final(std::int32_t at) const {
    return at < 0 || (stop_at_cells_ && tree_.nodes[static_cast<std::size_t>(at)].cell >= 0);
  }

  std::int32_t name_of(std::int32_t at) const {
    if (!stop_at_cells_) return ~at;
    if (at >= 0) return tree_.nodes[static_cast<std::size_t>(at)].cell;
    return static_cast<std::int32_t>(tree_.leaves[static_cast<std::size_t>(~at)].cell);
  }

  void add_portal(Facet facet, std::int32_t front, std::int32_t back) {
    const auto index = static_cast<std::uint32_t>(portals_.size());
    portals_.push_back({std::move(facet), {front, back}});
    for (const std::int32_t region : {front, back}) {
      if (region != ExactPortal::kBeyond) regions_[static_cast<std::size_t>(region)].portals.push_back(index);
    }
  }

  void add_rim(const OrientedPlane& plane, const std::vector<OrientedPlane>& rim, std::int32_t whole) {
    Facet facet = cover_plane(planes_, plane.index, reach_);
    for (const OrientedPlane& other : rim) {
      if (facet.empty()) return;
      if (other.index != plane.index) clip(planes_, facet, other.index, other.flipped);
    }
    if (facet.empty()) return;
    // The rim's normals point away from the region.
    if (plane.flipped) {
      add_portal(std::move(facet), whole, ExactPortal::kBeyond);
    } else {
      add_portal(std::move(facet), ExactPortal::kBeyond, whole);
    }
  }

  void divide(std::int32_t region) {
    const std::int32_t at = regions_[static_cast<std::size_t>(region)].at;
    if (is_final(at)) return;
    const ExactNode& node = tree_.nodes[static_cast<std::size_t>(at)];
    const std::vector<std::uint32_t> around = std::move(regions_[static_cast<std::size_t>(region)].portals);
    const std::int32_t front = add_region(node.child[0]);
    const std::int32_t back = add_region(node.child[1]);
    Facet facet = cross_section(node.plane, around, region);
    for (const std::uint32_t portal : around) hand_down(portal, region, node.plane, front, back);
    if (!facet.empty()) add_portal(std::move(facet), front, back);
  }

  /// What of a plane lies in a region.
  Facet cross_section(std::uint32_t plane, const std::vector<std::uint32_t>& around, std::int32_t region) {
    if (around.empty()) return {};  // nothing is left of the region
    Facet facet = cover_plane(planes_, plane, reach_);
    seen_.clear();
    for (const std::uint32_t index : around) {
      const ExactPortal& portal = portals_[index];
      if (std::find(seen_.begin(), seen_.end(), portal.facet.plane) != seen_.end()) continue;
      seen_.push_back(portal.facet.plane);
      clip(planes_, facet, portal.facet.plane, portal.region[0] == region);
      if (facet.empty()) break;
    }
    return facet;
  }

  /// Gives a portal of a divided region to its parts.
  void hand_down(std::uint32_t index, std::int32_t region, std::uint32_t plane, std::int32_t front,
                 std::int32_t back) {
    const std::size_t own = portals_[index].region[0] == region ? 0 : 1;
    Facet front_part, back_part;
    split(planes_, portals_[index].facet, plane, front_part, back_part);
    const std::int32_t other = portals_[index].region[1 - own];
    bool reused = false;
    for (const auto& [part, to] : {std::pair(&front_part, front), std::pair(&back_part, back)}) {
      if (part->empty()) continue;
      if (!reused) {
        portals_[index].facet = std::move(*part);
        portals_[index].region[own] = to;
        regions_[static_cast<std::size_t>(to)].portals.push_back(index);
        reused = true;
      } else {
        add_portal(std::move(*part), own == 0 ? to : other, own == 0 ? other : to);
      }
    }
  }

  PlaneSet& planes_;
  const ExactTree& tree_;
  double reach_;
  bool stop_at_cells_;
  std::vector<Region> regions_;
  std::vector<ExactPortal> portals_;
  std::vector<std::uint32_t> seen_;
};

}  // namespace

std::vector<ExactPortal> cell_portals(PlaneSet& planes, const ExactTree& tree,
                                      const std::vector<OrientedPlane>& rim, double reach) {
  return PortalMaker(planes, tree, reach, true).run(tree.root(), rim);
}

std::vector<ExactPortal> leaf_portals(PlaneSet& planes, const ExactTree& tree, const Cell& cell,
                                      const std::vector<OrientedPlane>& rim, double reach) {
  return PortalMaker(planes, tree, reach, false).run(cell.root, rim);
}

}  // namespace hallway::bsp

// SPDX-License-Identifier: MIT
#include "bsp/exact_tree.hpp"

#include <algorithm>
#include <utility>

#include "bsp/split_choice.hpp"

namespace hallway::bsp {
namespace {

/// How far a facet has come on its way down.
enum class State : std::uint8_t {
  kInside,    ///< lies in the inside of the region
  kFrontRim,  ///< lies on the region's rim, which is in front of it
  kBackRim,   ///< lies on the region's rim, which is behind it
};

struct Item {
  TreeFacet facet;
  State state = State::kInside;

  bool tells_empty() const { return (state == State::kFrontRim) != facet.flipped; }
};

/// A region that is still to be divided.
struct Region {
  std::vector<Item> items;
  std::int32_t parent = -1;
  int side = 0;
  std::int32_t cell = -1;  ///< it lies in, where it is part of one
};

class Builder {
 public:
  Builder(const PlaneSet& planes, bool structure_is_surface, const BuildOptions& options)
      : planes_(planes), options_(options), structure_is_surface_(structure_is_surface) {}

  ExactTree build(std::vector<TreeFacet> facets) {
    Region whole;
    for (TreeFacet& facet : facets) {
      if (!facet.facet.empty()) whole.items.push_back({std::move(facet), State::kInside});
    }
    std::vector<Region> open;
    open.push_back(std::move(whole));
    while (!open.empty()) {
      Region region = std::move(open.back());
      open.pop_back();
      divide(std::move(region), open);
    }
    return std::move(tree_);
  }

 private:
  static bool has_inside(const Region& region, FacetKind kind) {
    return std::any_of(region.items.begin(), region.items.end(), [&](const Item& item) {
      return item.state == State::kInside && item.facet.kind == kind;
    });
  }

  /// The kind of facets whose planes are next; empty if nothing divides the region any more.
  static std::optional<FacetKind> next_kind(const Region& region) {
    for (const FacetKind kind : {FacetKind::kHint, FacetKind::kStructure, FacetKind::kSurface}) {
      if (has_inside(region, kind)) return kind;
    }
    return std::nullopt;
  }

  void divide(Region region, std::vector<Region>& open) {
    const auto kind = next_kind(region);
    const bool is_cell = region.cell < 0 && (!kind || *kind == FacetKind::kSurface);
    if (is_cell) begin_cell(region);
    if (!kind) {
      const std::int32_t cell = region.cell;
      const std::int32_t leaf = add_leaf(std::move(region));
      if (is_cell) tree_.cells[static_cast<std::size_t>(cell)].root = ~leaf;
      return;
    }
    const std::uint32_t plane = choose(region, *kind);
    const auto node = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.push_back({plane, {}, is_cell ? region.cell : -1});
    attach(region, node);
    if (is_cell) tree_.cells[static_cast<std::size_t>(region.cell)].root = node;
    Region front{{}, node, 0, region.cell};
    Region back{{}, node, 1, region.cell};
    for (Item& item : region.items) distribute(std::move(item), plane, front, back);
    open.push_back(std::move(back));
    open.push_back(std::move(front));
  }

  std::uint32_t choose(const Region& region, FacetKind kind) {
    shapes_.clear();
    for (const Item& item : region.items) {
      if (item.state != State::kInside) continue;
      // What detail there is must not matter to how the structure divides space.
      if (item.facet.kind == FacetKind::kSurface && kind != FacetKind::kSurface) continue;
      FacetShape shape = shape_of(item.facet.facet);
      shape.candidate = item.facet.kind == kind;
      shapes_.push_back(shape);
    }
    return choose_plane(planes_, shapes_, options_);
  }

  void distribute(Item item, std::uint32_t plane, Region& front, Region& back) const {
    TreeFacet front_part{{}, item.facet.polygon, item.facet.kind, item.facet.flipped};
    TreeFacet back_part = front_part;
    const FacetSide side = split(planes_, item.facet.facet, plane, front_part.facet, back_part.facet);
    if (side == FacetSide::kOn) {
      if (item.facet.kind == FacetKind::kHint) return;
      front.items.push_back({item.facet, State::kFrontRim});
      back.items.push_back({std::move(item.facet), State::kBackRim});
      return;
    }
    if (!front_part.facet.empty()) front.items.push_back({std::move(front_part), item.state});
    if (!back_part.facet.empty()) back.items.push_back({std::move(back_part), item.state});
  }

  void begin_cell(Region& region) {
    region.cell = static_cast<std::int32_t>(tree_.cells.size());
    Cell& cell = tree_.cells.emplace_back();
    for (Item& item : region.items) {
      if (item.facet.kind != FacetKind::kStructure) continue;
      if (item.tells_empty()) {
        cell.label = Label::kEmpty;
        cell.structure.push_back(item.facet);
      } else if (cell.label == Label::kUnknown) {
        cell.label = Label::kSolid;
      }
      if (structure_is_surface_) item.facet.kind = FacetKind::kSurface;
    }
    std::erase_if(region.items, [](const Item& item) { return item.facet.kind == FacetKind::kStructure; });
  }

  std::int32_t add_leaf(Region region) {
    const auto index = static_cast<std::int32_t>(tree_.leaves.size());
    ExactLeaf& leaf = tree_.leaves.emplace_back();
    leaf.cell = static_cast<std::uint32_t>(region.cell);
    for (Item& item : region.items) {
      if (item.tells_empty()) {
        leaf.label = Label::kEmpty;
        leaf.surface.push_back(std::move(item.facet));
      } else if (leaf.label == Label::kUnknown) {
        leaf.label = Label::kSolid;
      }
    }
    attach(region, ~index);
    return index;
  }

  void attach(const Region& region, std::int32_t child) {
    if (region.parent < 0) return;
    tree_.nodes[static_cast<std::size_t>(region.parent)].child[static_cast<std::size_t>(region.side)] = child;
  }

  const PlaneSet& planes_;
  const BuildOptions& options_;
  bool structure_is_surface_;
  ExactTree tree_;
  std::vector<FacetShape> shapes_;
};

}  // namespace

ExactTree build_tree(const PlaneSet& planes, std::vector<TreeFacet> facets, bool structure_is_surface,
                     const BuildOptions& options) {
  return Builder(planes, structure_is_surface, options).build(std::move(facets));
}

std::uint32_t leaf_at(const PlaneSet& planes, const ExactTree& tree, const Vec3& point) {
  std::int32_t at = tree.root();
  while (at >= 0) {
    const ExactNode& node = tree.nodes[static_cast<std::size_t>(at)];
    at = node.child[planes[node.plane].unit.distance(point) < 0.0 ? 1 : 0];
  }
  return static_cast<std::uint32_t>(~at);
}

}  // namespace hallway::bsp

// SPDX-License-Identifier: MIT
#include "bsp/compile.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <tuple>
#include <utility>

#include "bsp/exact_portals.hpp"
#include "bsp/exact_tree.hpp"
#include "csg/merge.hpp"

namespace hallway::bsp {
namespace {

constexpr double kMargin = 64.0;  ///< between the world and the tree's bounds, map units

/// Tells regions without a label the one of their neighbours: no facet covers the portals of a region that no facet has told its label.
/// @param label  of a region. O(portals log portals).
void spread_labels(const std::vector<ExactPortal>& portals,
                   const std::function<Label&(std::int32_t)>& label) {
  std::vector<std::pair<std::int32_t, std::int32_t>> links;  // from, to
  for (const ExactPortal& portal : portals) {
    const auto& [a, b] = portal.region;
    if (a == ExactPortal::kBeyond || b == ExactPortal::kBeyond) continue;
    if (label(a) != Label::kUnknown && label(b) != Label::kUnknown) continue;
    links.emplace_back(a, b);
    links.emplace_back(b, a);
  }
  std::sort(links.begin(), links.end());
  std::vector<std::int32_t> known;
  for (const auto& link : links) {
    if (label(link.first) != Label::kUnknown) known.push_back(link.first);
  }
  while (!known.empty()) {
    const std::int32_t region = known.back();
    known.pop_back();
    const auto begin = std::lower_bound(links.begin(), links.end(), std::pair(region, std::int32_t{0}));
    for (auto link = begin; link != links.end() && link->first == region; ++link) {
      if (label(link->second) != Label::kUnknown) continue;
      label(link->second) = label(region);
      known.push_back(link->second);
    }
  }
}

/// The stages of a compilation, in their order.
class Compiler {
 public:
  Compiler(const map::World& world, const std::vector<Vec3>& occupants_m, const CompileOptions& options)
      : world_(world), occupants_m_(occupants_m), options_(options), exact_(csg::make_exact(world)) {}

  Compiled run() {
    const std::vector<csg::BoundaryFacet> surface = csg::boundary(exact_, csg::Parts::kAll);
    compiled_.surface = csg::make_surface(exact_, surface, world_.metres_per_unit);
    make_rim();
    divide(first_facets(surface));
    const CellSpace space{exact_.planes, tree_, portals_, world_.metres_per_unit};
    compiled_.enclosure = find_enclosure(space, occupants_m_, options_.narrowest_m);
    if (compiled_.enclosure.sealed) divide(inside_facets(compiled_.enclosure.outside));
    compiled_.enclosure.outside.clear();
    label_leaves();
    number_clusters();
    emit_tree();
    emit_portals();
    return std::move(compiled_);
  }

 private:
  void make_rim() {
    // Hints too: every plane of the tree must pass through what it divides.
    Box box;
    for (const csg::ExactBrush& brush : exact_.brushes) {
      if (brush.role != map::BrushRole::kSubtract) box.extend(brush.box);
    }
    if (box.isEmpty()) box.extend(Vec3::Zero().eval());
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::floor(box.min()[axis]) - kMargin;
      const double high = std::ceil(box.max()[axis]) + kMargin;
      OrientedPlane plane = exact_.planes.add_axial(axis, low);
      plane.flipped = !plane.flipped;
      rim_.push_back(plane);
      rim_.push_back(exact_.planes.add_axial(axis, high));
      bounds_low_[axis] = low;
      bounds_high_[axis] = high;
    }
    compiled_.tree.bounds = Box(bounds_low_ * world_.metres_per_unit, bounds_high_ * world_.metres_per_unit);
    reach_ = std::exp2(std::ceil(
        std::log2(2.0 * std::max(bounds_low_.cwiseAbs().maxCoeff(), bounds_high_.cwiseAbs().maxCoeff()))));
  }

  void divide(std::vector<TreeFacet> facets) {
    tree_ = build_tree(exact_.planes, std::move(facets), !has_detail(), options_.build);
    portals_ = cell_portals(exact_.planes, tree_, rim_, reach_);
    spread_labels(portals_, [&](std::int32_t cell) -> Label& {
      return tree_.cells[static_cast<std::size_t>(cell)].label;
    });
    for (Cell& cell : tree_.cells) {
      if (cell.label == Label::kUnknown) cell.label = Label::kEmpty;  // a world without a face
    }
  }

  bool has_detail() const {
    return std::any_of(exact_.brushes.begin(), exact_.brushes.end(),
                       [](const csg::ExactBrush& brush) { return brush.role == map::BrushRole::kDetail; });
  }

  std::vector<TreeFacet> hints() const {
    std::vector<TreeFacet> facets;
    for (const csg::ExactBrush& brush : exact_.brushes) {
      if (brush.role != map::BrushRole::kHint) continue;
      for (const Facet& facet : brush.facets) facets.push_back({facet, kNoPolygon, FacetKind::kHint, false});
    }
    return facets;
  }

  std::vector<TreeFacet> first_facets(const std::vector<csg::BoundaryFacet>& surface) const {
    std::vector<TreeFacet> facets = hints();
    const bool detail = has_detail();
    for (std::size_t i = 0; i < surface.size(); ++i) {
      facets.push_back({surface[i].facet, static_cast<std::uint32_t>(i),
                        detail ? FacetKind::kSurface : FacetKind::kStructure, surface[i].flipped});
    }
    if (!detail) return facets;
    // Their numbers only keep pieces of different facets apart, as they are in a world without the detail.
    std::uint32_t number = 0;
    for (const csg::BoundaryFacet& facet : csg::boundary(exact_, csg::Parts::kStructure)) {
      facets.push_back({facet.facet, number++, FacetKind::kStructure, facet.flipped});
    }
    return facets;
  }

  /// Facets that close the cracks between the inside and the outside: portals too narrow to count as openings.
  std::vector<TreeFacet> plugs(const std::vector<bool>& outside) const {
    std::vector<TreeFacet> facets;
    const auto is_inside = [&](std::int32_t cell) {
      const auto c = static_cast<std::size_t>(cell);
      return cell != ExactPortal::kBeyond && tree_.cells[c].label == Label::kEmpty && !outside[c];
    };
    const auto is_outside = [&](std::int32_t cell) {
      return cell == ExactPortal::kBeyond || outside[static_cast<std::size_t>(cell)];
    };
    for (const ExactPortal& portal : portals_) {
      for (const std::size_t side : {0u, 1u}) {
        if (!is_inside(portal.region[side]) || !is_outside(portal.region[1 - side])) continue;
        facets.push_back({portal.facet, kNoPolygon, FacetKind::kStructure, side == 1});
        if (has_detail()) facets.push_back({portal.facet, kNoPolygon, FacetKind::kSurface, side == 1});
      }
    }
    return facets;
  }

  /// What of the facets bounds cells that the void does not reach, pieces of one facet joined again.
  std::vector<TreeFacet> inside_facets(const std::vector<bool>& outside) const {
    std::vector<TreeFacet> pieces = plugs(outside);
    for (std::size_t c = 0; c < tree_.cells.size(); ++c) {
      if (outside[c]) continue;
      for (const TreeFacet& piece : tree_.cells[c].structure) pieces.push_back(piece);
    }
    if (has_detail()) {
      for (const ExactLeaf& leaf : tree_.leaves) {
        if (outside[leaf.cell]) continue;
        for (const TreeFacet& piece : leaf.surface) pieces.push_back(piece);
      }
    }
    const auto group = [](const TreeFacet& f) {
      return std::tuple(f.kind, f.polygon, f.facet.plane, f.flipped);
    };
    std::stable_sort(pieces.begin(), pieces.end(),
                     [&](const TreeFacet& a, const TreeFacet& b) { return group(a) < group(b); });
    std::vector<TreeFacet> facets = hints();
    for (std::size_t begin = 0; begin < pieces.size();) {
      std::size_t end = begin;
      std::vector<Facet> same;
      for (; end < pieces.size() && group(pieces[end]) == group(pieces[begin]); ++end) {
        same.push_back(std::move(pieces[end].facet));
      }
      const TreeFacet& first = pieces[begin];
      csg::merge_convex(exact_.planes, same);
      for (Facet& facet : same)
        facets.push_back({std::move(facet), first.polygon, first.kind, first.flipped});
      begin = end;
    }
    return facets;
  }

  /// The planes around each cell, normals outward.
  std::vector<std::vector<OrientedPlane>> cell_rims() const {
    std::vector<std::vector<OrientedPlane>> rims(tree_.cells.size());
    for (const ExactPortal& portal : portals_) {
      for (const int side : {0, 1}) {
        if (portal.region[static_cast<std::size_t>(side)] == ExactPortal::kBeyond) continue;
        auto& rim = rims[static_cast<std::size_t>(portal.region[static_cast<std::size_t>(side)])];
        const OrientedPlane plane{portal.facet.plane, side == 0};
        if (std::find(rim.begin(), rim.end(), plane) == rim.end()) rim.push_back(plane);
      }
    }
    return rims;
  }

  /// Labels of leaves that no face told: from neighbouring leaves of the cell; where there are none, as in a cell within a block of
  /// detail, from the brushes.
  void label_leaves() {
    const auto rims = cell_rims();
    const auto middles = cell_middles();
    for (std::size_t c = 0; c < tree_.cells.size(); ++c) {
      const Cell& cell = tree_.cells[c];
      if (cell.root < 0) {
        Label& label = tree_.leaves[static_cast<std::size_t>(~cell.root)].label;
        if (cell.label == Label::kSolid) label = Label::kSolid;
        if (label == Label::kUnknown) label = brushes_at(middles[c]);
        continue;
      }
      const auto portals = leaf_portals(exact_.planes, tree_, cell, rims[c], reach_);
      spread_labels(portals, [&](std::int32_t leaf) -> Label& {
        return tree_.leaves[static_cast<std::size_t>(leaf)].label;
      });
    }
    for (ExactLeaf& leaf : tree_.leaves) {
      if (leaf.label == Label::kUnknown) leaf.label = tree_.cells[leaf.cell].label;
    }
  }

  /// What the brushes, applied in order, leave at a point that is on none of their planes; map units.
  Label brushes_at(const Vec3& point) const {
    for (auto brush = exact_.brushes.rbegin(); brush != exact_.brushes.rend(); ++brush) {
      if (brush->role == map::BrushRole::kHint || brush->planes.empty() || !brush->box.contains(point))
        continue;
      const bool holds = std::all_of(
          brush->planes.begin(), brush->planes.end(),
          [&](const OrientedPlane& plane) { return exact_.planes.unit(plane).distance(point) <= 0.0; });
      if (holds) return brush->role == map::BrushRole::kSubtract ? Label::kEmpty : Label::kSolid;
    }
    return Label::kEmpty;
  }

  /// A point inside each cell: the mean of its corners; map units.
  std::vector<Vec3> cell_middles() const {
    std::vector<Vec3> sums(tree_.cells.size(), Vec3::Zero());
    std::vector<double> counts(tree_.cells.size(), 0.0);
    for (const ExactPortal& portal : portals_) {
      for (const std::int32_t cell : portal.region) {
        if (cell == ExactPortal::kBeyond) continue;
        for (const FacetEdge& edge : portal.facet.edges)
          sums[static_cast<std::size_t>(cell)] += edge.start.at;
        counts[static_cast<std::size_t>(cell)] += static_cast<double>(portal.facet.edges.size());
      }
    }
    for (std::size_t c = 0; c < sums.size(); ++c) sums[c] /= std::max(counts[c], 1.0);
    return sums;
  }

  void number_clusters() {
    cluster_.assign(tree_.cells.size(), -1);
    for (std::size_t c = 0; c < tree_.cells.size(); ++c) {
      if (tree_.cells[c].label == Label::kEmpty)
        cluster_[c] = static_cast<std::int32_t>(compiled_.tree.clusters++);
    }
  }

  std::vector<Box> cell_boxes() const {
    std::vector<Box> boxes(tree_.cells.size());
    for (const ExactPortal& portal : portals_) {
      for (const std::int32_t cell : portal.region) {
        if (cell == ExactPortal::kBeyond) continue;
        for (const FacetEdge& edge : portal.facet.edges) {
          boxes[static_cast<std::size_t>(cell)].extend(edge.start.at * world_.metres_per_unit);
        }
      }
    }
    return boxes;
  }

  void emit_tree() {
    Tree& tree = compiled_.tree;
    const std::vector<Box> boxes = cell_boxes();
    compiled_.inside.assign(compiled_.surface.polygons.size(), false);
    std::vector<std::uint32_t> faces;
    for (const ExactLeaf& leaf : tree_.leaves) {
      faces.clear();
      if (leaf.label == Label::kEmpty) {
        for (const TreeFacet& piece : leaf.surface) {
          if (piece.polygon != kNoPolygon) faces.push_back(piece.polygon);
        }
      }
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
      for (const std::uint32_t face : faces) compiled_.inside[face] = true;
      const bool empty = leaf.label == Label::kEmpty;
      tree.leaves.push_back({empty ? Content::kEmpty : Content::kSolid, empty ? cluster_[leaf.cell] : -1,
                             boxes[leaf.cell], static_cast<std::uint32_t>(tree.leaf_faces.size()),
                             static_cast<std::uint32_t>(faces.size())});
      tree.leaf_faces.insert(tree.leaf_faces.end(), faces.begin(), faces.end());
    }
    std::vector<Division> divisions;
    for (const ExactNode& node : tree_.nodes) {
      Plane plane = exact_.planes[node.plane].unit;
      plane.offset *= world_.metres_per_unit;
      divisions.push_back({plane, node.child});
    }
    set_nodes(tree, divisions);
  }

  /// The facet in metres, without corners that rounding has made one; empty where nothing is left of it.
  Polygon polygon_of(const Facet& facet) const {
    Polygon polygon;
    polygon.plane = exact_.planes[facet.plane].unit;
    polygon.plane.offset *= world_.metres_per_unit;
    for (std::size_t i = 0; i < facet.edges.size(); ++i) {
      const Vec3& corner = facet.edges[i].start.at;
      const Vec3& next = facet.edges[(i + 1) % facet.edges.size()].start.at;
      if ((next - corner).cwiseAbs().maxCoeff() > csg::kWeldDistance)
        polygon.vertices.push_back(corner * world_.metres_per_unit);
    }
    if (polygon.vertices.size() < 3 || width(exact_.planes, facet) <= csg::kWeldDistance)
      polygon.vertices.clear();
    return polygon;
  }

  void emit_portals() {
    compiled_.portals.clusters = compiled_.tree.clusters;
    for (const ExactPortal& portal : portals_) {
      if (portal.region[0] == ExactPortal::kBeyond || portal.region[1] == ExactPortal::kBeyond) continue;
      const std::int32_t front = cluster_[static_cast<std::size_t>(portal.region[0])];
      const std::int32_t back = cluster_[static_cast<std::size_t>(portal.region[1])];
      if (front < 0 || back < 0) continue;
      Polygon polygon = polygon_of(portal.facet);
      if (polygon.vertices.empty()) continue;
      compiled_.portals.portals.push_back(
          {std::move(polygon), {static_cast<std::uint32_t>(front), static_cast<std::uint32_t>(back)}});
    }
  }

  const map::World& world_;
  const std::vector<Vec3>& occupants_m_;
  const CompileOptions& options_;
  csg::ExactBrushes exact_;
  Compiled compiled_;
  ExactTree tree_;
  std::vector<ExactPortal> portals_;
  std::vector<OrientedPlane> rim_;
  Vec3 bounds_low_ = Vec3::Zero();
  Vec3 bounds_high_ = Vec3::Zero();
  double reach_ = 0.0;
  std::vector<std::int32_t> cluster_;  ///< of each cell, -1 for solid ones
};

}  // namespace

Compiled compile(const map::World& world, const std::vector<Vec3>& occupants_m,
                 const CompileOptions& options) {
  return Compiler(world, occupants_m, options).run();
}

}  // namespace hallway::bsp

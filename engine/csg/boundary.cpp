// SPDX-License-Identifier: MIT
#include "csg/boundary.hpp"

#include <algorithm>
#include <utility>

#include "csg/merge.hpp"

namespace hallway::csg {
namespace {

constexpr double kBoxSlack = 1e-3;  ///< boxes are rounded; a pair too many costs little

bool boxes_touch(const Box& a, const Box& b) {
  return ((a.min() - b.max()).array() <= kBoxSlack).all() && ((b.min() - a.max()).array() <= kBoxSlack).all();
}

/// A part of a face that is still to be decided on.
struct Piece {
  Facet facet;
  Box box;

  Piece() = default;
  explicit Piece(Facet f) : facet(std::move(f)) {
    for (const FacetEdge& edge : facet.edges) box.extend(edge.start.at);
  }
};

/// For each brush those that its faces may meet, in the order in which they are applied.
class Neighbours {
 public:
  explicit Neighbours(const std::vector<const ExactBrush*>& brushes) : lists_(brushes.size()) {
    std::vector<std::uint32_t> order(brushes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto low = [&](std::uint32_t i) { return brushes[i]->box.min().x(); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(low(a), a) < std::pair(low(b), b); });
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Box& box = brushes[order[k]]->box;
      for (std::size_t m = k + 1; m < order.size(); ++m) {
        const Box& other = brushes[order[m]]->box;
        if (other.min().x() > box.max().x() + kBoxSlack) break;
        if (!boxes_touch(box, other)) continue;
        lists_[order[k]].push_back(order[m]);
        lists_[order[m]].push_back(order[k]);
      }
    }
    for (auto& list : lists_) std::sort(list.begin(), list.end());
  }

  const std::vector<std::uint32_t>& of(std::size_t brush) const { return lists_[brush]; }

 private:
  std::vector<std::vector<std::uint32_t>> lists_;
};

/// How a brush's faces in the facet's own plane count.
enum class Coplanar {
  kInside,  ///< a facet on a face is inside the brush
  kBeyond,  ///< what counts is the space just beyond the facet: inside if the brush lies on that side
};

/// Cuts facets by convex brushes.
class Carver {
 public:
  explicit Carver(const PlaneSet& planes) : planes_(planes) {}

  /// The part of the facet that is inside the brush, empty for none; what is outside is appended to `outside`. A facet that is
  /// outside altogether is not cut. `beyond_front`: which way "beyond" is.
  Facet carve(Piece piece, const ExactBrush& brush, Coplanar coplanar, bool beyond_front,
              std::vector<Piece>& outside) const {
    if (!boxes_touch(piece.box, brush.box) || !meets(piece.facet, brush, coplanar, beyond_front)) {
      outside.push_back(std::move(piece));
      return {};
    }
    Facet facet = std::move(piece.facet);
    for (const OrientedPlane& plane : brush.planes) {
      if (plane.index == facet.plane) continue;
      Facet front, back;
      split(planes_, facet, plane.index, front, back);
      Facet& out = plane.flipped ? back : front;
      facet = std::move(plane.flipped ? front : back);
      if (!out.empty()) outside.emplace_back(std::move(out));
    }
    return facet;
  }

 private:
  /// True if a part of the facet with an area is inside the brush.
  bool meets(const Facet& facet, const ExactBrush& brush, Coplanar coplanar, bool beyond_front) const {
    bool cut = false;
    for (const OrientedPlane& plane : brush.planes) {
      if (plane.index == facet.plane) {
        if (coplanar == Coplanar::kBeyond && plane.flipped != beyond_front) return false;
        continue;
      }
      const FacetSide side = classify(planes_, facet, plane.index);
      if (side == (plane.flipped ? FacetSide::kBack : FacetSide::kFront)) return false;
      cut = cut || side == FacetSide::kSplit;
    }
    if (!cut) return true;
    Facet inside = facet;
    for (const OrientedPlane& plane : brush.planes) {
      if (plane.index == facet.plane) continue;
      clip(planes_, inside, plane.index, plane.flipped);
      if (inside.empty()) return false;
    }
    return true;
  }

  const PlaneSet& planes_;
};

/// Finds what of each brush's faces is boundary.
class BoundaryMaker {
 public:
  BoundaryMaker(const ExactBrushes& all, Parts parts)
      : planes_(all.planes), carver_(all.planes), brushes_(chosen(all, parts)), neighbours_(brushes_) {}

  std::vector<BoundaryFacet> run() {
    for (std::size_t i = 0; i < brushes_.size(); ++i) {
      for (std::size_t f = 0; f < brushes_[i]->facets.size(); ++f) {
        if (!brushes_[i]->facets[f].empty()) add_face(i, f);
      }
    }
    return std::move(out_);
  }

 private:
  static std::vector<const ExactBrush*> chosen(const ExactBrushes& all, Parts parts) {
    std::vector<const ExactBrush*> brushes;
    for (const ExactBrush& brush : all.brushes) {
      if (brush.role == map::BrushRole::kHint) continue;
      if (parts == Parts::kStructure && brush.role == map::BrushRole::kDetail) continue;
      brushes.push_back(&brush);
    }
    return brushes;
  }

  bool adds(std::size_t brush) const { return brushes_[brush]->role != map::BrushRole::kSubtract; }

  void add_face(std::size_t i, std::size_t f) {
    std::vector<Piece> pieces;
    pieces.emplace_back(brushes_[i]->facets[f]);
    const auto& near = neighbours_.of(i);
    const auto later = std::upper_bound(near.begin(), near.end(), static_cast<std::uint32_t>(i));
    for (auto j = later; j != near.end() && !pieces.empty(); ++j) remove_inside(pieces, *brushes_[*j]);
    std::vector<Facet> kept;
    const bool front = !brushes_[i]->planes[f].flipped;  // which side of the plane is outside the brush
    for (auto j = later; j != near.begin() && !pieces.empty();) {
      --j;
      std::vector<Piece> undecided;
      for (Piece& piece : pieces) {
        Facet inside = carver_.carve(std::move(piece), *brushes_[*j], Coplanar::kBeyond, front, undecided);
        if (!inside.empty() && adds(*j) != adds(i)) kept.push_back(std::move(inside));
      }
      pieces = std::move(undecided);
    }
    if (adds(i)) {  // what no earlier brush has touched is empty
      for (Piece& piece : pieces) kept.push_back(std::move(piece.facet));
    }
    merge_convex(planes_, kept);
    const bool flipped = front != adds(i);
    for (Facet& facet : kept)
      out_.push_back({std::move(facet), flipped, brushes_[i]->solid, brushes_[i]->faces[f]});
  }

  /// Pieces that the brush does not touch stay where they are: there may be thousands.
  void remove_inside(std::vector<Piece>& pieces, const ExactBrush& brush) const {
    std::vector<Piece> cut;
    for (std::size_t k = 0; k < pieces.size();) {
      if (!boxes_touch(pieces[k].box, brush.box)) {
        ++k;
        continue;
      }
      carver_.carve(std::move(pieces[k]), brush, Coplanar::kInside, true, cut);
      pieces[k] = std::move(pieces.back());
      pieces.pop_back();
    }
    for (Piece& piece : cut) pieces.push_back(std::move(piece));
  }

  const PlaneSet& planes_;
  Carver carver_;
  std::vector<const ExactBrush*> brushes_;
  Neighbours neighbours_;
  std::vector<BoundaryFacet> out_;
};

}  // namespace

std::vector<BoundaryFacet> boundary(const ExactBrushes& brushes, Parts parts) {
  return BoundaryMaker(brushes, parts).run();
}

}  // namespace hallway::csg

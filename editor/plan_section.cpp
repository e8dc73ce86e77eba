// SPDX-License-Identifier: MIT
#include "editor/plan_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace hallway::editor {
namespace {

constexpr double kSame = 1e-6;        ///< metres; what is nearer is at the same place
constexpr double kStraight = 1e-10;   ///< metres; a corner nearer to the line of its neighbours is none
constexpr double kUpright = 1e-3;     ///< a face whose normal rises less is upright
constexpr double kBend = 0.96592583;  ///< cosine of 15 degrees

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Vec2 flat(const Vec3& point) {
  return point.head<2>();
}

/// An edge of the surface that goes through the cut, by its vertices.
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;  // the one below, the one above

struct Piece {
  EdgeKey from{}, to{};
};

std::vector<Piece> pieces_at(const csg::Surface& surface, double height) {
  std::vector<Piece> pieces;
  const auto above = [&](std::uint32_t v) { return surface.vertices[v].z() > height; };
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    const auto some = std::ranges::count_if(polygon.vertices, above);
    if (some == 0 || some == static_cast<std::ptrdiff_t>(polygon.vertices.size())) continue;
    for (const auto& corners : csg::triangulate(surface, polygon)) {
      std::optional<EdgeKey> rises, falls;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
        if (!above(a) && above(b)) rises = EdgeKey{a, b};
        if (above(a) && !above(b)) falls = EdgeKey{b, a};
      }
      // Seen from outside the left side falls and the right one rises; going right, solid is on the left.
      if (rises && falls) pieces.push_back({*falls, *rises});
    }
  }
  return pieces;
}

Vec2 crossing(const csg::Surface& surface, const EdgeKey& edge, double height) {
  const Vec3& low = surface.vertices[edge.first];
  const Vec3& high = surface.vertices[edge.second];
  const double t = (height - low.z()) / (high.z() - low.z());
  return flat(low) + t * (flat(high) - flat(low));
}

/// A loop without the corners at which it goes straight on.
std::vector<Vec2> straightened(const std::vector<Vec2>& loop) {
  std::vector<Vec2> kept;
  const std::size_t n = loop.size();
  const auto is_corner = [](const Vec2& before, const Vec2& at, const Vec2& after) {
    const Vec2 along = after - before;
    const double length = along.norm();
    if (length <= kStraight) return true;
    return std::abs(cross(along, at - before)) > kStraight * length || along.dot(at - before) < 0.0 ||
           along.dot(after - at) < 0.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (!kept.empty() && (loop[i] - kept.back()).norm() <= kStraight) continue;
    while (kept.size() >= 2 && !is_corner(kept[kept.size() - 2], kept.back(), loop[i])) kept.pop_back();
    kept.push_back(loop[i]);
  }
  // The end meets the beginning.
  while (kept.size() >= 3 && (kept.front() - kept.back()).norm() <= kStraight) kept.pop_back();
  while (kept.size() >= 3 && !is_corner(kept[kept.size() - 2], kept.back(), kept.front())) kept.pop_back();
  while (kept.size() >= 3 && !is_corner(kept.back(), kept.front(), kept[1])) kept.erase(kept.begin());
  return kept;
}

/// An edge with the polygons that meet in it.
struct Side {
  std::uint32_t low = 0, high = 0;  ///< vertices
  std::uint32_t polygon = 0;

  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(const csg::Surface& surface) {
  std::vector<Side> sides;
  for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
    const auto& vertices = surface.polygons[p].vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::uint32_t a = vertices[i], b = vertices[(i + 1) % vertices.size()];
      sides.push_back({std::min(a, b), std::max(a, b), p});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

/// Whether polygons that meet in an edge are drawn apart from above.
bool is_drawn(const csg::Surface& surface, const Side* first, const Side* last) {
  for (const Side* a = first; a != last; ++a) {
    const Vec3& normal = surface.polygons[a->polygon].plane.normal;
    if (normal.z() < kUpright) continue;
    for (const Side* b = first; b != last; ++b) {
      if (normal.dot(surface.polygons[b->polygon].plane.normal) < kBend) return true;
    }
  }
  return false;
}

/// Hides what lies under other parts of the surface.
class EdgeView {
 public:
  EdgeView(const csg::Surface& surface, const PlanColumns& columns, double height)
      : surface_(surface), columns_(columns), height_(height) {}

  void add(Vec3 from, Vec3 to) {
    if (from.z() > to.z()) std::swap(from, to);
    if (from.z() > height_) return;
    if (to.z() > height_) to = from + (height_ - from.z()) / (to.z() - from.z()) * (to - from);
    if ((flat(to) - flat(from)).norm() <= kSame) return;
    PlanBox box(flat(from).cwiseMin(flat(to)), flat(from).cwiseMax(flat(to)));
    const auto near = columns_.near(box);
    const auto cuts = cuts_of(flat(from), flat(to), near);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const Vec3 middle = from + (cuts[i] + cuts[i + 1]) / 2.0 * (to - from);
      if (hidden(middle, near)) continue;
      lines_.push_back(ordered(flat(from + cuts[i] * (to - from)), flat(from + cuts[i + 1] * (to - from))));
    }
  }

  /// Every line once.
  std::vector<PlanLine> lines() {
    const auto key = [](const PlanLine& line) {
      const auto whole = [](double x) { return std::llround(x / kSame); };
      return std::array{whole(line.from.x()), whole(line.from.y()), whole(line.to.x()), whole(line.to.y())};
    };
    std::ranges::stable_sort(lines_, [&](const PlanLine& a, const PlanLine& b) { return key(a) < key(b); });
    const auto end = std::unique(lines_.begin(), lines_.end(),
                                 [&](const PlanLine& a, const PlanLine& b) { return key(a) == key(b); });
    lines_.erase(end, lines_.end());
    return std::move(lines_);
  }

 private:
  static PlanLine ordered(const Vec2& a, const Vec2& b) {
    const bool forward = a.x() < b.x() || (a.x() == b.x() && a.y() <= b.y());
    return forward ? PlanLine{a, b} : PlanLine{b, a};
  }

  /// Where along a line the outlines of polygons cross or touch it, with 0 and 1.
  std::vector<double> cuts_of(const Vec2& from, const Vec2& to,
                              const std::vector<std::uint32_t>& polygons) const {
    const Vec2 way = to - from;
    const double length = way.norm();
    std::vector<double> cuts{0.0, 1.0};
    const auto add_cut = [&](double t) {
      if (t * length > kSame && (1.0 - t) * length > kSame) cuts.push_back(t);
    };
    for (const std::uint32_t p : polygons) {
      const auto& vertices = surface_.polygons[p].vertices;
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec2 a = flat(surface_.vertices[vertices[i]]);
        const Vec2 b = flat(surface_.vertices[vertices[(i + 1) % vertices.size()]]);
        const double side_a = cross(way, a - from) / length, side_b = cross(way, b - from) / length;
        if (std::abs(side_a) <= kSame) add_cut(way.dot(a - from) / (length * length));
        if (std::abs(side_b) <= kSame) add_cut(way.dot(b - from) / (length * length));
        if ((side_a > kSame && side_b < -kSame) || (side_a < -kSame && side_b > kSame)) {
          const Vec2 at = a + side_a / (side_a - side_b) * (b - a);
          add_cut(way.dot(at - from) / (length * length));
        }
      }
    }
    std::ranges::sort(cuts);
    const auto end =
        std::unique(cuts.begin(), cuts.end(), [&](double a, double b) { return (b - a) * length <= kSame; });
    cuts.erase(end, cuts.end());
    cuts.back() = 1.0;
    return cuts;
  }

  bool hidden(const Vec3& at, const std::vector<std::uint32_t>& polygons) const {
    return std::ranges::any_of(polygons, [&](std::uint32_t p) {
      const double z = columns_.height_at(p, flat(at));
      return z > at.z() + kSame && z <= height_ && columns_.covers(p, flat(at));
    });
  }

  const csg::Surface& surface_;
  const PlanColumns& columns_;
  double height_;
  std::vector<PlanLine> lines_;
};

}  // namespace

double Section::area_m2() const {
  double twice = 0.0;
  for (const auto& loop : loops) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      twice += cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  }
  return twice / 2.0;
}

PlanBox Section::bounds() const {
  PlanBox box;
  for (const auto& loop : loops) {
    for (const Vec2& point : loop) box.extend(point);
  }
  return box;
}

Section section_at(const csg::Surface& surface, double height_m) {
  std::vector<Piece> pieces = pieces_at(surface, height_m);
  std::ranges::stable_sort(pieces, {}, &Piece::from);
  std::vector<bool> used(pieces.size(), false);
  const auto next_from = [&](const EdgeKey& key) {
    auto found = std::ranges::lower_bound(pieces, key, {}, &Piece::from);
    while (found != pieces.end() && found->from == key &&
           used[static_cast<std::size_t>(found - pieces.begin())])
      ++found;
    return found != pieces.end() && found->from == key ? static_cast<std::size_t>(found - pieces.begin())
                                                       : pieces.size();
  };
  Section section;
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    std::vector<Vec2> loop;
    for (std::size_t i = first; i < pieces.size(); i = next_from(pieces[i].to)) {
      used[i] = true;
      loop.push_back(crossing(surface, pieces[i].from, height_m));
      if (pieces[i].to == pieces[first].from) break;
    }
    loop = straightened(loop);
    if (loop.size() >= 3) section.loops.push_back(std::move(loop));
  }
  return section;
}

PlanColumns::PlanColumns(const csg::Surface& surface) : surface_(surface) {
  constexpr int kMostCells = 128;
  for (const Vec3& vertex : surface.vertices) bounds_.extend(flat(vertex));
  side_ =
      std::clamp(static_cast<int>(std::sqrt(static_cast<double>(surface.polygons.size()))), 1, kMostCells);
  cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
    const csg::SurfacePolygon& polygon = surface.polygons[p];
    if (polygon.vertices.size() < 3 || std::abs(polygon.plane.normal.z()) < kUpright) continue;
    PlanBox box;
    for (const std::uint32_t v : polygon.vertices) box.extend(flat(surface.vertices[v]));
    const Eigen::Array2i low = cell_of(box.min()), high = cell_of(box.max());
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) cells_[static_cast<std::size_t>(y * side_ + x)].push_back(p);
    }
  }
}

Eigen::Array2i PlanColumns::cell_of(const Vec2& at) const {
  Eigen::Array2i cell;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double size = std::max(bounds_.max()[i] - bounds_.min()[i], kSame);
    const double place = std::floor((at[i] - bounds_.min()[i]) / size * side_);
    cell[i] = static_cast<int>(std::clamp(place, 0.0, static_cast<double>(side_ - 1)));
  }
  return cell;
}

std::vector<std::uint32_t> PlanColumns::near(const PlanBox& box) const {
  const Vec2 rim(kSame, kSame);
  const Eigen::Array2i low = cell_of(box.min() - rim), high = cell_of(box.max() + rim);
  std::vector<std::uint32_t> found;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const auto& cell = cells_[static_cast<std::size_t>(y * side_ + x)];
      found.insert(found.end(), cell.begin(), cell.end());
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool PlanColumns::covers(std::uint32_t polygon, const Vec2& at) const {
  const csg::SurfacePolygon& one = surface_.polygons[polygon];
  const double turn =
      one.plane.normal.z() > 0.0 ? 1.0 : -1.0;  // from above, faces that look down run clockwise
  for (std::size_t i = 0; i < one.vertices.size(); ++i) {
    const Vec2 a = flat(surface_.vertices[one.vertices[i]]);
    const Vec2 b = flat(surface_.vertices[one.vertices[(i + 1) % one.vertices.size()]]);
    if (turn * cross(b - a, at - a) < -kSame * (b - a).norm()) return false;
  }
  return true;
}

double PlanColumns::height_at(std::uint32_t polygon, const Vec2& at) const {
  const Plane& plane = surface_.polygons[polygon].plane;
  return (plane.offset - plane.normal.head<2>().dot(at)) / plane.normal.z();
}

bool PlanColumns::blocked(const Vec2& at, double low_m, double high_m) const {
  if (cells_.empty() || bounds_.isEmpty() || !bounds_.contains(at)) return false;
  const Eigen::Array2i cell = cell_of(at);
  const auto& polygons = cells_[static_cast<std::size_t>(cell.y() * side_ + cell.x())];
  return std::ranges::any_of(polygons, [&](std::uint32_t p) {
    const double z = height_at(p, at);
    return z > low_m && z < high_m && covers(p, at);
  });
}

std::vector<PlanLine> edges_below(const csg::Surface& surface, const PlanColumns& columns, double height_m) {
  EdgeView view(surface, columns, height_m);
  const auto sides = sides_of(surface);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (is_drawn(surface, sides.data() + i, sides.data() + end))
      view.add(surface.vertices[sides[i].low], surface.vertices[sides[i].high]);
    i = end;
  }
  return view.lines();
}

}  // namespace hallway::editor

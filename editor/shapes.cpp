// SPDX-License-Identifier: MIT
#include "editor/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "base/refuse.hpp"
#include "map/texture_axes.hpp"
#include "map/world.hpp"

namespace hallway::editor {
namespace {

constexpr double kTolerance = 1e-6;  ///< map units; as build_world() has it

/// Twice the signed area of a triangle in x and y; positive if counter-clockwise.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double area_of(std::span<const Vec3> polygon) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += turn(polygon[0], polygon[i], polygon[i + 1]) / 2.0;
  return area;
}

/// Whether two edges of a polygon that have no corner in common meet.
bool meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto side = [](double x) { return (x > 0.0) - (x < 0.0); };
  const int s1 = side(turn(a, b, c)), s2 = side(turn(a, b, d)), s3 = side(turn(c, d, a)),
            s4 = side(turn(c, d, b));
  if (s1 != s2 && s3 != s4) return true;
  const auto on = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    return side(turn(p, q, r)) == 0 && r.x() >= std::min(p.x(), q.x()) && r.x() <= std::max(p.x(), q.x()) &&
           r.y() >= std::min(p.y(), q.y()) && r.y() <= std::max(p.y(), q.y());
  };
  return on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b);
}

void check_simple(const std::vector<Vec3>& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (meet(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n]))
        refuse("the polygon touches or crosses itself");
    }
  }
}

/// Whether a corner is on the straight way between its neighbours: within the tolerance, or where `slack` is larger within that if the
/// edges are so nearly parallel that no body could tell them apart.
bool is_straight(const Vec3& before, const Vec3& corner, const Vec3& after, double slack) {
  constexpr double kFlat = 2e-4;  // a sine
  const double in = (corner - before).norm(), out = (after - corner).norm();
  const double twice = std::abs(turn(before, corner, after));
  return twice <= kTolerance * std::max({in, out, 1.0}) ||
         (twice <= kFlat * in * out && twice <= slack * std::max(in, out));
}

/// The corners counter-clockwise, without those that are on the straight way between their neighbours.
std::vector<Vec3> cleaned(std::span<const Vec3> polygon, double slack) {
  std::vector<Vec3> corners(polygon.begin(), polygon.end());
  for (Vec3& corner : corners) corner.z() = polygon[0].z();
  for (bool again = true; again && corners.size() >= 3;) {
    again = false;
    for (std::size_t i = 0; i < corners.size() && corners.size() >= 3; ++i) {
      const Vec3& before = corners[(i + corners.size() - 1) % corners.size()];
      const Vec3& after = corners[(i + 1) % corners.size()];
      if (!is_straight(before, corners[i], after, slack)) continue;
      if ((after - corners[i]).dot(corners[i] - before) < -kTolerance)
        refuse("the polygon turns straight back at a corner");
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      again = true;
      break;
    }
  }
  if (corners.size() < 3) refuse("the polygon has no area");
  if (area_of(corners) < 0.0) std::ranges::reverse(corners);
  return corners;
}

/// Whether no corner is so nearly straight that a body could not have it.
bool is_clearly_convex(const std::vector<Vec3>& polygon) {
  constexpr double kLeastSine = 1e-3;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
    if (turn(a, b, c) <= kLeastSine * (b - a).norm() * (c - b).norm()) return false;
  }
  return true;
}

bool is_ear(const std::vector<Vec3>& rest, std::size_t i) {
  const std::size_t n = rest.size();
  const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
  if (turn(rest[before], rest[i], rest[after]) <= 0.0) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (k == before || k == i || k == after) continue;
    if (turn(rest[before], rest[i], rest[k]) >= 0.0 && turn(rest[i], rest[after], rest[k]) >= 0.0 &&
        turn(rest[after], rest[before], rest[k]) >= 0.0)
      return false;
  }
  return true;
}

/// The ear that is furthest from being a sliver; the polygon's size where there is none.
std::size_t best_ear(const std::vector<Vec3>& rest) {
  const std::size_t n = rest.size();
  std::size_t best = n;
  double widest_sine = -1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = rest[(i + n - 1) % n], &b = rest[i], &c = rest[(i + 1) % n];
    const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
    // Of its three angles the one with the smallest sine is between the longest edges.
    const double sine = turn(a, b, c) * std::min({ab, bc, ca}) / (ab * bc * ca);
    if (sine <= widest_sine * (1.0 + 1e-9) || !is_ear(rest, i)) continue;
    widest_sine = sine;
    best = i;
  }
  return best;
}

/// Two parts with an edge in common as one, if that is convex.
std::optional<std::vector<Vec3>> joined(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
      std::vector<Vec3> both;
      for (std::size_t k = 0; k < a.size(); ++k) both.push_back(a[(i + 1 + k) % a.size()]);
      for (std::size_t k = 2; k < b.size(); ++k) both.push_back(b[(j + k) % b.size()]);
      both = cleaned(both, 0.0);
      if (is_clearly_convex(both)) return both;
    }
  }
  return std::nullopt;
}

/// The three corners of a polygon that are furthest from being on one line, in their order. O(n^3), but n is small.
std::optional<std::array<Vec3, 3>> widest(std::span<const Vec3> polygon) {
  const std::size_t n = polygon.size();
  const std::size_t step = std::max<std::size_t>(1, n / 16);  // of a large polygon some are enough
  std::array<Vec3, 3> best{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double largest = 0.0;
  for (std::size_t i = 0; i < n; i += step) {
    for (std::size_t j = i + 1; j < n; j += step) {
      for (std::size_t k = j + 1; k < n; k += step) {
        const double area = (polygon[j] - polygon[i]).cross(polygon[k] - polygon[i]).norm();
        // Of equally large ones the first: rounding must not choose.
        if (area <= largest * (1.0 + 1e-9)) continue;
        largest = area;
        best = {polygon[i], polygon[j], polygon[k]};
      }
    }
  }
  const double longest = std::max((best[1] - best[0]).norm(), (best[2] - best[0]).norm());
  if (largest <= kTolerance * std::max(longest, kTolerance)) return std::nullopt;
  return best;
}

/// Adds a side by its corners, counter-clockwise from outside; one without area is left out.
void add_side(map::Brush& brush, std::span<const Vec3> corners, const std::string& material) {
  if (const auto points = widest(corners))
    brush.faces.push_back(face_through((*points)[0], (*points)[1], (*points)[2], material));
}

/// Whether a brush is a body and has each of the points as a corner.
bool has_corners(const map::Brush& brush, std::span<const Vec3> points) {
  const auto body = body_of(brush);
  if (!body || body->sides.size() != brush.faces.size()) return false;
  return std::ranges::all_of(points, [&](const Vec3& point) {
    const double slack = 10.0 * kTolerance + 1e-9 * point.norm();
    return std::ranges::any_of(body->vertices,
                               [&](const Vec3& vertex) { return (vertex - point).norm() <= slack; });
  });
}

map::ConvexBody needed_body(const map::Brush& brush) {
  auto body = body_of(brush);
  if (!body) refuse("a brush is no closed body");
  return std::move(*body);
}

map::Face turned_round(map::Face face) {
  std::swap(face.points[0], face.points[2]);
  return face;
}

/// A face that was put through a plane, now through three corners of its side.
void put_on_corners(map::Face& face, const map::ConvexBody& body, const map::ConvexBody::Side& side) {
  std::vector<Vec3> loop;
  for (const std::uint32_t v : side.loop) loop.push_back(tidied(body.vertices[v]));
  if (const auto points = widest(loop)) {
    const std::string material = face.material;
    face = face_through((*points)[0], (*points)[1], (*points)[2], material);
  }
}

/// What is behind the faces of a brush and behind the planes, whose faces get points on their corners.
std::optional<map::Brush> behind_planes(const map::Brush& brush, const std::vector<map::Face>& planes) {
  std::vector<map::Face> faces = brush.faces;
  faces.insert(faces.end(), planes.begin(), planes.end());
  map::Brush all;
  all.faces = faces;
  const auto body = body_of(all);
  if (!body) return std::nullopt;
  map::Brush part;
  for (const map::ConvexBody::Side& side : body->sides) {
    part.faces.push_back(faces[side.plane]);
    if (side.plane >= brush.faces.size()) put_on_corners(part.faces.back(), *body, side);
  }
  if (!body_of(part)) return std::nullopt;
  return part;
}

std::vector<map::Brush> mitred_walls(const map::Brush& brush, const std::vector<Plane>& planes,
                                     const std::vector<map::Face>& inner, const Vec3& middle) {
  std::vector<map::Brush> walls;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    // Of the wall behind face i are the points that are less deep behind it than behind any other.
    std::vector<map::Face> cuts{turned_round(inner[i])};
    for (std::size_t j = 0; j < planes.size(); ++j) {
      const Vec3 normal = planes[j].normal - planes[i].normal;
      if (j == i || normal.norm() < kTolerance) continue;
      const double length = normal.norm();
      const Plane between{normal / length, (planes[j].offset - planes[i].offset) / length};
      cuts.push_back(face_on(between, middle, brush.faces[i].material));
    }
    if (auto wall = behind_planes(brush, cuts)) walls.push_back(std::move(*wall));
  }
  return walls;
}

std::vector<map::Brush> slab_walls(const map::Brush& brush, const std::vector<map::Face>& inner) {
  std::vector<map::Brush> walls;
  map::Brush rest = brush;
  for (const map::Face& face : inner) {
    if (auto wall = behind_planes(rest, {turned_round(face)})) walls.push_back(std::move(*wall));
    auto left = behind_planes(rest, {face});
    if (!left) break;
    rest = std::move(*left);
  }
  return walls;
}

}  // namespace

map::Face face_through(const Vec3& a, const Vec3& b, const Vec3& c, const std::string& material) {
  map::Face face;
  face.points = {c, b, a};
  face.material = material;
  const map::TextureAxes axes = map::standard_axes(face.points, 0.0);
  face.u_axis = axes.u;
  face.v_axis = axes.v;
  return face;
}

std::optional<Plane> plane_of(const map::Face& face) {
  const Vec3 normal = (face.points[2] - face.points[0]).cross(face.points[1] - face.points[0]);
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  const Vec3 unit = normal / length;
  return Plane{unit, unit.dot(face.points[0])};
}

std::optional<map::ConvexBody> body_of(const map::Brush& brush) {
  std::vector<Plane> planes;
  for (const map::Face& face : brush.faces) {
    const auto plane = plane_of(face);
    if (!plane) return std::nullopt;
    planes.push_back(*plane);
  }
  if (planes.size() < 4 || planes.size() > map::kMaxBrushFaces) return std::nullopt;
  auto body = map::intersect_half_spaces(planes, 2.0 * map::kMaxCoordinate, kTolerance);
  if (!std::holds_alternative<map::ConvexBody>(body)) return std::nullopt;
  return std::get<map::ConvexBody>(std::move(body));
}

double volume_of(const map::ConvexBody& body) {
  double volume = 0.0;
  const Vec3& from = body.vertices.front();
  for (const map::ConvexBody::Side& side : body.sides) {
    const Vec3 a = body.vertices[side.loop[0]] - from;
    for (std::size_t i = 1; i + 1 < side.loop.size(); ++i) {
      const Vec3 b = body.vertices[side.loop[i]] - from, c = body.vertices[side.loop[i + 1]] - from;
      volume += a.dot(b.cross(c)) / 6.0;
    }
  }
  return volume;
}

Box bounds_of(const map::ConvexBody& body) {
  Box box;
  for (const Vec3& vertex : body.vertices) box.extend(vertex);
  return box;
}

Vec3 tidied(const Vec3& point) {
  constexpr double kFine = 1e6, kNear = 1e-9;
  Vec3 result = point;
  for (double& x : result) {
    const double near = std::round(x * kFine) / kFine;
    if (std::abs(near - x) <= kNear) x = near;
  }
  return result;
}

map::Brush box_brush(const Vec3& a, const Vec3& b, const std::string& material) {
  const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
  if ((high - low).minCoeff() <= kTolerance) refuse("the box has no volume");
  const std::array<Vec3, 4> base{
      low, {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()}, {low.x(), high.y(), low.z()}};
  return extrusion(base, {0.0, 0.0, high.z() - low.z()}, material);
}

map::Brush column(std::span<const Vec3> bottom, std::span<const Vec3> top, const std::string& material) {
  map::Brush brush;
  const std::size_t n = bottom.size();
  if (n < 3 || top.size() != n) refuse("a body needs at least three corners");
  add_side(brush, top, material);
  const std::vector<Vec3> from_below(bottom.rbegin(), bottom.rend());
  add_side(brush, from_below, material);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const std::array<Vec3, 4> side{bottom[i], bottom[next], top[next], top[i]};
    add_side(brush, side, material);
  }
  if (!has_corners(brush, bottom) || !has_corners(brush, top) || brush.faces.size() < 4)
    refuse("the corners make no convex body with a volume");
  return brush;
}

map::Brush extrusion(std::span<const Vec3> base, const Vec3& way, const std::string& material) {
  if (base.size() < 3) refuse("a polygon needs at least three corners");
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < base.size(); ++i)
    normal += (base[i] - base[0]).cross(base[i + 1] - base[0]);
  const double height = normal.norm() > 0.0 ? normal.normalized().dot(way) : 0.0;
  if (std::abs(height) <= kTolerance) refuse("the polygon, or what is made of it, has no extent");
  std::vector<Vec3> bottom(base.begin(), base.end());
  if (height < 0.0) std::ranges::reverse(bottom);
  std::vector<Vec3> top;
  for (const Vec3& corner : bottom) top.push_back(tidied(corner + way));
  return column(bottom, top, material);
}

std::vector<std::vector<Vec3>> convex_parts(std::span<const Vec3> polygon) {
  if (polygon.size() < 3) refuse("a polygon needs at least three corners");
  constexpr double kSlack = 1e-4;  // map units
  std::vector<Vec3> rest = cleaned(polygon, kSlack);
  check_simple(rest);
  if (is_clearly_convex(rest)) return {rest};
  std::vector<std::vector<Vec3>> parts;
  while (rest.size() > 3) {
    const std::size_t ear = best_ear(rest);
    if (ear == rest.size()) refuse("the polygon touches or crosses itself");
    const std::size_t n = rest.size();
    parts.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (turn(rest[0], rest[1], rest[2]) > 0.0) parts.push_back(rest);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size();) {
      if (auto both = joined(parts[i], parts[j])) {
        parts[i] = std::move(*both);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      } else {
        ++j;
      }
    }
  }
  return parts;
}

std::vector<Vec3> polygon_behind(std::span<const Vec3> polygon, const Vec3& place, const Vec3& normal) {
  std::vector<Vec3> part;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % n];
    const double at_a = normal.dot(a - place), at_b = normal.dot(b - place);
    if (at_a <= kTolerance) part.push_back(a);
    if ((at_a < -kTolerance && at_b > kTolerance) || (at_a > kTolerance && at_b < -kTolerance))
      part.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  if (part.size() < 3 || std::abs(area_of(part)) <= kTolerance) part.clear();
  return part;
}

map::Face face_on(const Plane& plane, const Vec3& place, const std::string& material) {
  constexpr double kApart = 64.0;  // map units; far enough for an exact direction
  const Vec3 on = place - plane.distance(place) * plane.normal;
  const Vec3 u = plane.normal.unitOrthogonal();
  const Vec3 v = plane.normal.cross(u);
  return face_through(on, on + kApart * u, on + kApart * v, material);
}

std::optional<map::Brush> behind_all(const std::vector<map::Face>& faces) {
  map::Brush all;
  all.faces = faces;
  return behind_planes(all, {});
}

Halves halves(const map::Brush& brush, const map::Face& cut) {
  const map::ConvexBody body = needed_body(brush);
  const auto plane = plane_of(cut);
  if (!plane) refuse("the places that are to make a plane are on one line");
  double lowest = 0.0, highest = 0.0;
  for (const Vec3& vertex : body.vertices) {
    lowest = std::min(lowest, plane->distance(vertex));
    highest = std::max(highest, plane->distance(vertex));
  }
  if (highest <= kTolerance) return {.behind = brush, .in_front = {}};
  if (lowest >= -kTolerance) return {.behind = {}, .in_front = brush};
  return {.behind = behind_planes(brush, {cut}), .in_front = behind_planes(brush, {turned_round(cut)})};
}

std::optional<map::Brush> intersection(const map::Brush& a, const map::Brush& b) {
  std::vector<map::Face> faces = a.faces;
  faces.insert(faces.end(), b.faces.begin(), b.faces.end());
  return behind_all(faces);
}

std::vector<map::Brush> hollowed(const map::Brush& brush, double thickness, Joint joint,
                                 const std::string& inside) {
  const map::ConvexBody body = needed_body(brush);
  map::Brush outer;  // without faces that bound nothing
  outer.comments = brush.comments;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& vertex : body.vertices) middle += vertex / static_cast<double>(body.vertices.size());
  std::vector<Plane> planes;
  std::vector<map::Face> inner;
  for (const map::ConvexBody::Side& side : body.sides) {
    const map::Face& face = brush.faces[side.plane];
    const Plane plane = *plane_of(face);
    outer.faces.push_back(face);
    planes.push_back(plane);
    inner.push_back(
        face_on({plane.normal, plane.offset - thickness}, middle, inside.empty() ? face.material : inside));
  }
  if (!behind_all(inner)) refuse("a brush is too thin: walls of that thickness leave nothing inside");
  return joint == Joint::kMitred ? mitred_walls(outer, planes, inner, middle) : slab_walls(outer, inner);
}

}  // namespace hallway::editor

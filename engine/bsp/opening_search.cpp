// SPDX-License-Identifier: MIT
#include "bsp/opening_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace hallway::bsp {
namespace {

constexpr double kWider = 1.05;  ///< a section that is so much larger than the smallest is behind the hole
/// Least cosine between the normals of sections through one hole. A hole that is wider than the room behind it has smaller sections across
/// the room, which begin at its edge; they are no part of it.
constexpr double kSameWay = 0.95;

/// A place on the way.
struct Place {
  std::size_t piece = 0;
  double share = 0.0;  ///< of the piece, from its beginning
};

Vec3 point_at(const std::vector<WayPiece>& way, const Place& place) {
  const WayPiece& piece = way[place.piece];
  return piece.from + place.share * (piece.to - piece.from);
}

/// Places along a piece from its end to its beginning: on both sides of each plane that it crosses, and at even distances.
std::vector<Place> places_on(const std::vector<WayPiece>& way, std::size_t piece,
                             const std::vector<Plane>& planes) {
  constexpr double kBeside_m = 1e-5, kStep_m = 0.05;
  constexpr int kMostSteps = 100;
  const Vec3 along = way[piece].to - way[piece].from;
  const double length = along.norm();
  if (length < 2.0 * kBeside_m) return {{piece, 0.5}};
  std::vector<double> shares;
  for (const Plane& plane : planes) {
    const double a = plane.distance(way[piece].from), b = plane.distance(way[piece].to);
    if (std::abs(a - b) < 1e-12) continue;
    for (const double side : {kBeside_m, -kBeside_m}) shares.push_back((a + side) / (a - b));
  }
  const int steps = std::clamp(static_cast<int>(length / kStep_m), 1, kMostSteps);
  for (int i = 0; i < steps; ++i)
    shares.push_back((i + 0.5) / steps);  // not in the portals, which may be in a section's plane
  std::sort(shares.begin(), shares.end(), std::greater<>());
  std::vector<Place> places;
  for (const double share : shares) {
    if (share >= 0.0 && share <= 1.0) places.push_back({piece, share});
  }
  return places;
}

/// Normals that sections are tried with: the way's direction, those of the planes, and halfway between two of these.
std::vector<Vec3> directions_for(const WayPiece& piece, const std::vector<Plane>& planes) {
  constexpr std::size_t kMostOfPlanes = 12, kMost = 80;
  std::vector<Vec3> found;
  const auto add = [&](const Vec3& direction) {
    constexpr double kSame = 1.0 - 1e-9;
    if (direction.norm() < 1e-6 || found.size() == kMost) return;
    const Vec3 unit = direction.normalized();
    if (std::none_of(found.begin(), found.end(),
                     [&](const Vec3& other) { return std::abs(unit.dot(other)) > kSame; }))
      found.push_back(unit);
  };
  for (const Plane& plane : planes) {
    if (found.size() < kMostOfPlanes) add(plane.normal);
  }
  const std::size_t of_planes = found.size();
  add(piece.to - piece.from);
  for (std::size_t i = 0; i < of_planes; ++i) {
    for (std::size_t k = i + 1; k < of_planes; ++k) {
      add(found[i] + found[k]);
      add(found[i] - found[k]);
    }
  }
  return found;
}

Plane plane_at(const Vec3& point, const Vec3& normal) {
  return {normal, normal.dot(point)};
}

/// A section and where on the way it is.
struct Found {
  Section section;
  Place place;
};

class Search {
 public:
  Search(const EmptySpace& space, const std::vector<WayPiece>& way) : space_(space), way_(way) {}

  Opening run() {
    walk_inwards();
    if (best_) refine();
    Opening opening;
    opening.width_m = std::numeric_limits<double>::infinity();
    if (best_) opening = opening_of(best_->section);
    if (const auto gap = gap_outside(opening.width_m)) return *gap;
    if (!best_) opening.width_m = 0.0;
    return opening;
  }

 private:
  void walk_inwards() {
    for (std::size_t piece = way_.size(); piece-- > 0;) {
      const auto planes = space_.planes_near(way_[piece].cell);
      const auto directions = directions_for(way_[piece], planes);
      for (const Place& place : places_on(way_, piece, planes)) {
        auto section = smallest_at(place, directions);
        if (!section && best_) return;
        if (!section) continue;
        constexpr double kSmaller = 1.0 - 1e-6;
        if (!best_) first_normal_ = section->plane.normal;
        if (!best_ || section->area_m2 < kSmaller * best_->section.area_m2)
          best_ = Found{std::move(*section), place};
      }
    }
  }

  /// The smallest section through a place; of those that lie about as the first, and not much larger than the best.
  std::optional<Section> smallest_at(const Place& place, const std::vector<Vec3>& directions) const {
    std::optional<Section> smallest;
    double most = best_ ? kWider * best_->section.area_m2 : std::numeric_limits<double>::infinity();
    const Vec3 point = point_at(way_, place);
    for (const Vec3& direction : directions) {
      if (best_ && std::abs(direction.dot(first_normal_)) < kSameWay) continue;
      auto section = space_.section(plane_at(point, direction), point, way_[place.piece].cell, most);
      if (!section) continue;
      most = section->area_m2;
      smallest = std::move(section);
    }
    return smallest;
  }

  /// Turns and moves the best section while that makes it smaller: holes need not be along planes of the map.
  void refine() {
    constexpr double kWorthIt = 0.995;
    constexpr int kRounds = 4, kHalvings = 16, kMostSteps = 10;
    Found better = *best_;
    for (int round = 0; round < kRounds; ++round) {
      const double before = better.section.area_m2;
      double turn = 0.2, shift_m = 0.05;
      for (int i = 0; i < kHalvings; ++i, turn *= 0.5, shift_m *= 0.5) {
        for (int step = 0; step < kMostSteps && improve(better, turn, shift_m);) ++step;
      }
      if (better.section.area_m2 > kWorthIt * before) break;
    }
    if (better.section.area_m2 < kWorthIt * best_->section.area_m2) best_ = std::move(better);
  }

  bool improve(Found& found, double turn, double shift_m) const {
    const Vec3 normal = found.section.plane.normal;
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const Place here = found.place;
    bool any = false;
    const auto attempt = [&](const Place& place, const Vec3& direction) {
      const Vec3 at = point_at(way_, place);
      if (std::abs(direction.dot(first_normal_)) < kSameWay) return;
      constexpr double kSmaller = 1.0 - 1e-4;
      auto section = space_.section(plane_at(at, direction), at, way_[place.piece].cell,
                                    kSmaller * found.section.area_m2);
      if (!section) return;
      found = {std::move(*section), place};
      any = true;
    };
    const std::array<Vec3, 5> turns{Vec3::Zero(), u, Vec3(-u), v, Vec3(-v)};
    for (const double way_m : {0.0, shift_m, -shift_m}) {
      const Place place = moved(here, way_m);
      for (const Vec3& side : turns) attempt(place, (normal + turn * side).normalized());
    }
    return any;
  }

  /// A place farther along the way.
  Place moved(Place place, double way_m) const {
    for (;;) {
      const double length = std::max((way_[place.piece].to - way_[place.piece].from).norm(), 1e-12);
      const double share = place.share + way_m / length;
      if (share > 1.0 && place.piece + 1 < way_.size()) {
        way_m -= (1.0 - place.share) * length;
        place = {place.piece + 1, 0.0};
      } else if (share < 0.0 && place.piece > 0) {
        way_m += place.share * length;
        place = {place.piece - 1, 1.0};
      } else {
        return {place.piece, std::clamp(share, 0.0, 1.0)};
      }
    }
  }

  static Opening opening_of(const Section& section) {
    Opening opening;
    std::tie(opening.width_m, opening.height_m) = sides_of_rectangle(section.polygons);
    opening.polygons = section.polygons;
    double sum = 0.0;
    for (const Polygon& polygon : section.polygons) {
      const auto& vertices = polygon.vertices;
      for (std::size_t i = 2; i < vertices.size(); ++i) {
        const double area = (vertices[i - 1] - vertices[0]).cross(vertices[i] - vertices[0]).norm();
        opening.at += area * (vertices[0] + vertices[i - 1] + vertices[i]) / 3.0;
        sum += area;
      }
    }
    opening.at /= sum;
    return opening;
  }

  /// The narrowest place between two parallel faces on the way outside of the best section, if it is narrower than that.
  std::optional<Opening> gap_outside(double width_m) const {
    constexpr double kNarrower = 0.8;
    std::optional<Opening> gap;
    double most = kNarrower * width_m;
    for (std::size_t piece = way_.size(); piece-- > (best_ ? best_->place.piece : 0);) {
      const auto planes = space_.planes_near(way_[piece].cell);
      for (const Place& place : places_on(way_, piece, planes)) {
        if (best_ && piece == best_->place.piece && place.share <= best_->place.share) break;
        const Vec3 point = point_at(way_, place);
        for (const Plane& plane : planes) {
          const auto chord = chord_at(point, way_[piece].cell, plane.normal);
          if (!chord || chord->first >= most) continue;
          most = chord->first;
          gap = Opening{chord->second, most, 0.0, {}};
        }
      }
    }
    return gap;
  }

  /// The distance between two solids on both sides of a point, where their faces look at each other, and the middle.
  std::optional<std::pair<double, Vec3>> chord_at(const Vec3& point, std::int32_t cell,
                                                  const Vec3& direction) const {
    constexpr double kFacing = 0.9;
    const auto ahead = space_.first_solid(point, cell, direction);
    if (!ahead || ahead->normal.dot(direction) > -kFacing) return std::nullopt;
    const auto behind = space_.first_solid(point, cell, Vec3(-direction));
    if (!behind || behind->normal.dot(direction) < kFacing) return std::nullopt;
    return std::pair(ahead->distance_m + behind->distance_m,
                     Vec3(point + 0.5 * (ahead->distance_m - behind->distance_m) * direction));
  }

  const EmptySpace& space_;
  const std::vector<WayPiece>& way_;
  Vec3 first_normal_ = Vec3::Zero();  ///< of the first section, which is the mouth of the hole
  std::optional<Found> best_;
};

}  // namespace

Opening find_opening(const EmptySpace& space, const std::vector<WayPiece>& way) {
  return Search(space, way).run();
}

}  // namespace hallway::bsp

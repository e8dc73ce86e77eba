// SPDX-License-Identifier: MIT
#include "contact/floor_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

#include "contact/local_floor.hpp"
#include "contact/trial_drive.hpp"

namespace hallway::contact {
namespace {

constexpr double kEighth = std::numbers::pi / 4.0;
constexpr double kLongestStep = kFloorSpacing * std::numbers::sqrt2;
constexpr std::uint8_t kAllHeadings = 0xff;
/// Pieces in which a turn by 45 degrees is looked at.
constexpr int kTurnPieces = 4;
/// Heights of one stance differ by less than this, metres.
constexpr double kSameStance = 1e-6;

constexpr std::array<std::array<int, 2>, 8> kNeighbour{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

std::uint8_t bit(int heading) {
  return static_cast<std::uint8_t>(1u << (heading & 7));
}

Quat turned(int heading) {
  const double half = 0.5 * kEighth * heading;
  return {std::cos(half), 0.0, 0.0, std::sin(half)};
}

Quat on_slope(const Vec2& slope, int heading) {
  if (slope.isZero(0.0)) return heading == 0 ? Quat::Identity() : turned(heading);
  const Vec2 ahead = heading_vector(heading);
  const Vec3 x = Vec3(ahead.x(), ahead.y(), slope.dot(ahead)).normalized();
  const Vec3 z = Vec3(-slope.x(), -slope.y(), 1.0).normalized();
  Mat3 axes;
  axes << x, z.cross(x), z;
  return Quat(axes).normalized();
}

Vec2 slope_of(const Pose& pose) {
  const Vec3 normal = pose.q * Vec3::UnitZ();
  return normal.head<2>().isZero(0.0) ? Vec2(Vec2::Zero()) : Vec2(-normal.head<2>() / normal.z());
}

double yaw_of(const Pose& pose) {
  const Vec3 ahead = pose.q * Vec3::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

std::uint64_t column(std::int32_t ix, std::int32_t iy) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(ix)) << 32) | static_cast<std::uint32_t>(iy);
}

/// A body seen from above.
struct Outline {
  Convex area;            ///< body frame
  double radius = 0.0;    ///< of the circle about the origin that holds it
  bool is_round = false;  ///< it is that circle
};

Outline outline_of(const BodyShape& shape) {
  Outline outline;
  Convex points;
  for (const Vec3& vertex : shape.vertices()) {
    points.emplace_back(vertex.head<2>());
    outline.radius = std::max(outline.radius, vertex.head<2>().norm());
  }
  if (points.empty()) {
    const double east = shape.extent(Vec3::UnitX()), west = shape.extent(-Vec3::UnitX());
    const double north = shape.extent(Vec3::UnitY()), south = shape.extent(-Vec3::UnitY());
    const Vec2 axis(0.5 * (east - west), 0.5 * (north - south));
    outline.is_round = axis.norm() < 1e-9;
    outline.radius = axis.norm() + 0.5 * (east + west);
    for (const Vec2& corner : round_area(0.5 * (east + west))) points.emplace_back(axis + corner);
  }
  outline.area = convex_hull(std::move(points));
  return outline;
}

FloorBands bands_of(const RobotSpec& spec, double radius) {
  FloorBands bands;
  const GroundLimits& limits = spec.ground;
  const double jump = std::max(limits.step_m, limits.ledge_m);
  bands.body_low = spec.shape.bottom();
  bands.body_high = spec.shape.extent(Vec3::UnitZ());
  const double play = jump + std::tan(limits.slope_rad) * (radius + kLongestStep);
  bands.wall_low = bands.body_low + play;
  bands.wall_high = bands.body_high - play;
  bands.wheel_down = 2.0 * limits.ledge_m + 1e-3;
  bands.wheel_up = std::max(limits.step_m, limits.clearance_m);
  bands.flat = std::clamp(0.25 * std::min(limits.step_m, limits.ledge_m), 1e-9, 1e-4);
  return bands;
}

/// Where the body and its neighbours are in the plane of a node.
class View {
 public:
  View(const Obstacles& obstacles, const FloorBands& bands, const FloorNode& node, double range)
      : slope_(node.slope),
        frame_{on_slope(node.slope, 0), node.at()},
        floor_(obstacles, bands, frame_, range) {}

  const LocalFloor& floor() const { return floor_; }
  /// A level vector, as the way on the plane above which it is.
  Vec2 flat(const Vec2& level) const {
    return (frame_.q.conjugate() * Vec3(level.x(), level.y(), slope_.dot(level))).head<2>();
  }
  Vec2 ahead(int heading) const { return flat(heading_vector(heading)).normalized(); }
  Vec2 way(int heading) const {
    const auto& step = kNeighbour[static_cast<std::size_t>(heading & 7)];
    return flat(kFloorSpacing * Vec2(step[0], step[1]));
  }

 private:
  Vec2 slope_;
  Pose frame_;
  LocalFloor floor_;
};

Convex placed(const Convex& area, const Vec2& ahead) {
  Convex points;
  for (const Vec2& p : area) points.emplace_back(p.x() * ahead + p.y() * Vec2(-ahead.y(), ahead.x()));
  return points;
}

class Search {
 public:
  Search(const Obstacles& obstacles, const RobotSpec& spec)
      : obstacles_(obstacles),
        wheels_(spec.wheels.at),
        outline_(outline_of(spec.shape)),
        bands_(bands_of(spec, outline_.radius)),
        trial_(obstacles, spec) {
    for (const Vec2& wheel : wheels_) reach_ = std::max(reach_, wheel.norm());
    reach_ /= std::cos(spec.ground.slope_rad);
    far_ = kLongestStep / std::cos(spec.ground.slope_rad);
    range_ = std::max(outline_.radius, 1.02 * reach_) * 1.01 + far_ + 0.01;
    same_floor_ = 0.02 + std::max(spec.ground.step_m, spec.ground.ledge_m);
    disc_ = round_area(reach_);
    wide_disc_ = round_area(reach_ + far_);
  }

  FloorGraph run(const Pose& start) {
    const auto stance = trial_.stand(start);
    if (stance) begin(*stance);
    for (std::size_t i = 0; i < queue_.size(); ++i) look_around(queue_[i]);
    return std::move(graph_);
  }

 private:
  void begin(const Pose& start) {
    const auto ix = static_cast<std::int32_t>(std::floor(start.t.x() / kFloorSpacing));
    const auto iy = static_cast<std::int32_t>(std::floor(start.t.y() / kFloorSpacing));
    for (std::int32_t dx = -2; dx <= 2; ++dx) {
      for (std::int32_t dy = -2; dy <= 2; ++dy) {
        const FloorNode node{.ix = ix + dx, .iy = iy + dy};
        join_start(start, node.ix, node.iy, node.at().head<2>());
      }
    }
  }

  void join_start(const Pose& start, std::int32_t ix, std::int32_t iy, const Vec2& place) {
    const Vec2 way = place - start.t.head<2>();
    const double yaw = yaw_of(start);
    std::vector<double> turns{0.0};
    if (way.norm() > 1e-6) {
      const double face = std::remainder(std::atan2(way.y(), way.x()) - yaw, 2.0 * std::numbers::pi);
      turns = {face, std::remainder(face + std::numbers::pi, 2.0 * std::numbers::pi), 0.0};
    }
    for (const double turn : turns) {
      const auto facing = trial_.turn(start, turn);
      const auto there = facing ? trial_.go(*facing, place) : std::nullopt;
      if (!there) continue;
      const double eighths = yaw_of(*there) / kEighth;
      for (const double heading : {std::floor(eighths), std::ceil(eighths)}) {
        const auto end = trial_.turn(*there, (heading - eighths) * kEighth);
        if (end) reach(node_at(ix, iy, end->t.z(), slope_of(*end)), bit(static_cast<int>(heading) & 7));
      }
    }
  }

  std::uint32_t find(std::int32_t ix, std::int32_t iy, double z) const {
    const auto first = columns_.find(column(ix, iy));
    std::uint32_t node = first == columns_.end() ? kNoFloorNode : first->second;
    while (node != kNoFloorNode && std::abs(graph_.nodes[node].z - z) > same_floor_) node = above_[node];
    return node;
  }

  std::uint32_t node_at(std::int32_t ix, std::int32_t iy, double z, const Vec2& slope) {
    const std::uint32_t known = find(ix, iy, z);
    if (known != kNoFloorNode) return known;
    if (graph_.nodes.size() >= kMostFloorNodes) {
      graph_.is_cut_off = true;
      return kNoFloorNode;
    }
    const auto index = static_cast<std::uint32_t>(graph_.nodes.size());
    graph_.nodes.push_back({.ix = ix, .iy = iy, .z = z, .slope = slope});
    const auto [place, is_new] = columns_.try_emplace(column(ix, iy), index);
    above_.push_back(is_new ? kNoFloorNode : std::exchange(place->second, index));
    pending_.push_back(0);
    return index;
  }

  void reach(std::uint32_t node, std::uint8_t headings) {
    if (node == kNoFloorNode) return;
    const auto fresh = static_cast<std::uint8_t>(headings & ~graph_.nodes[node].headings);
    if (fresh == 0) return;
    graph_.nodes[node].headings |= fresh;
    if (pending_[node] == 0) queue_.push_back(node);
    pending_[node] |= fresh;
  }

  void look_around(std::uint32_t index) {
    const View view(obstacles_, bands_, graph_.nodes[index], range_);
    const LocalFloor& floor = view.floor();
    const Vec2 here = Vec2::Zero();
    const bool is_wide = floor.is_free(here, here, outline_.radius + far_) && floor.is_flat(wide_disc_);
    const bool is_open = is_wide || (floor.is_free(here, here, outline_.radius) && floor.is_flat(disc_));
    std::uint8_t headings = std::exchange(pending_[index], 0);
    if (is_open) {
      headings = kAllHeadings;
      graph_.nodes[index].headings = kAllHeadings;
    } else {
      headings = turn_all(index, view, headings);
    }
    for (int way = 0; way < 8; ++way) {
      if (is_open && !is_joined(index, way, kAllHeadings)) {
        const Vec2 there = view.way(way);
        if (is_wide || (floor.is_free(here, there, outline_.radius) && floor.is_flat(swept(disc_, there)))) {
          join_flat(index, way, kAllHeadings);
          continue;
        }
      }
      for (const int heading : {way, (way + 4) & 7}) {
        if ((headings & bit(heading)) && !is_joined(index, way, bit(heading))) go(index, view, way, heading);
      }
    }
  }

  bool is_joined(std::uint32_t index, int way, std::uint8_t headings) const {
    const std::uint32_t other = graph_.nodes[index].next[static_cast<std::size_t>(way)];
    return other != kNoFloorNode && (graph_.nodes[other].headings & headings) == headings;
  }

  /// The headings to which a robot at a node can turn.
  std::uint8_t turn_all(std::uint32_t index, const View& view, std::uint8_t headings) {
    std::vector<int> open;
    for (int k = 0; k < 8; ++k) {
      if (headings & bit(k)) open.push_back(k);
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
      for (const int side : {1, -1}) {
        const int other = (open[i] + side) & 7;
        if ((headings | graph_.nodes[index].headings) & bit(other)) continue;
        if (!can_turn(graph_.nodes[index], view, open[i], side)) continue;
        headings |= bit(other);
        open.push_back(other);
      }
    }
    graph_.nodes[index].headings |= headings;
    return headings;
  }

  bool can_turn(const FloorNode& node, const View& view, int heading, int side) {
    const Vec2 from = view.ahead(heading), to = view.ahead(heading + side);
    const double angle = std::atan2(cross(from, to), from.dot(to)), piece = angle / kTurnPieces;
    const auto at = [&](double turn, double scale) -> Convex {
      const Vec2 ahead = Eigen::Rotation2Dd(turn) * from;
      return placed(outline_.area, scale * ahead);
    };
    bool is_free = true;
    for (int i = 0; i < kTurnPieces && is_free; ++i) {
      Convex points = at(i * piece, 1.0);
      for (const Vec2& p : at((i + 0.5) * piece, 1.0 / std::cos(0.5 * piece))) points.push_back(p);
      for (const Vec2& p : at((i + 1) * piece, 1.0)) points.push_back(p);
      const Convex area = convex_hull(std::move(points));
      if (view.floor().has_wall(area) && view.floor().has_wall(placed(outline_.area, to))) return false;
      is_free = view.floor().is_free(area);
    }
    if (view.floor().is_flat(disc_)) return is_free;
    const auto begin = trial_.stand(pose_on(node, heading));
    const auto end = begin ? trial_.turn(*begin, side * kEighth) : std::nullopt;
    return end && trial_.turn(*end, -side * kEighth);
  }

  /// Joins a node to a neighbour in its plane.
  void join_flat(std::uint32_t index, int way, std::uint8_t headings) {
    const FloorNode& node = graph_.nodes[index];
    const auto& step = kNeighbour[static_cast<std::size_t>(way)];
    const Vec2 slope = node.slope;
    const double z = node.z + slope.dot(kFloorSpacing * Vec2(step[0], step[1]));
    join(index, way, node_at(node.ix + step[0], node.iy + step[1], z, slope), headings);
  }

  void join(std::uint32_t index, int way, std::uint32_t other, std::uint8_t headings) {
    if (other == kNoFloorNode) return;
    graph_.nodes[index].next[static_cast<std::size_t>(way)] = other;
    graph_.nodes[other].next[static_cast<std::size_t>((way + 4) & 7)] = index;
    reach(other, headings);
  }

  void go(std::uint32_t index, const View& view, int way, int heading) {
    const Vec2 there = view.way(way), ahead = view.ahead(heading);
    const Convex body = swept(placed(outline_.area, ahead), there);
    if (view.floor().has_wall(body)) return;
    Convex wheels;
    for (const Vec2& wheel : wheels_) {
      const Vec2 level = wheel.x() * heading_vector(heading) + wheel.y() * heading_vector(heading + 2);
      wheels.push_back(view.flat(level));
    }
    if (view.floor().is_flat(swept(wheels, there))) {
      const bool is_free = outline_.is_round ? view.floor().is_free(Vec2::Zero(), there, outline_.radius)
                                             : view.floor().is_free(body);
      if (is_free) join_flat(index, way, bit(heading));
      return;
    }
    try_to_go(index, way, heading);
  }

  void try_to_go(std::uint32_t index, int way, int heading) {
    const FloorNode node = graph_.nodes[index];
    const auto& step = kNeighbour[static_cast<std::size_t>(way)];
    FloorNode other{.ix = node.ix + step[0], .iy = node.iy + step[1]};
    const auto begin = trial_.stand(pose_on(node, heading));
    const auto end = begin ? trial_.go(*begin, other.at().head<2>()) : std::nullopt;
    const auto back = end ? trial_.go(*end, node.at().head<2>()) : std::nullopt;
    if (!back || std::abs(back->t.z() - begin->t.z()) > kSameStance) return;
    other.z = end->t.z();
    other.slope = slope_of(*end);
    const std::uint32_t known = find(other.ix, other.iy, other.z);
    if (known != kNoFloorNode) {
      const auto stance = trial_.stand(pose_on(graph_.nodes[known], heading));
      if (!stance || std::abs(stance->t.z() - other.z) > kSameStance) return;
    }
    join(index, way, node_at(other.ix, other.iy, other.z, other.slope), bit(heading));
  }

  const Obstacles& obstacles_;
  std::vector<Vec2> wheels_;
  Outline outline_;
  FloorBands bands_;
  TrialDrive trial_;
  double reach_ = 0.0, far_ = 0.0, range_ = 0.0, same_floor_ = 0.0;
  Convex disc_, wide_disc_;  ///< under the wheels at any heading; on any way to a neighbour
  FloorGraph graph_;
  std::vector<std::uint32_t> above_;   ///< another node at the same x and y
  std::vector<std::uint8_t> pending_;  ///< headings from which a node was not left yet
  std::unordered_map<std::uint64_t, std::uint32_t> columns_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace

Vec2 heading_vector(int heading) {
  static constexpr double kHalf = std::numbers::sqrt2 / 2.0;
  static constexpr double kAlong[8] = {1.0, kHalf, 0.0, -kHalf, -1.0, -kHalf, 0.0, kHalf};
  return {kAlong[heading & 7], kAlong[(heading + 6) & 7]};
}

Pose pose_on(const FloorNode& node, int heading) {
  return {on_slope(node.slope, heading), node.at()};
}

FloorGraph explore_floor(const Obstacles& obstacles, const RobotSpec& spec, const Pose& start) {
  return Search(obstacles, spec).run(start);
}

}  // namespace hallway::contact

// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/se3.hpp"
#include "map/curve_point.hpp"
#include "map/polyline_corners.hpp"

namespace hallway::map {

/// Straight lines between waypoints and the curves at their corners, in order along the path. Every curve begins and ends at the same distance from its
/// waypoint. @tparam Corner  the curve of a corner; its length_m() is what it adds to the path.
template <typename Corner>
class PolylinePieces {
 public:
  /// A straight line, or a corner.
  struct Piece {
    double begin_m = 0.0;  ///< distance from the start of the path
    double length_m = 0.0;
    Vec3 start = Vec3::Zero();
    Vec3 direction = Vec3::UnitX();  ///< at its start
    Vec3 inward = Vec3::Zero();      ///< of a corner: unit, across the direction, to the side of the turn
    std::optional<Corner> corner{};
  };
  struct Place {
    const Piece& piece;
    double along_m;  ///< from its start
  };

  /// @param waypoints    world, metres; must pass check_polyline()
  /// @param radius_m     of the arcs that take from each line as much as the corners do
  /// @param make_corner  (turn in radians, metres from the begin of the curve to the waypoint) -> Corner
  template <typename MakeCorner>
  PolylinePieces(std::span<const Vec3> waypoints, bool closed, double radius_m, const MakeCorner& make_corner)
      : closed_(closed) {
    const PolylineCorners corners = measure_corners(waypoints, closed, radius_m);
    for (std::size_t i = 0; i < corners.directions.size(); ++i) {
      const std::size_t next = (i + 1) % waypoints.size();
      const Vec3& direction = corners.directions[i];
      Piece line;
      line.start = waypoints[i] + direction * corners.trims[i];
      line.direction = direction;
      line.length_m = std::max(corners.lengths[i] - corners.trims[i] - corners.trims[next], 0.0);
      append(std::move(line));
      if (corners.turns[next] == 0.0) continue;
      const Vec3& after = corners.directions[next];
      Piece turn;
      turn.start = waypoints[next] - direction * corners.trims[next];
      turn.direction = direction;
      turn.inward = (after - direction * direction.dot(after)).normalized();
      turn.corner = make_corner(corners.turns[next], corners.trims[next]);
      turn.length_m = turn.corner->length_m();
      append(std::move(turn));
    }
  }

  double length_m() const { return length_m_; }
  bool closed() const { return closed_; }

  /// Where two pieces meet: the end of the one, or the start of the other. O(log pieces).
  Place at(double distance_m, CurveSide side = CurveSide::kAfter) const {
    const double distance = distance_within(distance_m, length_m_, closed_);
    const auto is_later = [side](double value, const Piece& piece) {
      return side == CurveSide::kAfter ? value < piece.begin_m : value <= piece.begin_m;
    };
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), distance, is_later);
    if (after != pieces_.begin()) return {*std::prev(after), distance - std::prev(after)->begin_m};
    // Before the first piece of a closed path is its last one.
    return closed_ ? Place{pieces_.back(), pieces_.back().length_m} : Place{pieces_.front(), 0.0};
  }

  /// Where pieces begin, ascending, and the end of the path.
  std::vector<double> joints_m() const {
    std::vector<double> joints;
    for (const Piece& piece : pieces_) joints.push_back(piece.begin_m);
    joints.push_back(length_m_);
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    return joints;
  }

 private:
  void append(Piece piece) {
    piece.begin_m = length_m_;
    length_m_ += piece.length_m;
    pieces_.push_back(std::move(piece));
  }

  std::vector<Piece> pieces_;
  double length_m_ = 0.0;
  bool closed_;
};

}  // namespace hallway::map

// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame.hpp"

#include <algorithm>

namespace hallway::slam_plane {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
constexpr double kLeastLength_m = 1e-3;

/// Written so that NaN fails.
bool may_be_wall(const Piece& piece) {
  return std::max(piece.a.cwiseAbs().maxCoeff(), piece.b.cwiseAbs().maxCoeff()) <= kMaxCoordinate_m &&
         piece.a.allFinite() && piece.b.allFinite() && cross(piece.a, piece.b) < 0.0;
}

}  // namespace

void take_pieces(std::span<const Piece> pieces, std::vector<Sighting>& sightings) {
  sightings.clear();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    if (!may_be_wall(piece)) continue;
    Sighting sighting;
    sighting.end[kEndA] = piece.a;
    sighting.end[kEndB] = piece.b;
    sighting.middle = 0.5 * (piece.a + piece.b);
    sighting.length = (piece.b - piece.a).norm();
    if (sighting.length < kLeastLength_m) continue;
    sighting.direction = (piece.b - piece.a) / sighting.length;
    sighting.z_low = piece.z_low;
    sighting.z_high = piece.z_high;
    sighting.given = i;
    sightings.push_back(sighting);
  }
}

}  // namespace hallway::slam_plane

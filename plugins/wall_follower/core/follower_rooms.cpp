// SPDX-License-Identifier: MIT
// A room into which the followed wall leads: its lap is taken back, and the robot leaves it.
#include "wall_follower/core/follower.hpp"

namespace hallway::wall_follower {
namespace {

constexpr std::size_t kLeastLead = 3;  // landmarks of a wall before a room into which it leads
constexpr double kLongestRoom = 16.0;  // round a room [m]
constexpr double kSameOpening = 0.75;  // an opening that is seen again is within this [m]

}  // namespace

/// Whether the loop is one round a room into which the wall led that is followed: it is not that wall's.
bool Follower::is_side_room() const {
  if (verdict_.circuit) return false;
  const std::span<const Node> wall = chart_.wall();
  const SameLandmark& joint = verdict_.same.front();
  const Node &first = wall[joint.first], &again = wall[joint.again];
  return joint.first >= kLeastLead && again.quarter > first.quarter &&
         again.way_m - first.way_m < kLongestRoom;
}

/// Whether the wall that is followed has led into a room and more than once round it, whatever its landmarks say.
bool Follower::has_turned_round() const {
  const std::span<const Node> wall = chart_.wall();
  for (std::size_t i = wall.size(); i-- > kLeastLead;) {
    if (wall.back().way_m - wall[i].way_m > kLongestRoom) return false;
    if (wall.back().quarter - wall[i].quarter > kWholeTurn) return true;
  }
  return false;
}

/// The lap of a room is taken back, and at the next opening the robot turns right, out of it: so the wall goes on.
void Follower::leave_room() {
  const std::span<const Node> wall = chart_.wall();
  const SameLandmark joint = from_surest(chart_, verdict_.same).front();
  // The robot is where it was at the first sight of the last landmark.
  take_back_lap(wall[joint.first], wall[joint.again],
                first_sight(verdict_.same, verdict_.same.back().again) + 1);
  verdict_ = {};
  if (chart_.circuits.empty()) chart_.loop = Loop::open;
  is_opening_charted_ = true;
  is_leaving_room_ = true;
  news_.push_back("the wall has led into a room, which the robot leaves");
}

/// As if the way from the first sight of a landmark to its second one had not been driven. @param kept  landmarks of the wall before that
void Follower::take_back_lap(const Node& first_sight, const Node& second_sight, std::size_t kept) {
  const Node first = first_sight, again = second_sight;
  const double lap = again.way_m - first.way_m;
  correct({again.at, first.at, first.quarter - again.quarter});
  odometer_.take_back(lap);
  for (double* way : {&last_right_.way_m, &swept_.way_m, &right_again_way_, &entered_way_, &keep_until_,
                      &scraped_until_, &bump_way_, &straight_from_})
    *way -= lap;
  const std::span<const Node> wall = chart_.wall();
  std::vector<std::uint32_t> out;
  for (std::size_t i = kept; i < wall.size(); ++i) out.push_back(wall[i].id);
  chart_.remove(out);
  loops_.forget(kept);
  explorer_.forget(chart_.nodes.back().way_m);
  wall_.expect(last_right_.at, wall_.direction());
}

/// At the opening of a room that the robot leaves: where it was passed once before, the lap since then is taken back.
void Follower::open_door() {
  const std::span<const Node> wall = chart_.wall();
  const Vec2 at = swept_.from.out(swept_.body);
  const int quarter = odometer_.quarter(wall_.slant(odometer_.reckoned()));
  for (std::size_t i = 0; i < wall.size(); ++i) {
    const bool is_it = wall[i].kind == Kind::room && quarter - wall[i].quarter == kWholeTurn &&
                       (wall[i].at - at).norm() < kSameOpening;
    if (!is_it) continue;
    Node again = wall[i];
    again.at = at;
    again.way_m = swept_.way_m;
    again.quarter = quarter;
    chart_.node(wall[i].id).kind = Kind::junction;
    take_back_lap(wall[i], again, i + 1);
    is_opening_charted_ = true;
    return;
  }
}

}  // namespace hallway::wall_follower

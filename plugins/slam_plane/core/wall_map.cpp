// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::slam_plane {
namespace {

constexpr double kOff_m = 0.05;    // of an observation from its wall, more than noise is likely to do
constexpr double kOff_rad = 0.05;  // likewise
constexpr std::uint32_t kDynamicOutliers = 8;  // in a row
constexpr double kDynamicMove_m = 0.15;        // across the line, between the first and the last of them
constexpr double kDynamicTurn_rad = 0.15;      // or that much turned
constexpr bool kBoth[2] = {true, true};
constexpr double kLargestTurn_rad = 1e-3;  // of a wall against the basis of its sums, which is for small ones

WallBasis moved(const Pose2& T, const WallBasis& basis) {
  return {T * basis.origin, T.rotate(basis.direction)};
}

void estimate_member(Member& member, const Noise& noise) {
  const WallBasis basis = member.evidence.count() > 1 ? member.estimate.basis : member.evidence.basis();
  if (!solve(member.evidence.form(basis, noise), basis, kBoth, member.estimate)) return;
  for (int k = 0; k < 2; ++k)
    member.estimate.reach[k] = member.estimate.basis.along(member.evidence.reach(k));
}

}  // namespace

WallMap::WallMap(const Options& options)
    : noise_(options.noise()), corner_sightings_(static_cast<std::uint32_t>(options.corner_sightings)) {}

Index WallMap::add_submap(const Pose2& T_map_submap, bool lines_only, std::uint32_t epoch) {
  SubmapRecord& submap = submaps.emplace_back();
  submap.T_map_submap = T_map_submap;
  submap.lines_only = lines_only;
  submap.epoch = epoch;
  return submaps.size() - 1;
}

Index WallMap::add_wall(std::uint32_t epoch, std::uint64_t iteration) {
  WallRecord& wall = walls.emplace_back();
  wall.epoch = epoch;
  wall.last_seen = iteration;
  return walls.size() - 1;
}

Index WallMap::join(Index submap, Index wall, bool in_first_frame) {
  SubmapRecord& record = submaps[submap];
  const Index member = record.members.size();
  record.members.push_back({wall, in_first_frame, {}, {}});
  if (in_first_frame) ++record.first_frame_size;
  walls[wall].memberships.push_back({submap, member});
  if (submap == active_) walls[wall].active_member = member;
  return member;
}

void WallMap::activate(Index submap) {
  if (active_ != kNone) {
    for (const Member& member : submaps[active_].members) {
      if (member.wall != kNone) deactivate(walls[member.wall]);
    }
  }
  active_ = submap;
  if (active_ == kNone) return;
  const std::vector<Member>& members = submaps[active_].members;
  for (Index m = 0; m < members.size(); ++m) {
    if (members[m].wall == kNone) continue;
    walls[members[m].wall].active_member = m;
    sum_inactive(walls[members[m].wall]);
  }
}

void WallMap::add_form(const Membership& at, const WallBasis& basis, WallForm& form, double (&reach)[2],
                       bool& first) const {
  const SubmapRecord& submap = submaps[at.submap];
  const WallEvidence& evidence = submap.members[at.member].evidence;
  if (evidence.count() == 0) return;
  form.add(evidence.form(moved(submap.T_map_submap.inverse(), basis), noise_));
  const double a = basis.along(submap.T_map_submap * evidence.reach(kEndA));
  const double b = basis.along(submap.T_map_submap * evidence.reach(kEndB));
  reach[kEndA] = first ? a : std::min(reach[kEndA], a);
  reach[kEndB] = first ? b : std::max(reach[kEndB], b);
  first = false;
}

/// Sums up all but the active submap.
void WallMap::sum_inactive(WallRecord& wall) {
  wall.inactive = WallForm{};
  wall.inactive_basis = wall.estimate.basis;
  wall.has_inactive = false;
  bool first = true;
  for (const Membership& at : wall.memberships) {
    if (at.submap == active_) continue;
    add_form(at, wall.inactive_basis, wall.inactive, wall.inactive_reach, first);
  }
  wall.has_inactive = !first;
}

/// Takes what the active submap tells into the sum of what the others do; that submap is no longer active.
void WallMap::deactivate(WallRecord& wall) {
  const Membership at{active_, wall.active_member};
  wall.active_member = kNone;
  const double turn = cross(wall.inactive_basis.direction, wall.estimate.basis.direction);
  if (!wall.has_inactive || std::abs(turn) > kLargestTurn_rad) {
    const Index active = std::exchange(active_, kNone);
    sum_inactive(wall);
    active_ = active;
    return;
  }
  bool first = false;
  add_form(at, wall.inactive_basis, wall.inactive, wall.inactive_reach, first);
}

void WallMap::observe(Index m, const Pose2& T_submap_robot, const AssociatedObservation& observation,
                      const bool (&corner)[2]) {
  Member& member = submaps[active_].members[m];
  WallRecord& wall = walls[member.wall];
  member.evidence.add(T_submap_robot, observation, corner, noise_);
  estimate_member(member, noise_);
  ++wall.count;
  const double share = 1.0 / wall.count;
  wall.z_low += share * (observation.z_low - wall.z_low);
  wall.z_high += share * (observation.z_high - wall.z_high);
  for (int k = 0; k < 2; ++k) {
    if (corner[k] && wall.corners[k]++ == 0) wall.corner_epoch[k] = submaps[active_].epoch;
  }
}

void WallMap::update(Index w) {
  WallRecord& wall = walls[w];
  if (!wall.has_inactive) {  // nothing else to go by yet: the active submap's own line is the basis
    for (const Membership& at : wall.memberships) {
      const Member& member = submaps[at.submap].members[at.member];
      if (at.submap == active_ && member.evidence.count() > 0)
        wall.inactive_basis = moved(submaps[active_].T_map_submap, member.estimate.basis);
    }
  }
  WallForm form = wall.inactive;
  double reach[2] = {wall.inactive_reach[kEndA], wall.inactive_reach[kEndB]};
  bool first = !wall.has_inactive;
  if (wall.active_member != kNone) {
    add_form({active_, wall.active_member}, wall.inactive_basis, form, reach, first);
  }
  const bool use[2] = {is_corner(wall, kEndA), is_corner(wall, kEndB)};
  if (first || !solve(form, wall.inactive_basis, use, wall.estimate)) return;
  for (int k = 0; k < 2; ++k)
    wall.estimate.reach[k] = wall.estimate.known[k] ? wall.estimate.end[k] : reach[k];
  index_.put(w, wall.estimate.extent(kEndA), wall.estimate.extent(kEndB));
}

void WallMap::refresh(Index w) {
  WallRecord& wall = walls[w];
  if (wall.merged_into != kNone || wall.memberships.empty()) return;
  // The first submap says about where it is now; the basis of the sums is to be near the line.
  const Membership& at = wall.memberships.front();
  wall.estimate.basis =
      moved(submaps[at.submap].T_map_submap, submaps[at.submap].members[at.member].estimate.basis);
  sum_inactive(wall);
  update(w);
  sum_inactive(wall);
  update(w);
}

void WallMap::refresh_all() {
  for (Index w = 0; w < walls.size(); ++w) refresh(w);
}

void WallMap::note_trail(Index w, std::uint64_t iteration, const Pose2& T_map_robot,
                         const AssociatedObservation& observation) {
  WallRecord& wall = walls[w];
  wall.trail_seen = iteration;
  wall.trail.basis = {T_map_robot * observation.middle, T_map_robot.rotate(observation.direction)};
  wall.trail.reach[kEndA] = -0.5 * observation.length;
  wall.trail.reach[kEndB] = 0.5 * observation.length;
  const WallBasis& basis = wall.estimate.basis;
  wall.trail_is_off = std::abs(basis.across(wall.trail.basis.origin)) > kOff_m ||
                      std::abs(cross(basis.direction, wall.trail.basis.direction)) > kOff_rad;
}

bool WallMap::note_outlier(Index w) {
  WallRecord& wall = walls[w];
  if (wall.outliers++ == 0) wall.outliers_begin = wall.trail.basis;
  bool turns_dynamic = false;
  if (!wall.is_dynamic && wall.outliers >= kDynamicOutliers) {
    const double move = wall.outliers_begin.across(wall.trail.basis.origin);
    const double turn = angle_between(wall.outliers_begin.direction, wall.trail.basis.direction);
    turns_dynamic = std::abs(move) > kDynamicMove_m || std::abs(turn) > kDynamicTurn_rad;
  }
  if (turns_dynamic) make_dynamic(w);
  if (wall.is_dynamic) place_dynamic(w);
  return turns_dynamic;
}

/// Takes a wall out of all submaps.
void WallMap::make_dynamic(Index w) {
  WallRecord& wall = walls[w];
  wall.is_dynamic = true;
  for (const Membership& at : wall.memberships) {
    SubmapRecord& submap = submaps[at.submap];
    if (submap.members[at.member].in_first_frame) --submap.first_frame_size;
    submap.members[at.member] = Member{};
  }
  wall.memberships.clear();
  wall.active_member = kNone;
  wall.inactive = WallForm{};
  wall.has_inactive = false;
}

void WallMap::place_dynamic(Index w) {
  WallRecord& wall = walls[w];
  wall.estimate = wall.trail;
  wall.estimate.p_tt = noise_.angle * noise_.angle;
  wall.estimate.p_oo = noise_.normal * noise_.normal;
  index_.put(w, wall.estimate.extent(kEndA), wall.estimate.extent(kEndB));
}

void WallMap::revoke_corner(Index w, int end) {
  WallRecord& wall = walls[w];
  for (const Membership& at : wall.memberships) {
    Member& member = submaps[at.submap].members[at.member];
    member.evidence.forget_end(end);
    estimate_member(member, noise_);
  }
  wall.corners[end] = wall.against[end] = wall.astray[end] = 0;
  sum_inactive(wall);
  update(w);
}

void WallMap::merge(Index into, Index from) {
  WallRecord& kept = walls[into];
  WallRecord& gone = walls[from];
  for (const Membership& at : gone.memberships) {
    SubmapRecord& submap = submaps[at.submap];
    Member& member = submap.members[at.member];
    const auto same = std::ranges::find(kept.memberships, at.submap, &Membership::submap);
    if (same == kept.memberships.end()) {
      member.wall = into;
      kept.memberships.push_back(at);
      if (at.submap == active_) kept.active_member = at.member;
      continue;
    }
    Member& other = submap.members[same->member];
    other.evidence.add(Pose2{}, member.evidence);
    if (member.in_first_frame) {
      if (other.in_first_frame) --submap.first_frame_size;
      other.in_first_frame = true;
    }
    estimate_member(other, noise_);
    member = Member{};
  }
  const double share = static_cast<double>(gone.count) / std::max(1u, kept.count + gone.count);
  kept.z_low += share * (gone.z_low - kept.z_low);
  kept.z_high += share * (gone.z_high - kept.z_high);
  kept.count += gone.count;
  for (int k = 0; k < 2; ++k) {
    const bool both = kept.corners[k] > 0 && gone.corners[k] > 0;
    if (both) kept.corner_epoch[k] = std::min(kept.corner_epoch[k], gone.corner_epoch[k]);
    if (kept.corners[k] == 0) kept.corner_epoch[k] = gone.corner_epoch[k];
    kept.corners[k] += gone.corners[k];
  }
  for (int k = 0; k < 2; ++k) {  // what is known of the end that is farther out

    if (outward(k) * (kept.estimate.basis.along(gone.estimate.extent(k)) - kept.estimate.reach[k]) > 0.0)
      kept.hidden[k] = gone.hidden[k];
  }
  kept.last_seen = std::max(kept.last_seen, gone.last_seen);
  kept.epoch = std::min(kept.epoch, gone.epoch);
  gone.memberships.clear();
  gone.active_member = kNone;
  gone.merged_into = into;
  index_.remove(from);
  refresh(into);
}

Index WallMap::resolve(Index wall) const {
  while (wall != kNone && walls[wall].merged_into != kNone) wall = walls[wall].merged_into;
  return wall;
}

void WallMap::shift(std::uint32_t epoch, const Vec2& step) {
  for (SubmapRecord& submap : submaps) {
    if (submap.epoch >= epoch) submap.T_map_submap.t += step;
  }
  for (WallRecord& wall : walls) wall.trail_seen = 0;
}

}  // namespace hallway::slam_plane

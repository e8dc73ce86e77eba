// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_map.hpp"

#include <algorithm>

namespace hallway::slam_plane {
namespace {

constexpr bool kBoth[2] = {true, true};

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
  submaps.emplace_back();
  submaps.back().T_map_submap = T_map_submap;
  submaps.back().lines_only = lines_only;
  submaps.back().epoch = epoch;
  return static_cast<Index>(submaps.size() - 1);
}

Index WallMap::add_wall(std::uint32_t epoch, std::uint64_t iteration) {
  walls.emplace_back();
  walls.back().epoch = epoch;
  walls.back().last_seen = iteration;
  return static_cast<Index>(walls.size() - 1);
}

Index WallMap::join(Index submap, Index wall, bool in_first_frame) {
  SubmapRecord& record = submaps[submap];
  const auto member = static_cast<Index>(record.members.size());
  record.members.emplace_back();
  record.members.back().wall = wall;
  record.members.back().in_first_frame = in_first_frame;
  if (in_first_frame) ++record.first_frame_size;
  walls[wall].memberships.push_back({submap, member});
  if (submap == active_) {
    walls[wall].active_member = member;
    settle(walls[wall]);
  }
  return member;
}

void WallMap::activate(Index submap) {
  if (active_ != kNone) {
    for (const Member& member : submaps[active_].members) {
      if (member.wall != kNone) walls[member.wall].active_member = kNone;
    }
  }
  active_ = submap;
  if (active_ == kNone) return;
  const std::vector<Member>& members = submaps[active_].members;
  for (Index m = 0; m < members.size(); ++m) {
    if (members[m].wall == kNone) continue;
    walls[members[m].wall].active_member = m;
    settle(walls[members[m].wall]);
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
void WallMap::settle(WallRecord& wall) {
  wall.settled = WallForm{};
  wall.settled_basis = wall.estimate.basis;
  wall.has_settled = false;
  bool first = true;
  for (const Membership& at : wall.memberships) {
    if (at.submap == active_) continue;
    add_form(at, wall.settled_basis, wall.settled, wall.settled_reach, first);
  }
  wall.has_settled = !first;
}

void WallMap::observe(Index m, const Pose2& T_submap_robot, const Sighting& sighting,
                      const bool (&corner)[2]) {
  Member& member = submaps[active_].members[m];
  WallRecord& wall = walls[member.wall];
  member.evidence.add(T_submap_robot, sighting, corner, noise_);
  estimate_member(member, noise_);
  ++wall.count;
  const double share = 1.0 / wall.count;
  wall.z_low += share * (sighting.z_low - wall.z_low);
  wall.z_high += share * (sighting.z_high - wall.z_high);
  for (int k = 0; k < 2; ++k) {
    if (corner[k] && wall.corners[k]++ == 0) wall.corner_epoch[k] = submaps[active_].epoch;
  }
}

void WallMap::update(Index w) {
  WallRecord& wall = walls[w];
  if (!wall.has_settled) {  // nothing else to go by yet: the active submap's own line is the basis
    for (const Membership& at : wall.memberships) {
      const Member& member = submaps[at.submap].members[at.member];
      if (at.submap == active_ && member.evidence.count() > 0)
        wall.settled_basis = moved(submaps[active_].T_map_submap, member.estimate.basis);
    }
  }
  WallForm form = wall.settled;
  double reach[2] = {wall.settled_reach[kEndA], wall.settled_reach[kEndB]};
  bool first = !wall.has_settled;
  if (wall.active_member != kNone) {
    add_form({active_, wall.active_member}, wall.settled_basis, form, reach, first);
  }
  const bool use[2] = {is_corner(wall, kEndA), is_corner(wall, kEndB)};
  if (first || !solve(form, wall.settled_basis, use, wall.estimate)) return;
  for (int k = 0; k < 2; ++k)
    wall.estimate.reach[k] = wall.estimate.known[k] ? wall.estimate.end[k] : reach[k];
  index_.put(w, wall.estimate.basis.point(wall.estimate.reach[kEndA]),
             wall.estimate.basis.point(wall.estimate.reach[kEndB]));
}

void WallMap::refresh(Index w) {
  WallRecord& wall = walls[w];
  if (wall.merged_into != kNone || wall.memberships.empty()) return;
  // The first submap says about where it is now; the basis of the sums is to be near the line.
  const Membership& at = wall.memberships.front();
  wall.estimate.basis =
      moved(submaps[at.submap].T_map_submap, submaps[at.submap].members[at.member].estimate.basis);
  settle(wall);
  update(w);
  settle(wall);
  update(w);
}

void WallMap::refresh_all() {
  for (Index w = 0; w < walls.size(); ++w) refresh(w);
}

void WallMap::revoke_corner(Index w, int end) {
  WallRecord& wall = walls[w];
  for (const Membership& at : wall.memberships) {
    Member& member = submaps[at.submap].members[at.member];
    member.evidence.forget_end(end);
    estimate_member(member, noise_);
  }
  wall.corners[end] = wall.against[end] = wall.astray[end] = 0;
  settle(wall);
  update(w);
}

void WallMap::merge(Index into, Index from) {
  WallRecord& kept = walls[into];
  WallRecord& gone = walls[from];
  for (const Membership& at : gone.memberships) {
    SubmapRecord& submap = submaps[at.submap];
    Member& member = submap.members[at.member];
    const auto same = std::find_if(kept.memberships.begin(), kept.memberships.end(),
                                   [&](const Membership& m) { return m.submap == at.submap; });
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
  refresh_all();
}

}  // namespace hallway::slam_plane

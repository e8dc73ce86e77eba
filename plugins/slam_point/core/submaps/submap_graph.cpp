// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/submap_graph.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace hallway::slam_point {

void Member::average(const Vec3& p, double observation_weight, const Mat3& information, Mat3& known) {
  ++count;
  quality += (observation_weight - quality) / static_cast<double>(count);
  known += information;
  mean = count == 1 ? p : Vec3(mean + known.inverse() * (information * (p - mean)));
}

Index SubmapGraph::add_submap(const Pose& T_map_submap) {
  submaps.emplace_back();
  submaps.back().part = part_;
  submaps.back().held = submaps.size() == 1;
  poses.push_back(T_map_submap);
  return static_cast<Index>(submaps.size() - 1);
}

Index SubmapGraph::add_landmark(const Vec3& position, std::uint64_t activation) {
  LandmarkRecord record;
  record.position = position;
  record.last_activation = activation;
  record.part = part_;
  landmarks.push_back(std::move(record));
  if (is_directional()) informations.emplace_back();
  grid_.add(position);
  return static_cast<Index>(landmarks.size() - 1);
}

Index SubmapGraph::join(Index submap, Index landmark, const Vec3& mean, bool in_first_frame) {
  SubmapRecord& record = submaps[submap];
  const auto member = static_cast<Index>(record.members.size());
  record.members.push_back({landmark, 0, in_first_frame, mean});
  if (is_directional()) record.informations.emplace_back(Mat3::Zero());
  if (in_first_frame) ++record.first_frame_size;
  landmarks[landmark].memberships.push_back({submap, member});
  if (submap == active_) landmarks[landmark].active_member = member;
  return member;
}

void SubmapGraph::activate(Index submap) {
  active_ = submap;
  from_active_ = PointMotion(poses[submap]);
  const std::vector<Member>& members = submaps[submap].members;
  motions_.begin(submaps.size());
  for (Index m = 0; m < members.size(); ++m) {
    if (members[m].count == 0) continue;  // emptied by a merge
    landmarks[members[m].landmark].active_member = m;
    sum_up(members[m].landmark);
  }
}

void SubmapGraph::deactivate() {
  const Index closed = active_;
  active_ = kNone;
  for (const Member& member : submaps[closed].members) {
    LandmarkRecord& landmark = landmarks[member.landmark];
    landmark.active_member = kNone;
    if (member.count == 0) continue;  // emptied by a merge
    if (is_directional()) {
      sum_up_directional(member.landmark);
      continue;
    }
    landmark.settled_sum += member.weight() * (from_active_ * member.mean);
    landmark.settled_count += member.count;
    landmark.settled_weight += member.weight();
    landmark.count = landmark.settled_count;
    landmark.weight = landmark.settled_weight;
    landmark.position = landmark.settled_sum / landmark.weight;
    grid_.move(member.landmark, landmark.position);
  }
}

void SubmapGraph::take_moved(const std::vector<Index>& moved_landmarks) {
  if (active_ != kNone) from_active_ = PointMotion(poses[active_]);
  motions_.begin(submaps.size());
  for (const Index landmark : moved_landmarks) sum_up(landmark);
}

void SubmapGraph::observe(Index member, const Vec3& p, std::uint64_t activation, double weight) {
  Member& m = submaps[active_].members[member];
  LandmarkRecord& landmark = landmarks[m.landmark];
  m.average(p, weight);
  landmark.count = landmark.settled_count + m.count;
  const Vec3 here = from_active_ * m.mean;
  landmark.weight = landmark.settled_weight + m.weight();
  landmark.position = (landmark.settled_sum + m.weight() * here) * (1.0 / landmark.weight);
  landmark.last_activation = activation;
  grid_.move(m.landmark, landmark.position);
}

void SubmapGraph::observe(Index member, const Vec3& p, std::uint64_t activation, double weight,
                          const Mat3& information) {
  SubmapRecord& submap = submaps[active_];
  Member& m = submap.members[member];
  LandmarkRecord& landmark = landmarks[m.landmark];
  LandmarkInformation& known = informations[m.landmark];
  m.average(p, weight, information, submap.informations[member]);
  const Evidence here = evidence({active_, member}, poses[active_]);
  known.whole = known.settled + here.information;
  landmark.count = landmark.settled_count + m.count;
  landmark.weight = landmark.settled_weight + m.weight();
  landmark.position = known.whole.inverse() * (landmark.settled_sum + here.information * here.place);
  landmark.last_activation = activation;
  grid_.move(m.landmark, landmark.position);
}

SubmapGraph::Evidence SubmapGraph::evidence(const Membership& at, const Pose& T_map_submap) const {
  const SubmapRecord& submap = submaps[at.submap];
  const Mat3 turn = T_map_submap.q.toRotationMatrix();
  return {turn * submap.members[at.member].mean + T_map_submap.t,
          turn * submap.informations[at.member] * turn.transpose()};
}

void SubmapGraph::sum_up_directional(Index index) {
  LandmarkRecord& landmark = landmarks[index];
  LandmarkInformation& known = informations[index];
  known = LandmarkInformation();
  landmark.settled_sum.setZero();
  landmark.settled_count = landmark.count = 0;
  landmark.settled_weight = landmark.weight = 0.0;
  Vec3 sum = Vec3::Zero();
  for (const Membership& at : landmark.memberships) {
    const Member& member = submaps[at.submap].members[at.member];
    const Evidence here = evidence(at, poses[at.submap]);
    const Vec3 weighted = here.information * here.place;
    known.whole += here.information;
    sum += weighted;
    landmark.count += member.count;
    landmark.weight += member.weight();
    if (at.submap == active_) continue;
    known.settled += here.information;
    landmark.settled_sum += weighted;
    landmark.settled_count += member.count;
    landmark.settled_weight += member.weight();
  }
  if (landmark.count == 0) return;
  landmark.position = known.whole.inverse() * sum;
  grid_.move(index, landmark.position);
}

void SubmapGraph::resum(Index index) {
  motions_.begin(submaps.size());
  sum_up(index);
}

/// Sums a landmark up in the round that was begun last: poses have not changed since.
void SubmapGraph::sum_up(Index index) {
  if (is_directional()) return sum_up_directional(index);
  LandmarkRecord& landmark = landmarks[index];
  landmark.settled_sum.setZero();
  landmark.settled_count = 0;
  landmark.settled_weight = 0.0;
  Vec3 active_sum = Vec3::Zero();
  std::uint32_t active_count = 0;
  double active_weight = 0.0;
  for (const Membership& at : landmark.memberships) {
    const Member& member = submaps[at.submap].members[at.member];
    const Vec3 weighted = member.weight() * (motions_.of(at.submap, poses) * member.mean);
    if (at.submap == active_) {
      active_sum = weighted;
      active_count = member.count;
      active_weight = member.weight();
    } else {
      landmark.settled_sum += weighted;
      landmark.settled_count += member.count;
      landmark.settled_weight += member.weight();
    }
  }
  landmark.count = landmark.settled_count + active_count;
  landmark.weight = landmark.settled_weight + active_weight;
  if (landmark.count == 0) return;
  landmark.position = (landmark.settled_sum + active_sum) / landmark.weight;
  grid_.move(index, landmark.position);
}

Vec3 SubmapGraph::mean_position(Index landmark) const {
  if (is_directional()) {
    Vec3 weighted = Vec3::Zero();
    Mat3 whole = Mat3::Zero();
    for (const Membership& at : landmarks[landmark].memberships) {
      const Evidence here = evidence(at, poses[at.submap]);
      weighted += here.information * here.place;
      whole += here.information;
    }
    return whole.inverse() * weighted;
  }
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (const Membership& at : landmarks[landmark].memberships) {
    const Member& member = submaps[at.submap].members[at.member];
    sum += member.weight() * (poses[at.submap] * member.mean);
    weight += member.weight();
  }
  return sum / weight;
}

void SubmapGraph::merge(Index into, Index from) {
  LandmarkRecord& kept = landmarks[into];
  LandmarkRecord& given = landmarks[from];
  for (const Membership& at : given.memberships) {
    std::vector<Member>& members = submaps[at.submap].members;
    Member& member = members[at.member];
    member.landmark = into;
    const auto same = std::find_if(kept.memberships.begin(), kept.memberships.end(),
                                   [&](const Membership& m) { return m.submap == at.submap; });
    if (same == kept.memberships.end()) {
      kept.memberships.push_back(at);
      continue;
    }
    // A submap that knew both: one member takes all, the other stays as an empty place so that no number changes.
    Member& whole = members[same->member];
    const double weight = whole.weight() + member.weight();
    whole.count += member.count;
    if (whole.count > 0 && is_directional()) {
      std::vector<Mat3>& known = submaps[at.submap].informations;
      const Mat3 both = known[same->member] + known[at.member];
      whole.mean += both.inverse() * (known[at.member] * (member.mean - whole.mean));
      whole.quality = weight / static_cast<double>(whole.count);
      known[same->member] = both;
      known[at.member].setZero();
    } else if (whole.count > 0) {
      whole.mean += (member.mean - whole.mean) * (member.weight() / weight);
      whole.quality = weight / static_cast<double>(whole.count);
    }
    if (member.in_first_frame && whole.in_first_frame) --submaps[at.submap].first_frame_size;
    whole.in_first_frame = whole.in_first_frame || member.in_first_frame;
    member.in_first_frame = false;
    member.count = 0;
  }
  if (given.active_member != kNone) kept.active_member = given.active_member;
  given.active_member = kNone;
  kept.last_activation = std::max(kept.last_activation, given.last_activation);
  given.memberships.clear();
  given.count = 0;
  given.weight = 0.0;
  given.settled_count = 0;
  given.settled_weight = 0.0;
  given.merged_into = into;
  if (is_directional()) informations[from] = LandmarkInformation();
  grid_.remove(from);
  resum(into);
}

void SubmapGraph::drop(Index submap) {
  SubmapRecord& record = submaps[submap];
  for (const Member& member : record.members) {
    LandmarkRecord& landmark = landmarks[member.landmark];
    if (member.count == 0 || landmark.part == kNone) continue;
    std::erase_if(landmark.memberships, [&](const Membership& at) { return at.submap == submap; });
    if (!landmark.memberships.empty()) {
      resum(member.landmark);
      continue;
    }
    landmark.count = 0;
    landmark.settled_count = 0;
    landmark.weight = 0.0;
    landmark.settled_weight = 0.0;
    landmark.part = kNone;
    if (is_directional()) informations[member.landmark] = LandmarkInformation();
    ++dropped_;
    grid_.remove(member.landmark);
  }
  record.members = {};
  record.informations = {};
  record.first_frame_size = 0;
  record.part = kNone;
  record.held = true;
}

void SubmapGraph::withdraw(Index index) {
  LandmarkRecord& landmark = landmarks[index];
  for (const Membership& at : landmark.memberships) {
    Member& member = submaps[at.submap].members[at.member];
    if (member.in_first_frame) --submaps[at.submap].first_frame_size;
    member.in_first_frame = false;
    member.count = 0;
    if (is_directional()) submaps[at.submap].informations[at.member].setZero();
  }
  landmark.memberships.clear();
  landmark.count = 0;
  landmark.weight = 0.0;
  landmark.settled_count = 0;
  landmark.settled_weight = 0.0;
  landmark.settled_sum.setZero();
  landmark.active_member = kNone;
  landmark.moving = true;
  if (is_directional()) informations[index] = LandmarkInformation();
  grid_.remove(index);
}

void SubmapGraph::clear() {
  landmarks.clear();
  submaps.clear();
  poses.clear();
  informations.clear();
  grid_.clear();
  active_ = kNone;
  part_ = 0;
  dropped_ = 0;
}

}  // namespace hallway::slam_point

// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/reduced_system.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "slam_point/core/fit/directional_fit.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kDamping = 1e-10;    // of the diagonal: keeps a direction nothing determines from moving
constexpr double kPairProducts = 24;  // multiplications for one landmark that two submaps share
constexpr double kDirectionalPairProducts = 160;  // likewise, where noise has directions
constexpr int kCentrePasses = 3;                  // the first counts all evidence in full

/// What evidence counts for beside such as agrees with its landmark, `squared` away from it in units of its noise.
double share_of(double squared, double inlier2) {
  return squared <= inlier2 ? 1.0 : inlier2 / squared;
}

}  // namespace

// With J = [I, -[y]x] for (translation, rotation) of x = exp(rotation) y + t: J_row^T J_column = [I, -[y_column]x;
// [y_row]x, (y_row . y_column) I - y_column y_row^T].
ReducedSystem::Block ReducedSystem::expand(const PairSums& sums) {
  const double weight = sums.products(0, 0);
  const Vec3 row = sums.products.bottomLeftCorner<3, 1>();
  const Vec3 column = sums.products.topRightCorner<1, 3>();
  const Mat3 outer = sums.products.bottomRightCorner<3, 3>();
  const double trace = outer.trace();
  Block block;
  block << weight, 0.0, 0.0, 0.0, column.z(), -column.y(),                      //
      0.0, weight, 0.0, -column.z(), 0.0, column.x(),                           //
      0.0, 0.0, weight, column.y(), -column.x(), 0.0,                           //
      0.0, -row.z(), row.y(), trace - outer(0, 0), -outer(1, 0), -outer(2, 0),  //
      row.z(), 0.0, -row.x(), -outer(0, 1), trace - outer(1, 1), -outer(2, 1),  //
      -row.y(), row.x(), 0.0, -outer(0, 2), -outer(1, 2), trace - outer(2, 2);
  return block;
}

void ReducedSystem::take(const SubmapGraph& graph, const std::vector<Index>& free,
                         const std::vector<Pose>& poses, const Grouping& grouping) {
  planar_ = graph.planar;
  directional_ = graph.is_directional();
  choose(graph, free);
  make_groups(graph, free, poses, grouping);
  take_evidence(graph, poses);
  take_places();
  take_means(graph, poses);
  row_.resize(directional_ ? 0 : rows());
  row_blocks_.resize(directional_ ? rows() : 0);
  in_row_.assign(rows(), 0);
}

void ReducedSystem::take_all(const SubmapGraph& graph, BlockCholesky& factor) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  take(graph, all, graph.poses);
  factor.begin(rows());
  double work = 0.0;
  for (Index row = 0; row < rows(); ++row)
    make_row(row, work, [&](Index column, const Block& block) { factor.add(row, column, block); });
  if (!free_.empty()) factor.analyse();
}

void ReducedSystem::choose(const SubmapGraph& graph, const std::vector<Index>& free) {
  for (const Index landmark : touched_) marked_[landmark] = 0;
  for (const Index submap : free_) slot_[submap] = kNone;
  slot_.resize(graph.submaps.size(), kNone);
  alone_.resize(graph.submaps.size(), 0);
  marked_.resize(graph.landmarks.size(), 0);
  seen_by_.resize(graph.landmarks.size(), 0);
  place_.resize(graph.landmarks.size());
  touched_.clear();
  newest_.clear();
  free_.clear();
  for (const Index submap : free) {
    if (!graph.submaps[submap].held) free_.push_back(submap);
  }
  std::sort(free_.begin(), free_.end());
}

/// Gives each free submap its row.
void ReducedSystem::make_groups(const SubmapGraph& graph, const std::vector<Index>& free,
                                const std::vector<Pose>& poses, const Grouping& grouping) {
  origins_.clear();
  const std::size_t most = directional_ ? 1 : grouping.most;
  const std::size_t alone = std::min(grouping.alone, free.size());
  const auto first_alone = free.end() - static_cast<std::ptrdiff_t>(alone);
  std::for_each(first_alone, free.end(), [&](Index submap) { alone_[submap] = 1; });
  std::size_t room = 0;  // in the group under way
  for (std::size_t f = 0; f < free_.size(); ++f) {
    const Index submap = free_[f];
    const Index before = f > 0 ? free_[f - 1] : submap;
    const bool follows = most > 1 && continues(graph, submap, before) && f > 0;
    if (!follows || room == 0 || alone_[submap] != 0 || alone_[before] != 0) {
      room = origins_.empty() ? std::min(grouping.first, most) : most;
      origins_.push_back(poses[submap].t);
    }
    --room;
    slot_[submap] = static_cast<Index>(origins_.size() - 1);
  }
  std::for_each(first_alone, free.end(), [&](Index submap) { alone_[submap] = 0; });
}

/// Whether a submap holds at least half of its landmarks in common with the one that was asked about just before.
bool ReducedSystem::continues(const SubmapGraph& graph, Index submap, Index before) {
  std::size_t shared = 0;
  for (const Member& member : graph.submaps[submap].members) {
    if (seen_by_[member.landmark] == before + 1) ++shared;
    seen_by_[member.landmark] = submap + 1;
  }
  return 2 * shared >= graph.submaps[submap].members.size();
}

void ReducedSystem::take_evidence(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  evidence_.clear();
  informations_.clear();
  evidence_start_.clear();
  for (const Index submap : free_) {
    if (slot_[submap] == evidence_start_.size())
      evidence_start_.push_back(static_cast<Index>(evidence_.size()));
    take_submap(graph, poses[submap], submap);
  }
  evidence_start_.push_back(static_cast<Index>(evidence_.size()));
}

void ReducedSystem::take_submap(const SubmapGraph& graph, const Pose& pose, Index submap) {
  const SubmapRecord& record = graph.submaps[submap];
  const PointMotion from_origin(Pose{pose.q, pose.t - origins_[slot_[submap]]});
  const Mat3 rotation = pose.q.toRotationMatrix();
  for (std::size_t m = 0; m < record.members.size(); ++m) {
    const Member& member = record.members[m];
    if (member.count == 0) continue;  // keeps its place, and says nothing
    const Vec3 y = from_origin * member.mean;
    const double weight = member.weight();
    const auto next = static_cast<Index>(evidence_.size());
    if (marked_[member.landmark] == 0) {
      marked_[member.landmark] = 1;
      place_[member.landmark] = static_cast<Index>(touched_.size());
      touched_.push_back(member.landmark);
      newest_.push_back(next);
    }
    const Index touched = place_[member.landmark];
    const Index known = newest_[touched];
    if (known != next && known >= evidence_start_.back()) {
      Evidence& whole = evidence_[known];
      whole.count += weight;
      whole.y += (weight / whole.count) * (y - whole.y);
      continue;
    }
    newest_[touched] = next;
    evidence_.push_back({y, weight, touched});
    if (directional_) informations_.emplace_back(rotation * record.informations[m] * rotation.transpose());
  }
}

/// Takes down where each landmark stands, in the order of rows.
void ReducedSystem::take_places() {
  places_start_.assign(touched_.size() + 1, 0);
  for (const Evidence& known : evidence_) ++places_start_[known.landmark + 1];
  std::partial_sum(places_start_.begin(), places_start_.end(), places_start_.begin());
  places_.resize(evidence_.size());
  next_place_.assign(places_start_.begin(), places_start_.end() - 1);
  for (Index row = 0; row < rows(); ++row) {
    for (Index e = evidence_start_[row]; e < evidence_start_[row + 1]; ++e) {
      const Evidence& known = evidence_[e];
      Place& place = places_[next_place_[known.landmark]++];
      place.weighted << known.count, known.count * known.y;
      place.slot = row;
      place.evidence = e;
    }
  }
}

/// Takes from evidence that strays from its landmark what it would count too much.
void ReducedSystem::lighten(const Place& place, double inlier2) {
  const Evidence& known = evidence_[place.evidence];
  Mat3& information = informations_[place.evidence];
  const Vec3 residual = known.y + origins_[place.slot] - means_[known.landmark].centre;
  information *= share_of(residual.dot(information * residual), inlier2);
}

void ReducedSystem::take_means(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  means_.clear();
  motions_.begin(graph.submaps.size());
  const double inlier2 = graph.directional_inlier_m() * graph.directional_inlier_m();
  for (Index touched = 0; touched < touched_.size(); ++touched) {
    if (!directional_) {
      means_.push_back(mean_of_places(graph, poses, touched));
      continue;
    }
    means_.push_back(directional_mean_of(graph, poses, touched_[touched]));
    for (Index p = places_start_[touched]; p < places_start_[touched + 1]; ++p) lighten(places_[p], inlier2);
  }
}

/// Where a landmark is best, from what has been taken down, and of other submaps from the graph.
ReducedSystem::Mean ReducedSystem::mean_of_places(const SubmapGraph& graph, const std::vector<Pose>& poses,
                                                  Index touched) {
  // Sums are taken about the first place: the others lie so near that no digits cancel.
  const Place& front = places_[places_start_[touched]];
  const Vec3 origin = origins_[front.slot] + evidence_[front.evidence].y;
  Vec3 sum = Vec3::Zero();
  Mean mean;
  for (Index p = places_start_[touched]; p < places_start_[touched + 1]; ++p) {
    const Evidence& known = evidence_[places_[p].evidence];
    sum += known.count * (origins_[places_[p].slot] + known.y - origin);
    mean.count += known.count;
  }
  for (const Membership& at : graph.landmarks[touched_[touched]].memberships) {
    if (slot_[at.submap] != kNone) continue;
    const Member& member = graph.submaps[at.submap].members[at.member];
    sum += member.weight() * (motions_.of(at.submap, poses) * member.mean - origin);
    mean.count += member.weight();
  }
  mean.centre = origin + sum / mean.count;
  return mean;
}

ReducedSystem::Mean ReducedSystem::mean_of(const SubmapGraph& graph, const std::vector<Pose>& poses,
                                           Index landmark) {
  if (graph.is_directional()) return directional_mean_of(graph, poses, landmark);
  // Sums are taken about the first place: the others lie so near that no digits cancel.
  const std::vector<Membership>& memberships = graph.landmarks[landmark].memberships;
  const Membership& front = memberships.front();
  const Vec3 origin = poses[front.submap] * graph.submaps[front.submap].members[front.member].mean;
  Mean mean;
  Vec3 sum = Vec3::Zero();
  double squares = 0.0;
  for (const Membership& at : memberships) {
    const Member& member = graph.submaps[at.submap].members[at.member];
    const double count = member.weight();
    const Vec3 place = poses[at.submap] * member.mean - origin;
    sum += count * place;
    squares += count * place.squaredNorm();
    mean.count += count;
  }
  mean.centre = origin + sum / mean.count;
  mean.cost = std::max(0.0, squares - sum.squaredNorm() / mean.count);
  return mean;
}

ReducedSystem::Mean ReducedSystem::directional_mean_of(const SubmapGraph& graph,
                                                       const std::vector<Pose>& poses, Index landmark) {
  const std::vector<Membership>& memberships = graph.landmarks[landmark].memberships;
  const Membership& front = memberships.front();
  const Vec3 origin = poses[front.submap] * graph.submaps[front.submap].members[front.member].mean;
  const double inlier2 = graph.directional_inlier_m() * graph.directional_inlier_m();
  Mean mean;
  Vec3 off = Vec3::Zero();
  for (int pass = 0; pass < kCentrePasses; ++pass) {
    mean.cost = mean.count = 0.0;
    Vec3 sum = Vec3::Zero();
    Mat3 whole = Mat3::Zero();
    for (const Membership& at : memberships) {
      const SubmapGraph::Evidence here = graph.evidence(at, poses[at.submap]);
      const Vec3 place = here.place - origin;
      const double squared = pass == 0 ? 0.0 : (place - off).dot(here.information * (place - off));
      const Mat3 information = share_of(squared, inlier2) * here.information;
      whole += information;
      sum += information * place;
      mean.count += graph.submaps[at.submap].members[at.member].weight();
      mean.cost += squared <= inlier2 ? squared : inlier2 * (1.0 + std::log(squared / inlier2));
    }
    mean.noise = whole.inverse();
    off = mean.noise * sum;
  }
  mean.centre = origin + off;
  return mean;
}

double ReducedSystem::cost_of(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark) {
  return mean_of(graph, poses, landmark).cost;
}

/// Takes note that the row under way has a block in the column of `slot`.
void ReducedSystem::open_row(Index slot) {
  if (in_row_[slot] != 0) return;
  in_row_[slot] = 1;
  row_slots_.push_back(slot);
  if (directional_) {
    row_blocks_[slot].setZero();
  } else {
    row_[slot] = PairSums();
  }
}

ReducedSystem::Vec6 ReducedSystem::sum_row_directional(Index row, double& work) {
  row_slots_.clear();
  open_row(row);
  Vec6 gradient = Vec6::Zero();
  std::size_t pairs = 0;
  for (Index e = evidence_start_[row]; e < evidence_start_[row + 1]; ++e) {
    const Evidence& known = evidence_[e];
    const Mean& mean = means_[known.landmark];
    const Vec3 residual = informations_[e] * (known.y + origins_[row] - mean.centre);
    gradient.head<3>() += residual;
    gradient.tail<3>() += known.y.cross(residual);
    row_blocks_[row] += motion_information(known.y, informations_[e], known.y);
    const Mat3 share = -informations_[e] * mean.noise;
    for (Index p = places_start_[known.landmark]; p < places_start_[known.landmark + 1]; ++p) {
      const Place& other = places_[p];
      if (other.slot > row) break;
      open_row(other.slot);
      row_blocks_[other.slot] +=
          motion_information(known.y, share * informations_[other.evidence], evidence_[other.evidence].y);
      ++pairs;
    }
  }
  work += kDirectionalPairProducts * static_cast<double>(pairs);
  return gradient;
}

ReducedSystem::Vec6 ReducedSystem::sum_row(Index row, double& work) {
  row_slots_.clear();
  own_ = PairSums();
  Vec6 gradient = Vec6::Zero();
  std::size_t pairs = 0;
  for (Index e = evidence_start_[row]; e < evidence_start_[row + 1]; ++e) {
    const Evidence& known = evidence_[e];
    const Mean& mean = means_[known.landmark];
    const Vec3 residual = known.count * (known.y + origins_[row] - mean.centre);
    gradient.head<3>() += residual;
    gradient.tail<3>() += known.y.cross(residual);
    const Vec4 lever(1.0, known.y.x(), known.y.y(), known.y.z());
    const Vec4 weighted = known.count * lever;
    own_.add(weighted, lever);
    const Vec4 share = weighted / -mean.count;
    for (Index p = places_start_[known.landmark]; p < places_start_[known.landmark + 1]; ++p) {
      const Place& other = places_[p];
      if (other.slot > row) break;
      open_row(other.slot);
      row_[other.slot].add(share, other.weighted);
      ++pairs;
    }
  }
  open_row(row);
  work += kPairProducts * static_cast<double>(pairs);
  return gradient;
}

ReducedSystem::Block ReducedSystem::take_block(Index row, Index column) {
  in_row_[column] = 0;
  Block block = directional_ ? row_blocks_[column] : expand(row_[column]);
  if (row == column) {
    if (!directional_) block += expand(own_);
    block.diagonal() *= 1.0 + kDamping;
    block.diagonal().array() += kDamping;
    // Out-of-plane directions are decoupled in planar data; this keeps them determined, and their step exactly 0.
    if (planar_) block.diagonal().segment<3>(2).array() += 1.0;
  }
  return block;
}

}  // namespace hallway::slam_point

// SPDX-License-Identifier: MIT
#include "slam_point/core/reduced_system.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "slam_point/core/directional_fit.hpp"

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

void ReducedSystem::PairSums::add(double weight, const Vec3& row, const Vec3& column) {
  const Vec3 weighted = weight * row;
  w += weight;
  y_row += weighted;
  y_column += weight * column;
  add_outer(weighted, column, y_outer);
}

// With J = [I, -[y]x] for (translation, rotation) of x = exp(rotation) y + t: J_row^T J_column = [I, -[y_column]x;
// [y_row]x, (y_row . y_column) I - y_column y_row^T].
ReducedSystem::Block ReducedSystem::expand(const PairSums& sums) {
  Block block;
  block.topLeftCorner<3, 3>() = sums.w * Mat3::Identity();
  block.topRightCorner<3, 3>() = -skew(sums.y_column);
  block.bottomLeftCorner<3, 3>() = skew(sums.y_row);
  block.bottomRightCorner<3, 3>() = sums.y_outer.trace() * Mat3::Identity() - sums.y_outer.transpose();
  return block;
}

void ReducedSystem::take(const SubmapGraph& graph, const std::vector<Index>& free,
                         const std::vector<Pose>& poses, bool planar) {
  planar_ = planar;
  directional_ = graph.is_directional();
  choose(graph, free);
  take_evidence(graph, poses);
  take_landmarks(graph, poses);
  row_.resize(directional_ ? 0 : free_.size());
  row_blocks_.resize(directional_ ? free_.size() : 0);
  in_row_.assign(free_.size(), 0);
}

void ReducedSystem::choose(const SubmapGraph& graph, const std::vector<Index>& free) {
  for (const Index landmark : touched_) marked_[landmark] = 0;
  for (const Index submap : free_) slot_[submap] = kNone;
  slot_.resize(graph.submaps.size(), kNone);
  marked_.resize(graph.landmarks.size(), 0);
  place_.resize(graph.landmarks.size());
  touched_.clear();
  free_.clear();
  for (const Index submap : free) {
    if (!graph.submaps[submap].held) free_.push_back(submap);
  }
  std::sort(free_.begin(), free_.end());
  for (Index slot = 0; slot < free_.size(); ++slot) slot_[free_[slot]] = slot;
}

void ReducedSystem::take_evidence(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  evidence_.clear();
  informations_.clear();
  evidence_start_.clear();
  positions_.clear();
  for (const Index submap : free_) {
    evidence_start_.push_back(static_cast<Index>(evidence_.size()));
    positions_.push_back(poses[submap].t);
    const Mat3 rotation = poses[submap].q.toRotationMatrix();
    if (directional_) {
      for (const Mat3& information : graph.submaps[submap].informations)
        informations_.emplace_back(rotation * information * rotation.transpose());
    }
    for (const Member& member : graph.submaps[submap].members) {
      if (member.count == 0) {  // keeps its place, and says nothing
        evidence_.push_back({Vec3::Zero(), 0.0, kNone});
        continue;
      }
      if (marked_[member.landmark] == 0) {
        marked_[member.landmark] = 1;
        place_[member.landmark] = static_cast<Index>(touched_.size());
        touched_.push_back(member.landmark);
      }
      evidence_.push_back({rotation * member.mean, member.weight(), place_[member.landmark]});
    }
  }
  evidence_start_.push_back(static_cast<Index>(evidence_.size()));
}

/// Takes from evidence that strays from its landmark what it would count too much.
void ReducedSystem::lighten(const Place& place, double inlier2) {
  const Evidence& known = evidence_[place.evidence];
  Mat3& information = informations_[place.evidence];
  const Vec3 residual = known.y + positions_[place.slot] - means_[known.landmark].centre;
  information *= share_of(residual.dot(information * residual), inlier2);
}

void ReducedSystem::take_landmarks(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  means_.clear();
  places_.clear();
  places_start_.clear();
  cost_ = 0.0;
  const double inlier2 = graph.directional_inlier_m() * graph.directional_inlier_m();
  for (const Index landmark : touched_) {
    means_.push_back(mean_of(graph, poses, landmark));
    cost_ += means_.back().cost;
    places_start_.push_back(static_cast<Index>(places_.size()));
    for (const Membership& at : graph.landmarks[landmark].memberships) {
      const Index slot = slot_[at.submap];
      if (slot == kNone) continue;
      places_.push_back({slot, evidence_start_[slot] + at.member});
      if (directional_) lighten(places_.back(), inlier2);
    }
  }
  places_start_.push_back(static_cast<Index>(places_.size()));
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
    if (known.count == 0.0) continue;
    const Mean& mean = means_[known.landmark];
    const Vec3 residual = informations_[e] * (known.y + positions_[row] - mean.centre);
    gradient.head<3>() += residual;
    gradient.tail<3>() += known.y.cross(residual);
    row_blocks_[row] += motion_information(known.y, informations_[e], known.y);
    const Mat3 share = -informations_[e] * mean.noise;
    for (Index p = places_start_[known.landmark]; p < places_start_[known.landmark + 1]; ++p) {
      const Place& other = places_[p];
      if (other.slot > row) continue;
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
    if (known.count == 0.0) continue;
    const Mean& mean = means_[known.landmark];
    const Vec3 residual = known.count * (known.y + positions_[row] - mean.centre);
    gradient.head<3>() += residual;
    gradient.tail<3>() += known.y.cross(residual);
    own_.add(known.count, known.y, known.y);
    const double share = known.count / mean.count;
    for (Index p = places_start_[known.landmark]; p < places_start_[known.landmark + 1]; ++p) {
      const Place& other = places_[p];
      if (other.slot > row) continue;
      open_row(other.slot);
      row_[other.slot].add(-share * evidence_[other.evidence].count, known.y, evidence_[other.evidence].y);
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

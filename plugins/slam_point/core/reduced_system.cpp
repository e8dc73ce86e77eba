// SPDX-License-Identifier: MIT
#include "slam_point/core/reduced_system.hpp"

#include <algorithm>

namespace hallway::slam_point {
namespace {

constexpr double kDamping = 1e-10;    // of the diagonal: keeps a direction nothing determines from moving
constexpr double kPairProducts = 24;  // multiplications for one landmark that two submaps share

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
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
  choose(graph, free);
  take_evidence(graph, poses);
  take_landmarks(graph, poses);
  row_.resize(free_.size());
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
  evidence_start_.clear();
  positions_.clear();
  for (const Index submap : free_) {
    evidence_start_.push_back(static_cast<Index>(evidence_.size()));
    positions_.push_back(poses[submap].t);
    const Mat3 rotation = poses[submap].q.toRotationMatrix();
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

void ReducedSystem::take_landmarks(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  means_.clear();
  places_.clear();
  places_start_.clear();
  cost_ = 0.0;
  for (const Index landmark : touched_) {
    means_.push_back(mean_of(graph, poses, landmark));
    cost_ += means_.back().cost;
    places_start_.push_back(static_cast<Index>(places_.size()));
    for (const Membership& at : graph.landmarks[landmark].memberships) {
      const Index slot = slot_[at.submap];
      if (slot != kNone) places_.push_back({slot, evidence_start_[slot] + at.member});
    }
  }
  places_start_.push_back(static_cast<Index>(places_.size()));
}

ReducedSystem::Mean ReducedSystem::mean_of(const SubmapGraph& graph, const std::vector<Pose>& poses,
                                           Index landmark) {
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

double ReducedSystem::cost_of(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark) {
  return mean_of(graph, poses, landmark).cost;
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
      if (in_row_[other.slot] == 0) {
        in_row_[other.slot] = 1;
        row_slots_.push_back(other.slot);
        row_[other.slot] = PairSums();
      }
      row_[other.slot].add(-share * evidence_[other.evidence].count, known.y, evidence_[other.evidence].y);
      ++pairs;
    }
  }
  if (in_row_[row] == 0) {
    in_row_[row] = 1;
    row_slots_.push_back(row);
    row_[row] = PairSums();
  }
  work += kPairProducts * static_cast<double>(pairs);
  return gradient;
}

ReducedSystem::Block ReducedSystem::take_block(Index row, Index column) {
  in_row_[column] = 0;
  Block block = expand(row_[column]);
  if (row == column) {
    block += expand(own_);
    block.diagonal() *= 1.0 + kDamping;
    block.diagonal().array() += kDamping;
    // Out-of-plane directions are decoupled in planar data; this keeps them determined, and their step exactly 0.
    if (planar_) block.diagonal().segment<3>(2).array() += 1.0;
  }
  return block;
}

}  // namespace hallway::slam_point

// SPDX-License-Identifier: MIT
#include "slam_point/core/submap_solver.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>

#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kDamping = 1e-10;     // of the diagonal: keeps a direction nothing determines from moving
constexpr double kSettledGain = 1e-9;  // relative fall of the cost that ends the global iteration

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

void SubmapSolver::PairSums::add(double weight, const Vec3& row, const Vec3& column) {
  const Vec3 weighted = weight * row;
  w += weight;
  y_row += weighted;
  y_column += weight * column;
  y_outer += weighted * column.transpose();
}

// With J = [I, -[y]x] for (translation, rotation) of x = exp(rotation) y + t:
// J_row^T J_column = [I, -[y_column]x; [y_row]x, (y_row . y_column) I - y_column y_row^T].
SubmapSolver::Block SubmapSolver::expand(const PairSums& sums) {
  Block block;
  block.topLeftCorner<3, 3>() = sums.w * Mat3::Identity();
  block.topRightCorner<3, 3>() = -skew(sums.y_column);
  block.bottomLeftCorner<3, 3>() = skew(sums.y_row);
  block.bottomRightCorner<3, 3>() = sums.y_outer.trace() * Mat3::Identity() - sums.y_outer.transpose();
  return block;
}

void SubmapSolver::choose(const SubmapGraph& graph, const std::vector<Index>& free) {
  for (const Index landmark : touched_) marked_[landmark] = 0;
  for (const Index submap : free_) slot_[submap] = kNone;
  slot_.resize(graph.submaps.size(), kNone);
  marked_.resize(graph.landmarks.size(), 0);
  place_.resize(graph.landmarks.size());
  touched_.clear();
  free_.clear();
  for (const Index submap : free) {
    if (submap != 0) free_.push_back(submap);
  }
  std::sort(free_.begin(), free_.end());
  for (Index slot = 0; slot < free_.size(); ++slot) slot_[free_[slot]] = slot;
  for (const Index submap : free_) {
    for (const Member& member : graph.submaps[submap].members) {
      if (marked_[member.landmark] != 0) continue;
      marked_[member.landmark] = 1;
      place_[member.landmark] = static_cast<Index>(touched_.size());
      touched_.push_back(member.landmark);
    }
  }
}

double SubmapSolver::lay_out(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  offsets_.clear();
  first_offset_.clear();
  for (const Index submap : free_) {
    first_offset_.push_back(static_cast<Index>(offsets_.size()));
    const Mat3 rotation = poses[submap].q.toRotationMatrix();
    for (const Member& member : graph.submaps[submap].members) offsets_.push_back(rotation * member.mean);
  }
  means_.clear();
  double cost = 0.0;
  for (const Index landmark : touched_) {
    means_.push_back(mean_of(graph, poses, landmark));
    cost += means_.back().cost;
  }
  return cost;
}

SubmapSolver::Mean SubmapSolver::mean_of(const SubmapGraph& graph, const std::vector<Pose>& poses,
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
    const double count = static_cast<double>(member.count);
    const Vec3 place = poses[at.submap] * member.mean - origin;
    sum += count * place;
    squares += count * place.squaredNorm();
    mean.count += count;
  }
  mean.centre = origin + sum / mean.count;
  mean.cost = std::max(0.0, squares - sum.squaredNorm() / mean.count);
  return mean;
}

template <typename Emit>
void SubmapSolver::build(const SubmapGraph& graph, const std::vector<Pose>& poses, bool planar, Emit&& emit) {
  gradient_.setZero(6 * static_cast<Eigen::Index>(free_.size()));
  row_.resize(free_.size());
  in_row_.assign(free_.size(), 0);
  for (Index k = 0; k < free_.size(); ++k) {
    row_slots_.clear();
    PairSums own;
    Vec6 gradient = Vec6::Zero();
    const std::vector<Member>& members = graph.submaps[free_[k]].members;
    for (Index m = 0; m < members.size(); ++m) {
      const Index landmark = members[m].landmark;
      const double count = static_cast<double>(members[m].count);
      const Vec3 y = offsets_[first_offset_[k] + m];
      const Vec3 residual = count * (y + poses[free_[k]].t - means_[place_[landmark]].centre);
      gradient.head<3>() += residual;
      gradient.tail<3>() += y.cross(residual);
      own.add(count, y, y);
      const double share = count / means_[place_[landmark]].count;
      for (const Membership& at : graph.landmarks[landmark].memberships) {
        const Index l = slot_[at.submap];
        if (l == kNone || l > k) continue;
        if (in_row_[l] == 0) {
          in_row_[l] = 1;
          row_slots_.push_back(l);
          row_[l] = PairSums();
        }
        const double other = static_cast<double>(graph.submaps[at.submap].members[at.member].count);
        row_[l].add(-share * other, y, offsets_[first_offset_[l] + at.member]);
      }
    }
    gradient_.segment<6>(6 * static_cast<Eigen::Index>(k)) = gradient;
    for (const Index l : row_slots_) {
      in_row_[l] = 0;
      Block block = expand(row_[l]);
      if (l == k) {
        block += expand(own);
        block.diagonal() *= 1.0 + kDamping;
        block.diagonal().array() += kDamping;
        // Out-of-plane directions are decoupled in planar data; this keeps them determined, and their step exactly 0.
        if (planar) block.diagonal().segment<3>(2).array() += 1.0;
      }
      emit(k, l, block);
    }
  }
}

SubmapSolver::Step SubmapSolver::take(const SubmapGraph& graph, double cost_before,
                                      std::vector<Pose>& poses) {
  Step step{cost_before, cost_before};
  if (!move_.allFinite()) return step;
  previous_.clear();
  for (Index k = 0; k < free_.size(); ++k) {
    const Vec6 move = move_.segment<6>(6 * static_cast<Eigen::Index>(k));
    Pose& pose = poses[free_[k]];
    previous_.push_back(pose);
    pose.t -= move.head<3>();
    pose.q = (rotation_exp(-move.tail<3>()) * pose.q).normalized();
  }
  double cost_after = 0.0;
  for (const Index landmark : touched_) cost_after += mean_of(graph, poses, landmark).cost;
  if (cost_after < cost_before) {
    step.cost_after = cost_after;
  } else {
    for (Index k = 0; k < free_.size(); ++k) poses[free_[k]] = previous_[k];
  }
  return step;
}

SubmapSolver::Step SubmapSolver::step_dense(const SubmapGraph& graph, const std::vector<Index>& free,
                                            bool planar, std::vector<Pose>& poses) {
  choose(graph, free);
  const double before = lay_out(graph, poses);
  if (free_.empty()) return {before, before};
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(free_.size());
  dense_.setZero(n, n);
  build(graph, poses, planar, [this](Index k, Index l, const Block& block) {
    dense_.block<6, 6>(6 * static_cast<Eigen::Index>(k), 6 * static_cast<Eigen::Index>(l)) = block;
  });
  dense_factor_.compute(dense_);
  if (dense_factor_.info() != Eigen::Success) return {before, before};
  move_ = dense_factor_.solve(gradient_);
  return take(graph, before, poses);
}

SubmapSolver::Step SubmapSolver::step_sparse(const SubmapGraph& graph, const std::vector<Index>& free,
                                             bool planar, std::vector<Pose>& poses) {
  choose(graph, free);
  const double before = lay_out(graph, poses);
  if (free_.empty()) return {before, before};
  std::vector<Eigen::Triplet<double>> entries;
  build(graph, poses, planar, [&entries](Index k, Index l, const Block& block) {
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < (k == l ? row + 1 : 6); ++column) {
        entries.emplace_back(static_cast<int>(6 * k) + row, static_cast<int>(6 * l) + column,
                             block(row, column));
      }
    }
  });
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(free_.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return {before, before};
  sparse_work_ = static_cast<double>(entries.size());
  const auto& lower = factor.matrixL().nestedExpression();
  for (Eigen::Index column = 0; column < n; ++column) {
    const auto height =
        static_cast<double>(lower.outerIndexPtr()[column + 1] - lower.outerIndexPtr()[column]);
    sparse_work_ += height * height;
  }
  move_ = factor.solve(gradient_);
  return take(graph, before, poses);
}

int SubmapSolver::solve_all(const SubmapGraph& graph, bool planar, int max_steps, std::vector<Pose>& poses) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  int steps = 0;
  while (steps < max_steps) {
    const Step step = step_sparse(graph, all, planar, poses);
    if (step.cost_after == step.cost_before) break;
    ++steps;
    if (step.cost_before - step.cost_after <= kSettledGain * step.cost_before) break;
  }
  return steps;
}

}  // namespace hallway::slam_point

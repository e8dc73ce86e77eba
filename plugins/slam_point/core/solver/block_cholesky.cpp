// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>

namespace hallway::slam_point {
namespace {

constexpr double kBlockProduct = 216.0;  // multiplications of a product of two blocks
constexpr std::uint32_t kNobody = 0xffffffffu;

using TwoRows = Eigen::Vector2d;  // what a register holds

/// x lower^T = given, for a lower triangle whose diagonal's reciprocals are `inverses`. `given` becomes x.
void solve_behind(const BlockCholesky::Block& lower, const BlockCholesky::Vec6& inverses,
                  BlockCholesky::Block& given) {
  for (Eigen::Index column = 0; column < 6; ++column) {
    for (Eigen::Index row = 0; row < 6; row += 2) {
      TwoRows x = given.block<2, 1>(row, column);
      for (Eigen::Index k = 0; k < column; ++k) x -= given.block<2, 1>(row, k) * lower(column, k);
      given.block<2, 1>(row, column) = x * inverses[column];
    }
  }
}

/// Turns counts, one for each bin with a spare one behind, into where each bin begins.
void counts_to_starts(std::vector<std::size_t>& counts) {
  std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), std::size_t{0});
}

}  // namespace

void BlockCholesky::begin(std::size_t size) {
  entries_.clear();
  place_.assign(size, 0);
  column_ = 0;
  open_ = false;
}

void BlockCholesky::add(Place row, Place column, const Block& block) {
  entries_.push_back({row, column, block});
}

void BlockCholesky::analyse() {
  order();
  sort_entries();
  find_fill();
  find_sources();
  blocks_.resize(rows_.size());
  column_blocks_.assign(size(), Block::Zero());
}

void BlockCholesky::order() {
  std::vector<Eigen::Triplet<char, int>> pattern;
  pattern.reserve(entries_.size());
  for (const Entry& entry : entries_)
    pattern.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column), char{1});
  const auto n = static_cast<Eigen::Index>(size());
  Eigen::SparseMatrix<char> matrix(n, n);
  matrix.setFromTriplets(pattern.begin(), pattern.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(matrix, permutation);
  for (Place place = 0; place < size(); ++place)
    place_[static_cast<std::size_t>(permutation.indices()[static_cast<Eigen::Index>(place)])] = place;
}

void BlockCholesky::sort_entries() {
  const auto column_of = [this](const Entry& entry) {
    return std::min(place_[entry.row], place_[entry.column]);
  };
  entry_start_.assign(size() + 1u, 0);
  for (const Entry& entry : entries_) ++entry_start_[column_of(entry)];
  counts_to_starts(entry_start_);
  entry_of_column_.resize(entries_.size());
  std::vector<std::size_t> next = entry_start_;
  for (std::size_t e = 0; e < entries_.size(); ++e) entry_of_column_[next[column_of(entries_[e])]++] = e;
}

/// The rows of a column of the factor: those of the matrix, and those of the columns whose first row below the
/// diagonal it is.
void BlockCholesky::find_fill() {
  std::vector<Place> marked(size(), kNobody);
  std::vector<Place> last_child(size(), kNobody);
  std::vector<Place> sibling(size(), kNobody);
  start_.assign(1, 0);
  rows_.clear();
  for (Place k = 0; k < size(); ++k) {
    const auto take = [&](Place row) {
      if (marked[row] == k) return;
      marked[row] = k;
      rows_.push_back(row);
    };
    take(k);
    for (std::size_t e = entry_start_[k]; e < entry_start_[k + 1]; ++e) {
      const Entry& entry = entries_[entry_of_column_[e]];
      take(std::max(place_[entry.row], place_[entry.column]));
    }
    for (Place child = last_child[k]; child != kNobody; child = sibling[child]) {
      for (std::size_t at = start_[child] + 1; at < start_[child + 1]; ++at) take(rows_[at]);
    }
    const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(start_[k]);
    std::sort(first, rows_.end());
    start_.push_back(rows_.size());
    if (rows_.size() - start_[k] < 2) continue;
    const Place parent = rows_[start_[k] + 1];
    sibling[k] = last_child[parent];
    last_child[parent] = k;
  }
}

void BlockCholesky::find_sources() {
  source_start_.assign(size() + 1u, 0);
  for (Place k = 0; k < size(); ++k) {
    for (std::size_t at = start_[k] + 1; at < start_[k + 1]; ++at) ++source_start_[rows_[at]];
  }
  counts_to_starts(source_start_);
  sources_.resize(source_start_.back());
  std::vector<std::size_t> next = source_start_;
  for (Place k = 0; k < size(); ++k) {
    for (std::size_t at = start_[k] + 1; at < start_[k + 1]; ++at) sources_[next[rows_[at]]++] = {k, at};
  }
}

BlockCholesky::State BlockCholesky::advance(double& work) {
  while (column_ < size()) {
    if (work <= 0.0) return State::running;
    if (!open_) open_column();
    while (next_source_ < source_start_[column_ + 1]) {
      if (work <= 0.0) return State::running;
      subtract(sources_[next_source_++], work);
    }
    work -= kBlockProduct * static_cast<double>(start_[column_ + 1] - start_[column_]);
    if (!close_column()) return State::not_positive;
    ++column_;
  }
  return State::done;
}

void BlockCholesky::open_column() {
  for (std::size_t e = entry_start_[column_]; e < entry_start_[column_ + 1]; ++e) {
    const Entry& entry = entries_[entry_of_column_[e]];
    if (place_[entry.row] >= place_[entry.column]) {
      column_blocks_[place_[entry.row]] = entry.block;
    } else {
      column_blocks_[place_[entry.column]] = entry.block.transpose();
    }
  }
  next_source_ = source_start_[column_];
  open_ = true;
}

void BlockCholesky::subtract(const Source& source, double& work) {
  const std::size_t end = start_[source.column + 1];
  const Block pivot = blocks_[source.at].transpose();
  for (std::size_t at = source.at; at < end; ++at)
    column_blocks_[rows_[at]].noalias() -= blocks_[at].lazyProduct(pivot);
  work -= kBlockProduct * static_cast<double>(end - source.at);
}

bool BlockCholesky::close_column() {
  const Eigen::LLT<Block> diagonal(column_blocks_[column_]);
  if (diagonal.info() != Eigen::Success) return false;
  blocks_[start_[column_]] = diagonal.matrixL();
  column_blocks_[column_].setZero();
  const Block& lower = blocks_[start_[column_]];
  const Vec6 inverses = lower.diagonal().cwiseInverse();
  for (std::size_t at = start_[column_] + 1; at < start_[column_ + 1]; ++at) {
    Block& given = column_blocks_[rows_[at]];
    solve_behind(lower, inverses, given);
    blocks_[at] = given;
    given.setZero();
  }
  open_ = false;
  return true;
}

double BlockCholesky::work() const {
  double blocks = 0.0;
  for (Place k = 0; k < size(); ++k) {
    const double rows = static_cast<double>(start_[k + 1] - start_[k]);
    blocks += 0.5 * rows * (rows + 1.0);
  }
  return kBlockProduct * blocks;
}

void BlockCholesky::invert() {
  inverse_.resize(rows_.size());
  for (Place k = size(); k-- > 0;) invert_column(k);
}

/// From L^T Z = L^-1, which is known above the diagonal: Z_ik = -sum over rows j of column k of Z_ij L_jk L_kk^-1.
void BlockCholesky::invert_column(Place k) {
  const Block pivot = blocks_[start_[k]].triangularView<Eigen::Lower>().solve(Block::Identity());
  const std::size_t first = start_[k] + 1;
  const std::size_t end = start_[k + 1];
  for (std::size_t at = first; at < end; ++at) inverse_[at].setZero();
  for (std::size_t j = first; j < end; ++j) {
    // Rows of column rows_[j] that column k has too, from the diagonal on: both lists ascend.
    std::size_t of_j = start_[rows_[j]];
    for (std::size_t i = j; i < end; ++i) {
      while (rows_[of_j] != rows_[i]) ++of_j;
      const Block& z = inverse_[of_j];
      inverse_[i].noalias() -= z.lazyProduct(blocks_[j]);
      if (i != j) inverse_[j].noalias() -= z.transpose().lazyProduct(blocks_[i]);
    }
  }
  Block diagonal = pivot;
  for (std::size_t at = first; at < end; ++at) {
    inverse_[at] *= pivot;
    diagonal.noalias() -= blocks_[at].transpose() * inverse_[at];
  }
  inverse_[start_[k]] = pivot.transpose() * diagonal;
}

/// Where the factor's block of these places stands, row >= column.
std::size_t BlockCholesky::find(Place row, Place column) const {
  const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(start_[column]);
  const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(start_[column + 1]);
  return static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows_.begin());
}

BlockCholesky::Block BlockCholesky::inverse_block(Place row, Place column) const {
  const Place a = place_[row];
  const Place b = place_[column];
  return a >= b ? inverse_[find(a, b)] : Block(inverse_[find(b, a)].transpose());
}

void BlockCholesky::solve(std::vector<Vec6>& b) const {
  std::vector<Vec6> x(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) x[place_[i]] = b[i];
  for (Place k = 0; k < size(); ++k) {
    blocks_[start_[k]].triangularView<Eigen::Lower>().solveInPlace(x[k]);
    for (std::size_t at = start_[k] + 1; at < start_[k + 1]; ++at)
      x[rows_[at]].noalias() -= blocks_[at] * x[k];
  }
  for (Place k = size(); k-- > 0;) {
    for (std::size_t at = start_[k] + 1; at < start_[k + 1]; ++at)
      x[k].noalias() -= blocks_[at].transpose() * x[rows_[at]];
    blocks_[start_[k]].transpose().triangularView<Eigen::Upper>().solveInPlace(x[k]);
  }
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = x[place_[i]];
}

}  // namespace hallway::slam_point

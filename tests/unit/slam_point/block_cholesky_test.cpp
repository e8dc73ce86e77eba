// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point {
namespace {

using Block = BlockCholesky::Block;
using Vec6 = BlockCholesky::Vec6;
using State = BlockCholesky::State;

/// The same matrix twice: as blocks for the factorisation, and dense for the oracle.
struct System {
  struct Entry {
    std::uint32_t row = 0, column = 0;
    Block block;
  };
  std::vector<Entry> entries;
  Eigen::MatrixXd dense;

  explicit System(int size) : dense(Eigen::MatrixXd::Zero(6 * size, 6 * size)) {}

  void add(int row, int column, const Block& block) {
    entries.push_back({static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), block});
    dense.block<6, 6>(6 * row, 6 * column) = block;
    if (row != column) dense.block<6, 6>(6 * column, 6 * row) = block.transpose();
  }
};

/// Symmetric, strictly dominated by its diagonal, with `share` of the blocks off it.
System random_system(int size, double share, std::uint64_t seed) {
  scenes::Random random(seed);
  System system(size);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column <= row; ++column) {
      if (row != column && random.uniform(0.0, 1.0) > share) continue;
      Block block = Block::Zero();
      for (int i = 0; i < 36; ++i) block(i % 6, i / 6) = random.uniform(-1.0, 1.0);
      if (row == column) block = (block + block.transpose()).eval() + 14.0 * size * Block::Identity();
      system.add(row, column, block);
    }
  }
  return system;
}

State factorise(BlockCholesky& factor, const System& system, double slice) {
  factor.begin(static_cast<std::size_t>(system.dense.rows()) / 6);
  for (const System::Entry& entry : system.entries) factor.add(entry.row, entry.column, entry.block);
  factor.analyse();
  while (true) {
    double work = slice;
    const State state = factor.advance(work);
    if (state != State::running) return state;
  }
}

std::vector<Vec6> right_side(int size) {
  std::vector<Vec6> b(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < b.size(); ++i) b[i].setLinSpaced(static_cast<double>(i), -3.0);
  return b;
}

TEST(BlockCholesky, InvertsWhereTheMatrixHasBlocks) {
  BlockCholesky factor;
  for (const auto& [size, share] : {std::pair{1, 0.0}, {2, 1.0}, {9, 0.3}, {30, 0.1}, {12, 1.0}, {25, 0.0}}) {
    const System system = random_system(size, share, static_cast<std::uint64_t>(size));
    ASSERT_EQ(factorise(factor, system, 1e12), State::done);
    factor.invert();
    const Eigen::MatrixXd inverse = dense::inverse(system.dense);
    for (const System::Entry& entry : system.entries) {
      const Block expected = inverse.block<6, 6>(6 * static_cast<Eigen::Index>(entry.row),
                                                 6 * static_cast<Eigen::Index>(entry.column));
      const double near = 1e-12 * inverse.norm();
      EXPECT_LT((factor.inverse_block(entry.row, entry.column) - expected).norm(), near);
      EXPECT_LT((factor.inverse_block(entry.column, entry.row) - expected.transpose()).norm(), near);
    }
  }
}

TEST(BlockCholesky, SaysBeforehandHowMuchWorkItIs) {
  BlockCholesky factor;
  const System system = random_system(20, 0.2, 5);
  ASSERT_EQ(factorise(factor, system, 1e12), State::done);
  double left = 1e12;
  factor.begin(20);
  for (const System::Entry& entry : system.entries) factor.add(entry.row, entry.column, entry.block);
  factor.analyse();
  const double work = factor.work();
  ASSERT_EQ(factor.advance(left), State::done);
  EXPECT_NEAR(1e12 - left, work, 1e-3);
}

TEST(BlockCholesky, SolvesWhatADenseFactorisationSolves) {
  BlockCholesky factor;
  for (const auto& [size, share] :
       {std::pair{1, 0.0}, {2, 1.0}, {17, 0.15}, {40, 0.05}, {25, 1.0}, {30, 0.0}}) {
    const System system = random_system(size, share, static_cast<std::uint64_t>(size));
    ASSERT_EQ(factorise(factor, system, 1e12), State::done);
    std::vector<Vec6> x = right_side(size);
    Eigen::VectorXd b(6 * size);
    for (int i = 0; i < size; ++i) b.segment<6>(6 * i) = x[static_cast<std::size_t>(i)];
    factor.solve(x);
    const Eigen::VectorXd expected = dense::solve_symmetric(system.dense, b);
    for (int i = 0; i < size; ++i) {
      EXPECT_LT((x[static_cast<std::size_t>(i)] - expected.segment<6>(6 * i)).norm(), 1e-12)
          << size << ", " << share;
    }
  }
}

TEST(BlockCholesky, SlicesGiveTheSameBits) {
  const System system = random_system(30, 0.2, 7);
  BlockCholesky whole;
  BlockCholesky sliced;
  ASSERT_EQ(factorise(whole, system, 1e12), State::done);
  ASSERT_EQ(factorise(sliced, system, 1.0), State::done);
  std::vector<Vec6> a = right_side(30);
  std::vector<Vec6> b = a;
  whole.solve(a);
  sliced.solve(b);
  EXPECT_EQ(a, b);
}

TEST(BlockCholesky, SaysWhereAMatrixIsNotPositive) {
  System system = random_system(12, 0.3, 9);
  BlockCholesky factor;
  ASSERT_EQ(factorise(factor, system, 1e12), State::done);
  system.entries.back().block.diagonal().array() -= 1e4;
  EXPECT_EQ(factorise(factor, system, 1e12), State::not_positive);
}

}  // namespace
}  // namespace hallway::slam_point

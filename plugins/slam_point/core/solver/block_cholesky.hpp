// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hallway::slam_point {

/// Cholesky factorisation of a sparse symmetric positive definite matrix of 6 x 6 blocks that can be done in slices:
/// each call of advance() does a bounded number of multiplications, so that no single frame pays for a large map.
///
/// Left-looking, by columns, in an order of approximate minimum degree. Buffers are kept between systems.
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Place = std::uint32_t;
  enum class State { running, done, not_positive };

  /// Starts a new matrix of `size` x `size` blocks, all zero.
  void begin(std::size_t size);
  /// Gives a block of the lower triangle (row >= column), each at most once; every diagonal block is to be given.
  void add(Place row, Place column, const Block& block);
  /// Orders the unknowns and finds where the factor has blocks, once all are added. O(blocks of the factor).
  void analyse();
  /// Goes on with the factorisation until it is over or `work` multiplications are spent, which it counts down; it
  /// may overdraw them by one block of columns.
  State advance(double& work);
  /// Solves for right-hand side `b`, one vector for each block row, in place. Once advance() has said `done`.
  void solve(std::vector<Vec6>& b) const;
  /// Multiplications that the factorisation takes. Once analyse() is done.
  double work() const;
  /// Finds the blocks of the matrix's inverse where the factor has blocks (Takahashi, Fagan and Chin 1973), among them those
  /// where the matrix has. Once advance() has said `done`; costs about twice what the factorisation did.
  void invert();
  /// A block of the inverse, after invert(), for a place of the matrix that was given, or that of its transpose.
  Block inverse_block(Place row, Place column) const;

 private:
  struct Entry {
    Place row = 0;
    Place column = 0;
    Block block;
  };
  /// Where a column's block of one row stands in the factor.
  struct Source {
    Place column = 0;
    std::size_t at = 0;
  };

  void order();
  void sort_entries();
  void find_fill();
  void find_sources();
  void open_column();
  void subtract(const Source& source, double& work);
  bool close_column();
  void invert_column(Place k);
  std::size_t find(Place row, Place column) const;
  Place size() const { return static_cast<Place>(place_.size()); }

  std::vector<Entry> entries_;            // as given
  std::vector<Place> place_;              // unknown -> its place in the order
  std::vector<std::size_t> entry_start_;  // place -> where its column begins in entry_of_column_
  std::vector<std::size_t> entry_of_column_;
  std::vector<std::size_t> start_;         // place -> where its column begins in rows_, the diagonal first
  std::vector<Place> rows_;                // ascending within a column
  std::vector<Block> blocks_;              // the factor, as rows_
  std::vector<Block> inverse_;             // likewise
  std::vector<std::size_t> source_start_;  // place -> where the sources of its column begin
  std::vector<Source> sources_;
  std::vector<Block> column_blocks_;  // row -> the open column's block
  Place column_ = 0;                  // the next to finish
  bool open_ = false;
  std::size_t next_source_ = 0;
};

}  // namespace hallway::slam_point

// SPDX-License-Identifier: MIT
#include "pvs/bit_matrix.hpp"

#include <algorithm>
#include <array>

#include "base/parallel.hpp"

namespace hallway::pvs {
namespace {

using Block = std::array<Word, kWordBits>;

/// Exchanges rows and columns of 64 x 64 bits (Warren, "Hacker's Delight", 2nd edition, section 7-3).
void transpose(Block& block) {
  Word mask = 0x00000000FFFFFFFFu;
  for (std::size_t width = kWordBits / 2; width != 0; width /= 2, mask ^= mask << width) {
    for (std::size_t k = 0; k < kWordBits; k = (k + width + 1) & ~width) {
      const Word difference = ((block[k] >> width) ^ block[k + width]) & mask;
      block[k] ^= difference << width;
      block[k + width] ^= difference;
    }
  }
}

/// Exchanges each even bit with the odd bit above it.
Word swap_neighbours(Word word) {
  constexpr Word kEven = 0x5555555555555555u;
  return (word & kEven) << 1 | (word >> 1 & kEven);
}

/// What the block at (column, row) demands of the one at (row, column).
Block mutual_block(const BitMatrix& matrix, std::size_t row, std::size_t column) {
  Block block{};
  const std::size_t first = column * kWordBits;
  const std::size_t count = std::min(kWordBits, matrix.rows() - first);
  for (std::size_t k = 0; k < count; ++k) block[k ^ 1u] = swap_neighbours(matrix.row(first + k)[row]);
  transpose(block);
  return block;
}

void keep(BitMatrix& matrix, std::size_t row, std::size_t column, const Block& block) {
  const std::size_t first = row * kWordBits;
  const std::size_t count = std::min(kWordBits, matrix.rows() - first);
  for (std::size_t k = 0; k < count; ++k) matrix.row(first + k)[column] &= block[k];
}

}  // namespace

void keep_mutual(BitMatrix& matrix, unsigned threads) {
  // A pair of blocks that mirror each other is the business of the lower one's row alone.
  parallel_for(matrix.words(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      for (std::size_t column = row; column < matrix.words(); ++column) {
        const Block for_upper = mutual_block(matrix, row, column);
        const Block for_lower = mutual_block(matrix, column, row);
        keep(matrix, row, column, for_upper);
        keep(matrix, column, row, for_lower);
      }
    }
  });
}

}  // namespace hallway::pvs

// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hallway::pvs {

using Word = std::uint64_t;
inline constexpr std::size_t kWordBits = 64;

/// Words that hold `bits` bits.
constexpr std::size_t words_for(std::size_t bits) {
  return (bits + kWordBits - 1) / kWordBits;
}

inline bool test_bit(const Word* row, std::size_t bit) {
  return (row[bit / kWordBits] >> (bit % kWordBits) & 1u) != 0;
}
inline void set_bit(Word* row, std::size_t bit) {
  row[bit / kWordBits] |= Word{1} << (bit % kWordBits);
}
inline void clear_bit(Word* row, std::size_t bit) {
  row[bit / kWordBits] &= ~(Word{1} << (bit % kWordBits));
}

/// Calls `visit(bit)` for every set bit of a row, rising.
template <typename Visit>
void for_each_bit(const Word* row, std::size_t words, Visit visit) {
  for (std::size_t w = 0; w < words; ++w) {
    for (Word rest = row[w]; rest != 0; rest &= rest - 1) {
      visit(w * kWordBits + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

/// Number of set bits of a row.
inline std::size_t count_bits(const Word* row, std::size_t words) {
  std::size_t count = 0;
  for (std::size_t w = 0; w < words; ++w) count += static_cast<std::size_t>(std::popcount(row[w]));
  return count;
}

/// Rows of bits in one block of memory, all zero at first.
class BitMatrix {
 public:
  BitMatrix(std::size_t rows, std::size_t bits)
      : rows_(rows), words_(words_for(bits)), data_(rows * words_) {}

  std::size_t rows() const { return rows_; }
  std::size_t words() const { return words_; }  ///< in a row
  Word* row(std::size_t index) { return data_.data() + index * words_; }
  const Word* row(std::size_t index) const { return data_.data() + index * words_; }

 private:
  std::size_t rows_;
  std::size_t words_;
  std::vector<Word> data_;
};

/// Clears bit (p, q) of a square matrix of even size unless bit (q ^ 1, p ^ 1) is set, for all p and q: for
/// rows of directed portals, where p ^ 1 is p passed the other way, keeps what is seen both ways. O(size² /
/// 64) word operations.
void keep_mutual(BitMatrix& matrix, unsigned threads);

}  // namespace hallway::pvs

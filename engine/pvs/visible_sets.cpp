// SPDX-License-Identifier: MIT
#include "pvs/visible_sets.hpp"

#include <bit>
#include <string>

#include "base/error.hpp"

namespace hallway::pvs {
namespace {

constexpr std::size_t kLongestRun = 255;

/// Appends a row: bytes as they are, but a zero is followed by the length of its run.
void compress(const std::vector<std::uint8_t>& row, std::vector<std::uint8_t>& data) {
  for (std::size_t i = 0; i < row.size();) {
    data.push_back(row[i]);
    if (row[i] != 0) {
      ++i;
      continue;
    }
    std::size_t run = 1;
    while (run < kLongestRun && i + run < row.size() && row[i + run] == 0) ++run;
    data.push_back(static_cast<std::uint8_t>(run));
    i += run;
  }
}

/// Calls `visit(place, byte)` for the bytes of a compressed row that are not zero, until it returns false.
template <typename Visit>
void for_each_byte(const std::uint8_t* data, const std::uint8_t* end, Visit visit) {
  std::size_t place = 0;
  while (data != end) {
    const std::uint8_t byte = *data++;
    if (byte == 0) {
      place += *data++;
    } else if (!visit(place++, byte)) {
      return;
    }
  }
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::kInternal, "visible sets: " + why);
}

}  // namespace

VisibleSets::VisibleSets(const std::vector<std::vector<std::uint8_t>>& rows)
    : clusters_(static_cast<std::uint32_t>(rows.size())) {
  const std::size_t bytes = (rows.size() + 7) / 8;
  const std::size_t rest = rows.size() % 8;
  begin_.reserve(rows.size() + 1);
  begin_.push_back(0);
  for (const auto& row : rows) {
    if (row.size() != bytes) refuse("a row of the wrong length");
    if (rest != 0 && (row.back() >> rest) != 0) refuse("a bit beyond the last cluster");
    compress(row, data_);
    begin_.push_back(data_.size());
  }
  data_.shrink_to_fit();
}

bool VisibleSets::visible(std::uint32_t from, std::uint32_t to) const {
  if (from >= clusters_ || to >= clusters_) refuse("cluster out of range");
  bool result = false;
  for_each_byte(data_.data() + begin_[from], data_.data() + begin_[from + std::size_t{1}],
                [&](std::size_t place, std::uint8_t byte) {
                  if (place == to / 8) result = (byte >> (to % 8) & 1) != 0;
                  return place < to / 8;
                });
  return result;
}

std::vector<std::uint32_t> VisibleSets::visible_from(std::uint32_t from) const {
  if (from >= clusters_) refuse("cluster out of range");
  std::vector<std::uint32_t> clusters;
  for_each_byte(data_.data() + begin_[from], data_.data() + begin_[from + std::size_t{1}],
                [&](std::size_t place, std::uint8_t byte) {
                  for (unsigned rest = byte; rest != 0; rest &= rest - 1) {
                    clusters.push_back(static_cast<std::uint32_t>(8 * place) +
                                       static_cast<std::uint32_t>(std::countr_zero(rest)));
                  }
                  return true;
                });
  return clusters;
}

double VisibleSets::mean_share() const {
  if (clusters_ == 0) return 0.0;
  std::uint64_t pairs = 0;
  for (std::size_t row = 0; row < clusters_; ++row) {
    for_each_byte(data_.data() + begin_[row], data_.data() + begin_[row + 1],
                  [&](std::size_t, std::uint8_t byte) {
                    pairs += static_cast<std::uint64_t>(std::popcount(byte));
                    return true;
                  });
  }
  return static_cast<double>(pairs) / (static_cast<double>(clusters_) * static_cast<double>(clusters_));
}

std::size_t VisibleSets::bytes() const {
  return begin_.size() * sizeof(begin_[0]) + data_.size();
}

}  // namespace hallway::pvs

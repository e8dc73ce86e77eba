// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hallway::pvs {

/// Which clusters may see which: for each cluster a row of bits, run-length compressed (zero bytes).
/// Symmetric; every cluster sees itself. Never says "hidden" of two clusters between which there is a free
/// line of sight.
class VisibleSets {
 public:
  VisibleSets() = default;
  /// @param rows  one row of (clusters + 7) / 8 bytes for each cluster, bit i of a row for cluster i
  /// @throws Error kInternal if a row has another length or a bit for a cluster that there is not
  explicit VisibleSets(const std::vector<std::vector<std::uint8_t>>& rows);

  std::uint32_t clusters() const { return clusters_; }
  /// True if `to` may be seen from `from`. O(length of the row). Throws Error kInternal if there is no such
  /// cluster.
  bool visible(std::uint32_t from, std::uint32_t to) const;
  /// Clusters that may be seen from `from`, itself among them, rising. Throws as visible().
  std::vector<std::uint32_t> visible_from(std::uint32_t from) const;
  /// Share of all ordered pairs of clusters (a cluster with itself included) that may see each other; 0 for
  /// none.
  double mean_share() const;
  std::size_t bytes() const;  ///< memory of the compressed rows

 private:
  std::uint32_t clusters_ = 0;
  std::vector<std::uint64_t> begin_;  ///< of each row in data_, and the end
  std::vector<std::uint8_t> data_;
};

}  // namespace hallway::pvs

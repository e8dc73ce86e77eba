// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "pvs/bit_matrix.hpp"
#include "pvs/directed_portals.hpp"

namespace hallway::pvs {

/// True if a straight line may pass `first` and then `second`: part of the second lies in front of the first,
/// and part of the first behind the second.
bool in_front(const DirectedPortal& first, const DirectedPortal& second);

/// Which portals can be reached after a portal, from cluster to cluster. Keeps its memory from call to call.
class Flood {
 public:
  explicit Flood(const DirectedPortals& world);

  /// Sets in `reached` (zero before) the portals reached after `source` through portals in front of it.
  void in_front_of(std::uint32_t source, Word* reached);
  /// Clears in `allowed` the portals that cannot be reached after `source` through portals that are set in
  /// it.
  void prune(std::uint32_t source, Word* allowed);

 private:
  template <typename Passable>
  void spread(std::uint32_t source, Passable passable, Word* reached);

  const DirectedPortals& world_;
  std::vector<std::uint32_t> open_;  ///< clusters to look at
  std::vector<std::uint32_t> met_;   ///< the last flood that met each cluster
  std::uint32_t floods_ = 0;
  std::vector<Word> reached_;
};

}  // namespace hallway::pvs

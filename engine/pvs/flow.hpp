// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pvs/bit_matrix.hpp"
#include "pvs/directed_portals.hpp"
#include "pvs/separators.hpp"

namespace hallway::pvs {

/// The search for what can be seen through one portal: lines through it are followed from portal to portal,
/// each portal cut to what lines through the source and the portal before it can reach. One thread's; keeps
/// its memory from call to call.
///
/// After each portal, the cone of lines that are left is flooded ahead: only portals that a flood within the
/// separating planes reaches stay candidates, and a way that leads to no candidate not yet seen is left at
/// once. So most ways that are followed find something.
class Flow {
 public:
  explicit Flow(const DirectedPortals& world);

  /// Adds to `seen` the portals that may be seen through `source`.
  /// @param candidates  a superset of them
  /// @param rows        for each portal a superset of what can be seen through it
  /// @param seen        what is known already to be visible
  /// @param work_limit  in looks at a portal in a flood; after it the search takes what each flood reaches for
  ///                    visible, and after twice as much what the rows say
  /// @return the work done, a function of the arguments alone
  std::uint64_t run(std::uint32_t source, const Word* candidates, const std::vector<const Word*>& rows,
                    std::uint64_t work_limit, Word* seen);
  /// True if the last run came to its limit.
  bool was_cut_short() const { return cut_short_; }

 private:
  /// One portal of the way from the source.
  struct Frame {
    const DirectedPortal* portal = nullptr;
    std::vector<Word> might{};        ///< candidates that may be seen after the portal; words of live_
    const Winding* source = nullptr;  ///< what is left of the source
    const Winding* pass = nullptr;    ///< what is left of the portal
    Winding source_part{};
    std::array<Winding, 2> pass_parts{};
    Separators separators{};  ///< of `source` and `pass`
  };

  void start(std::uint32_t source, const Word* candidates, const Word* seen);
  Frame& frame(std::size_t level);
  void follow(std::size_t level);
  void pass_through(std::size_t level, std::uint32_t portal);
  bool narrow(const Word* before, const Word* row, Word* after);
  bool clip(const Frame& last, const DirectedPortal& target, Frame& next) const;
  bool flood_ahead(Frame& last);
  void take_for_seen(const Frame& last);

  const DirectedPortals& world_;
  Precision precision_;
  std::vector<std::unique_ptr<Frame>> frames_;
  std::vector<std::uint32_t> live_;  ///< words of a row in which there are candidates
  std::vector<std::uint32_t>
      place_;               ///< of each word in live_; live_.size(), a word that stays zero, for the others
  std::vector<Word> seen_;  ///< words of live_
  std::vector<Word> reached_;        ///< words of live_
  std::vector<std::uint32_t> open_;  ///< clusters to look at in a flood
  std::vector<std::uint64_t> met_;   ///< the last flood that met each cluster
  std::uint64_t floods_ = 0;
  const std::vector<const Word*>* rows_ = nullptr;
  const DirectedPortal* source_ = nullptr;
  std::uint64_t work_ = 0;
  std::uint64_t work_limit_ = 0;
  bool cut_short_ = false;
};

}  // namespace hallway::pvs

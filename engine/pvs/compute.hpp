// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "bsp/portal_graph.hpp"
#include "pvs/visible_sets.hpp"

namespace hallway::pvs {

/// How hard to try to find out that two clusters cannot see each other.
enum class Level {
  kFast,  ///< a flood through portals that lie in front of each other
  kFull,  ///< portal flow with anti-penumbra clipping
};

/// Settings of compute().
struct Options {
  Level level = Level::kFull;
  unsigned threads = 1;  ///< at least 1; no matter to the result
  /// Called now and then with rising `done`, from any thread but never from two at once; may be empty.
  /// Throwing from it stops the work and comes out of compute().
  std::function<void(std::size_t done, std::size_t total)> progress{};
  /// Of kFull: bound of the work, in looks at a portal (10 to 30 ns), of which every portal has the same
  /// part. A portal that needs more takes what its search has not ruled out by then for visible. The default
  /// is about ten minutes of one thread.
  std::uint64_t work_limit = 20'000'000'000;
};

/// What compute() did.
struct Statistics {
  std::size_t portals = 0;     ///< both directions counted
  std::size_t candidates = 0;  ///< kFull: pairs of directed portals left by the flood
  std::size_t seen = 0;        ///< kFull: pairs of directed portals that may see each other
  std::uint64_t work = 0;      ///< kFull: in the unit of Options::work_limit
  std::size_t cut_short = 0;   ///< kFull: portals that came to their part of the limit
  bool too_large = false;      ///< kFast was done instead of kFull: more than kLargestFull portals
};

/// Portals (each counted once) up to which kFull is done; its two bit matrices then take 8 GB.
inline constexpr std::size_t kLargestFull = 89'000;

/// The potentially visible sets of a world. kFull needs (2 * portals)² / 4 bytes of memory besides its input,
/// kFast little. The result does not depend on the number of threads.
/// @param statistics  filled if not null
/// @throws Error kInternal if a portal has a cluster that there is not, the same cluster on both sides, fewer
///         than three vertices, a number that is not finite, a normal that is not of unit length, no extent,
///         a vertex off its plane, or is not convex; the message names the portal
VisibleSets compute(const bsp::PortalGraph& graph, const Options& options, Statistics* statistics = nullptr);

}  // namespace hallway::pvs

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace hallway {

/// Calls `work(begin, end)` for consecutive chunks that together cover [0, count), on up to `threads` threads (the
/// caller's is one of them). The chunks depend on `count` and `grain` alone, never on the number of threads, so that work
/// which writes only to places of its own chunk gives the same bytes on any number of threads. If chunks throw, the
/// exception of the first chunk, in order, is rethrown once all have ended.
///
/// @param count    number of items
/// @param grain    items in a chunk, at least 1
/// @param threads  at least 1
void parallel_for(std::size_t count, std::size_t grain, unsigned threads,
                  const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Number of hardware threads, at least 1.
unsigned hardware_threads();

}  // namespace hallway

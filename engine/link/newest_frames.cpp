// SPDX-License-Identifier: MIT
#include "link/newest_frames.hpp"

#include <utility>

namespace hallway::link {

FrameReply NewestFrames::take(const Datagram& fragment) {
  const Header& header = fragment.header;
  if (newest_ && header.sequence <= *newest_) {
    ++(header.sequence == *newest_ ? counters_.duplicates : counters_.late);
    return {};
  }
  Assembly* assembly = assembly_for(header);
  if (assembly == nullptr) {
    ++counters_.late;
    return {};
  }
  switch (assembly->add(fragment)) {
    case Assembly::Added::kMisfit:
      ++counters_.misfits;
      break;
    case Assembly::Added::kDuplicate:
      ++counters_.duplicates;
      break;
    case Assembly::Added::kNew:
      if (assembly->complete()) finish(*assembly);
      break;
  }
  return {};
}

/// The one of that frame, else a free one, else that of the oldest frame if it is older; null if there is none.
Assembly* NewestFrames::assembly_for(const Header& header) {
  Assembly* place = nullptr;
  for (Assembly& assembly : assemblies_) {
    if (assembly.begun() && assembly.sequence() == header.sequence) return &assembly;
  }
  for (Assembly& assembly : assemblies_) {
    if (!assembly.begun()) {
      place = &assembly;
      break;
    }
    if (place == nullptr || assembly.sequence() < place->sequence()) place = &assembly;
  }
  if (place->begun() && place->sequence() > header.sequence) return nullptr;
  if (place->begun()) ++given_up_;
  place->begin(header);
  return place;
}

void NewestFrames::finish(Assembly& whole) {
  const std::uint64_t sequence = whole.sequence();
  if (waiting_) std::swap(ready_, overtaken_);
  whole.take(ready_);
  counters_.lost += newest_ ? sequence - *newest_ - 1 : sequence;
  for (Assembly& assembly : assemblies_) {
    if (!assembly.begun() || assembly.sequence() > sequence) continue;
    ++given_up_;
    assembly.clear();
  }
  counters_.incomplete += std::exchange(given_up_, 0);
  ++counters_.frames;
  if (waiting_) {
    ++counters_.skipped;
    carried_.carry(overtaken_, ready_);
  }
  waiting_ = newest_ = sequence;
}

std::optional<std::uint64_t> NewestFrames::next(Bytes& frame) {
  if (waiting_) std::swap(frame, ready_);
  return std::exchange(waiting_, std::nullopt);
}

}  // namespace hallway::link

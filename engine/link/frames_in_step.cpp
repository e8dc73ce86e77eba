// SPDX-License-Identifier: MIT
#include "link/frames_in_step.hpp"

#include <utility>

namespace hallway::link {

FrameReply FramesInStep::take(const Datagram& fragment) {
  const Header& header = fragment.header;
  if (last_ != Last::kNone && header.sequence <= sequence_) return about_last(fragment);
  if (waits_for_answer() || (assembly_.begun() && header.sequence != assembly_.sequence())) {
    ++counters_.misfits;  // it did not wait for the answer, or left a frame unfinished
    return {};
  }
  if (!assembly_.begun()) assembly_.begin(header);
  switch (assembly_.add(fragment)) {
    case Assembly::Added::kMisfit:
      ++counters_.misfits;
      return {};
    case Assembly::Added::kDuplicate:
      ++counters_.duplicates;
      break;
    case Assembly::Added::kNew:
      break;
  }
  FrameReply reply = state_of(fragment);
  if (assembly_.complete()) {
    last_ = Last::kWhole;
    sequence_ = header.sequence;
    fragments_ = header.fragments;
    assembly_.take(ready_);
    ++counters_.frames;
  }
  return reply;
}

FrameReply FramesInStep::about_last(const Datagram& fragment) {
  if (fragment.header.sequence < sequence_) {
    ++counters_.late;
    return {};
  }
  if (fragment.header.fragments != fragments_) {
    ++counters_.misfits;
    return {};
  }
  ++counters_.duplicates;
  if (!fragment.header.wants_reply()) return {};
  if (last_ == Last::kAnswered) return {.kind = FrameReply::Kind::kAnswer};
  return {.kind = FrameReply::Kind::kMissing, .missing = std::vector<bool>(fragments_, false)};
}

FrameReply FramesInStep::state_of(const Datagram& fragment) const {
  if (!fragment.header.wants_reply()) return {};
  FrameReply reply{.kind = FrameReply::Kind::kMissing, .missing = std::vector<bool>(assembly_.fragments())};
  for (std::size_t i = 0; i < reply.missing.size(); ++i) reply.missing[i] = !assembly_.has(i);
  return reply;
}

std::optional<std::uint64_t> FramesInStep::next(Bytes& frame) {
  if (last_ != Last::kWhole) return std::nullopt;
  last_ = Last::kRead;
  std::swap(frame, ready_);
  return sequence_;
}

void FramesInStep::answered(std::uint64_t sequence) {
  if (last_ == Last::kRead && sequence == sequence_) last_ = Last::kAnswered;
}

}  // namespace hallway::link

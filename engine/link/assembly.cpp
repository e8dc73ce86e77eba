// SPDX-License-Identifier: MIT
#include "link/assembly.hpp"

#include <cstring>

namespace hallway::link {

void Assembly::begin(const Header& first) {
  begun_ = true;
  header_ = first;
  begin_.assign(first.fragments, kAbsent);
  present_ = 0;
  last_bytes_ = 0;
  store_.clear();
}

Assembly::Added Assembly::add(const Datagram& fragment) {
  const std::size_t index = fragment.header.fragment;
  if (fragment.header.fragments != begin_.size()) return Added::kMisfit;
  if (begin_[index] != kAbsent) return Added::kDuplicate;
  begin_[index] = static_cast<std::uint32_t>(store_.size());
  store_.insert(store_.end(), fragment.payload.begin(), fragment.payload.end());
  if (index + 1 == begin_.size()) last_bytes_ = fragment.payload.size();
  ++present_;
  return Added::kNew;
}

void Assembly::take(Bytes& message) {
  const std::size_t last = begin_.size() - 1;
  message.resize(last * kFragmentBytes + last_bytes_);
  for (std::size_t i = 0; i <= last; ++i) {
    const std::size_t bytes = i < last ? kFragmentBytes : last_bytes_;
    if (bytes != 0) std::memcpy(message.data() + i * kFragmentBytes, store_.data() + begin_[i], bytes);
  }
  clear();
}

}  // namespace hallway::link

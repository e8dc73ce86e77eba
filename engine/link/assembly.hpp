// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "link/datagram.hpp"

namespace hallway::link {

/// A message that is put together from its fragments, in whatever order and however often they come. Memory grows with the bytes that are
/// there, and by 4 bytes for each fragment that is promised.
class Assembly {
 public:
  /// What add() made of a fragment.
  enum class Added { kNew, kDuplicate, kMisfit };

  /// Forgets what is there, and begins a message of as many fragments as `first` says.
  void begin(const Header& first);
  /// Forgets what is there.
  void clear() { begun_ = false; }
  bool begun() const { return begun_; }

  /// Adds a fragment of the message that was begun. kMisfit: it is of another number of fragments.
  Added add(const Datagram& fragment);
  bool complete() const { return begun_ && present_ == begin_.size(); }
  std::uint64_t sequence() const { return header_.sequence; }
  std::uint32_t session() const { return header_.session; }
  std::uint8_t version() const { return header_.version; }
  std::uint16_t fragments() const { return header_.fragments; }
  bool has(std::size_t fragment) const { return begin_[fragment] != kAbsent; }

  /// Writes the complete message over `message`, and forgets it.
  void take(Bytes& message);

 private:
  static constexpr std::uint32_t kAbsent = UINT32_MAX;

  bool begun_ = false;
  Header header_;
  std::vector<std::uint32_t> begin_;  ///< by fragment: where it begins in store_
  std::size_t present_ = 0;
  std::size_t last_bytes_ = 0;  ///< of the last fragment, once it is there
  Bytes store_;                 ///< the fragments in the order in which they came
};

}  // namespace hallway::link

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/random.hpp"
#include "link/wire.hpp"

namespace hallway::link {

/// A wire that loses datagrams: of those sent, and of those that come, each with the same probability. Which ones follows from the seed and their
/// number alone.
class LossyWire final : public Wire {
 public:
  /// Keeps a reference to `wire`.
  /// @param loss  from 0 to 1
  LossyWire(Wire& wire, double loss, std::uint64_t seed);

  void send(std::span<const std::byte> datagram, const Address& to) override;
  std::optional<std::size_t> receive(std::span<std::byte> room, Address& from,
                                     std::chrono::milliseconds wait) override;

 private:
  Wire& wire_;
  double loss_;
  Random of_sent_;
  Random of_received_;
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
};

}  // namespace hallway::link

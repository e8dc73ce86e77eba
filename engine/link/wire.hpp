// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "link/address.hpp"

namespace hallway::link {

/// What carries datagrams, or loses them, as it likes. One thread may send while another one receives.
class Wire {
 public:
  Wire() = default;
  virtual ~Wire() = default;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  /// Sends a datagram; what cannot be sent is lost.
  virtual void send(std::span<const std::byte> datagram, const Address& to) = 0;
  /// Waits for a datagram, `wait` at most; a signal may end that early.
  /// @param room  gets as much of it as there is room for
  /// @param from  gets its sender's address
  /// @return its whole length; empty if none came
  virtual std::optional<std::size_t> receive(std::span<std::byte> room, Address& from,
                                             std::chrono::milliseconds wait) = 0;
};

}  // namespace hallway::link

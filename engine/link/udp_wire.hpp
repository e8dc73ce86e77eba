// SPDX-License-Identifier: MIT
#pragma once

#include "link/wire.hpp"

namespace hallway::link {

/// A UDP socket that listens to one address.
class UdpWire final : public Wire {
 public:
  /// @param listen  port 0: any that is free
  /// Throws Error{kIo} naming the address if it cannot be had.
  explicit UdpWire(const Address& listen);
  ~UdpWire() override;

  /// Where it listens, with the port that it was given.
  const Address& address() const { return address_; }

  void send(std::span<const std::byte> datagram, const Address& to) override;
  std::optional<std::size_t> receive(std::span<std::byte> room, Address& from,
                                     std::chrono::milliseconds wait) override;

 private:
  int socket_ = -1;
  Address address_;
};

/// The address of this machine from which datagrams to `peer` go out, with port 0. Nothing is sent. Throws Error{kIo} if there is no way there.
Address local_address_towards(const Address& peer);

}  // namespace hallway::link

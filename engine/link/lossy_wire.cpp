// SPDX-License-Identifier: MIT
#include "link/lossy_wire.hpp"

namespace hallway::link {

LossyWire::LossyWire(Wire& wire, double loss, std::uint64_t seed)
    : wire_(wire),
      loss_(loss),
      of_sent_(seed, stream_id("link.loss.sent")),
      of_received_(seed, stream_id("link.loss.received")) {}

void LossyWire::send(std::span<const std::byte> datagram, const Address& to) {
  if (of_sent_.uniform(0, sent_++) >= loss_) wire_.send(datagram, to);
}

std::optional<std::size_t> LossyWire::receive(std::span<std::byte> room, Address& from,
                                              std::chrono::milliseconds wait) {
  const auto bytes = wire_.receive(room, from, wait);
  if (bytes && of_received_.uniform(0, received_++) < loss_) return std::nullopt;
  return bytes;
}

}  // namespace hallway::link

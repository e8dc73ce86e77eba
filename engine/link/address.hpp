// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hallway::link {

/// An IP address with a port.
struct Address {
  bool v6 = false;
  std::array<std::uint8_t, 16> ip{};  ///< in network order; of an IPv4 address the first four
  std::uint32_t scope = 0;            ///< which interface a link-local IPv6 address is of
  std::uint16_t port = 0;

  friend bool operator==(const Address&, const Address&) = default;
};

/// Reads "127.0.0.1:7000", "[::1]:7000" or "[fe80::1%eth0]:7000": numbers, never names, so that nothing is asked of the network. Throws
/// Error{kUsage} saying what is wrong.
Address parse_address(std::string_view text);

/// The form that parse_address() reads.
std::string print_address(const Address& address);

}  // namespace hallway::link

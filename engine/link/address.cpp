// SPDX-License-Identifier: MIT
#include "link/address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>

#include <cstring>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::link {
namespace {

[[noreturn]] void bad(std::string_view text, const std::string& cause) {
  throw Error(ErrorCode::kUsage, fmt::format("\"{}\" is no address: {}", printable(text), cause));
}

std::uint16_t parse_port(std::string_view text, std::string_view port) {
  const auto number = parse_uint(port);
  if (!number || *number > 65535) {
    bad(text, fmt::format("the port is a number from 0 to 65535, not \"{}\"", printable(port)));
  }
  return static_cast<std::uint16_t>(*number);
}

void parse_scope(std::string_view text, std::string_view scope, Address& address) {
  const std::string name(scope);
  const auto number = parse_uint(scope);
  address.scope = number ? static_cast<std::uint32_t>(*number) : ::if_nametoindex(name.c_str());
  if (address.scope == 0) bad(text, fmt::format("there is no interface \"{}\"", printable(scope)));
}

Address parse_v6(std::string_view text) {
  const std::size_t close = text.find("]:");
  if (close == std::string_view::npos) bad(text, "after an IPv6 address in brackets stands :PORT");
  std::string_view ip = text.substr(1, close - 1);
  Address address;
  address.v6 = true;
  address.port = parse_port(text, text.substr(close + 2));
  if (const std::size_t percent = ip.find('%'); percent != std::string_view::npos) {
    parse_scope(text, ip.substr(percent + 1), address);
    ip = ip.substr(0, percent);
  }
  if (::inet_pton(AF_INET6, std::string(ip).c_str(), address.ip.data()) != 1) {
    bad(text, fmt::format("\"{}\" is no IPv6 address", printable(ip)));
  }
  return address;
}

}  // namespace

Address parse_address(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) bad(text, "it holds a NUL");
  if (text.starts_with('[')) return parse_v6(text);
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) bad(text, "it is IP:PORT, such as 127.0.0.1:7000 or [::1]:7000");
  const std::string ip(text.substr(0, colon));
  if (ip.find(':') != std::string::npos) bad(text, "an IPv6 address is written in brackets: [::1]:7000");
  Address address;
  address.port = parse_port(text, text.substr(colon + 1));
  if (::inet_pton(AF_INET, ip.c_str(), address.ip.data()) != 1) {
    bad(text, fmt::format("\"{}\" is no IPv4 address (names are not looked up)", printable(ip)));
  }
  return address;
}

std::string print_address(const Address& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(address.v6 ? AF_INET6 : AF_INET, address.ip.data(), text.data(), text.size());
  if (!address.v6) return fmt::format("{}:{}", text.data(), address.port);
  const std::string scope = address.scope != 0 ? fmt::format("%{}", address.scope) : std::string();
  return fmt::format("[{}{}]:{}", text.data(), scope, address.port);
}

}  // namespace hallway::link

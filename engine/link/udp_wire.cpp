// SPDX-License-Identifier: MIT
#include "link/udp_wire.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/error.hpp"

namespace hallway::link {
namespace {

/// Room in the kernel for what comes while the receiving thread is not scheduled; it gives as much of it as it may.
constexpr int kReceiveBytes = 4 << 20;

/// An address as the kernel has it.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);

  SocketAddress() = default;
  explicit SocketAddress(const Address& address) {
    if (address.v6) {
      sockaddr_in6 in{};
      in.sin6_family = AF_INET6;
      in.sin6_port = htons(address.port);
      in.sin6_scope_id = address.scope;
      std::memcpy(&in.sin6_addr, address.ip.data(), sizeof in.sin6_addr);
      std::memcpy(&storage, &in, size = sizeof in);
    } else {
      sockaddr_in in{};
      in.sin_family = AF_INET;
      in.sin_port = htons(address.port);
      std::memcpy(&in.sin_addr, address.ip.data(), sizeof in.sin_addr);
      std::memcpy(&storage, &in, size = sizeof in);
    }
  }

  Address address() const {
    Address address;
    address.v6 = storage.ss_family == AF_INET6;
    if (address.v6) {
      sockaddr_in6 in{};
      std::memcpy(&in, &storage, sizeof in);
      address.port = ntohs(in.sin6_port);
      address.scope = in.sin6_scope_id;
      std::memcpy(address.ip.data(), &in.sin6_addr, sizeof in.sin6_addr);
    } else {
      sockaddr_in in{};
      std::memcpy(&in, &storage, sizeof in);
      address.port = ntohs(in.sin_port);
      std::memcpy(address.ip.data(), &in.sin_addr, sizeof in.sin_addr);
    }
    return address;
  }

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

[[noreturn]] void fail(const char* what, const Address& address) {
  throw Error(ErrorCode::kIo, std::string(what) + ": " + std::generic_category().message(errno),
              {.file = print_address(address)});
}

int open_socket(const Address& address) {
  const int made = ::socket(address.v6 ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (made < 0) fail("no socket", address);
  return made;
}

Address name_of(int socket, const Address& otherwise) {
  SocketAddress name;
  if (::getsockname(socket, name.get(), &name.size) != 0) return otherwise;
  return name.address();
}

}  // namespace

UdpWire::UdpWire(const Address& listen) : socket_(open_socket(listen)), address_(listen) {
  const int on = 1;
  // An IPv6 address stands for itself alone, not for every IPv4 address too.
  if (listen.v6) ::setsockopt(socket_, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on);
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &kReceiveBytes, sizeof kReceiveBytes);
  const SocketAddress name(listen);
  if (::bind(socket_, name.get(), name.size) != 0) {
    const int error = errno;
    ::close(socket_);
    errno = error;
    fail("cannot listen", listen);
  }
  address_ = name_of(socket_, listen);
}

UdpWire::~UdpWire() {
  ::close(socket_);
}

void UdpWire::send(std::span<const std::byte> datagram, const Address& to) {
  const SocketAddress name(to);
  while (::sendto(socket_, datagram.data(), datagram.size(), MSG_NOSIGNAL, name.get(), name.size) < 0 &&
         errno == EINTR) {
  }
}

std::optional<std::size_t> UdpWire::receive(std::span<std::byte> room, Address& from,
                                            std::chrono::milliseconds wait) {
  SocketAddress name;
  const auto take = [&] {
    name.size = sizeof name.storage;
    return ::recvfrom(socket_, room.data(), room.size(), MSG_TRUNC, name.get(), &name.size);
  };
  ssize_t bytes = take();
  if (bytes < 0 && wait.count() > 0) {
    pollfd entry{.fd = socket_, .events = POLLIN, .revents = 0};
    const auto limit = std::min<std::chrono::milliseconds::rep>(wait.count(), 1'000'000);
    if (::poll(&entry, 1, static_cast<int>(limit)) <= 0) return std::nullopt;
    bytes = take();
  }
  if (bytes < 0) return std::nullopt;
  from = name.address();
  return static_cast<std::size_t>(bytes);
}

Address local_address_towards(const Address& peer) {
  const int probe = open_socket(peer);
  const SocketAddress name(peer);
  const bool reached = ::connect(probe, name.get(), name.size) == 0;
  const int error = errno;
  Address local = name_of(probe, peer);
  ::close(probe);
  errno = error;
  if (!reached) fail("there is no way to this address", peer);
  local.port = 0;
  return local;
}

}  // namespace hallway::link

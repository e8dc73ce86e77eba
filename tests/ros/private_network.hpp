// SPDX-License-Identifier: MIT
#pragma once

#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace hallway::test {

/// Moves this process, which must have one thread, into a network of its own with nothing but the loopback device. What it
/// starts is in there too. @return empty, or why it is not permitted
inline std::string enter_private_network() {
  if (::unshare(CLONE_NEWNET) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0)
    return std::strerror(errno);
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  request.ifr_flags = IFF_UP;
  const bool up = ::ioctl(socket, SIOCSIFFLAGS, &request) == 0;
  const std::string cause = up ? "" : std::strerror(errno);
  ::close(socket);
  return cause;
}

}  // namespace hallway::test

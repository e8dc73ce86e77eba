// SPDX-License-Identifier: MIT
#pragma once

namespace hallway::host {

// Descriptors with which a plugin's process is started, beside 0 (nothing), 1 and 2 (one pipe).
inline constexpr int kRequestDescriptor = 3;  ///< memory: requests
inline constexpr int kReplyDescriptor = 4;    ///< memory: replies
inline constexpr int kLogDescriptor = 5;      ///< a socket of packets: what the plugin logs

/// What stands before the text in a packet of the log.
struct LogHead {
  unsigned level;
};

/// What the process of an isolated plugin does, from its start to its end: confines itself, makes the plugin that it is told and passes the host's calls
/// on to it. Does not return.
/// @param parent  the number of the process that started this one
[[noreturn]] void serve_plugin(long parent);

}  // namespace hallway::host

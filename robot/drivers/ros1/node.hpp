// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>

#include "ros1/settings.hpp"

namespace hallway::ros1 {

/// This process as a node of the ROS graph. roscpp is one for the process, so there is one at a time, and whoever opens
/// again must do so under the same name and with the same master.
class Node {
 public:
  /// Starts roscpp; its master has answered just now. Installs no signal handlers. Throws sdk::Failure.
  explicit Node(const Settings& settings);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Leaves the graph.
  /// @param tell_master  false: it does not answer, and telling it would take as long as the system keeps a connection
  void shut_down(bool tell_master);

  /// Whether somebody asked this node to end: `rosnode kill`, or the master because another node took the name.
  static bool end_asked();

 private:
  struct sigaction previous_sigpipe_ {};
};

}  // namespace hallway::ros1

// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace hallway::ros1 {

/// Where a ROS master is.
struct MasterAddress {
  std::string uri{};
  std::string host{};
  std::string port{};
};

/// Reads "http://HOST:PORT". Throws sdk::Failure. (roscpp ends the program where it cannot read it.)
MasterAddress parse_master(const std::string& uri);

/// What a master answered.
struct MasterAnswer {
  std::optional<std::string> pid{};  ///< its process id; unset: it does not answer
  std::string problem{};             ///< why not
};

/// Asks the master who it is, and gives up after `limit`. (roscpp waits as long as the system keeps a connection that says nothing.)
MasterAnswer ask_master(const MasterAddress& address, std::chrono::milliseconds limit);

/// Asks until the master answers or `limit` is over.
MasterAnswer wait_for_master(const MasterAddress& address, std::chrono::milliseconds limit);

/// Asks the master every second, by a thread of its own, and tells when it goes and comes.
class MasterWatch {
 public:
  MasterWatch(MasterAddress address, std::string pid);
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  bool answers() const { return answers_; }
  /// How often it stopped answering.
  std::uint64_t times_lost() const { return times_lost_; }

 private:
  void watch();
  void take(const MasterAnswer& answer);

  MasterAddress address_;
  std::string pid_;
  std::atomic<bool> answers_ = true;
  std::atomic<std::uint64_t> times_lost_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace hallway::ros1

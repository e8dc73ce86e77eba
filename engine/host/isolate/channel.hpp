// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/shared_memory.hpp"
#include "host/isolate/crash_record.hpp"

namespace hallway::host {

/// What the host asks of a plugin's process. The numbers are those of one build: both sides compare kChannelVersion.
enum class Request : std::uint32_t {
  kStart = 1,     ///< confine yourself, find the plugin and make it
  kSetParameter,  ///< name, value, where it was said
  kGetParameter,  ///< index
  kActivate,      ///< sensors
  kReset,         ///< nothing
  kProcess,       ///< a frame (frame_bytes.hpp)
  kReport,        ///< whether to refine
  kClose,         ///< end in good order
  kDescribe,      ///< instead of kStart: confine yourself, load one file and say what is in it
};

/// The name of the plugin's function that a request calls, for messages: "process".
const char* call_name(Request request);

/// The same, of kStart and kDescribe the step that was begun last (load_step.hpp): "init".
const char* call_name(Request request, std::uint32_t load_step);

/// How the plugin's process answers.
enum class Reply : std::uint32_t {
  kDone = 1,  ///< with what was asked for
  kError,     ///< with an Error
};

inline constexpr std::uint32_t kChannelVersion = 4;

/// Calls that may be under way at a time. Eight would do for two processors that have nothing else to do; more carry over the times in which a busy
/// machine lets one side wait.
inline constexpr std::uint32_t kSlots = 64;

/// A request or a reply, as it stands in shared memory.
struct Entry {
  std::uint32_t kind;  ///< Request or Reply
  std::uint32_t slot;  ///< where its bytes stand
  std::uint64_t size;  ///< of its bytes
  std::int64_t wall_ns;
  std::int64_t cpu_ns;
};

/// What stands at the beginning of the memory that the host alone writes.
struct RequestArea {
  std::uint32_t version;
  FutexWord submitted;  ///< counts requests
  FutexWord wake_at;    ///< number of replies at which the host wants to be woken
  std::array<Entry, kSlots> entries;
};

/// What stands at the beginning of the memory that the plugin's process writes.
struct ReplyArea {
  FutexWord answered;  ///< counts replies
  std::array<Entry, kSlots> entries;
  CrashRecord crash;
};

/// Two pieces of memory shared by the host and a plugin's process: requests with their bytes, which only the host can write, and replies with
/// theirs. Each has kSlots slots, so that as many calls may be under way; calls are answered in their order. Slots are as large as anybody may
/// need: pages that nobody has touched take no memory.
class HostChannel {
 public:
  /// Throws Error{kIo}.
  HostChannel();

  int request_descriptor() const { return requests_.descriptor(); }
  int reply_descriptor() const { return replies_.descriptor(); }

  /// Calls under way.
  std::uint32_t under_way() const { return submitted_ - answered_; }
  /// Room for the bytes of the next request, with fewer than kSlots calls under way.
  std::span<std::byte> room();
  /// Submits a request of the first `size` bytes of room().
  void submit(Request request, std::size_t size);

  /// Sleeps until the oldest call under way is answered, at most `limit`. May return early for no reason.
  /// @return whether it is
  bool wait(std::chrono::nanoseconds limit);
  /// A reply with its bytes, which the other side may still change.
  struct Answer {
    Reply reply{};
    std::span<const std::byte> bytes{};
    std::int64_t wall_ns = 0;
    std::int64_t cpu_ns = 0;
  };
  /// The answer that wait() saw; the bytes stand until kSlots further calls. Throws BadBytes.
  Answer take();

  /// How much memory requests have taken so far.
  std::uint64_t request_bytes() const { return request_bytes_; }

  /// How the plugin's process says that it crashed.
  CrashRecord& crash() { return reply_area_->crash; }

 private:
  bool is_answered() const;

  SharedMemory requests_;
  SharedMemory replies_;
  RequestArea* request_area_;
  ReplyArea* reply_area_;
  std::uint32_t submitted_ = 0;
  std::uint32_t answered_ = 0;
  std::uint32_t slot_ = 0;                     ///< of the next request
  std::array<std::size_t, kSlots> largest_{};  ///< request in each slot
  std::uint64_t request_bytes_ = 0;            ///< their sum
};

/// The plugin's side.
class PluginChannel {
 public:
  /// Takes both descriptors. Throws Error{kIo} where they are not those of a HostChannel of this version.
  PluginChannel(int request_descriptor, int reply_descriptor);

  struct Call {
    Request request{};
    std::span<const std::byte> bytes{};
    std::span<std::byte> room{};  ///< for the bytes of the reply
  };
  /// Sleeps until there is a request.
  Call receive();
  /// Answers the call received last with the first `size` bytes of its room.
  void answer(Reply reply, std::size_t size, std::int64_t wall_ns = 0, std::int64_t cpu_ns = 0);
  /// Wakes a host that waits for an answer, so that it looks at what else there is.
  void nudge() { futex_wake(reply_area_->answered); }

  CrashRecord& crash() { return reply_area_->crash; }

 private:
  SharedMemory requests_;
  SharedMemory replies_;
  const RequestArea* request_area_;
  ReplyArea* reply_area_;
  std::uint32_t received_ = 0;
  std::uint32_t slot_ = 0;
};

}  // namespace hallway::host

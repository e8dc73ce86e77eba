// SPDX-License-Identifier: MIT
#include "host/isolate/channel.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <thread>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "host/load/load_step.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t kHeadBytes = std::size_t{64} << 10;
constexpr std::size_t kRequestBytes = std::size_t{128} << 20;  ///< of a slot
constexpr std::size_t kReplyBytes = std::size_t{256} << 20;    ///< of a slot
constexpr std::size_t kPage = std::size_t{64} << 10;           ///< the largest that a kernel has: on arm64
constexpr std::chrono::microseconds kSpin{20};
static_assert(sizeof(RequestArea) <= kHeadBytes && sizeof(ReplyArea) <= kHeadBytes);

/// A limit of this process, as a share of it for one slot.
std::size_t share_of_limit(int resource, std::size_t parts) {
  rlimit limit{};
  ::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return SIZE_MAX;
  return limit.rlim_cur / parts / kPage * kPage;
}

/// What a slot may have: limits on addresses and on the size of files count for shared memory too, and going over the second would end us.
std::size_t slot_bytes(std::size_t wanted) {
  return std::min({wanted, share_of_limit(RLIMIT_FSIZE, kSlots + 1), share_of_limit(RLIMIT_AS, 8 * kSlots)});
}

std::size_t size_of(std::size_t wanted) {
  return kHeadBytes + kSlots * slot_bytes(wanted);
}

std::span<std::byte> slot_of(const SharedMemory& memory, std::uint32_t slot) {
  const std::size_t size = (memory.bytes().size() - kHeadBytes) / kSlots;
  return memory.bytes().subspan(kHeadBytes + slot * size, size);
}

template <typename Area>
Area* area_of(const SharedMemory& memory) {
  if (memory.bytes().size() < kHeadBytes)
    throw Error(ErrorCode::kIo, "the shared memory is not that of this program");
  return static_cast<Area*>(static_cast<void*>(memory.bytes().data()));
}

void pause_processor() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Looks for a short time, since sleeping and being woken takes longer than most answers; with one processor only the other side could use it.
template <typename Condition>
bool spin_until(Condition&& condition) {
  static const bool kAlone = std::thread::hardware_concurrency() < 2;
  if (condition()) return true;
  if (kAlone) return false;
  const auto end = std::chrono::steady_clock::now() + kSpin;
  do {
    for (int i = 0; i < 32; ++i) pause_processor();
    if (condition()) return true;
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

const char* call_name(Request request) {
  switch (request) {
    case Request::kStart:
    case Request::kDescribe:
      return "load";
    case Request::kSetParameter:
      return "set";
    case Request::kGetParameter:
      return "get";
    case Request::kActivate:
      return "activate";
    case Request::kReset:
      return "reset";
    case Request::kProcess:
      return "process";
    case Request::kReport:
      return "report";
    case Request::kClose:
      return "close";
  }
  return "?";
}

const char* call_name(Request request, std::uint32_t load_step) {
  const bool loads = request == Request::kStart || request == Request::kDescribe;
  return loads ? load_step_name(load_step) : call_name(request);
}

HostChannel::HostChannel()
    : requests_("hallway-requests", size_of(kRequestBytes), SharedMemory::Writers::kCreator),
      replies_("hallway-replies", size_of(kReplyBytes), SharedMemory::Writers::kBoth),
      request_area_(area_of<RequestArea>(requests_)),
      reply_area_(area_of<ReplyArea>(replies_)) {
  request_area_->version = kChannelVersion;
}

std::span<std::byte> HostChannel::room() {
  // From the first slot again when nothing is under way, so that one call at a time stays in the same memory.
  if (under_way() == 0) slot_ = 0;
  return slot_of(requests_, slot_);
}

void HostChannel::submit(Request request, std::size_t size) {
  request_area_->entries[submitted_ % kSlots] = {static_cast<std::uint32_t>(request), slot_, size, 0, 0};
  if (size > largest_[slot_]) {
    request_bytes_ += size - largest_[slot_];
    largest_[slot_] = size;
  }
  slot_ = (slot_ + 1) % kSlots;
  request_area_->submitted.store(++submitted_, std::memory_order_release);
  futex_wake(request_area_->submitted);
}

bool HostChannel::is_answered() const {
  return reply_area_->answered.load(std::memory_order_acquire) != answered_;
}

bool HostChannel::wait(std::chrono::nanoseconds limit) {
  if (spin_until([&] { return is_answered(); })) return true;
  // Not for each of many: half of them are taken at once, while the other side has the other half to do.
  // One order of all four: either the answer is seen here, or its writer sees from which one on it has to wake us.
  request_area_->wake_at.store(answered_ + std::max(1u, under_way() / 2), std::memory_order_seq_cst);
  if (reply_area_->answered.load(std::memory_order_seq_cst) != answered_) return true;
  futex_wait(reply_area_->answered, answered_, limit);
  return is_answered();
}

HostChannel::Answer HostChannel::take() {
  const std::uint32_t there = reply_area_->answered.load(std::memory_order_acquire);
  if (there - answered_ > under_way()) throw BadBytes{"more answers than there were calls"};
  const std::uint32_t slot = request_area_->entries[answered_ % kSlots].slot;
  const Entry entry = reply_area_->entries[answered_ % kSlots];
  ++answered_;
  const std::span<const std::byte> room = slot_of(replies_, slot);
  if (entry.size > room.size()) throw BadBytes{"an answer larger than the room for it"};
  if (entry.kind != static_cast<std::uint32_t>(Reply::kDone) &&
      entry.kind != static_cast<std::uint32_t>(Reply::kError)) {
    throw BadBytes{"an answer of an unknown kind"};
  }
  return {static_cast<Reply>(entry.kind), room.first(entry.size), entry.wall_ns, entry.cpu_ns};
}

PluginChannel::PluginChannel(int request_descriptor, int reply_descriptor)
    : requests_(request_descriptor, false),
      replies_(reply_descriptor, true),
      request_area_(area_of<RequestArea>(requests_)),
      reply_area_(area_of<ReplyArea>(replies_)) {
  if (request_area_->version != kChannelVersion)
    throw Error(ErrorCode::kIo, "the host is of another version");
}

PluginChannel::Call PluginChannel::receive() {
  const auto waiting = [&] { return request_area_->submitted.load(std::memory_order_acquire) != received_; };
  while (!spin_until(waiting)) {
    futex_wait(request_area_->submitted, received_, std::chrono::seconds(10));
  }
  const Entry& entry = request_area_->entries[received_ % kSlots];
  slot_ = entry.slot;
  return {static_cast<Request>(entry.kind), slot_of(requests_, slot_).first(entry.size),
          slot_of(replies_, slot_)};
}

void PluginChannel::answer(Reply reply, std::size_t size, std::int64_t wall_ns, std::int64_t cpu_ns) {
  reply_area_->entries[received_ % kSlots] = {static_cast<std::uint32_t>(reply), slot_, size, wall_ns,
                                              cpu_ns};
  reply_area_->answered.store(++received_, std::memory_order_seq_cst);
  const auto beyond =  // as numbers that go round
      static_cast<std::int32_t>(received_ - request_area_->wake_at.load(std::memory_order_seq_cst));
  const bool last = request_area_->submitted.load(std::memory_order_acquire) == received_;
  if (last || beyond >= 0) futex_wake(reply_area_->answered);
}

}  // namespace hallway::host

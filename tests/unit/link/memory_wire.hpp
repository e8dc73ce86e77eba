// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>

#include "link/datagram.hpp"
#include "link/wire.hpp"

namespace hallway::link {

/// Carries datagrams between the MemoryWires that belong to it, in order and without loss.
class MemoryNet {
 public:
  void put(std::span<const std::byte> datagram, const Address& from, const Address& to) {
    const std::lock_guard lock(mutex_);
    waiting_[to.port].push_back({Bytes(datagram.begin(), datagram.end()), from});
    changed_.notify_all();
  }
  std::optional<std::pair<Bytes, Address>> get(const Address& to, std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    auto& queue = waiting_[to.port];
    if (!changed_.wait_for(lock, wait, [&] { return !queue.empty(); })) return std::nullopt;
    auto first = std::move(queue.front());
    queue.pop_front();
    return first;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint16_t, std::deque<std::pair<Bytes, Address>>> waiting_;
};

/// One end of a MemoryNet.
class MemoryWire final : public Wire {
 public:
  MemoryWire(MemoryNet& net, std::uint16_t port) : net_(net) { address_.port = port; }
  const Address& address() const { return address_; }

  void send(std::span<const std::byte> datagram, const Address& to) override {
    net_.put(datagram, address_, to);
  }
  std::optional<std::size_t> receive(std::span<std::byte> room, Address& from,
                                     std::chrono::milliseconds wait) override {
    const auto got = net_.get(address_, wait);
    if (!got) return std::nullopt;
    from = got->second;
    std::copy_n(got->first.begin(), std::min(got->first.size(), room.size()), room.begin());
    return got->first.size();
  }

 private:
  MemoryNet& net_;
  Address address_;
};

}  // namespace hallway::link

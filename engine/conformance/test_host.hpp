// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/output/outputs.hpp"

namespace hallway::conformance {

/// What may be unusual about a host, all of it as the ABI allows.
struct HostShape {
  std::uint32_t growth = 0;    ///< bytes that hw_host_t has more than today
  std::uint32_t reserved = 0;  ///< what hw_host_t.reserved is
  bool extensions = true;      ///< whether there are any
  bool counters = true;        ///< whether counters count as a part of what was put
  hw_status_t answer = HW_OK;  ///< what put() returns, whatever it is given
  const char* name = "hallway";
  const char* version = "0.1.0";
};

/// What was put in one call.
struct Collected {
  std::string bytes{};              ///< all of it, so that equal bytes mean equal outputs
  std::string problem{};            ///< what the host finds wrong with it; empty: nothing
  std::set<std::uint32_t> kinds{};  ///< of outputs
  std::string epoch_problem{};  ///< what is wrong with the counters of HW_COUNTER_MAP_EPOCH; empty if nothing
  std::map<std::uint32_t, std::int64_t> places{};  ///< of the topology: the time of each node, by its id
  bool reserved_written = false;                   ///< a member was not 0 that must be
};

/// The host of one instance. It takes wrong outputs without a word, so that the plugin goes on and only what asks for them finds them.
class TestHost {
 public:
  explicit TestHost(const HostShape& shape);
  TestHost(const TestHost&) = delete;
  TestHost& operator=(const TestHost&) = delete;

  const hw_host_t& host() const {
    return *static_cast<const hw_host_t*>(static_cast<const void*>(memory_.data()));
  }
  /// Begins a call with `frame`; null: with none. `indices` as in host::OutputCollector::begin().
  void begin(const hw_frame_t* frame, std::vector<std::uint32_t> indices);
  Collected finish();
  /// How many outputs came outside of process() and report().
  unsigned out_of_turn() const { return out_of_turn_; }

 private:
  static hw_status_t put(void* self, const hw_output_t* output);
  static const void* get_extension(void* self, const char* id);
  hw_status_t take(const hw_output_t* output);

  HostShape shape_;
  hw_host_vtable_t vtable_;
  std::vector<std::uint64_t> memory_;  ///< the hw_host_t and what it is grown by
  host::OutputCollector collector_;
  std::vector<std::uint32_t> indices_;
  std::uint32_t n_samples_ = 0;
  Collected collected_;
  bool open_ = false;
  std::atomic<unsigned> out_of_turn_ = 0;
};

}  // namespace hallway::conformance

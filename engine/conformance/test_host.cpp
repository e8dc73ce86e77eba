// SPDX-License-Identifier: MIT
#include "conformance/test_host.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "host/output/outputs_bytes.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kRubbishWord = 0xa5a5a5a5a5a5a5a5u;

void write_log(void*, std::uint32_t, const char*) {}

std::string bytes_of(const host::Outputs& outputs, std::uint32_t n_samples) {
  AlignedByteWriter counting{std::span<std::byte>()};
  host::write_outputs(counting, outputs, n_samples);
  std::string bytes(counting.size(), '\0');
  AlignedByteWriter writer{std::as_writable_bytes(std::span(bytes))};
  host::write_outputs(writer, outputs, n_samples);
  return bytes;
}

/// What is wrong with the counters that tell parts of the map, as output.h has them.
std::string epoch_problem(const host::Outputs& outputs) {
  constexpr std::string_view kName = HW_COUNTER_MAP_EPOCH;
  std::size_t epochs = 0, joins = 0;
  for (const host::Counter& counter : outputs.counters()) {
    if (counter.name == kName) ++epochs;
    if (counter.name.starts_with(std::string(kName) + "_")) ++joins;
  }
  if (epochs > 1) return "map_epoch is put twice";
  if (epochs == 1 && !outputs.map_epoch()) return "map_epoch is no whole number from 0 to 2^53";
  const std::vector<host::JoinedEpoch> joined = outputs.joined_epochs();
  if (joined.size() != joins) return "map_epoch_N has no whole number";
  for (const host::JoinedEpoch& part : joined) {
    if (part.into >= part.epoch) return "a part is joined to one that is not older";
    const auto again = std::ranges::find(joined, part.into, &host::JoinedEpoch::epoch);
    if (again != joined.end()) return "a part is joined to one that is itself joined to another";
  }
  return "";
}

}  // namespace

TestHost::TestHost(const HostShape& shape)
    : shape_(shape),
      vtable_{&TestHost::put, &TestHost::get_extension},
      memory_((sizeof(hw_host_t) + shape.growth + 7) / 8, kRubbishWord) {
  hw_host_t host{};
  host.size = static_cast<std::uint32_t>(sizeof host) + shape.growth;
  host.reserved = shape.reserved;
  host.abi = {HW_ABI_MAJOR, HW_ABI_MINOR};
  host.vtable = &vtable_;
  host.self = this;
  host.name = shape.name;
  host.version = shape.version;
  std::memcpy(memory_.data(), &host, sizeof host);
}

void TestHost::begin(const hw_frame_t* frame, std::vector<std::uint32_t> indices) {
  indices_ = std::move(indices);
  n_samples_ = indices_.empty() ? 0 : *std::ranges::max_element(indices_) + 1;
  collected_ = {};
  collector_.begin(frame, indices_);
  open_ = true;
}

Collected TestHost::finish() {
  open_ = false;
  collected_.problem = collector_.finish();
  collected_.epoch_problem = epoch_problem(collector_.outputs());
  if (const host::Topology* topology = collector_.outputs().topology()) {
    for (const hw_topology_node_t& node : topology->nodes()) collected_.places[node.id] = node.t_ns;
  }
  collected_.bytes = bytes_of(collector_.outputs(), n_samples_) + collected_.problem;
  return std::move(collected_);
}

hw_status_t TestHost::put(void* self, const hw_output_t* output) {
  return static_cast<TestHost*>(self)->take(output);
}

hw_status_t TestHost::take(const hw_output_t* output) {
  if (!open_) {
    ++out_of_turn_;
    return HW_ERROR_STATE;
  }
  if (output != nullptr && HW_HAS(output, hw_output_t, payload)) {
    collected_.kinds.insert(output->kind);
    if (output->flags != 0 || output->reserved != 0) collected_.reserved_written = true;
    if (output->kind == HW_OUTPUT_COUNTERS && !shape_.counters) return shape_.answer;
  }
  collector_.put(output);
  return shape_.answer;
}

const void* TestHost::get_extension(void* self, const char* id) {
  static constexpr hw_log_t kLog{&write_log};
  const bool wanted = id != nullptr && std::strcmp(id, HW_EXT_LOG) == 0;
  return wanted && static_cast<const TestHost*>(self)->shape_.extensions ? &kLog : nullptr;
}

}  // namespace hallway::conformance

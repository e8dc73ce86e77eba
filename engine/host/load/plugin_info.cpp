// SPDX-License-Identifier: MIT
#include "host/load/plugin_info.hpp"

#include <fmt/format.h>
#include <hallway/output.h>
#include <hallway/sample.h>

#include <array>

#include "host/load/info_text.hpp"

namespace hallway::host {
namespace {

constexpr std::uint32_t kMaxKinds = 64;

std::vector<std::uint32_t> read_kinds(const std::uint32_t* kinds, std::uint32_t count, const char* member) {
  if (count > kMaxKinds) fail_info(fmt::format("it has {} {}, more than {}", count, member, kMaxKinds));
  if (count > 0 && kinds == nullptr) fail_info(fmt::format("its {} are null", member));
  return {kinds, kinds + count};
}

template <std::size_t N>
std::string kind_name(std::uint32_t kind, const std::array<const char*, N>& names) {
  return kind >= 1 && kind <= N ? names[kind - 1] : fmt::format("kind {}", kind);
}

}  // namespace

PluginInfo read_plugin_info(const hw_plugin_info_t* info) {
  if (info == nullptr) fail_info("the description is null");
  if (!HW_HAS(info, hw_plugin_info_t, n_outputs)) {
    fail_info(fmt::format("its size of {} bytes is too small", info->size));
  }
  PluginInfo result;
  result.id = read_info_id(info->id);
  result.name = read_info_text(info->name, "name");
  result.version = read_info_text(info->version, "version");
  result.vendor = read_info_text(info->vendor, "vendor");
  result.description = read_info_text(info->description, "description");
  result.inputs = read_kinds(info->inputs, info->n_inputs, "inputs");
  result.outputs = read_kinds(info->outputs, info->n_outputs, "outputs");
  return result;
}

std::string sample_kind_name(std::uint32_t kind) {
  static constexpr std::array kNames = {"points",  "planes",   "segments", "range_scan", "bump",
                                        "encoder", "odometry", "image",    "depth"};
  static_assert(kNames.size() == HW_SAMPLE_DEPTH);
  return kind_name(kind, kNames);
}

std::string output_kind_name(std::uint32_t kind) {
  static constexpr std::array kNames = {"pose",          "landmarks", "associations", "submaps",
                                        "counters",      "planes",    "segments",     "topology",
                                        "drive_command", "drawing",   "mapped_planes"};
  static_assert(kNames.size() == HW_OUTPUT_MAPPED_PLANES);
  return kind_name(kind, kNames);
}

}  // namespace hallway::host

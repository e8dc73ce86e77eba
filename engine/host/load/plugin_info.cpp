// SPDX-License-Identifier: MIT
#include "host/load/plugin_info.hpp"

#include <fmt/format.h>

#include "host/load/info_text.hpp"

namespace hallway::host {
namespace {

constexpr std::uint32_t kMaxKinds = 64;

std::vector<std::uint32_t> read_kinds(const std::uint32_t* kinds, std::uint32_t count, const char* member) {
  if (count > kMaxKinds) fail_info(fmt::format("it has {} {}, more than {}", count, member, kMaxKinds));
  if (count > 0 && kinds == nullptr) fail_info(fmt::format("its {} are null", member));
  return {kinds, kinds + count};
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
  if (HW_HAS(info, hw_plugin_info_t, n_optional_inputs))
    result.optional_inputs = read_kinds(info->optional_inputs, info->n_optional_inputs, "optional inputs");
  result.outputs = read_kinds(info->outputs, info->n_outputs, "outputs");
  return result;
}

}  // namespace hallway::host

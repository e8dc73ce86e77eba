// SPDX-License-Identifier: MIT
#include "host/load/driver_info.hpp"

#include <fmt/format.h>

#include <string_view>

#include "base/text.hpp"
#include "host/load/info_text.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t kMaxSettings = 256;

/// "key  what it means [default]", one in each line.
std::vector<DriverSettingInfo> read_settings(const char* text) {
  if (text == nullptr) fail_info("its settings are null");
  std::vector<DriverSettingInfo> settings;
  for (const std::string_view line : split(text, '\n')) {
    if (trim(line).empty()) continue;
    const std::size_t end = line.find(' ');
    const std::string_view help = end == std::string_view::npos ? std::string_view() : line.substr(end);
    settings.push_back({read_info_id(std::string(line.substr(0, end)).c_str()), printable(trim(help), 1000)});
    if (settings.size() > kMaxSettings) fail_info(fmt::format("it has more than {} settings", kMaxSettings));
  }
  return settings;
}

}  // namespace

std::vector<std::string> DriverInfo::setting_keys() const {
  std::vector<std::string> keys;
  for (const DriverSettingInfo& setting : settings) keys.push_back(setting.key);
  return keys;
}

DriverInfo read_driver_info(const hw_driver_info_t* info) {
  if (info == nullptr) fail_info("the description is null");
  if (!HW_HAS(info, hw_driver_info_t, settings)) {
    fail_info(fmt::format("its size of {} bytes is too small", info->size));
  }
  return {.id = read_info_id(info->id),
          .name = read_info_text(info->name, "name"),
          .version = read_info_text(info->version, "version"),
          .vendor = read_info_text(info->vendor, "vendor"),
          .description = read_info_text(info->description, "description"),
          .settings = read_settings(info->settings)};
}

}  // namespace hallway::host

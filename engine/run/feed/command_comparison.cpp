// SPDX-License-Identifier: MIT
#include "run/feed/command_comparison.hpp"

#include <nlohmann/json.hpp>

namespace hallway::run {

void CommandComparison::add(std::uint32_t iteration, const std::optional<log::CommandAnswer>& then,
                            const host::Outputs* outputs) {
  std::optional<log::CommandAnswer> now;
  if (outputs != nullptr && outputs->drive_command()) {
    const host::DriveCommand& command = *outputs->drive_command();
    now = {command.linear_m_s, command.angular_rad_s, command.lateral_m_s};
  }
  if (then) ++compared_;
  if (now == then) return;
  ++different_;
  if (!first_different_) first_different_ = iteration;
}

nlohmann::ordered_json to_json(const CommandComparison& comparison) {
  nlohmann::ordered_json json{{"compared", comparison.compared()}, {"different", comparison.different()}};
  json["first_different"] = nullptr;
  if (comparison.first_different()) json["first_different"] = *comparison.first_different();
  return json;
}

}  // namespace hallway::run

// SPDX-License-Identifier: MIT
//
// Tables of commands, and drives that obey them. Whatever the bytes are, the table is refused with an Error that names its line, or its times grow, its
// numbers are finite, and each kind of drive obeys it within its limits. The first byte chooses the drive.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "drive/command_table.hpp"
#include "drive/drive.hpp"

namespace {

using namespace hallway;

void demand(bool condition) {
  if (!condition) std::abort();
}

drive::DriveSpec spec_of(std::uint8_t choice) {
  drive::DriveSpec spec;
  spec.kind = static_cast<drive::DriveKind>(choice % 4);
  spec.latency_ns = choice % 3 * 40'000'000;
  spec.dead_band_m_s = choice % 5 == 0 ? 0.05 : 0.0;
  if (spec.kind == drive::DriveKind::kTracked) spec.turn_slip = 0.3;
  return spec;
}

void obey(const drive::CommandTable& table, const drive::DriveSpec& spec) {
  constexpr double kSlack = 1e-9;
  constexpr std::int64_t kStep = 50'000'000;
  drive::Drive drive(spec, 1);
  PlanarPose pose;
  for (std::int64_t t = 0; t < 40 * kStep; t += kStep) {
    const drive::Obeyed obeyed = drive.command(t, table.at(t));
    demand(std::abs(obeyed.command.forward_m_s) <= spec.max_speed_m_s + kSlack);
    demand(std::abs(obeyed.command.lateral_m_s) <= drive::lateral_limit(spec) + kSlack);
    demand(std::abs(obeyed.command.angular_rad_s) <= spec.max_angular_rad_s + kSlack);
    for (const drive::Motion& motion : drive.advance(t + kStep)) {
      demand(std::abs(motion.body.to.forward_m_s) <= spec.max_speed_m_s + kSlack);
      pose = move(pose, motion.body);
    }
  }
  demand(std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad));
}

void check(const drive::CommandTable& table) {
  demand(!table.commands().empty() && table.commands().front().t_ns >= 0);
  std::int64_t last = -1;
  for (const drive::TimedCommand& row : table.commands()) {
    demand(row.t_ns > last);
    last = row.t_ns;
    demand(std::isfinite(row.command.forward_m_s) && std::isfinite(row.command.lateral_m_s) &&
           std::isfinite(row.command.angular_rad_s));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const drive::CommandTable table = drive::CommandTable::parse(text, "commands.csv");
    check(table);
    obey(table, spec_of(data[0]));
  } catch (const Error& error) {
    demand(error.code() == ErrorCode::kBadInput && error.where().file == "commands.csv" &&
           error.where().line > 0);
  }
  return 0;
}

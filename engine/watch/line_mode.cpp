// SPDX-License-Identifier: MIT
#include "watch/line_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "watch/plugin_layers.hpp"

namespace hallway::watch {
namespace {

double seconds(std::int64_t t_ns) {
  return static_cast<double>(t_ns) * 1e-9;
}

std::string state_line(const Moment& moment, const Past& past) {
  std::string text = fmt::format("{:.2f} s  frame {}", seconds(moment.t_ns), moment.iteration);
  const PastPlace* place = past.place(moment.iteration);
  if (const auto pose = pose_shown(moment, place)) {
    const Vec3 ahead = pose->q * Vec3::UnitX();
    text += fmt::format("  at ({:.2f}, {:.2f})", pose->t.x(), pose->t.y());
    if (!moment.T_world_body || moment.orientation_known)
      text += fmt::format(" {:.0f} deg", std::atan2(ahead.y(), ahead.x()) * 180.0 / std::numbers::pi + 0.0);
  }
  if (moment.pose && !moment.pose->valid) text += "  lost";
  if (place != nullptr && place->estimate && moment.T_world_body)
    text += fmt::format("  off by {:.3f} m", (place->estimate->t - moment.T_world_body->t).norm());
  if (const auto& obeyed = moment.obeyed)
    text += fmt::format("  {:.2f} m/s {:.2f} rad/s ({})", obeyed->linear_m_s, obeyed->angular_rad_s,
                        log::command_cause_name(obeyed->cause));
  if (moment.topology) text += "  " + topology_text(*moment.topology);
  if (const std::string said = drawn_text(moment.drawing); !said.empty()) text += "  " + said;
  return text + "\n";
}

}  // namespace

LineMode::LineMode(double every_s) : every_ns_(std::max<std::int64_t>(std::llround(every_s * 1e9), 1)) {}

std::string LineMode::add(const Moment& moment) {
  past_.add(moment);
  std::string text;
  for (const Past::Line& line : lines_of(moment))
    text += fmt::format("{:.2f} s  {}\n", seconds(line.t_ns), line.text);
  if (!next_ns_ || moment.t_ns >= *next_ns_) {
    text += state_line(moment, past_);
    next_ns_ = (moment.t_ns / every_ns_ + 1) * every_ns_;
  }
  return text;
}

}  // namespace hallway::watch

// SPDX-License-Identifier: MIT
#include "watch/page.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/text.hpp"
#include "watch/keys.hpp"
#include "watch/plugin_layers.hpp"

namespace hallway::watch {
namespace {

constexpr int kPanelWidth = 27;
constexpr double kDegrees = 180.0 / std::numbers::pi;

double yaw_deg(const Pose& pose) {
  const Vec3 ahead = pose.q * Vec3::UnitX();
  const double yaw = std::atan2(ahead.y(), ahead.x()) * kDegrees;
  return std::abs(yaw) < 0.05 ? 0.0 : yaw;  // no "-0"
}

std::string pose_text(const Pose& pose, bool has_heading) {
  std::string text = fmt::format("{:.2f}, {:.2f} m", pose.t.x(), pose.t.y());
  if (has_heading) text += fmt::format(" {:.0f} deg", yaw_deg(pose));
  return text;
}

std::string speed_text(double linear_m_s, double lateral_m_s, double angular_rad_s) {
  std::string text = fmt::format("{:.2f} m/s", linear_m_s);
  if (lateral_m_s != 0.0) text += fmt::format(" {:.2f} left", lateral_m_s);
  return text + fmt::format(" {:.2f} rad/s", angular_rad_s);
}

void add_plugin(const Subject& subject, std::vector<PanelLine>& lines) {
  const Moment& moment = subject.moment;
  const std::string said = drawn_text(moment.drawing);
  if (!moment.pose && !moment.command && moment.counters.empty() && !moment.topology && said.empty()) return;
  lines.emplace_back("plugin", Role::kEstimate);
  if (moment.topology) {
    const bool is_sure = moment.topology->loop != log::LoopState::kUncertain;
    lines.emplace_back("  " + topology_text(*moment.topology), is_sure ? Role::kText : Role::kContact);
    if (!moment.topology->note.empty())
      lines.emplace_back("  " + printable(moment.topology->note, 60), Role::kDim);
  }
  if (!said.empty()) lines.emplace_back("  " + said, Role::kDrawn);
  if (moment.pose && !moment.pose->valid) lines.emplace_back("  lost", Role::kContact);
  const PastPlace* place = subject.past.place(moment.iteration);
  if (place != nullptr && place->estimate) {
    lines.emplace_back("  " + pose_text(*place->estimate, true), Role::kText);
    if (moment.T_world_body) {
      std::string error =
          fmt::format("  off by {:.3f} m", (place->estimate->t - moment.T_world_body->t).norm());
      if (moment.orientation_known)
        error +=
            fmt::format(" {:.1f} deg", kDegrees * angle_between(place->estimate->q, moment.T_world_body->q));
      lines.emplace_back(std::move(error), Role::kText);
    }
  }
  if (const auto& command = moment.command)
    lines.emplace_back("  " + speed_text(command->linear_m_s, command->lateral_m_s, command->angular_rad_s),
                       Role::kText);
  for (const auto& [name, value] : moment.counters)
    lines.emplace_back(fmt::format("  {} {:.6g}", name, value), Role::kText);
}

std::string title_of(const Subject& subject, const PageState& state) {
  const Player& player = state.player;
  const std::string mode = !state.note.empty() ? state.note
                           : player.at_end()   ? "END"
                           : player.paused()   ? "PAUSED"
                                               : "playing";
  return fmt::format(" {}  {:.2f} s  {} x{:g}{}  {:.3g} m wide", subject.scene.name,
                     static_cast<double>(subject.moment.t_ns) * 1e-9, mode, player.speed(),
                     state.follows ? "  following" : "", state.view.extent_m().x());
}

void put_lines(Grid& grid, const Area& area, const std::vector<PanelLine>& lines) {
  for (int i = 0; i < area.height && i < static_cast<int>(lines.size()); ++i) {
    const auto& [text, role] = lines[static_cast<std::size_t>(i)];
    grid.put(area.column, area.row + i, text, role, area.width);
  }
  const int hidden = static_cast<int>(lines.size()) - area.height;
  if (hidden <= 0 || area.height < 4) return;
  grid.fill(area.column, area.row + area.height - 1, Role::kDim);
  grid.put(area.column, area.row + area.height - 1, fmt::format("  ... {} more", hidden + 1), Role::kDim,
           area.width);
}

void put_log(Grid& grid, const Area& area, const Subject& subject) {
  const auto lines = subject.past.lines(subject.moment.t_ns);
  const auto n = std::min(lines.size(), static_cast<std::size_t>(std::max(area.height, 0)));
  int row = area.row;
  for (const Past::Line& line : lines.last(n)) {
    const Role role = line.level >= HW_LOG_WARNING ? Role::kContact
                      : line.level == HW_LOG_DEBUG ? Role::kDim
                                                   : Role::kText;
    grid.put(area.column, row++,
             fmt::format("{:8.2f} s  {}", static_cast<double>(line.t_ns) * 1e-9, line.text), role,
             area.width);
  }
}

/// The table of keys and the layers, in columns of one height over the canvas.
void put_help(Grid& grid, const Area& area, const ShownLayers& shown) {
  std::vector<PanelLine> lines;
  for (const KeyRow& row : key_table())
    lines.emplace_back(fmt::format("{:<7} {}", row.shown, row.help), Role::kText);
  std::vector<std::size_t> by_key(layers().size());
  std::iota(by_key.begin(), by_key.end(), std::size_t{0});
  std::ranges::sort(by_key, {}, [](std::size_t i) { return layers()[i].key; });
  for (const std::size_t i : by_key) {
    const Layer& layer = layers()[i];
    lines.emplace_back(fmt::format("{:<7} {}{}", layer.key, layer.help, shown.has(i) ? "" : " (hidden)"),
                       shown.has(i) ? Role::kEstimate : Role::kDim);
  }
  for (int row = 0; row < area.height; ++row) {
    for (int column = 0; column < area.width; ++column)
      grid.put(area.column + column, area.row + row, Cell{});
  }
  const int height = std::max(area.height, 1);
  const int columns = (static_cast<int>(lines.size()) + height - 1) / height;
  const int width = area.width / columns;
  for (int i = 0; i < static_cast<int>(lines.size()); ++i) {
    const auto& [text, role] = lines[static_cast<std::size_t>(i)];
    grid.put(area.column + i / height * width, area.row + i % height, text, role, width - 1);
  }
}

void put_frame(Grid& grid, const PageLayout& layout, bool ascii) {
  const char32_t level = ascii ? U'-' : U'─';
  const char32_t upright = ascii ? U'|' : U'│';
  for (int column = 0; column < grid.width(); ++column)
    grid.put(column, layout.lines.row - 1, Cell{level, Role::kDim});
  if (layout.panel.row != layout.canvas.row) {
    for (int column = 0; column < grid.width(); ++column)
      grid.put(column, layout.panel.row - 1, Cell{level, Role::kDim});
    return;
  }
  for (int row = 0; row < layout.panel.height; ++row)
    grid.put(layout.panel.column - 2, layout.panel.row + row, Cell{upright, Role::kDim});
}

}  // namespace

PageLayout layout_of(int width, int height) {
  PageLayout layout;
  const int n_lines = height >= 40 ? 8 : height >= 20 ? 4 : 2;
  layout.lines = {.column = 0, .row = height - 1 - n_lines, .width = width, .height = n_lines};
  const int body = height - 3 - n_lines;  // between the title and the rule above the log
  if (width >= 70) {
    const int panel = width >= 120 ? kPanelWidth + 9 : kPanelWidth;
    layout.canvas = {.column = 0, .row = 1, .width = width - panel - 2, .height = body};
    layout.panel = {.column = width - panel, .row = 1, .width = panel, .height = body};
    return layout;
  }
  const int panel = std::min(5, body / 3);
  layout.canvas = {.column = 0, .row = 1, .width = width, .height = body - panel - 1};
  layout.panel = {.column = 0, .row = 1 + body - panel, .width = width, .height = panel};
  return layout;
}

std::vector<PanelLine> panel_lines(const Subject& subject) {
  const Moment& moment = subject.moment;
  std::vector<PanelLine> lines;
  const std::string total =
      subject.scene.iterations > 0 ? fmt::format(" of {}", subject.scene.iterations - 1) : std::string();
  lines.emplace_back(
      fmt::format("frame {}{}, {:.2f} s", moment.iteration, total, static_cast<double>(moment.t_ns) * 1e-9),
      Role::kText);
  if (moment.T_world_body) {
    lines.emplace_back("at " + pose_text(*moment.T_world_body, moment.orientation_known), Role::kTruth);
  }
  if (const auto& obeyed = moment.obeyed) {
    lines.emplace_back("  " + speed_text(obeyed->linear_m_s, obeyed->lateral_m_s, obeyed->angular_rad_s),
                       Role::kText);
    lines.emplace_back(fmt::format("  by {}{}{}", log::command_cause_name(obeyed->cause),
                                   obeyed->changes.empty() ? "" : ", changed: ", obeyed->changes),
                       Role::kDim);
  }
  if (const auto contacts = subject.past.contacts(moment.t_ns); !contacts.empty())
    lines.emplace_back(fmt::format("  {} contact{}", contacts.size(), contacts.size() == 1 ? "" : "s"),
                       Role::kContact);
  add_plugin(subject, lines);
  if (!moment.readings.empty()) lines.emplace_back("sensors", Role::kSeen);
  for (const std::string& reading : moment.readings) lines.emplace_back("  " + reading, Role::kText);
  return lines;
}

Grid text_page(int width, int height, const std::string& text) {
  Grid grid(width, height);
  grid.put(0, 0, text, Role::kText, width);
  return grid;
}

Grid draw_page(int width, int height, const Subject& subject, const PageState& state) {
  if (width < kLeastWidth || height < kLeastHeight)
    return text_page(width, height,
                     fmt::format("{} x {} is too small: {} x {}", width, height, kLeastWidth, kLeastHeight));
  Grid grid(width, height);
  const PageLayout layout = layout_of(width, height);
  Canvas canvas(layout.canvas.width, layout.canvas.height, state.dots);
  draw_layers(subject, state.layers, {canvas, state.view, state.dots});
  canvas.put(grid, layout.canvas.column, layout.canvas.row);
  grid.fill(0, 0, Role::kTitle);
  grid.put(0, 0, title_of(subject, state), Role::kTitle, width);
  put_frame(grid, layout, state.dots == Dots::kAscii);
  put_lines(grid, layout.panel, panel_lines(subject));
  put_log(grid, layout.lines, subject);
  if (state.shows_help) put_help(grid, {0, 1, width, layout.lines.row - 2}, state.layers);
  grid.fill(0, height - 1, Role::kTitle);
  grid.put(0, height - 1,
           width >= 76 ? " q close  SPACE pause  . , step  + - speed  f follow  z Z zoom  a all  ? keys"
                       : " q close SPACE pause . step ? keys",
           Role::kTitle, width);
  return grid;
}

}  // namespace hallway::watch

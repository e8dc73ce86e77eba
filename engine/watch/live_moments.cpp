// SPDX-License-Identifier: MIT
#include "watch/live_moments.hpp"

#include <utility>

#include "run/feed/frame_feed.hpp"

namespace hallway::watch {

LiveMoments::LiveMoments(const run::Source& source, run::PluginLog& log) : log_(log) {
  maker_.set_sensors(source.sensors());
}

void LiveMoments::add_to(run::RunHooks& hooks, std::function<void(const Moment&)> show) {
  hooks.answered = [this](const run::FrameAnswer& answer) {
    maker_.begin(answer.frame.samples());
    if (answer.frame.T_world_body)
      maker_.add_true_pose(*answer.frame.T_world_body, answer.frame.orientation_known);
    if (answer.outputs != nullptr) maker_.add_answer(*answer.outputs);
  };
  hooks.driven = [this](const run::DriveNotes& notes, std::span<const log::EventRow> events) {
    for (const log::EventRow& event : events) maker_.add_event(event);
    for (const log::ContactRow& contact : notes.contacts) maker_.add_contact(contact);
    for (const log::ObeyedCommand& command : notes.commands) maker_.add_obeyed(command);
  };
  hooks.progress = [this, show = std::move(show)](std::uint32_t) {
    for (const foxglove::LogLine& line : log_.take()) maker_.add_line(line);
    show(maker_.take());
  };
}

}  // namespace hallway::watch

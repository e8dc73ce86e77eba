// SPDX-License-Identifier: MIT
#include "robot/drivers/recorded_frames.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/error.hpp"
#include "base/text.hpp"
#include "log/json_text.hpp"
#include "log/run_log.hpp"
#include "record/robot_parts_json.hpp"
#include "record/sensor_json.hpp"

namespace hallway::robot {
namespace {

[[noreturn]] void bad(const std::string& file, const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.file = file});
}

}  // namespace

RecordedFrames::RecordedFrames(const std::filesystem::path& file)
    : name_(printable(file.string(), 4096)), input_(file) {
  try {
    begin();
    first_ = read();
  } catch (const Error& error) {
    if (error.where().file.empty()) bad(name_, error.message());
    throw;
  }
  if (!described_) bad(name_, "does not say which sensors its robot had");
  if (first_ == nullptr) bad(name_, "holds no frames of Hallway");
}

void RecordedFrames::begin() {
  reader_ = std::make_unique<log::McapReader>(input_);
  round_frames_ = 0;
}

const hw_frame_t* RecordedFrames::read() {
  while (const log::McapItem* item = reader_->next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const log::McapChannel& channel = reader_->channels().at(message->channel_id);
    if (channel.topic != log::topics::kFrame && channel.topic != log::topics::kActivation) continue;
    const log::RunMessage parsed = log::parse_run_message(channel, *message);
    if (const auto* activation = std::get_if<log::ActivationMessage>(&parsed)) {
      if (!described_) read_activation(activation->json);
    }
    if (const auto* frame = std::get_if<log::FrameMessage>(&parsed)) {
      ++round_frames_;
      return &frame_reader_.read(std::as_bytes(std::span(frame->bytes)));
    }
  }
  if (const auto& damage = reader_->damage()) bad(name_, "is damaged: " + damage->cause);
  return nullptr;
}

void RecordedFrames::read_activation(const std::string& text) {
  log::check_json_size(text);
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    period_ns_ = std::max<std::int64_t>(0, json.value("period_ns", std::int64_t{0}));
    for (const auto& entry : json.at("sensors")) {
      activation_.sensors.push_back(record::read_sensor(entry));
      activation_.sensors.back().id = entry.value("id", 0u);
    }
    activation_.drive = record::read_drive_in(json);
    activation_.body = record::read_body_in(json);
  } catch (const nlohmann::json::exception& failure) {
    bad(name_, "the activation: " + printable(failure.what()));
  }
  described_ = true;
}

const hw_frame_t* RecordedFrames::next(bool again) {
  const hw_frame_t* frame = std::exchange(first_, nullptr);
  if (frame == nullptr) frame = read();
  if (frame == nullptr && again) {
    // The frame after the last one comes a step after it, as if the log went on.
    const hw_frame_t last = last_;
    begin();
    frame = read();
    if (frame == nullptr) return nullptr;
    sequence_shift_ = last.sequence + 1 - frame->sequence;
    t_shift_ns_ = last.t_ns + std::max<std::int64_t>(last_step_ns_, 1) - frame->t_ns;
  }
  return frame == nullptr ? nullptr : &moved(*frame);
}

const hw_frame_t& RecordedFrames::moved(const hw_frame_t& frame) {
  frame_ = frame;
  frame_.sequence += sequence_shift_;
  frame_.t_ns += t_shift_ns_;
  samples_.clear();
  pointers_.clear();
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    hw_sample_t& sample = samples_.emplace_back(*frame.samples[i]);
    sample.sequence += sequence_shift_;
    sample.t_begin_ns += t_shift_ns_;
    sample.t_end_ns += t_shift_ns_;
  }
  for (const hw_sample_t& sample : samples_) pointers_.push_back(&sample);
  frame_.samples = pointers_.data();
  if (round_frames_ > 1 || sequence_shift_ != 0) last_step_ns_ = frame_.t_ns - last_.t_ns;
  last_ = frame_;
  return frame_;
}

}  // namespace hallway::robot

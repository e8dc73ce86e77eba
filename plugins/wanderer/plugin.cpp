// SPDX-License-Identifier: MIT
// Drives a robot through a place of which it knows nothing: ahead in gentle curves, off what its bumper touches, and on in another direction.
#include <hallway/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

class Wanderer final : public hallway::sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() {
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_BUMP};
    static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_DRIVE_COMMAND, HW_OUTPUT_COUNTERS};
    static constexpr hw_plugin_info_t kInfo = hallway::sdk::plugin_info(
        "wanderer", "Wanderer", "0.1.0", "Hallway",
        "Drives ahead, and turns away from what its bumper touches.", kInputs, kOutputs);
    return &kInfo;
  }

  explicit Wanderer(const hw_host_t* host) : Plugin(host) {
    parameters().add("speed_m_s", &speed_m_s_, 0.01, 10.0, "m/s", "Speed where nothing is in the way.");
    parameters().add("turn_rad_s", &turn_rad_s_, 0.01, 10.0, "rad/s", "Rate of a turn on the spot.");
    parameters().add("bend_rad_s", &bend_rad_s_, 0.0, 10.0, "rad/s",
                     "Greatest rate of the turns on the way.");
    parameters().add("leave_s", &leave_s_, 0.05, 10.0, "s", "How long it drives off what it touched.");
    parameters().add("longest_turn_s", &longest_turn_s_, 0.1, 60.0, "s", "Longest turn after that.");
  }

  void reset() override {
    state_ = State::kAhead;
    random_ = 1;
    t_ns_ = until_ns_ = left_ns_ = on_ns_ = bent_ns_ = 0;
    tries_ = 0;
    bumps_ = 0.0;
    away_ = sign_ = 1.0;
    bend_ = 0.0;
  }
  void deactivate() override { reset(); }

  void process(const hw_frame_t& frame) override {
    t_ns_ = frame.t_ns;
    double ahead = 0.0;  // where the pressed zones are: in front of the middle, or behind it
    const bool touches = look(frame, ahead);
    if (touches && state_ == State::kAhead) leave(ahead);
    if (t_ns_ >= until_ns_ && state_ == State::kTurn) go_on();
    const bool is_stuck =
        touches && ahead * away_ > 0.0 && t_ns_ >= left_ns_ + ns(leave_s_);  // on both sides
    if ((t_ns_ >= until_ns_ || is_stuck) && state_ == State::kLeave) turn();
    command();
    const hw_counter_t counters[] = {{"bumps", bumps_}};
    host().put_counters(counters);
  }

  void report(bool) override {}

 private:
  enum class State { kAhead, kLeave, kTurn };

  /// Whether a zone is pressed; `ahead` gets the sum of the directions' forward parts.
  static bool look(const hw_frame_t& frame, double& ahead) {
    bool touches = false;
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      if (frame.samples[k]->kind != HW_SAMPLE_BUMP) continue;
      const auto& bump = *static_cast<const hw_bump_t*>(frame.samples[k]->payload);
      for (std::uint64_t i = 0; i < bump.count; ++i) {
        const hw_bump_zone_t& zone = *hw_bump_zone_at(&bump, i);
        if (zone.pressed == 0) continue;
        touches = true;
        ahead += zone.direction[0];
      }
    }
    return touches;
  }

  /// Drives to the free side. If it has left something just now, in vain as it seems, it tries the other one, and each time goes twice as far: so it comes out of
  /// a gap that is as narrow as itself.
  void leave(double ahead) {
    const bool in_vain = bumps_ > 0.0 && t_ns_ - on_ns_ < ns(1.5);
    tries_ = in_vain ? std::min(tries_ + 1, 4) : 0;
    away_ = in_vain ? -away_ : (ahead > 0.0 ? -1.0 : 1.0);
    sign_ = next() < 0.5 ? -1.0 : 1.0;
    state_ = State::kLeave;
    left_ns_ = t_ns_;
    until_ns_ = t_ns_ + ns(leave_s_ * (1 << tries_));
    ++bumps_;
  }

  void go_on() {
    state_ = State::kAhead;
    on_ns_ = t_ns_;
  }

  void turn() {
    state_ = State::kTurn;
    until_ns_ = t_ns_ + ns(longest_turn_s_ * (0.15 + 0.85 * next()));
  }

  void command() {
    switch (state_) {
      case State::kLeave:
        host().put_drive_command(0.6 * away_ * speed_m_s_, 0.0);
        return;
      case State::kTurn:
        host().put_drive_command(0.0, sign_ * turn_rad_s_);
        return;
      case State::kAhead:
        if (t_ns_ >= bent_ns_) {
          bend_ = (2.0 * next() - 1.0) * bend_rad_s_;
          bent_ns_ = t_ns_ + ns(3.0);
        }
        host().put_drive_command(speed_m_s_, bend_);
    }
  }

  static std::int64_t ns(double seconds) { return std::llround(seconds * 1e9); }

  /// Evenly from [0, 1): xorshift (Marsaglia, 2003).
  double next() {
    random_ ^= random_ << 13;
    random_ ^= random_ >> 7;
    random_ ^= random_ << 17;
    return static_cast<double>(random_ >> 11) * 0x1p-53;
  }

  double speed_m_s_ = 0.5, turn_rad_s_ = 1.2, bend_rad_s_ = 0.4, leave_s_ = 0.5, longest_turn_s_ = 2.4;
  State state_ = State::kAhead;
  std::uint64_t random_ = 1;
  std::int64_t t_ns_ = 0, until_ns_ = 0, left_ns_ = 0, on_ns_ = 0, bent_ns_ = 0;
  int tries_ = 0;
  double bumps_ = 0.0;
  double away_ = 1.0, sign_ = 1.0, bend_ = 0.0;
};

}  // namespace

HALLWAY_PLUGINS(Wanderer);

// SPDX-License-Identifier: MIT
#include "watch_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "console.hpp"

namespace hallway::cli {
namespace {

/// Drawing more often shows nothing more, and a slow line could not take it.
constexpr std::int64_t kFrame_ns = 50'000'000;
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr double kLineEvery_s = 1.0;

std::int64_t clock_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

watch::Dots dots_of(const WatchStyle& style, bool has_utf8) {
  return watch::dots_named(style.dots).value_or(has_utf8 ? watch::Dots::kBraille : watch::Dots::kAscii);
}

}  // namespace

Screen::Screen(watch::Scene scene, const WatchStyle& style, bool can_restart)
    : style_(style), scene_(std::move(scene)), lines_(kLineEvery_s) {
  const bool wants_utf8 = !style.dots.empty() && style.dots != watch::name_of(watch::Dots::kAscii);
  if (!style.lines) terminal_ = Terminal::open(wants_utf8);
  if (terminal_)
    display_ = std::make_unique<watch::Display>(
        scene_, watch::DisplayOptions{.dots = dots_of(style, terminal_->has_utf8()),
                                      .speed = style.speed > 0.0 ? style.speed : 1.0,
                                      .can_restart = can_restart});
}

void Screen::add(const watch::Moment& moment) {
  if (display_) return display_->add(moment);
  const std::string text = lines_.add(moment);
  if (!text.empty() && !style_.quiet) {
    if (style_.to_stderr) {
      fmt::print(stderr, "{}", text);
    } else {
      print_result(text);
    }
  }
  if (style_.speed > 0.0) pace(moment.t_ns);
}

void Screen::pace(std::int64_t t_ns) {
  if (start_ns_ == 0) {
    start_ns_ = clock_ns();
    first_ns_ = t_ns;
  }
  const double ahead_ns = static_cast<double>(t_ns - first_ns_) / style_.speed;
  while (!interrupted()) {
    const double left_ns = ahead_ns - static_cast<double>(clock_ns() - start_ns_);
    if (!(left_ns > 0.0)) return;
    std::this_thread::sleep_for(std::chrono::nanoseconds(std::llround(std::min(left_ns, 1e8))));
  }
}

void Screen::end() {
  ended_ = true;
  if (display_) display_->player().end();
}

Screen::Next Screen::show_last() {
  if (!terminal_) return next();
  display_->player().end();
  is_last_ = true;
  const Next last = next();
  is_last_ = false;
  if (last == Next::kLeave) return last;
  display_->set_note("writing the run");
  draw(clock_ns());
  display_->set_note({});
  is_dirty_ = true;
  return last;
}

void Screen::restart() {
  if (display_) display_->player().restart();
}

void Screen::set_mapped(const watch::Scene& scene) {
  scene_.mapped = scene.mapped;
  scene_.mapped_walls = scene.mapped_walls;
  if (display_) display_->set_scene(scene_);
  is_dirty_ = true;
}

void Screen::draw(std::int64_t now_ns) {
  terminal_->show(display_->draw(terminal_->width(), terminal_->height()));
  is_dirty_ = false;
  drawn_ns_ = now_ns;
}

Screen::Next Screen::next() {
  if (!terminal_) return ended_ || interrupted() ? Next::kLeave : Next::kNewer;
  watch::Player& player = display_->player();
  for (;;) {
    if (interrupted()) return Next::kLeave;
    while (const std::optional<int> key = terminal_->key()) {
      is_dirty_ = true;
      if (!display_->press(*key)) return Next::kLeave;
    }
    const watch::Moment* before = player.shown();
    const std::uint32_t iteration = before != nullptr ? before->iteration : 0;
    const std::int64_t now_ns = clock_ns();
    const watch::Player::Need need = player.advance(now_ns);
    const watch::Moment* after = player.shown();
    is_dirty_ = is_dirty_ || after != before || (after != nullptr && after->iteration != iteration);
    if (is_dirty_ && now_ns - drawn_ns_ >= kFrame_ns) draw(now_ns);
    if (need == watch::Player::Need::kOlder) return Next::kOlder;
    if (need == watch::Player::Need::kNewer) return Next::kNewer;
    if (is_last_ && player.at_end()) return Next::kNewer;
    std::optional<std::int64_t> wait_ns = player.wait_ns(now_ns);
    if (is_dirty_) wait_ns = std::min(wait_ns.value_or(kFrame_ns), kFrame_ns);
    // A signal between the check above and the wait is seen after it.
    constexpr std::int64_t kMost_ns = 200 * kMillisecond_ns;
    terminal_->wait(static_cast<int>((std::min(wait_ns.value_or(kMost_ns), kMost_ns) + kMillisecond_ns - 1) /
                                     kMillisecond_ns));
  }
}

}  // namespace hallway::cli

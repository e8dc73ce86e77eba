// SPDX-License-Identifier: MIT
#include "watch/player.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hallway::watch {
namespace {

/// A run that cannot keep up goes on from where it is and does not hurry after.
constexpr std::int64_t kLate_ns = 200'000'000;

}  // namespace

void Player::add(Moment moment) {
  moments_.push_back(std::move(moment));
  if (moments_.size() <= kKept) return;
  moments_.pop_front();
  ++first_;
  if (index_ > 0) --index_;
}

void Player::restart() {
  moments_.clear();
  first_ = 0;
  index_ = 0;
  ended_ = false;
  shown_at_ns_.reset();
}

bool Player::goal_is_older() const {
  if (goal_->number) return *goal_->number < first_;
  return first_ > 0 && goal_->t_ns < moments_.front().t_ns;
}

std::optional<std::size_t> Player::index_of_goal() const {
  if (goal_->number) {
    const std::uint64_t index = *goal_->number - std::min(*goal_->number, first_);
    return index < moments_.size() ? std::optional(static_cast<std::size_t>(index)) : std::nullopt;
  }
  const auto found = std::ranges::lower_bound(moments_, goal_->t_ns, {}, &Moment::t_ns);
  return found == moments_.end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(found - moments_.begin()));
}

void Player::jump_to(std::size_t index) {
  index_ = index;
  goal_.reset();
  shown_at_ns_.reset();
}

std::int64_t Player::due_ns(std::size_t index) const {
  const double ahead = static_cast<double>(moments_[index].t_ns - anchor_ns_) / speed_;
  constexpr double kFar = 1e17;  // three years
  return *shown_at_ns_ + static_cast<std::int64_t>(std::clamp(ahead, -kFar, kFar));
}

Player::Need Player::advance(std::int64_t now_ns) {
  if (moments_.empty()) return ended_ ? Need::kNothing : Need::kNewer;
  if (goal_) {
    if (goal_is_older() && can_restart_) return Need::kOlder;
    if (const auto index = index_of_goal()) {
      jump_to(*index);
    } else if (ended_) {
      jump_to(moments_.size() - 1);
    } else {
      index_ = moments_.size() - 1;  // on the way
      return Need::kNewer;
    }
  }
  if (!shown_at_ns_) {
    shown_at_ns_ = now_ns;
    anchor_ns_ = moments_[index_].t_ns;
  }
  if (paused_) return Need::kNothing;
  while (index_ + 1 < moments_.size() && due_ns(index_ + 1) <= now_ns) {
    ++index_;
    if (now_ns - due_ns(index_) > kLate_ns) {
      shown_at_ns_ = now_ns;
      anchor_ns_ = moments_[index_].t_ns;
    }
  }
  return index_ + 1 == moments_.size() && !ended_ ? Need::kNewer : Need::kNothing;
}

std::optional<std::int64_t> Player::wait_ns(std::int64_t now_ns) const {
  if (goal_ || !shown_at_ns_) return 0;
  if (paused_ || at_end() || moments_.empty()) return std::nullopt;
  if (index_ + 1 == moments_.size()) return 0;
  return std::max<std::int64_t>(due_ns(index_ + 1) - now_ns, 0);
}

void Player::toggle_pause() {
  paused_ = !paused_;
  shown_at_ns_.reset();
}

void Player::step(int direction) {
  paused_ = true;
  if (direction < 0 && number() == 0) return;
  const std::uint64_t number = direction < 0 ? this->number() - 1 : this->number() + 1;
  goal_ = Goal{.number = number};
}

void Player::skip(double seconds) {
  if (moments_.empty()) return;
  goal_ = Goal{.t_ns = moments_[index_].t_ns + std::llround(seconds * 1e9)};
}

void Player::go_to_first() {
  goal_ = Goal{.number = 0};
}

void Player::go_to_last() {
  goal_ = Goal{.t_ns = std::numeric_limits<std::int64_t>::max()};
}

void Player::change_speed(double factor) {
  speed_ = std::clamp(speed_ * factor, 1.0 / 16.0, 4096.0);
  shown_at_ns_.reset();
}

}  // namespace hallway::watch

// SPDX-License-Identifier: MIT
#include "pvs/flow.hpp"

#include <algorithm>
#include <utility>

namespace hallway::pvs {
namespace {

/// A way longer than this is cut short, for the stack's sake.
constexpr std::size_t kLongestWay = 2000;

/// Work of clipping a portal and finding the planes behind it, in units of looking at one portal in a flood.
constexpr std::uint64_t kClipWork = 20;

/// The planes through which a target must be seen, those that turned away the last target first: its
/// neighbours are often turned away by the same.
class Planes {
 public:
  explicit Planes(const Separators& separators) : count_(separators.count) {
    for (std::size_t i = 0; i < count_; ++i) planes_[i] = &separators.planes[i];
  }

  /// True if a portal lies behind one of the planes.
  bool hide(const DirectedPortal& target) {
    for (std::size_t i = 0; i < count_; ++i) {
      const double middle = planes_[i]->reach(target.centre);
      if (middle >= 0.0) continue;
      if (middle + target.radius >= 0.0 && !all_behind(target.winding, *planes_[i])) continue;
      std::swap(planes_[i], planes_[0]);
      return true;
    }
    return false;
  }

 private:
  static bool all_behind(const Winding& winding, const Cutter& plane) {
    for (std::size_t i = 0; i < winding.count; ++i) {
      if (plane.reach(winding.points[i]) >= 0.0) return false;
    }
    return true;
  }

  std::array<const Cutter*, Separators::kCapacity> planes_{};
  std::size_t count_;
};

}  // namespace

Flow::Flow(const DirectedPortals& world)
    : world_(world),
      precision_{world.noise, world.diameter},
      place_(words_for(world.portals.size())),
      seen_(place_.size() + 1),
      reached_(place_.size() + 1),
      met_(world.clusters()) {}

std::uint64_t Flow::run(std::uint32_t source, const Word* candidates, const std::vector<const Word*>& rows,
                        std::uint64_t work_limit, Word* seen) {
  rows_ = &rows;
  work_limit_ = work_limit;
  start(source, candidates, seen);
  follow(0);
  for (std::size_t k = 0; k < live_.size(); ++k) seen[live_[k]] |= seen_[k];
  return work_;
}

void Flow::start(std::uint32_t source, const Word* candidates, const Word* seen) {
  live_.clear();
  for (std::size_t w = 0; w < place_.size(); ++w) {
    if (candidates[w] != 0) live_.push_back(static_cast<std::uint32_t>(w));
  }
  std::fill(place_.begin(), place_.end(), static_cast<std::uint32_t>(live_.size()));
  for (std::size_t k = 0; k < live_.size(); ++k) place_[live_[k]] = static_cast<std::uint32_t>(k);
  source_ = &world_.portals[source];
  work_ = 0;
  cut_short_ = false;
  Frame& first = frame(0);
  for (std::size_t k = 0; k < live_.size(); ++k) {
    seen_[k] = seen[live_[k]];
    first.might[k] = candidates[live_[k]];
  }
  first.might[live_.size()] = 0;
  first.portal = source_;
  first.source = &source_->winding;
  first.pass = &source_->winding;
  first.separators.count = 0;
}

Flow::Frame& Flow::frame(std::size_t level) {
  while (frames_.size() <= level) {
    frames_.push_back(std::make_unique<Frame>());
    frames_.back()->might.resize(place_.size() + 1);
  }
  return *frames_[level];
}

/// Goes on from the portal of a level to those that leave the cluster behind it.
void Flow::follow(std::size_t level) {
  const Frame& last = frame(level);
  for (const std::uint32_t portal : world_.leaving_from(last.portal->to)) {
    const Word bit = Word{1} << (portal % kWordBits);
    if ((last.might[place_[portal / kWordBits]] & bit) != 0) pass_through(level, portal);
  }
}

void Flow::pass_through(std::size_t level, std::uint32_t portal) {
  const Frame& last = frame(level);
  Frame& next = frame(level + 1);
  Word& seen = seen_[place_[portal / kWordBits]];
  const Word bit = Word{1} << (portal % kWordBits);
  const bool leads_on = narrow(last.might.data(), (*rows_)[portal], next.might.data());
  if (!leads_on && (seen & bit) != 0) return;
  if (work_ >= 2 * work_limit_) {
    seen |= bit;
    take_for_seen(next);
    return;
  }
  work_ += kClipWork;
  const DirectedPortal& target = world_.portals[portal];
  if (!clip(last, target, next)) return;
  seen |= bit;
  if (!leads_on) return;
  next.portal = &target;
  separate(*next.source, *source_, *next.pass, target, precision_, next.separators);
  if (!flood_ahead(next)) return;
  if (work_ < work_limit_ && level + 1 < kLongestWay) {
    follow(level + 1);
  } else {
    take_for_seen(next);
  }
}

/// Intersects candidates with a row; false if nothing is left that is not seen already.
bool Flow::narrow(const Word* before, const Word* row, Word* after) {
  const std::size_t count = live_.size();
  Word fresh = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Word might = before[k] & row[live_[k]];
    after[k] = might;
    fresh |= might & ~seen_[k];
  }
  after[count] = 0;
  work_ += count / 16 + 1;
  return fresh != 0;
}

/// Cuts the target to what lines through the source and the last portal reach, and the source to what lies
/// behind the target; false if nothing is left.
bool Flow::clip(const Frame& last, const DirectedPortal& target, Frame& next) const {
  std::array<const Cutter*, Separators::kCapacity + 1> cutters{};
  std::size_t count = 0;
  // False if the plane certainly leaves nothing of the target; notes the planes that may cut it.
  const auto passes = [&](const Cutter& plane) {
    const double middle = plane.reach(target.centre);
    if (middle >= target.radius) return true;
    cutters[count++] = &plane;
    return middle + target.radius >= 0.0;
  };
  const Cutter front = source_->front();
  if (!passes(front)) return false;
  for (std::size_t i = 0; i < last.separators.count; ++i) {
    if (!passes(last.separators.planes[i])) return false;
  }
  next.pass = &target.winding;
  for (std::size_t i = 0; i < count; ++i) {
    Winding& rest = next.pass_parts[next.pass == next.pass_parts.data() ? 1 : 0];
    const Cut result = cut(*next.pass, *cutters[i], rest);
    if (result == Cut::kNothing) return false;
    if (result == Cut::kPart) next.pass = &rest;
  }
  next.source = last.source;
  const Cutter behind = target.back();
  if (behind.reach(source_->centre) >= source_->radius) return true;
  const Cut result = cut(*last.source, behind, next.source_part);
  if (result == Cut::kPart) next.source = &next.source_part;
  return result != Cut::kNothing;
}

/// Keeps of a frame's candidates what a flood from its portal reaches between its planes; false if all of it
/// is seen already.
bool Flow::flood_ahead(Frame& last) {
  const std::size_t count = live_.size();
  std::fill_n(reached_.begin(), count, Word{0});
  Planes planes(last.separators);
  ++floods_;
  open_.assign(1, last.portal->to);
  met_[last.portal->to] = floods_;
  while (!open_.empty()) {
    const std::uint32_t cluster = open_.back();
    open_.pop_back();
    for (const std::uint32_t portal : world_.leaving_from(cluster)) {
      const std::size_t word = place_[portal / kWordBits];
      const Word bit = Word{1} << (portal % kWordBits);
      if ((last.might[word] & bit) == 0) continue;
      ++work_;
      const DirectedPortal& target = world_.portals[portal];
      if (planes.hide(target)) continue;
      reached_[word] |= bit;
      if (met_[target.to] == floods_) continue;
      met_[target.to] = floods_;
      open_.push_back(target.to);
    }
  }
  Word fresh = 0;
  for (std::size_t k = 0; k < count; ++k) {
    last.might[k] = reached_[k];
    fresh |= reached_[k] & ~seen_[k];
  }
  return fresh != 0;
}

void Flow::take_for_seen(const Frame& last) {
  cut_short_ = true;
  for (std::size_t k = 0; k < live_.size(); ++k) seen_[k] |= last.might[k];
}

}  // namespace hallway::pvs

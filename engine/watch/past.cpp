// SPDX-License-Identifier: MIT
#include "watch/past.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>

#include <algorithm>

#include "base/text.hpp"
#include "geom/arrays.hpp"

namespace hallway::watch {
namespace {

/// Not with every element: that would take the time of all.
template <typename Element>
void keep_last(std::vector<Element>& elements, std::size_t count) {
  if (elements.size() > 2 * count)
    elements.erase(elements.begin(), elements.end() - static_cast<std::ptrdiff_t>(count));
}

}  // namespace

std::vector<Past::Line> lines_of(const Moment& moment) {
  std::vector<Past::Line> lines;
  for (const log::EventRow& event : moment.events)
    lines.push_back({event.t_ns, HW_LOG_WARNING,
                     printable("event: " + event.kind + (event.what.empty() ? "" : " " + event.what))});
  for (const log::ContactRow& contact : moment.contacts)
    lines.push_back({contact.t_ns, HW_LOG_WARNING,
                     fmt::format("contact: {} at ({:.2f}, {:.2f}), {:.2f} m/s", printable(contact.kind),
                                 contact.position_m[0], contact.position_m[1], contact.speed_m_s)});
  std::ranges::stable_sort(lines, {}, &Past::Line::t_ns);
  for (const foxglove::LogLine& line : moment.lines)
    lines.push_back({moment.t_ns, line.level, printable(line.name + ": " + line.text, 400)});
  return lines;
}

std::optional<Pose> pose_shown(const Moment& moment, const PastPlace* place) {
  if (moment.T_world_body) return moment.T_world_body;
  return place != nullptr ? place->estimate : std::nullopt;
}

std::optional<Pose> Past::estimate_of(const Moment& moment) {
  if (!moment.pose || !moment.pose->valid) return std::nullopt;
  const Pose T_map_body = to_pose(moment.pose->position_m, moment.pose->orientation);
  const bool is_new_part = !T_world_map_ || epoch_ != moment.pose->map_epoch;
  if (is_new_part && moment.T_world_body && moment.orientation_known)
    T_world_map_ = *moment.T_world_body * T_map_body.inverse();
  if (is_new_part) epoch_ = moment.pose->map_epoch;
  return T_world_map_.value_or(Pose()) * T_map_body;
}

void Past::add(const Moment& moment) {
  if (!places_.empty() && moment.iteration <= places_.back().iteration) return;
  PastPlace& place = places_.emplace_back();
  place.iteration = moment.iteration;
  if (moment.T_world_body) place.truth = moment.T_world_body->t.head<2>();
  place.estimate = estimate_of(moment);
  if (moment.T_world_body && moment.orientation_known) true_poses_.add(moment.t_ns, *moment.T_world_body);
  if (place.estimate) estimates_.add(moment.t_ns, *place.estimate);
  contacts_.insert(contacts_.end(), moment.contacts.begin(), moment.contacts.end());
  const std::vector<Line> more = lines_of(moment);
  lines_.insert(lines_.end(), more.begin(), more.end());
  keep_last(lines_, kMaxLines);
  add_echoes(moment, pose_shown(moment, &place));
}

void Past::add_echoes(const Moment& moment, const std::optional<Pose>& pose) {
  if (!pose || moment.rays.size() > kMostRays) return;
  for (const Ray& ray : moment.rays) {
    if (ray.has_return) echoes_.push_back({moment.t_ns, (*pose * ray.to).head<2>()});
  }
  keep_last(echoes_, kMaxEchoes);
}

std::span<const Past::Echo> Past::echoes(std::int64_t from_ns, std::int64_t until_ns) const {
  const auto begin = std::ranges::lower_bound(echoes_, from_ns, {}, &Echo::t_ns);
  const auto end = std::ranges::upper_bound(begin, echoes_.end(), until_ns, {}, &Echo::t_ns);
  return {begin, end};
}

std::span<const PastPlace> Past::places(std::uint32_t until) const {
  const auto end = std::ranges::upper_bound(places_, until, {}, &PastPlace::iteration);
  return std::span(places_).first(static_cast<std::size_t>(end - places_.begin()));
}

const PastPlace* Past::place(std::uint32_t iteration) const {
  const auto found = std::ranges::lower_bound(places_, iteration, {}, &PastPlace::iteration);
  return found != places_.end() && found->iteration == iteration ? &*found : nullptr;
}

std::optional<foxglove::SeenPlace> Past::place_of(const log::TopologyNode& node) const {
  const Pose* body = (true_poses_.empty() ? estimates_ : true_poses_).at(node.t_ns);
  if (body == nullptr) return std::nullopt;
  return foxglove::seen_from(node, *body);
}

std::span<const log::ContactRow> Past::contacts(std::int64_t until_ns) const {
  const auto end = std::ranges::upper_bound(contacts_, until_ns, {}, &log::ContactRow::t_ns);
  return std::span(contacts_).first(static_cast<std::size_t>(end - contacts_.begin()));
}

std::span<const Past::Line> Past::lines(std::int64_t until_ns) const {
  // A plugin's line has the time of its frame, a contact its own: order differs within a frame alone.
  auto end = lines_.end();
  while (end != lines_.begin() && std::prev(end)->t_ns > until_ns) --end;
  const std::span all = std::span(lines_).first(static_cast<std::size_t>(end - lines_.begin()));
  return all.size() > kMaxLines ? all.last(kMaxLines) : all;
}

}  // namespace hallway::watch

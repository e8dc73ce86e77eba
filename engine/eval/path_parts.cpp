// SPDX-License-Identifier: MIT
#include "eval/path_parts.hpp"

#include <algorithm>

namespace hallway::eval {

std::uint64_t final_epoch(std::uint64_t epoch, std::span<const JoinedEpoch> joined) {
  const auto found =
      std::find_if(joined.begin(), joined.end(), [&](const JoinedEpoch& row) { return row.epoch == epoch; });
  return found == joined.end() ? epoch : found->into;
}

void PathParts::add(const PathFrame& frame) {
  const std::uint64_t number = frames_++;
  if (frame.T_world_body) {
    if (!true_path_.empty()) travelled_m_ += (frame.T_world_body->t - true_path_.back()).norm();
    true_path_.push_back(frame.T_world_body->t);
  }
  if (!frame.T_map_body) return;
  epoch_ = frame.map_epoch.value_or(epoch_);
  const auto [at, is_new] = epochs_.try_emplace(epoch_, Epoch{.poses = 0, .first = number, .last = number});
  ++at->second.poses;
  at->second.last = number;
  if (!frame.T_world_body) return;
  Entry entry{.frame = number,
              .epoch = epoch_,
              .pair = {*frame.T_world_body, *frame.T_map_body, frame.t_s, travelled_m_},
              .orientation_known = frame.orientation_known};
  entry.pair.T_world_body.q.normalize();
  entry.pair.T_map_body.q.normalize();
  orientations_known_ = orientations_known_ && frame.orientation_known;
  if (frame.covariance) {
    covariances_.push_back(*frame.covariance);
    entry.covariance = covariances_.size();
  }
  entries_.push_back(entry);
}

PathParts::Summary PathParts::summary(std::span<const JoinedEpoch> joined) const {
  Summary summary{.poses = {.frames = frames_}};
  if (epochs_.empty()) return summary;
  std::map<std::uint64_t, Epoch> parts;
  std::uint64_t poses = 0;
  for (const auto& [number, epoch] : epochs_) {
    Epoch& part =
        parts.try_emplace(final_epoch(number, joined), Epoch{0, epoch.first, epoch.last}).first->second;
    part.poses += epoch.poses;
    part.first = std::min(part.first, epoch.first);
    part.last = std::max(part.last, epoch.last);
    poses += epoch.poses;
  }
  const auto scored = std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.second.poses != b.second.poses ? a.second.poses < b.second.poses
                                            : a.second.first > b.second.first;
  });
  summary.parts = parts.size();
  summary.restarts = epochs_.size() - 1;
  summary.scored = scored->first;
  summary.last = final_epoch(epoch_, joined);
  summary.poses.scored = scored->second.poses;
  summary.poses.other_parts = poses - scored->second.poses;
  summary.poses.ends_in_scored = summary.last == summary.scored;
  summary.poses.last_scored = scored->second.last;
  return summary;
}

std::vector<std::uint64_t> PathParts::frames_of_map(std::span<const JoinedEpoch> joined) const {
  std::vector<std::uint64_t> frames;
  const std::uint64_t last = final_epoch(epoch_, joined);
  for (const Entry& entry : entries_) {
    if (final_epoch(entry.epoch, joined) == last) frames.push_back(entry.frame);
  }
  return frames;
}

PartPath PathParts::path_of(std::uint64_t part, std::span<const JoinedEpoch> joined) const {
  PartPath path;
  for (const Entry& entry : entries_) {
    if (final_epoch(entry.epoch, joined) != part) continue;
    std::optional<Eigen::Matrix<double, 6, 6>> covariance;
    if (entry.covariance != 0) covariance = covariances_[entry.covariance - 1];
    if (entry.orientation_known) {
      path.score.add(entry.pair.T_world_body, entry.pair.T_map_body, covariance);
    } else {
      path.score.add_position(entry.pair.T_world_body.t, entry.pair.T_map_body);
    }
    path.pairs.push_back(entry.pair);
    path.pair_frames.push_back(entry.frame);
  }
  return path;
}

}  // namespace hallway::eval

// SPDX-License-Identifier: MIT
#include "eval/path_parts.hpp"

#include <algorithm>
#include <utility>

namespace hallway::eval {

std::uint64_t final_epoch(std::uint64_t epoch, std::span<const JoinedEpoch> joined) {
  const auto found =
      std::find_if(joined.begin(), joined.end(), [&](const JoinedEpoch& row) { return row.epoch == epoch; });
  return found == joined.end() ? epoch : found->into;
}

std::uint64_t PartPath::frame_of(std::size_t pair) const {
  const auto next = pair_frames.read();
  for (; pair > 0; --pair) next();
  return *next();
}

/// Reads the entries of some epochs.
class PathParts::EntryReader {
 public:
  EntryReader(const PathParts& path, std::vector<std::uint64_t> epochs)
      : entries_(path.entries_), epochs_(std::move(epochs)) {}

  /// Null after the last one.
  const Entry* next() {
    const Entry* entry = entries_.next();
    while (entry != nullptr && !std::binary_search(epochs_.begin(), epochs_.end(), entry->epoch))
      entry = entries_.next();
    return entry;
  }

 private:
  SpillList<Entry>::Reader entries_;
  std::vector<std::uint64_t> epochs_;  ///< increasing
};

PathParts::PoseRecord PathParts::record_of(const Pose& pose) {
  return {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w(), pose.t.x(), pose.t.y(), pose.t.z()};
}

Pose PathParts::pose_of(const PoseRecord& record) {
  return {Quat(record.data()), Vec3(record.data() + 4)};
}

void PathParts::add(const PathFrame& frame) {
  const std::uint64_t number = frames_++;
  if (frame.T_world_body) {
    const Vec3& place = frame.T_world_body->t;
    if (!true_path_.empty()) travelled_m_ += (place - last_true_).norm();
    true_path_.push_back({place.x(), place.y(), place.z()});
    last_true_ = place;
  }
  if (!frame.T_map_body) return;
  epoch_ = frame.map_epoch.value_or(epoch_);
  const auto [at, is_new] = epochs_.try_emplace(epoch_, Epoch{.poses = 0, .first = number, .last = number});
  ++at->second.poses;
  at->second.last = number;
  if (!frame.T_world_body) return;
  Pose T_world_body = *frame.T_world_body, T_map_body = *frame.T_map_body;
  T_world_body.q.normalize();
  T_map_body.q.normalize();
  Entry entry{.frame = number,
              .epoch = epoch_,
              .T_world_body = record_of(T_world_body),
              .T_map_body = record_of(T_map_body),
              .t_s = frame.t_s,
              .travelled_m = travelled_m_,
              .orientation_known = frame.orientation_known};
  orientations_known_ = orientations_known_ && frame.orientation_known;
  if (frame.covariance) {
    Covariance covariance;
    std::copy_n(frame.covariance->data(), covariance.size(), covariance.begin());
    covariances_.push_back(covariance);
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

std::vector<std::uint64_t> PathParts::epochs_in(std::uint64_t part,
                                                std::span<const JoinedEpoch> joined) const {
  std::vector<std::uint64_t> epochs;
  for (const auto& [epoch, poses] : epochs_) {
    if (final_epoch(epoch, joined) == part) epochs.push_back(epoch);
  }
  return epochs;
}

std::vector<std::uint64_t> PathParts::frames_of_map(std::span<const JoinedEpoch> joined) const {
  std::vector<std::uint64_t> frames;
  EntryReader entries(*this, epochs_in(final_epoch(epoch_, joined), joined));
  while (const Entry* entry = entries.next()) frames.push_back(entry->frame);
  return frames;
}

Sequence<Vec3> PathParts::true_path() const {
  return {true_path_.size(), [this] {
            return [positions = SpillList<Position>::Reader(true_path_),
                    place = Vec3()]() mutable -> const Vec3* {
              const Position* position = positions.next();
              if (position == nullptr) return nullptr;
              place = Vec3(position->data());
              return &place;
            };
          }};
}

Sequence<StatedCovariance> PathParts::stated_in(const std::vector<std::uint64_t>& epochs,
                                                std::size_t size) const {
  return {size, [this, epochs] {
            return [entries = EntryReader(*this, epochs), all = SpillList<Covariance>::Reader(covariances_),
                    pairs = std::size_t{0}, read = std::uint64_t{0},
                    stated = StatedCovariance()]() mutable -> const StatedCovariance* {
              const Entry* entry = entries.next();
              for (; entry != nullptr && entry->covariance == 0; ++pairs) entry = entries.next();
              if (entry == nullptr) return nullptr;
              for (; read + 1 < entry->covariance; ++read) all.next();
              stated = {pairs, Eigen::Map<const Eigen::Matrix<double, 6, 6>>(all.next()->data())};
              ++read;
              ++pairs;
              return &stated;
            };
          }};
}

PartPath PathParts::path_of(std::uint64_t part, std::span<const JoinedEpoch> joined) const {
  const std::vector<std::uint64_t> epochs = epochs_in(part, joined);
  std::size_t size = 0, stated = 0;
  bool orientations_known = true;
  EntryReader counted(*this, epochs);
  while (const Entry* entry = counted.next()) {
    ++size;
    stated += entry->covariance != 0 ? 1u : 0u;
    orientations_known = orientations_known && entry->orientation_known;
  }
  PartPath path;
  path.pairs = {
      size, [this, epochs] {
        return [entries = EntryReader(*this, epochs), pair = PosePair()]() mutable -> const PosePair* {
          const Entry* entry = entries.next();
          if (entry == nullptr) return nullptr;
          pair = {pose_of(entry->T_world_body), pose_of(entry->T_map_body), entry->t_s, entry->travelled_m};
          return &pair;
        };
      }};
  path.pair_frames = {size, [this, epochs] {
                        return [entries = EntryReader(*this, epochs)]() mutable -> const std::uint64_t* {
                          const Entry* entry = entries.next();
                          return entry == nullptr ? nullptr : &entry->frame;
                        };
                      }};
  path.score = TrajectoryScore(path.pairs, orientations_known, stated_in(epochs, stated));
  return path;
}

}  // namespace hallway::eval

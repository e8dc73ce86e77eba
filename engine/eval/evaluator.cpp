// SPDX-License-Identifier: MIT
#include "eval/evaluator.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "eval/point_error.hpp"
#include "eval/time_summary.hpp"
#include "geometry/rigid_fit.hpp"

namespace hallway::eval {
namespace {

using log::LandmarkId;
using log::LandmarkStatus;
using log::MapLandmark;
using OwnerMap = std::map<LandmarkId, LandmarkId>;
using PositionMap = std::unordered_map<LandmarkId, Vec3>;

/// A landmark counts as moved when it has gone so many standard deviations of its sightings.
constexpr double kMovedNoises = 5.0;

/// Landmarks of a map beside the true ones that own them.
struct LandmarkPairs {
  std::vector<Vec3> truth;     ///< world
  std::vector<Vec3> estimate;  ///< map frame
  std::vector<std::optional<std::array<double, 6>>> covariance;
};

PositionMap positions_by_id(const std::vector<log::Landmark>& landmarks) {
  PositionMap positions;
  for (const log::Landmark& landmark : landmarks) {
    positions.emplace(landmark.id, Vec3(landmark.position_m.data()));
  }
  return positions;
}

/// In the order of `map`; its mapped landmarks without an owner, and those whose owner's place is unknown, are left out.
LandmarkPairs pair_landmarks(std::span<const MapLandmark> map, const OwnerMap& owner,
                             const PositionMap& truth) {
  LandmarkPairs pairs;
  for (const MapLandmark& landmark : map) {
    const auto owned = owner.find(landmark.id);
    if (landmark.status != LandmarkStatus::kMapped || owned == owner.end()) continue;
    const auto position = truth.find(owned->second);
    if (position == truth.end()) continue;
    pairs.truth.push_back(position->second);
    pairs.estimate.emplace_back(landmark.position_m.data());
    pairs.covariance.push_back(landmark.covariance);
  }
  return pairs;
}

/// The errors of landmarks in the map's frame, after the best fit to the truth, beside the covariances stated for them.
Consistency landmark_consistency(const LandmarkPairs& pairs) {
  Consistency consistency;
  if (pairs.truth.size() < 3) return consistency;
  const Pose T_map_world = *rigid_fit(pairs.truth, pairs.estimate);
  for (std::size_t i = 0; i < pairs.truth.size(); ++i) {
    if (!pairs.covariance[i]) continue;
    const std::array<double, 6>& c = *pairs.covariance[i];
    Eigen::Matrix3d covariance;
    covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    consistency.add(T_map_world * pairs.truth[i] - pairs.estimate[i], covariance);
  }
  return consistency;
}

/// Counts the mapped landmarks by owner.
void count_landmarks(std::span<const MapLandmark> map, const OwnerMap& owner, std::size_t observed,
                     Metrics& metrics) {
  std::set<LandmarkId> owners;
  std::uint64_t owned = 0;
  std::uint64_t unmatched = 0;
  for (const MapLandmark& landmark : map) {
    if (landmark.status != LandmarkStatus::kMapped) continue;
    const auto found = owner.find(landmark.id);
    if (found == owner.end()) {
      ++unmatched;
    } else {
      ++owned;
      owners.insert(found->second);
    }
  }
  metrics.landmarks_true = observed;
  metrics.landmarks_duplicated = owned - owners.size();
  metrics.landmarks_missed = observed - owners.size();
  metrics.landmarks_unmatched = unmatched;
}

std::uint64_t count_mapped(std::span<const MapLandmark> map) {
  std::uint64_t count = 0;
  for (const MapLandmark& landmark : map) count += landmark.status == LandmarkStatus::kMapped ? 1 : 0;
  return count;
}

std::vector<double> values_of(const SpillList<double>& list) {
  std::vector<double> values;
  values.reserve(list.size());
  SpillList<double>::Reader reader(list);
  while (const double* value = reader.next()) values.push_back(*value);
  return values;
}

}  // namespace

Evaluator::Evaluator(Truth truth, const std::filesystem::path& folder)
    : truth_(std::move(truth)), path_(folder), refitted_path_(folder), wall_ms_(folder), cpu_ms_(folder) {
  if (truth_.has_identities && truth_.landmarks)
    motion_.emplace(*truth_.landmarks, kMovedNoises * truth_.noise_m);
  if (truth_.has_identities && truth_.planes) planes_.emplace(*truth_.planes);
}

void Evaluator::add_planes(const Iteration& iteration) {
  planes_->add(iteration.planes, iteration.T_world_body, iteration.true_plane_points);
  if (iteration.T_world_body && iteration.T_map_body && iteration.orientation_known)
    planes_->add_pose(static_cast<std::uint32_t>(iterations_), *iteration.T_world_body, *iteration.T_map_body,
                      iteration.planes);
}

void Evaluator::add(const Iteration& iteration) {
  if (planes_) add_planes(iteration);
  ++iterations_;
  if (!iteration.T_map_body) ++lost_;
  path_.add({.t_s = iteration.t_s,
             .T_world_body = iteration.T_world_body,
             .orientation_known = iteration.orientation_known,
             .T_map_body = iteration.T_map_body,
             .covariance = iteration.pose_covariance,
             .map_epoch = iteration.map_epoch});
  if (iteration.T_world_body && !iteration.points.empty())
    refitted_path_.add(iteration.T_world_body->t, iteration.points, iteration.associations);
  if (truth_.has_identities) {
    associations_.add(iteration.associations, iteration.identities);
  } else {
    associations_.add(iteration.associations);
  }
  if (motion_ && iteration.T_world_body && iteration.orientation_known && !iteration.points.empty())
    motion_->add(*iteration.T_world_body, iteration.identities, iteration.points);
  if (iteration.wall_ms) wall_ms_.push_back(*iteration.wall_ms);
  if (iteration.cpu_ms) cpu_ms_.push_back(*iteration.cpu_ms);
}

void Evaluator::finish(std::span<const JoinedEpoch> joined) {
  if (!planes_) return;
  const std::vector<std::uint64_t> frames = path_.frames_of_map(joined);
  planes_->keep_poses([&](std::uint32_t iteration) {
    return std::binary_search(frames.begin(), frames.end(), std::uint64_t{iteration});
  });
}

Metrics Evaluator::metrics(std::span<const MapLandmark> online,
                           const std::optional<std::vector<MapLandmark>>& refined,
                           std::span<const JoinedEpoch> joined) const {
  Metrics metrics;
  metrics.iterations = iterations_;
  metrics.observations = associations_.observations();
  metrics.lost_iterations = truth_.gives_poses ? std::optional(lost_) : std::nullopt;
  metrics.landmarks_mapped = count_mapped(online);
  metrics.associations_none = associations_.none();
  PathParts::Summary summary = path_.summary(joined);
  const PartPath scored = path_.path_of(summary.scored, joined);
  // The map at the end is of the part that the last pose is in.
  const auto first_pose = summary.last == summary.scored
                              ? scored.score.first_pose_frame()
                              : path_.path_of(summary.last, joined).score.first_pose_frame();
  std::optional<Pose> T_map_world;
  if (truth_.has_identities) T_map_world = score_landmarks(online, refined, first_pose, metrics);
  if (truth_.has_identities && !planes_ && !online.empty()) {
    metrics.associations_dropped = dropped_associations(online);
    const std::uint64_t associated = metrics.observations - metrics.associations_none;
    summary.poses.map_forgotten = 2 * *metrics.associations_dropped > associated;
  }
  if (refined) score_refitted_path(*refined, metrics);
  if (summary.last != summary.scored) T_map_world.reset();
  score_path(summary, scored, T_map_world, metrics);
  metrics.iteration_ms = summarize(values_of(wall_ms_));
  metrics.iteration_cpu_ms = summarize(values_of(cpu_ms_));
  return metrics;
}

std::uint64_t Evaluator::dropped_associations(std::span<const MapLandmark> map) const {
  std::unordered_set<LandmarkId> there;
  for (const MapLandmark& landmark : map) there.insert(landmark.id);
  std::uint64_t dropped = 0;
  for (const auto& [pair, count] : associations_.votes()) dropped += there.contains(pair.map) ? 0 : count;
  return dropped;
}

void Evaluator::score_path(const PathParts::Summary& summary, const PartPath& path,
                           const std::optional<Pose>& T_map_world, Metrics& metrics) const {
  metrics.parts = {.count = summary.parts,
                   .restarts = summary.restarts,
                   .scored_iterations = summary.poses.scored,
                   .other_iterations = summary.poses.other_parts,
                   .ends_in_scored = summary.poses.ends_in_scored};
  metrics.divergence = divergence_of(path.pairs, extent_of(path_.true_path()),
                                     path_.orientations_known() ? Judged::kAll : Judged::kPositions,
                                     Alignment::kRigid, truth_.noise_m);
  if (metrics.divergence && metrics.divergence->first)
    metrics.diverged_at = path.frame_of(*metrics.divergence->first);
  if (truth_.gives_poses) metrics.verdict = judge(summary.poses, metrics.divergence);
  const TrajectoryScore& score = path.score;
  metrics.position_pairs = score.pairs();
  metrics.position_rmse_m = score.position_rmse_m();
  metrics.position_final_m = score.position_final_m();
  metrics.rotation_rmse_deg = score.rotation_rmse_deg();
  metrics.pose_consistency = score.consistency(T_map_world);
  if (!path_.orientations_known()) return;
  metrics.rpe_frame = relative_error(path.pairs, {1.0, DeltaUnit::kFrames});
  metrics.rpe_metre = relative_error(path.pairs, {1.0, DeltaUnit::kMetres});
  metrics.rpe_second = relative_error(path.pairs, {1.0, DeltaUnit::kSeconds});
}

void Evaluator::score_refitted_path(const std::vector<MapLandmark>& refined, Metrics& metrics) const {
  const auto error = refitted_path_.error(refined);
  if (!error) return;
  metrics.position_refitted_pairs = error->frames;
  metrics.position_rmse_refitted_aligned_m = error->aligned_m;
}

std::optional<Pose> Evaluator::score_landmarks(std::span<const MapLandmark> online,
                                               const std::optional<std::vector<MapLandmark>>& refined,
                                               const std::optional<Pose>& first_pose,
                                               Metrics& metrics) const {
  const AssociationScore::Ownership ownership = associations_.ownership();
  metrics.association_errors = ownership.errors;
  OwnerMap owner = ownership.owner;
  std::vector<MapLandmark> standing;  // what moves is scored apart
  std::size_t observed = 0;
  for (const MapLandmark& landmark : online) {
    const auto owned = owner.find(landmark.id);
    if (owned == owner.end() || !moves(owned->second)) standing.push_back(landmark);
  }
  std::erase_if(owner, [&](const auto& entry) { return moves(entry.second); });
  for (const LandmarkId landmark : associations_.seen()) observed += moves(landmark) ? 0u : 1u;
  count_landmarks(standing, owner, observed, metrics);
  if (motion_) metrics.moving = motion_->metrics(online, associations_.votes());
  if (!truth_.landmarks) return std::nullopt;
  const PositionMap truth = positions_by_id(*truth_.landmarks);
  const LandmarkPairs pairs = pair_landmarks(online, owner, truth);
  metrics.landmark_pairs = pairs.truth.size();
  if (first_pose) metrics.landmark_rmse_m.first_pose = rmse(pairs.truth, pairs.estimate, *first_pose);
  metrics.landmark_rmse_m.aligned = aligned_rmse(pairs.truth, pairs.estimate);
  if (refined) {
    const LandmarkPairs final_pairs = pair_landmarks(*refined, owner, truth);
    metrics.landmark_rmse_final_aligned_m = aligned_rmse(final_pairs.truth, final_pairs.estimate);
    metrics.landmark_consistency = landmark_consistency(final_pairs);
  }
  if (!determine_a_pose(pairs.truth) || !determine_a_pose(pairs.estimate)) return std::nullopt;
  return rigid_fit(pairs.truth, pairs.estimate);
}

}  // namespace hallway::eval

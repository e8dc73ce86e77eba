// SPDX-License-Identifier: MIT
#include "em/core/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/median.hpp"

namespace hallway::em {
namespace {

constexpr double kFarthest =
    4.5;  // standard deviations: farther off no point is a plane's, whatever the density
constexpr double kSmallestShare = 0.01;  // of a point: less of it is not worth the arithmetic
constexpr double kOutlierMatters =
    7.0;  // log likelihood; where none of the patches leads by more, outliers have a share
constexpr double kPriorPoints = 20.0;  // weight of the noise that a patch was found with in its own
constexpr double kNoiseLeeway = 1.4;   // a patch's noise against that
// What a patch must gain, in log likelihood by log of the number of points: half for each of its eight
// parameters (three of the plane, four of its extent, its noise), and one for each of the three points that
// make a plane, for so many were tried.
constexpr double kCost = 0.5 * 8.0 + 3.0;
constexpr double kMergedNoise = 1.15;  // RMS of a joined patch by that of its parts
constexpr double kMergeCosine = 0.9;   // planes turned farther than 25 degrees are not compared
constexpr double kFewest = 4.0;        // points that make a fit

/// Origin of the frame moved along its normal onto the plane of `fit`, the normal turned to that of `fit`:
/// places on the patch keep their coordinates.
PlaneFrame moved_onto(const PlaneFrame& frame, const PlaneFit& fit) {
  PlaneFrame result = turned(frame, fit.frame.normal);
  result.origin += result.normal * result.normal.dot(fit.frame.origin - frame.origin);
  return result;
}

double noise_of(const Patch& patch, double weight, double variance) {
  const double prior = kPriorPoints * patch.level * patch.level;
  const double pooled = (weight * variance + prior) / (weight - 3.0 + kPriorPoints);
  return std::clamp(std::sqrt(pooled), patch.level / kNoiseLeeway, patch.level * kNoiseLeeway);
}

/// Whether all points of two patches lie on the plane through them about as well as those of each on its own.
bool one_plane(const Moments& left, const Moments& right, double level, PlaneFit& fit) {
  if (left.weight() < kFewest || right.weight() < kFewest) return false;
  Moments joint = left;
  joint.join(right);
  fit = joint.fit(Vec3::Zero());
  const double apart = (left.weight() * left.fit(Vec3::Zero()).variances[0] +
                        right.weight() * right.fit(Vec3::Zero()).variances[0]) /
                       joint.weight();
  return fit.variances[0] <= kMergedNoise * kMergedNoise * std::max(apart, 0.5 * level * level);
}

}  // namespace

Mixture::Mixture(const PointField& field, double volume, Workers& workers)
    : field_(field),
      volume_(volume),
      workers_(workers),
      unassigned_(field.points.count),
      scratch_(workers.count()) {
  const std::size_t n = field.points.blocks() * kBlockSize;
  best_.assign(n, kNoPlane);
  second_.resize(n);
  best_score_.resize(n);
  second_score_.resize(n);
}

double Mixture::log_outlier() const {
  return std::log((static_cast<double>(unassigned_) + 0.5) / volume_);
}

double Mixture::noise() const {
  if (patches.empty()) return 0.0;
  std::vector<double> sigmas;
  for (const Patch& patch : patches) sigmas.push_back(patch.sigma);
  return median(sigmas);
}

std::vector<Mixture::Reach> Mixture::reaches(double outlier) const {
  std::vector<Reach> result;
  for (std::uint32_t j = 0; j < patches.size(); ++j) {
    const Patch& patch = patches[j];
    const double peak = log_peak(patch.sigma);
    const double lead = 2.0 * (std::log(patch.density) + peak - outlier);
    if (lead > 0.0) result.push_back({j, slab_over(patch, std::min(std::sqrt(lead), kFarthest)), peak});
  }
  return result;
}

void Mixture::assign_patch(std::size_t chunk, const Reach& reach, SlabPoints& slab) {
  collect_chunk(field_, chunk, reach.slab, slab);
  const Patch& patch = patches[reach.patch];
  const double scale = -0.5 / (patch.sigma * patch.sigma);
  for (std::size_t k = 0; k < slab.size(); ++k) {
    const float density = patch.log_density[patch.grid.at(slab.a[k], slab.b[k])];
    if (density == kNotCovered) continue;
    const auto score = density + static_cast<float>(reach.peak + scale * slab.height[k] * slab.height[k]);
    const std::uint32_t i = slab.place[k];
    if (score > best_score_[i]) {
      second_[i] = best_[i];
      second_score_[i] = best_score_[i];
      best_[i] = reach.patch;
      best_score_[i] = score;
    } else if (score > second_score_[i]) {
      second_[i] = reach.patch;
      second_score_[i] = score;
    }
  }
}

void Mixture::assign_chunk(std::size_t chunk, double outlier, const std::vector<Reach>& reaches,
                           SlabPoints& slab) {
  const std::size_t begin = chunk * BoxTree::kChunkSize;
  const std::size_t count = std::min(BoxTree::kChunkSize, best_.size() - begin);
  std::fill_n(&best_[begin], count, kNoPlane);
  std::fill_n(&second_[begin], count, kNoPlane);
  std::fill_n(&best_score_[begin], count, static_cast<float>(outlier));
  std::fill_n(&second_score_[begin], count, static_cast<float>(outlier));
  for (const Reach& reach : reaches) assign_patch(chunk, reach, slab);
}

void Mixture::assign() {
  const double outlier = log_outlier();
  const std::vector<Reach> reaches = this->reaches(outlier);
  std::vector<std::size_t> unassigned(field_.tree.chunks(), 0);
  workers_.run(unassigned.size(), [&](std::size_t chunk, std::size_t worker) {
    assign_chunk(chunk, outlier, reaches, scratch_[worker].slab);
    const std::size_t begin = chunk * BoxTree::kChunkSize;
    const std::size_t end = std::min(begin + BoxTree::kChunkSize, field_.points.count);
    unassigned[chunk] =
        static_cast<std::size_t>(std::count(best_.data() + begin, best_.data() + end, kNoPlane));
  });
  unassigned_ = std::accumulate(unassigned.begin(), unassigned.end(), std::size_t{0});
}

std::vector<Moments> Mixture::shared_moments(std::size_t begin, std::size_t end, double outlier) const {
  std::vector<Moments> moments(patches.size());
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t j = best_[i];
    if (j == kNoPlane) continue;
    const Vec3 p = field_.points.at(i);
    const double best = static_cast<double>(best_score_[i]);
    const std::uint32_t other = second_[i];
    const double none = best - outlier < kOutlierMatters ? std::exp(outlier - best) : 0.0;
    const double rest = other != kNoPlane ? std::exp(static_cast<double>(second_score_[i]) - best) : 0.0;
    const double share = 1.0 / (1.0 + none + rest);
    moments[j].add(p - patches[j].frame.origin, share);
    if (rest * share > kSmallestShare) moments[other].add(p - patches[other].frame.origin, rest * share);
  }
  return moments;
}

void Mixture::refit() {
  const double outlier = log_outlier();
  std::vector<std::vector<Moments>> parts(Workers::parts(field_.points.count));
  workers_.run_parts(field_.points.count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    parts[part] = shared_moments(begin, end, outlier);
  });
  std::vector<Moments> moments(patches.size());
  for (const std::vector<Moments>& part : parts) {
    for (std::size_t j = 0; j < patches.size(); ++j) moments[j].join(part[j]);
  }
  for (std::size_t j = 0; j < patches.size(); ++j) {
    Patch& patch = patches[j];
    if (moments[j].weight() < kFewest) continue;
    const PlaneFit fit = moments[j].fit(patch.frame.origin);
    patch.frame = moved_onto(patch.frame, fit);
    patch.sigma = noise_of(patch, moments[j].weight(), fit.variances[0]);
  }
}

std::vector<Mixture::Gain> Mixture::gains() const {
  std::vector<std::vector<Gain>> parts(Workers::parts(field_.points.count));
  workers_.run_parts(field_.points.count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<Gain> sums(patches.size());
    for (std::size_t i = begin; i < end; ++i) {
      if (best_[i] == kNoPlane) continue;
      sums[best_[i]].value += static_cast<double>(best_score_[i] - second_score_[i]);
      ++sums[best_[i]].members;
    }
    parts[part] = std::move(sums);
  });
  std::vector<Gain> all(patches.size());
  for (const std::vector<Gain>& part : parts) {
    for (std::size_t j = 0; j < patches.size(); ++j) {
      all[j].value += part[j].value;
      all[j].members += part[j].members;
    }
  }
  return all;
}

bool Mixture::cull(std::size_t min_points) {
  const std::vector<Gain> gain = gains();
  const double cost = kCost * std::log(static_cast<double>(field_.points.count));
  // One at a time, the least first: what it leaves may make another one worth its cost.
  std::size_t worst = patches.size();
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const bool poor = gain[j].members < min_points || gain[j].value < cost;
    if (poor && (worst == patches.size() || gain[j].value < gain[worst].value)) worst = j;
  }
  if (worst == patches.size()) return false;
  patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(worst));
  return true;
}

bool Mixture::merge() {
  std::vector<Moments> moments(patches.size());
  for (std::size_t i = 0; i < field_.points.count; ++i) {
    if (best_[i] != kNoPlane) moments[best_[i]].add(field_.points.at(i));
  }
  bool merged = false;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t j = i + 1; j < patches.size();) {
      const Patch& left = patches[i];
      const Patch& right = patches[j];
      PlaneFit fit;
      if (std::abs(left.frame.normal.dot(right.frame.normal)) < kMergeCosine || !touching(left, right) ||
          !one_plane(moments[i], moments[j], std::max(left.level, right.level), fit)) {
        ++j;
        continue;
      }
      patches[i] = joined(left, right, fit.frame);
      moments[i].join(moments[j]);
      moments.erase(moments.begin() + static_cast<std::ptrdiff_t>(j));
      patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(j));
      merged = true;
    }
  }
  return merged;
}

double Mixture::exclusive_share(std::uint32_t j, SlabPoints& slab) const {
  const Patch& patch = patches[j];
  collect(field_, slab_over(patch, kSlabSigmas), slab);
  double within = 0.0;
  double own = 0.0;
  for (std::size_t k = 0; k < slab.size(); ++k) {
    if (patch.log_density[patch.grid.at(slab.a[k], slab.b[k])] == kNotCovered) continue;
    const std::uint32_t best = best_[slab.place[k]];
    within += best != kNoPlane ? 1.0 : 0.0;
    own += best == j ? 1.0 : 0.0;
  }
  return within > 0.0 ? own / within : 1.0;
}

std::vector<double> Mixture::exclusive_shares() {
  std::vector<double> shares(patches.size());
  workers_.run(patches.size(), [&](std::size_t j, std::size_t worker) {
    shares[j] = exclusive_share(static_cast<std::uint32_t>(j), scratch_[worker].slab);
  });
  return shares;
}

}  // namespace hallway::em

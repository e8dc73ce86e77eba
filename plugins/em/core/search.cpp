// SPDX-License-Identifier: MIT
#include "em/core/search.hpp"

#include <algorithm>
#include <utility>

#include "geometry/median.hpp"

namespace hallway::em {
namespace {

// First what is one plane beyond doubt: what it claims is no longer in the way of the others. What is found
// beside it may be two planes that cross at a small angle, or have caught a strip of another; later passes
// tell.
constexpr Standard kStrict{1.12, 0.05};
constexpr Standard kLenient{1.3, 0.5};
constexpr double kStillFree = 0.9;  // share of a pending plane's members that nothing else has claimed since
constexpr double kRoughSeed =
    2.5;  // noise of a seed by that of the cloud: above, it holds more than one plane
// Rougher surfaces show as neighbourhoods that are left over although they are flat.
constexpr double kFlat = 0.03;          // flatness at most
constexpr double kRougher = 1.3;        // noise by that of the planes found so far, at least ...
constexpr double kRoughest = 5.0;       // ... and at most
constexpr std::size_t kRoughSeeds = 3;  // so many make a kind of surface
constexpr double kFinest = 1e-6;  // of the cloud's extent: noise below it is that of numbers with six digits
constexpr int kFailures = 2;      // growths that failed around a seed before it is left alone
constexpr std::size_t kLocalSearches = 32;  // in a round: the flattest that are left
constexpr double kDoubtful = 0.15;  // variance within two sheets by the whole: above, it may be one plane
constexpr std::size_t kPointsPerSeed = 8;  // no more seeds than one for so many points

/// The points that none has claimed, and where each stands in the whole list.
struct Unclaimed {
  Points points;
  std::vector<std::uint32_t> place;
};

Unclaimed unclaimed_of(const Points& points, const std::vector<std::uint8_t>& claimed) {
  Unclaimed result;
  for (std::size_t i = 0; i < points.count; ++i) {
    if (claimed[i] == 0) result.place.push_back(static_cast<std::uint32_t>(i));
  }
  result.points.resize(result.place.size());
  for (std::size_t k = 0; k < result.place.size(); ++k) result.points.set(k, points.at(result.place[k]));
  return result;
}

}  // namespace

PlaneSearch::PlaneSearch(const PointField& field, const AutoOptions& options, const Vec3& extent,
                         Workers& workers)
    : field_(field),
      options_(options),
      extent_(extent),
      workers_(workers),
      first_seeds_(find_seeds(field.points, static_cast<std::size_t>(options.seeds), 0, workers)) {}

double PlaneSearch::estimate_noise() const {
  const double finest = kFinest * extent_.maxCoeff();
  return first_seeds_.empty() ? 0.0 : std::max(noise_of_seeds(first_seeds_), finest);
}

double PlaneSearch::rougher_noise(double sigma, const std::vector<std::uint32_t>& labels) const {
  std::vector<std::uint8_t> claimed(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) claimed[i] = labels[i] != kNoPlane ? 1 : 0;
  const Unclaimed free = unclaimed_of(field_.points, claimed);
  const std::size_t wanted =
      std::min(static_cast<std::size_t>(options_.seeds), free.points.count / kPointsPerSeed + 1);
  std::vector<double> noise;
  for (const Seed& seed : find_seeds(free.points, wanted, 0, workers_)) {
    if (seed.flatness > kFlat) break;
    if (seed.noise > kRougher * sigma && seed.noise < kRoughest * sigma) noise.push_back(seed.noise);
  }
  if (noise.size() < kRoughSeeds) return 0.0;
  return median(noise);
}

void PlaneSearch::accept(Grown&& grown, std::vector<std::uint8_t>& claimed) {
  for (const std::uint32_t i : grown.members) {
    unclaimed_ -= claimed[i] == 0 ? 1u : 0u;
    claimed[i] = 1;
  }
  found_.push_back(std::move(grown));
}

void PlaneSearch::consider(Attempt&& attempt, double sigma, std::vector<std::uint8_t>& claimed) {
  const auto fewest = static_cast<std::size_t>(options_.min_points);
  Grown& grown = attempt.grown;
  const std::optional<TwoSheets>& sheets = attempt.sheets;
  if (grown.members.size() < fewest) return;
  if (!sheets || !(sheets->noise > 0.0)) {
    judge(std::move(grown), attempt.beside, sigma, claimed);
    return;
  }
  Grower grower(field_, claimed);
  const std::size_t before = found_.size() + pending_.size();
  // The noise was taken for that of two sheets together, as where they are nearer than the points on each.
  for (const double height : {sheets->low, sheets->high}) {
    Seed thin = *attempt.seed;
    thin.frame = grown.frame;
    thin.frame.origin += height * grown.frame.normal;
    Grown sheet = grower.grow(thin, sheets->noise);
    if (sheet.members.size() < fewest) continue;
    const Surroundings beside = surroundings_of(field_, claimed, sheet);
    judge(std::move(sheet), beside, sheets->noise, claimed);
  }
  const bool neither = found_.size() + pending_.size() == before;
  if (neither && sheets->within > kDoubtful) doubtful_.push_back(std::move(grown));
}

void PlaneSearch::judge(Grown&& grown, const Surroundings& beside, double sigma,
                        std::vector<std::uint8_t>& claimed) {
  const auto fewest = static_cast<std::size_t>(options_.min_points);
  const std::size_t n = field_.points.count;
  const double others = static_cast<double>(unclaimed_ - std::min(unclaimed_, grown.members.size()));
  const double volume_density = (others + 0.5) / extent_.cwiseMax(2.0 * kSlabSigmas * sigma).prod();
  const Evidence evidence = evidence_of(beside, claimed, grown, sigma, volume_density);
  if (convincing(evidence, kStrict, n, fewest)) {
    accept(std::move(grown), claimed);
    return;
  }
  for (const std::uint32_t i : grown.members) {
    if (failures_[i] < 255) ++failures_[i];
  }
  if (convincing(evidence, kLenient, n, fewest)) {
    pending_.push_back({std::move(grown), evidence.noise_ratio});
  }
}

void PlaneSearch::accept_pending(std::vector<std::uint8_t>& claimed) {
  std::stable_sort(pending_.begin(), pending_.end(), [](const Pending& left, const Pending& right) {
    return left.noise_ratio < right.noise_ratio;
  });
  for (Pending& pending : pending_) {
    const std::vector<std::uint32_t>& members = pending.grown.members;
    const auto free = std::count_if(members.begin(), members.end(),
                                    [&claimed](std::uint32_t i) { return claimed[i] == 0; });
    if (static_cast<double>(free) < kStillFree * static_cast<double>(members.size())) continue;
    accept(std::move(pending.grown), claimed);
  }
}

std::vector<Grown> PlaneSearch::accept_doubtful(double sigma, std::vector<std::uint8_t>& claimed) {
  found_.clear();
  pending_.clear();
  for (Grown& grown : doubtful_) {
    const std::vector<std::uint32_t>& members = grown.members;
    const bool free =
        std::all_of(members.begin(), members.end(), [&claimed](std::uint32_t i) { return claimed[i] == 0; });
    if (!free) continue;
    const Surroundings beside = surroundings_of(field_, claimed, grown);
    judge(std::move(grown), beside, sigma, claimed);
  }
  doubtful_.clear();
  return std::move(found_);
}

void PlaneSearch::try_all(const Trial& trial, double sigma, std::vector<std::uint8_t>& claimed) {
  GrowthAhead growth(field_, claimed, trial, {sigma, facets_, static_cast<std::size_t>(options_.min_points)},
                     workers_);
  std::size_t left = trial.most;
  for (std::size_t next = 0; next < trial.count && left > 0; ++next) {
    if (trial.skip(next)) continue;
    Attempt attempt = growth.take(next, left);
    --left;
    if (attempt.seed) consider(std::move(attempt), sigma, claimed);
  }
}

void PlaneSearch::begin_round(std::vector<std::uint8_t>& claimed) {
  found_.clear();
  pending_.clear();
  failures_.assign(claimed.size(), 0);
}

std::vector<Grown> PlaneSearch::try_warm_seeds(double sigma, std::vector<std::uint8_t>& claimed) {
  begin_round(claimed);
  const std::vector<Seed> seeds = std::exchange(warm_seeds_, {});
  const auto end = claimed.begin() + static_cast<std::ptrdiff_t>(field_.points.count);
  unclaimed_ = static_cast<std::size_t>(std::count(claimed.begin(), end, std::uint8_t{0}));
  const auto likely = [&](std::size_t k) -> const Seed& { return seeds[k]; };
  try_all({seeds.size(), seeds.size(), [](std::size_t) { return false; }, likely,
           [&](std::size_t k) { return std::optional(seeds[k]); }},
          sigma, claimed);
  return std::move(found_);
}

std::vector<Grown> PlaneSearch::round(double sigma, std::size_t number, std::vector<std::uint8_t>& claimed) {
  begin_round(claimed);
  const Unclaimed free = unclaimed_of(field_.points, claimed);
  const BoxTree tree(free.points, workers_);
  const PointField free_field{free.points, tree};
  unclaimed_ = free.points.count;
  const std::size_t wanted =
      std::min(static_cast<std::size_t>(options_.seeds), free.points.count / kPointsPerSeed + 1);
  const bool nothing_claimed = number == 0 && free.points.count == field_.points.count;
  const std::vector<Seed> seeds =
      nothing_claimed ? first_seeds_ : find_seeds(free.points, wanted, number, workers_);
  const auto place = [&](std::size_t k) { return free.place[seeds[k].place]; };
  const auto skip_grown = [&](std::size_t k) {
    return claimed[place(k)] != 0 || failures_[place(k)] >= kFailures || seeds[k].noise > kRoughSeed * sigma;
  };
  const auto likely = [&](std::size_t k) -> const Seed& { return seeds[k]; };
  try_all({seeds.size(), seeds.size(), skip_grown, likely,
           [&](std::size_t k) { return std::optional(seeds[k]); }},
          sigma, claimed);
  const auto skip_searched = [&](std::size_t k) {
    return claimed[place(k)] != 0 || failures_[place(k)] >= 2 * kFailures;
  };
  const auto search = [&](std::size_t k) {
    return search_locally(free_field, seeds[k].place, seeds[k].radius, sigma, number);
  };
  try_all({seeds.size(), kLocalSearches, skip_searched, likely, search}, sigma, claimed);
  if (found_.empty()) accept_pending(claimed);
  return std::move(found_);
}

std::vector<Grown> PlaneSearch::find(double sigma, int fruitless, std::vector<std::uint8_t>& claimed) {
  doubtful_.clear();
  std::vector<Grown> all = try_warm_seeds(sigma, claimed);
  int in_a_row = 0;
  for (std::size_t number = 0; number < static_cast<std::size_t>(options_.rounds); ++number) {
    std::vector<Grown> found = round(sigma, number, claimed);
    in_a_row = found.empty() ? in_a_row + 1 : 0;
    for (Grown& grown : found) all.push_back(std::move(grown));
    if (in_a_row == fruitless) break;
  }
  for (Grown& grown : accept_doubtful(sigma, claimed)) all.push_back(std::move(grown));
  return all;
}

}  // namespace hallway::em

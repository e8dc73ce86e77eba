// SPDX-License-Identifier: MIT
#include "eval/association_score.hpp"

#include <algorithm>
#include <vector>

#include "base/error.hpp"

namespace hallway::eval {

using log::kNoLandmark;
using log::LandmarkId;

std::size_t AssociationScore::PairHash::operator()(const Pair& pair) const {
  // The finaliser of MurmurHash3: consecutive ids must not fall into neighbouring buckets of both numbers.
  std::uint64_t hash = pair.map * 0x9E3779B97F4A7C15u + pair.truth;
  hash = (hash ^ (hash >> 33)) * 0xFF51AFD7ED558CCDu;
  hash = (hash ^ (hash >> 33)) * 0xC4CEB9FE1A85EC53u;
  return hash ^ (hash >> 33);
}

void AssociationScore::add(std::span<const LandmarkId> associations) {
  observations_ += associations.size();
  none_ += static_cast<std::uint64_t>(std::count(associations.begin(), associations.end(), kNoLandmark));
}

void AssociationScore::add(std::span<const LandmarkId> associations, std::span<const LandmarkId> identities) {
  if (associations.size() != identities.size()) {
    throw Error(ErrorCode::kInternal, "a frame has not as many associations as identities");
  }
  add(associations);
  for (std::size_t i = 0; i < associations.size(); ++i) {
    if (identities[i] != kNoLandmark) seen_.insert(identities[i]);
    if (associations[i] != kNoLandmark) ++votes_[{associations[i], identities[i]}];
  }
}

AssociationScore::Ownership AssociationScore::ownership() const {
  std::vector<std::pair<Pair, std::uint64_t>> votes(votes_.begin(), votes_.end());
  std::sort(votes.begin(), votes.end());
  Ownership result;
  for (std::size_t begin = 0; begin < votes.size();) {
    const LandmarkId map = votes[begin].first.map;
    LandmarkId owner = kNoLandmark;
    std::uint64_t most = 0;
    std::uint64_t all = 0;
    std::size_t i = begin;
    for (; i < votes.size() && votes[i].first.map == map; ++i) {
      const auto& [pair, count] = votes[i];
      all += count;
      if (pair.truth != kNoLandmark && count > most) {  // ids increase: the lowest of equal ones stays
        owner = pair.truth;
        most = count;
      }
    }
    if (owner != kNoLandmark) {
      result.owner.emplace(map, owner);
      result.errors += all - most;
    }
    begin = i;
  }
  return result;
}

}  // namespace hallway::eval

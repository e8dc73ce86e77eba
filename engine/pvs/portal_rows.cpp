// SPDX-License-Identifier: MIT
#include "pvs/portal_rows.hpp"

#include <algorithm>
#include <numeric>

#include "base/parallel.hpp"
#include "pvs/flood.hpp"
#include "pvs/flow.hpp"
#include "pvs/rank_window.hpp"
#include "pvs/stage.hpp"

namespace hallway::pvs {
namespace {

/// Ranks before its own whose results a portal does not use: more than threads that a machine has, few of
/// all.
constexpr std::size_t kWindow = 64;

/// Portals flooded in one chunk.
constexpr std::size_t kFloodGrain = 64;

/// Of a thousand, what the flood takes of the time.
constexpr std::size_t kFloodShare = 100;

/// For each portal, what may be reached in front of it, both ways.
BitMatrix candidate_rows(const DirectedPortals& world, const Options& options) {
  const std::size_t count = world.portals.size();
  BitMatrix rows(count, count);
  Stage stage(options.progress, 0, kFloodShare, count);
  parallel_for(count, kFloodGrain, options.threads, [&](std::size_t begin, std::size_t end) {
    if (stage.stopped()) return;
    Flood flood(world);
    for (std::size_t p = begin; p < end; ++p) flood.in_front_of(static_cast<std::uint32_t>(p), rows.row(p));
    stage.add(end - begin);
  });
  keep_mutual(rows, options.threads);
  parallel_for(count, kFloodGrain, options.threads, [&](std::size_t begin, std::size_t end) {
    Flood flood(world);
    for (std::size_t p = begin; p < end; ++p) flood.prune(static_cast<std::uint32_t>(p), rows.row(p));
  });
  return rows;
}

/// Portals by rising number of candidates: what is found of the cheap ones makes the dear ones cheap.
struct Ranking {
  std::vector<std::uint32_t> portal;  ///< of each rank
  std::vector<std::size_t> size;      ///< of each portal: number of candidates
  std::vector<std::size_t> rank;      ///< of each portal
};

Ranking rank_portals(const BitMatrix& candidates) {
  Ranking ranking;
  const std::size_t count = candidates.rows();
  ranking.size.resize(count);
  for (std::size_t p = 0; p < count; ++p) ranking.size[p] = count_bits(candidates.row(p), candidates.words());
  ranking.portal.resize(count);
  std::iota(ranking.portal.begin(), ranking.portal.end(), 0u);
  std::sort(ranking.portal.begin(), ranking.portal.end(), [&](std::uint32_t a, std::uint32_t b) {
    return ranking.size[a] != ranking.size[b] ? ranking.size[a] < ranking.size[b] : a < b;
  });
  ranking.rank.resize(count);
  for (std::size_t r = 0; r < count; ++r) ranking.rank[ranking.portal[r]] = r;
  return ranking;
}

/// What all threads share.
struct Search {
  const DirectedPortals& world;
  const BitMatrix& candidates;
  const Ranking& ranking;
  std::uint64_t work_limit;  ///< of one portal
  BitMatrix seen;
  std::vector<std::uint64_t> work;  ///< of each rank
  std::vector<std::uint8_t> cut_short;
};

/// One thread's part of the search.
class Worker {
 public:
  explicit Worker(Search& search)
      : search_(search),
        flow_(search.world),
        flood_(search.world),
        rows_(search.world.portals.size()),
        candidates_(search.candidates.words()) {
    for (std::size_t p = 0; p < rows_.size(); ++p) rows_[p] = search.candidates.row(p);
  }

  /// Searches for the portal of a rank, using results of ranks below `usable`, which never goes down.
  void search(std::size_t rank, std::size_t usable) {
    for (; usable_ < usable; ++usable_) {
      const std::uint32_t finished = search_.ranking.portal[usable_];
      rows_[finished] = search_.seen.row(finished);
    }
    const std::uint32_t portal = search_.ranking.portal[rank];
    if (!use_what_is_known(portal)) return;
    flood_.prune(portal, candidates_.data());
    search_.work[rank] =
        flow_.run(portal, candidates_.data(), rows_, search_.work_limit, search_.seen.row(portal));
    search_.cut_short[rank] = flow_.was_cut_short() ? 1 : 0;
  }

 private:
  /// Sets candidates_, and the portal's row of what is seen, by the results of portals passed the other way:
  /// `portal` sees `target` if and only if the way back from `target` sees the way back from `portal`. False
  /// if that decides all.
  bool use_what_is_known(std::uint32_t portal) {
    const Word* all = search_.candidates.row(portal);
    Word* seen = search_.seen.row(portal);
    std::copy_n(all, candidates_.size(), candidates_.begin());
    bool open = false;
    for_each_bit(all, candidates_.size(), [&](std::size_t target) {
      const std::size_t back = target ^ 1u;
      if (search_.ranking.rank[back] >= usable_) {
        open = true;
      } else if (test_bit(search_.seen.row(back), portal ^ 1u)) {
        set_bit(seen, target);
      } else {
        clear_bit(candidates_.data(), target);
      }
    });
    return open;
  }

  Search& search_;
  Flow flow_;
  Flood flood_;
  std::vector<const Word*> rows_;
  std::vector<Word> candidates_;
  std::size_t usable_ = 0;
};

void run_worker(Search& search, RankWindow& window, Stage& stage) {
  try {
    Worker worker(search);
    const std::size_t count = search.ranking.portal.size();
    for (std::size_t rank = window.claim(); rank < count; rank = window.claim()) {
      worker.search(rank, window.usable(rank));
      window.finish(rank);
      stage.add(search.ranking.size[search.ranking.portal[rank]]);
    }
  } catch (...) {
    window.stop();
    throw;
  }
}

}  // namespace

BitMatrix full_portal_rows(const DirectedPortals& world, const Options& options, Statistics& statistics) {
  const std::size_t count = world.portals.size();
  const BitMatrix candidates = candidate_rows(world, options);
  const Ranking ranking = rank_portals(candidates);
  const std::size_t pairs = std::accumulate(ranking.size.begin(), ranking.size.end(), std::size_t{0});
  Search search{.world = world,
                .candidates = candidates,
                .ranking = ranking,
                .work_limit = options.work_limit / std::max<std::size_t>(count, 1),
                .seen = BitMatrix(count, count),
                .work = std::vector<std::uint64_t>(count),
                .cut_short = std::vector<std::uint8_t>(count)};
  RankWindow window(count, kWindow);
  Stage stage(options.progress, kFloodShare, Stage::kWhole, pairs);
  const unsigned threads = std::max(options.threads, 1u);
  parallel_for(threads, 1, threads, [&](std::size_t, std::size_t) { run_worker(search, window, stage); });

  statistics.candidates = pairs;
  statistics.work = std::accumulate(search.work.begin(), search.work.end(), std::uint64_t{0});
  statistics.cut_short =
      static_cast<std::size_t>(std::count(search.cut_short.begin(), search.cut_short.end(), std::uint8_t{1}));
  return std::move(search.seen);
}

}  // namespace hallway::pvs

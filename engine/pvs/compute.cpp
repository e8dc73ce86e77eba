// SPDX-License-Identifier: MIT
#include "pvs/compute.hpp"

#include <vector>

#include "base/parallel.hpp"
#include "pvs/bit_matrix.hpp"
#include "pvs/directed_portals.hpp"
#include "pvs/flood.hpp"
#include "pvs/portal_rows.hpp"
#include "pvs/stage.hpp"

namespace hallway::pvs {
namespace {

/// Clusters in one chunk of parallel work.
constexpr std::size_t kGrain = 16;

/// Adds to a row of clusters what is seen by looking through a portal that leaves it.
void add_portal(const DirectedPortals& world, std::uint32_t portal, const Word* seen, Word* clusters) {
  set_bit(clusters, world.portals[portal].to);
  for_each_bit(seen, words_for(world.portals.size()),
               [&](std::size_t target) { set_bit(clusters, world.portals[target].to); });
}

/// For each cluster, what the flood reaches.
BitMatrix fast_cluster_rows(const DirectedPortals& world, const Options& options) {
  const std::size_t clusters = world.clusters();
  BitMatrix rows(clusters, clusters);
  Stage stage(options.progress, 0, Stage::kWhole, clusters);
  parallel_for(clusters, kGrain, options.threads, [&](std::size_t begin, std::size_t end) {
    if (stage.stopped()) return;
    Flood flood(world);
    std::vector<Word> seen;
    for (std::size_t cluster = begin; cluster < end; ++cluster) {
      for (const std::uint32_t portal : world.leaving_from(cluster)) {
        seen.assign(words_for(world.portals.size()), 0);
        flood.in_front_of(portal, seen.data());
        add_portal(world, portal, seen.data(), rows.row(cluster));
      }
    }
    stage.add(end - begin);
  });
  return rows;
}

/// For each cluster, what its portals see.
BitMatrix full_cluster_rows(const DirectedPortals& world, const Options& options, Statistics& statistics) {
  const BitMatrix portals = full_portal_rows(world, options, statistics);
  for (std::size_t p = 0; p < portals.rows(); ++p)
    statistics.seen += count_bits(portals.row(p), portals.words());
  const std::size_t clusters = world.clusters();
  BitMatrix rows(clusters, clusters);
  parallel_for(clusters, kGrain, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cluster = begin; cluster < end; ++cluster) {
      for (const std::uint32_t portal : world.leaving_from(cluster)) {
        add_portal(world, portal, portals.row(portal), rows.row(cluster));
      }
    }
  });
  return rows;
}

/// Rows of bytes of what is seen in both directions, each cluster by itself too.
std::vector<std::vector<std::uint8_t>> mutual_bytes(const BitMatrix& rows, unsigned threads) {
  const std::size_t clusters = rows.rows();
  std::vector<std::vector<std::uint8_t>> bytes(clusters, std::vector<std::uint8_t>((clusters + 7) / 8));
  const auto set = [&](std::size_t row, std::size_t bit) {
    bytes[row][bit / 8] = static_cast<std::uint8_t>(bytes[row][bit / 8] | 1u << (bit % 8));
  };
  parallel_for(clusters, kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cluster = begin; cluster < end; ++cluster) {
      set(cluster, cluster);
      for_each_bit(rows.row(cluster), rows.words(), [&](std::size_t other) {
        if (test_bit(rows.row(other), cluster)) set(cluster, other);
      });
    }
  });
  return bytes;
}

}  // namespace

VisibleSets compute(const bsp::PortalGraph& graph, const Options& options, Statistics* statistics) {
  const DirectedPortals world = direct_portals(graph);
  Statistics done;
  done.portals = world.portals.size();
  done.too_large = options.level == Level::kFull && graph.portals.size() > kLargestFull;
  const bool full = options.level == Level::kFull && !done.too_large;
  const BitMatrix rows = full ? full_cluster_rows(world, options, done) : fast_cluster_rows(world, options);
  if (statistics != nullptr) *statistics = done;
  return VisibleSets(mutual_bytes(rows, options.threads));
}

}  // namespace hallway::pvs

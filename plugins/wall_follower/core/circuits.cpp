// SPDX-License-Identifier: MIT
#include "wall_follower/core/circuits.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/median.hpp"

namespace hallway::wall_follower {
namespace {

constexpr std::size_t kLatePairs = 3;   // that say where the robot is now
constexpr std::size_t kMostBehind = 4;  // landmarks behind such an alignment that are of the lap too
constexpr std::size_t kLeastKept = 6;   // landmarks of another wall, from which the robot came to a known one
constexpr double kSureWay = 0.15,
                 kAgree = 0.3;  // of ways between two sights of landmarks, from the middle one [m]
constexpr double kFarOff =
    1.5;  // the reckoned way is off by less than this, and the error of the station [m]
constexpr double kSeenAgain = 0.5;  // a landmark that leads into a lap is one of the lap within this [m]

bool leads_on(Kind kind) {
  return kind == Kind::sweep || kind == Kind::room || kind == Kind::junction;
}

/// The middle of what the first sights are off from the second ones.
Vec2 middle_correction(const Chart& chart, const std::vector<SameLandmark>& same) {
  const std::span<const Node> wall = chart.wall();
  Vec2 sum = Vec2::Zero();
  double count = 0.0;
  for (const SameLandmark& pair : same) {
    // The first sight of a landmark that was seen three times has drifted itself.
    if (pair.first >= same.front().again) continue;
    sum += wall[pair.first].at - wall[pair.again].at;
    count += 1.0;
  }
  return sum / count;
}

/// Leaves out what of a string of landmarks is of a circuit, the last one of the chart: from the first one on that is. Edges into what is left out, and out of it, are those of the circuit's landmarks.
/// @return what is left
std::vector<std::uint32_t> without_circuit(Chart& chart, const std::vector<std::uint32_t>& string,
                                           const Options& options) {
  const Circuit& circuit = chart.circuits.back();
  LoopFinder finder(options);
  finder.begin(chart);
  std::vector<std::optional<std::uint32_t>> again;
  for (const std::uint32_t id : string) {
    finder.add(chart.node(id));
    const auto index = landmark_near(chart, circuit, chart.node(id), kSeenAgain);
    again.push_back(index ? std::optional(circuit.lap[*index]) : std::nullopt);
  }
  // What is left out is [cut, stop).
  std::size_t cut = string.size(), stop = string.size(), known = 0;
  for (std::size_t i = string.size(); i-- > 0;) {
    if (!again[i]) continue;
    ++known;
    if (2 * known > string.size() - i) cut = i;
  }
  const auto same = finder.best_with(chart.circuits.size() - 1);
  if (!same.empty() && same.front().again < cut) {
    cut = same.front().again;
    if (same.back().again + kMostBehind < string.size()) stop = same.back().again + 1;
  }
  if (cut == string.size()) return string;
  for (const SameLandmark& pair : same) again[pair.again] = circuit.lap[pair.first];
  for (Edge& edge : chart.edges) {
    // A crossing leads to the wall's first landmark. A string of landmarks says which one of the lap that is.
    if (!same.empty() && cut == 0 && edge.is_crossing && edge.to == string.front() && same.front().again == 0)
      edge.to = *again.front();
  }
  for (std::size_t i = cut; i < stop; ++i) {
    if (again[i]) ++chart.node(*again[i]).visits;
  }
  std::vector<std::uint32_t> left(string), out;
  const auto begin = left.begin() + static_cast<std::ptrdiff_t>(cut);
  const auto end = left.begin() + static_cast<std::ptrdiff_t>(stop);
  out.assign(begin, end);
  left.erase(begin, end);
  chart.remove(out);
  return left;
}

/// The landmarks of a wall that did not lead back are kept; where most of them are of an earlier such wall, only the others. By its place alone no landmark says where a crossing has led: that is left out with its end.
void keep_unseen(Chart& chart, const std::vector<std::uint32_t>& string) {
  const auto is_seen = [&](std::uint32_t id) {
    const Node& node = chart.node(id);
    return std::ranges::any_of(chart.leads, [&](const std::vector<std::uint32_t>& lead) {
      return std::ranges::any_of(lead, [&](std::uint32_t known) {
        return may_be_one(chart.node(known), node) && (chart.node(known).at - node.at).norm() < kSeenAgain;
      });
    });
  };
  std::vector<std::uint32_t> unseen, seen;
  for (const std::uint32_t id : string) (is_seen(id) ? seen : unseen).push_back(id);
  const bool is_known = 2 * seen.size() > string.size();
  if (is_known) chart.remove(seen);
  std::vector<std::uint32_t> kept = is_known ? unseen : string;
  if (!kept.empty()) chart.leads.push_back(std::move(kept));
}

/// Of pairs with the ways between both sights: how far each is from the middle one. Where a wall's end is round, landmarks are seen in several places.
std::vector<double> off_middle(const std::vector<double>& ways) {
  std::vector<double> sorted(ways), off;
  const double middle = median(sorted);
  for (const double way : ways) off.push_back(std::abs(way - middle));
  return off;
}

/// The pair that says best where a landmark was seen again, and whether the others agree.
struct Surest {
  std::size_t pair = 0;
  bool is_sure = false;
};

Surest surest(const Chart& chart, const std::vector<SameLandmark>& same) {
  const std::span<const Node> wall = chart.wall();
  std::vector<double> ways;
  for (const SameLandmark& pair : same) {
    if (pair.first < same.front().again) ways.push_back(wall[pair.again].way_m - wall[pair.first].way_m);
  }
  const std::vector<double> off = off_middle(ways);
  const auto within = [&](double most) {
    return std::ranges::count_if(off, [=](double one) { return one < most; });
  };
  const bool is_sure = within(kAgree) >= 3 && 2 * within(kAgree) > std::ssize(off);
  if (chart.circuits.empty()) return {0, is_sure};
  // The last one: the first landmarks of a wall are seen at a slant, where a crossing ends.
  std::optional<std::size_t> last;
  for (std::size_t i = off.size(); i-- > 0;) {
    if (off[i] >= kSureWay) continue;
    if (!last) last = i;
    if (wall[same[i].first].kind == Kind::discontinuity) return {i, is_sure};
  }
  return last ? Surest{*last, is_sure} : Surest{};
}

}  // namespace

std::size_t first_sight(const std::vector<SameLandmark>& same, std::size_t landmark) {
  for (auto pair = same.rbegin(); pair != same.rend(); ++pair) {
    if (pair->again == landmark) landmark = pair->first;
  }
  return landmark;
}

std::vector<SameLandmark> from_surest(const Chart& chart, const std::vector<SameLandmark>& same) {
  return {same.begin() + static_cast<std::ptrdiff_t>(surest(chart, same).pair), same.end()};
}

Vec2 share_of(const Vec2& correction, double from_m, double to_m, double at_m) {
  return correction * std::clamp((at_m - from_m) / std::max(to_m - from_m, 1e-9), 0.0, 1.0);
}

bool may_be_one(const Node& a, const Node& b) {
  const bool is_kind = a.kind == b.kind || (leads_on(a.kind) && leads_on(b.kind));
  return is_kind && a.direction == b.direction && (a.quarter - b.quarter) % kWholeTurn == 0;
}

std::optional<std::size_t> landmark_near(const Chart& chart, const Circuit& circuit, const Node& node,
                                         double within_m) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < circuit.lap.size(); ++i) {
    const Node& known = chart.node(circuit.lap[i]);
    const double off = (known.at - node.at).norm();
    if (off > within_m || !may_be_one(known, node)) continue;
    within_m = off;
    best = i;
  }
  return best;
}

std::optional<std::size_t> landmark_at(const Chart& chart, const Circuit& circuit, const Node& node,
                                       double station_m, double within_m) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < circuit.lap.size(); ++i) {
    const Node& known = chart.node(circuit.lap[i]);
    const double off = std::abs(std::remainder(known.way_m - circuit.begin_m - station_m, circuit.length_m));
    if (off > within_m || !may_be_one(known, node)) continue;
    if ((known.at - node.at).norm() > kFarOff + within_m) continue;
    within_m = off;
    best = i;
  }
  return best;
}

Vec2 close_loop(Chart& chart, const std::vector<SameLandmark>& same, const Options& options) {
  const std::span<const Node> wall = chart.wall();
  const SameLandmark joint = from_surest(chart, same).front();
  const Vec2 correction = middle_correction(chart, same);
  Circuit circuit;
  circuit.begin_m = wall[joint.first].way_m;
  circuit.length_m = wall[joint.again].way_m - circuit.begin_m;
  std::vector<std::uint32_t> lead, seen_twice;
  for (std::size_t i = 0; i < wall.size(); ++i) {
    const bool is_lead = i < same.front().first;
    const bool is_lap = i >= joint.first && i < joint.again;
    (is_lead ? lead : is_lap ? circuit.lap : seen_twice).push_back(wall[i].id);
  }
  const std::uint32_t again = wall[joint.again].id;
  // Where the landmarks do not agree how long the lap is, its end is left open.
  const bool is_sure = chart.circuits.empty() || surest(chart, same).is_sure;
  for (const SameLandmark& pair : same) ++chart.node(wall[first_sight(same, pair.again)].id).visits;
  for (Edge& edge : chart.edges) {
    if (edge.to == again && is_sure) edge.to = circuit.lap.front();
    // A crossing leads to a landmark whose second sight is the one that is kept.
    for (const SameLandmark& pair : same) {
      const bool is_left_out = pair.first >= same.front().first && pair.first < joint.first;
      if (is_left_out && edge.is_crossing && edge.to == wall[pair.first].id) edge.to = wall[pair.again].id;
    }
  }
  chart.remove(seen_twice);
  for (const std::uint32_t id : circuit.lap) {
    Node& node = chart.node(id);
    node.at += share_of(correction, circuit.begin_m, circuit.begin_m + circuit.length_m, node.way_m);
  }
  for (Edge& edge : chart.edges) {
    // The way from what leads in is not along the wall of the lap.
    if (!lead.empty() && edge.from == lead.back() && edge.to == circuit.lap.front()) edge.is_crossing = true;
  }
  chart.circuits.push_back(std::move(circuit));
  chart.leads.push_back(lead);
  for (std::vector<std::uint32_t>& string : chart.leads) string = without_circuit(chart, string, options);
  std::erase_if(chart.leads, [](const std::vector<std::uint32_t>& string) { return string.empty(); });
  chart.wall_begin = chart.nodes.size();
  chart.loop = Loop::closed;
  ++chart.changes;
  return correction;
}

Correction join_circuit(Chart& chart, std::size_t circuit, const std::vector<SameLandmark>& same) {
  const Circuit& known = chart.circuits[circuit];
  const std::span<const Node> wall = chart.wall();
  const std::size_t late = same.size() - std::min<std::size_t>(same.size(), kLatePairs);
  Correction correction;
  correction.turns = chart.node(known.lap[same.back().first]).quarter - wall[same.back().again].quarter;
  for (std::size_t i = late; i < same.size(); ++i) {
    correction.to += chart.node(known.lap[same[i].first]).at / static_cast<double>(same.size() - late);
    correction.from += wall[same[i].again].at / static_cast<double>(same.size() - late);
  }
  for (const SameLandmark& pair : same) ++chart.node(known.lap[pair.first]).visits;
  const std::size_t begin = same.front().again < kLeastKept ? 0 : same.front().again;
  std::vector<std::uint32_t> kept, ids;
  for (std::size_t i = 0; i < wall.size(); ++i) (i < begin ? kept : ids).push_back(wall[i].id);
  keep_unseen(chart, kept);
  chart.remove(ids);
  chart.wall_begin = chart.nodes.size();
  ++chart.changes;
  return correction;
}

}  // namespace hallway::wall_follower

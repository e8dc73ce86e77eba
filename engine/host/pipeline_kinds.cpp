// SPDX-License-Identifier: MIT
#include "host/pipeline_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "host/output/output_kind.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::host {
namespace {

using Kinds = std::set<std::uint32_t>;

Kinds given_by(const PluginInfo& plugin) {
  Kinds kinds;
  for (const std::uint32_t output : plugin.outputs) {
    if (const auto sample = sample_of_output(output)) kinds.insert(*sample);
  }
  return kinds;
}

std::string names_of(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const std::uint32_t kind : kinds) names.push_back(sample_kind_name(kind));
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

/// Plugins by their place in the pipeline, and what there is before the first of them.
class Typing {
 public:
  Typing(std::span<const PluginInfo> plugins, std::span<const SensorInfo> sensors) : plugins_(plugins) {
    for (const SensorInfo& sensor : sensors) sensed_.insert(sensor.kind);
    for (const PluginInfo& plugin : plugins) given_.push_back(given_by(plugin));
  }

  void check() const {
    Kinds there = sensed_;
    for (std::size_t i = 0; i < plugins_.size(); ++i) {
      if (const auto kind = unmet(i, there)) fail(i, *kind);
      there.insert(given_[i].begin(), given_[i].end());
    }
  }

 private:
  /// A kind that plugin `i` needs and that is not there.
  std::optional<std::uint32_t> unmet(std::size_t i, const Kinds& there) const {
    for (const std::uint32_t kind : plugins_[i].inputs) {
      if (!there.contains(kind)) return kind;
    }
    return std::nullopt;
  }

  std::optional<std::size_t> giver_of(std::uint32_t kind, const std::vector<std::size_t>& placed) const {
    for (std::size_t i = 0; i < plugins_.size(); ++i) {
      if (given_[i].contains(kind) && std::ranges::find(placed, i) == placed.end()) return i;
    }
    return std::nullopt;
  }

  /// As many plugins as can stand behind each other, each with all that it needs; what is there then is added to `there`.
  std::vector<std::size_t> best_order(Kinds& there) const {
    std::vector<std::size_t> order;
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < plugins_.size() && !more; ++i) {
        const bool placed = std::ranges::find(order, i) != order.end();
        if (placed || unmet(i, there)) continue;
        order.push_back(i);
        there.insert(given_[i].begin(), given_[i].end());
        more = true;  // from the first again: one that stood before it may fit now
      }
    }
    return order;
  }

  [[noreturn]] void fail(std::size_t i, std::uint32_t kind) const {
    Kinds there = sensed_;
    const std::vector<std::size_t> order = best_order(there);
    if (order.size() == plugins_.size()) fail_order(i, kind, order);
    std::size_t stuck = i;
    while (!unmet(stuck, there)) ++stuck;  // there is one: not all could be placed, and those before `i` were
    fail_stuck(stuck, there, order);
  }

  [[noreturn]] void fail_order(std::size_t i, std::uint32_t kind,
                               const std::vector<std::size_t>& order) const {
    std::vector<std::string> ids;
    for (const std::size_t place : order) ids.push_back("`" + plugins_[place].id + "`");
    throw Error(
        ErrorCode::kBadInput,
        fmt::format(
            "plugin `{}` needs {}, which `{}` gives, but that stands behind it; this order would do: {}",
            plugins_[i].id, sample_kind_name(kind), plugins_[*giver_of(kind, {})].id, fmt::join(ids, ", ")));
  }

  /// Follows what is missing from plugin to plugin, until nobody gives it or one comes again.
  [[noreturn]] void fail_stuck(std::size_t stuck, const Kinds& there,
                               const std::vector<std::size_t>& placed) const {
    std::vector<std::size_t> way;
    std::vector<std::string> links;
    for (std::size_t at = stuck;;) {
      const std::uint32_t kind = *unmet(at, there);
      const auto giver = giver_of(kind, placed);
      if (!giver) fail_missing(at, kind);
      way.push_back(at);
      links.push_back(fmt::format("`{}` needs {}, which {} gives", plugins_[at].id, sample_kind_name(kind),
                                  *giver == at ? "only itself" : "`" + plugins_[*giver].id + "`"));
      const auto seen = std::ranges::find(way, *giver);
      at = *giver;
      if (seen == way.end()) continue;
      links.erase(links.begin(), links.begin() + (seen - way.begin()));
      throw Error(ErrorCode::kBadInput,
                  fmt::format("the plugins need each other in a circle: {}", fmt::join(links, "; ")));
    }
  }

  [[noreturn]] void fail_missing(std::size_t i, std::uint32_t kind) const {
    Kinds given;
    for (const Kinds& kinds : given_) given.insert(kinds.begin(), kinds.end());
    throw Error(ErrorCode::kBadInput,
                fmt::format("plugin `{}` needs {}, which no sensor gives; the sensors give: {}{}",
                            plugins_[i].id, sample_kind_name(kind), names_of(sensed_),
                            given.empty() ? "" : "; the plugins give: " + names_of(given)));
  }

  std::span<const PluginInfo> plugins_;
  Kinds sensed_;
  std::vector<Kinds> given_;
};

}  // namespace

void check_kinds(std::span<const PluginInfo> plugins, std::span<const SensorInfo> sensors) {
  Typing(plugins, sensors).check();
}

}  // namespace hallway::host

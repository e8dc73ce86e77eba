// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "adapter/option_rows.hpp"
#include "wall_follower/core/follower.hpp"
#include "wall_follower/drawing.hpp"
#include "wall_follower/sense_adapter.hpp"
#include "wall_follower/topology_rows.hpp"

namespace hallway::wall_follower {
namespace {

/// Follower behind the plugin ABI.
class WallFollower final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() {
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_RANGE_SCAN, HW_SAMPLE_ENCODER};
    static constexpr std::uint32_t kOptional[] = {HW_SAMPLE_BUMP};
    static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_DRIVE_COMMAND, HW_OUTPUT_TOPOLOGY,
                                                 HW_OUTPUT_DRAWING, HW_OUTPUT_COUNTERS};
    static constexpr hw_plugin_info_t kInfo =
        sdk::plugin_info("wall_follower", "Wall follower", "0.1.0", "Hallway",
                         "Follows the wall on its right, charts its landmarks and closes the loop.", kInputs,
                         kOutputs, kOptional);
    return &kInfo;
  }

  explicit WallFollower(const hw_host_t* host) : Plugin(host) {
    add_options(parameters(), options_, wall_follower::parameters());
  }

  void activate(const hw_activation_t& activation) override {
    adapter_.activate(activation);
    missing_ = adapter_.missing();
    if (!missing_.empty()) host().log(HW_LOG_WARNING, "the robot stands: it has no " + missing_);
    reset();
  }

  void deactivate() override { follower_.reset(); }

  void reset() override {
    follower_.emplace(adapter_.body(), options_);
    loop_ = Loop::open;
    sweeps_ = 0;
    changes_ = 0;
  }

  void process(const hw_frame_t& frame) override {
    const Senses& senses = adapter_.gather(frame);
    const Command command = missing_.empty() ? follower_->step(senses) : Command();
    host().put_drive_command(command.forward_m_s, command.left_rad_s);
    put_counters();
    if (follower_->chart().changes != changes_) put_topology();
    draw(*follower_, adapter_.body(), senses, drawing_);
    host().put_drawing(drawing_);
    log_changes(frame);
  }

  void report(bool) override { put_topology(); }

 private:
  void put_topology() {
    const Chart& chart = follower_->chart();
    changes_ = chart.changes;
    const TopologyRows rows = topology_rows(chart);
    nodes_.clear();
    edges_.clear();
    for (const Node& node : rows.nodes)
      nodes_.push_back({node.id, static_cast<std::uint32_t>(node.kind), node.direction, node.visits,
                        node.size_m, node.t_ns, node.body.x(), node.body.y()});
    for (const Edge& edge : rows.edges)
      edges_.push_back({edge.from, edge.to, edge.length_m, edge.confidence, edge.quarter_turns, 0});
    host().put_topology(nodes_, edges_, static_cast<std::uint32_t>(chart.loop), chart.note);
  }

  void put_counters() const {
    const hw_counter_t list[] = {{"state", static_cast<double>(follower_->state())},
                                 {"nodes", static_cast<double>(follower_->chart().nodes.size())},
                                 {"loop", static_cast<double>(follower_->chart().loop)},
                                 {"loop_score", follower_->loop_score()},
                                 {"other_score", follower_->other_score()},
                                 {"sweeps", static_cast<double>(follower_->sweeps())},
                                 {"bumps", static_cast<double>(follower_->bumps())},
                                 {"turn_slip", follower_->odometer().turn_slip()}};
    host().put_counters(list);
  }

  void log_changes(const hw_frame_t& frame) {
    if (follower_->sweeps() != sweeps_) {
      sweeps_ = follower_->sweeps();
      static constexpr const char* kNames[] = {"covered", "a room", "a hallway"};
      host().log(HW_LOG_INFO, "frame " + std::to_string(frame.sequence) + ": an opening, free for " +
                                  std::to_string(follower_->last_view().depth_m) +
                                  " m: " + kNames[static_cast<int>(follower_->last_opening())]);
    }
    for (const std::string& news : follower_->news())
      host().log(HW_LOG_INFO, "frame " + std::to_string(frame.sequence) + ": " + news);
    if (follower_->chart().loop == loop_) return;
    loop_ = follower_->chart().loop;
    if (loop_ == Loop::closed) return;
    const std::string what = loop_ == Loop::uncertain
                                 ? ": the wall reads like an earlier part of it, and it may be another one"
                                 : ": the wall reads like no earlier part of it";
    host().log(HW_LOG_INFO, "frame " + std::to_string(frame.sequence) + what);
  }

  Options options_;
  SenseAdapter adapter_;
  std::string missing_;
  std::optional<Follower> follower_;
  Loop loop_ = Loop::open;
  int sweeps_ = 0;
  std::uint32_t changes_ = 0;  // of the chart that was put last
  std::vector<hw_topology_node_t> nodes_;
  std::vector<hw_topology_edge_t> edges_;
  sdk::Drawing drawing_;
};

}  // namespace
}  // namespace hallway::wall_follower

HALLWAY_PLUGINS(hallway::wall_follower::WallFollower);

// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/isolate/isolation.hpp"
#include "host/samples/found_samples.hpp"
#include "host/stage.hpp"

namespace hallway::host {

/// A value for a plugin's parameter, and where it was said.
struct ParameterSetting {
  std::string name;
  std::string value;
  Where where;
  bool may_name_path =
      true;  ///< false: a parameter that names a file or folder is not set; a log must not choose what a plugin reads and writes
};

/// One plugin of a pipeline.
struct StageSpec {
  std::string plugin;  ///< an id or a file, as find_plugin() takes it
  std::vector<ParameterSetting> parameters;
};

/// What is known of a plugin that was made, also when it has ended.
struct StageFacts {
  PluginInfo info{};
  std::filesystem::path file{};
  std::vector<Parameter> parameters{};
  std::vector<std::string>
      values{};  ///< of the parameters in effect, paths as they were given; empty where it never came to that
  std::vector<bool> from_sensor{};  ///< for each, whether the plugin has taken it from a sensor's description
};

/// Plugins in order, each fed with the samples of the kinds it needs: those of the frame, and the planes that plugins before it found in
/// them. One is called for the frames that have any such sample. The last one's outputs are the pipeline's. A pipeline without plugins is called for no
/// frame and gives no outputs. After a PluginFailure only restart(), close() and the destructor may be used.
class Pipeline {
 public:
  /// Finds, makes, sets and activates the plugins. Before any of them is activated, checks that each kind of
  /// sample that one needs is given by a sensor or by a plugin before it (check_kinds()). Throws what find_plugin(), Plugin and IsolatedPlugin throw.
  /// @param isolation  unset: the plugins run in this process. Set: each has a process of its own, and what the kernel
  ///                   does not keep them from is logged once, as a warning
  Pipeline(std::vector<StageSpec> stages, std::vector<std::filesystem::path> folders, Activation activation,
           LogSink log = {}, std::optional<Isolation> isolation = {});

  /// The same, but starts nothing: restart() does.
  static Pipeline unstarted(std::vector<StageSpec> stages, std::vector<std::filesystem::path> folders,
                            Activation activation, LogSink log = {}, std::optional<Isolation> isolation = {});

  /// Whether the last start brought all plugins to activation.
  bool started() const { return started_; }
  const std::vector<StageSpec>& specs() const { return specs_; }
  /// Of the plugins that the last start made, in order: fewer than specs() where it failed.
  const std::vector<StageFacts>& facts() const { return facts_; }

  std::size_t size() const { return stages_.size(); }
  Stage& stage(std::size_t i) { return *stages_[i]; }
  /// Whether each plugin has a process of its own.
  bool isolated() const { return isolation_.has_value(); }

  /// How many frames may be submitted and not yet collected: one where a plugin takes what another one finds.
  std::size_t capacity() const;
  /// Hands one frame to every plugin, or remembers it where a plugin takes what another one finds; see Stage::submit().
  void submit(const hw_frame_t& frame, std::span<const std::byte> bytes = {});
  /// What the last plugin answers to the oldest frame that was submitted and not yet collected; nothing where it was not called.
  /// @return valid until the next call
  const Outputs& collect();
  /// Whether the last plugin was called for the frame that was collected last: it has a sample that the plugin takes.
  bool was_called() const { return was_called_; }
  /// From now on one plugin is called for every frame, whatever it holds: the one whose commands the robot obeys.
  /// @param stage  index in specs()
  void drive_by(std::size_t stage) { driver_ = stage; }
  /// What that plugin commanded at the frame that was collected last; nothing where it put no command.
  const std::optional<DriveCommand>& drive_command() const { return drive_command_; }
  /// Feeds one frame to every plugin, in order. @return the last one's outputs, valid until the next call
  const Outputs& process(const hw_frame_t& frame, std::span<const std::byte> bytes = {});
  /// The frame that was collected last with the planes that plugins found in it; null where no plugin takes what another one finds. Valid until
  /// the next call.
  const hw_frame_t* frame_with_planes() const { return with_planes_; }
  /// The last plugin's map.  @return valid until the next call
  const Outputs& report(bool refine);
  /// Forgets the maps.
  void reset();
  /// Ends all plugins and makes new ones of the same files and parameters. Frames under way are forgotten. Throws as the constructor does; then
  /// there are none.
  void restart();
  /// Ends all plugins in good order. Throws the PluginFailure of the first that does not end so.
  void close();
  /// The sum of what the plugins took in the last collect(), or the last one in report().
  const CallTime& last_call() const { return last_call_; }

 private:
  Pipeline() = default;
  void start();
  void prepare_stages();
  void activate_stages();
  void note_values(std::size_t stage);
  void check_kinds() const;
  bool takes_what_others_find() const;
  bool is_for(std::size_t stage, const hw_frame_t& frame) const;
  const Outputs& collect_in_turn();
  const Outputs& collect(std::size_t stage);
  std::unique_ptr<Stage> make_stage(const std::string& plugin);

  std::vector<StageSpec> specs_;
  std::vector<std::filesystem::path> folders_;
  Activation activation_;
  LogSink log_;
  std::optional<Isolation> isolation_;
  bool warned_ = false;
  bool started_ = false;
  std::vector<StageFacts> facts_;
  std::vector<std::unique_ptr<Stage>> stages_;
  bool in_turn_ = false;                   ///< a plugin is fed only when those before it have answered
  const hw_frame_t* submitted_ = nullptr;  ///< then: the frame that is to be collected
  std::span<const std::byte> submitted_bytes_;
  FoundSamples found_samples_;
  const hw_frame_t* with_planes_ = nullptr;
  std::deque<std::vector<bool>> called_;  ///< else: for each frame under way which plugins it was given to
  bool was_called_ = false;
  std::optional<std::size_t> driver_;  ///< which plugin drives
  std::optional<DriveCommand> drive_command_;
  const Outputs no_outputs_{};
  CallTime last_call_;
};

}  // namespace hallway::host

// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/isolate/isolation.hpp"
#include "host/isolate/plugin_messages.hpp"
#include "host/isolate/plugin_process.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_selection.hpp"
#include "host/stage.hpp"

namespace hallway::host {

/// One instance of a plugin, run in a process of its own: no code of it runs here, not even to find it. What it does wrong ends its process and
/// is a PluginFailure here.
class IsolatedPlugin final : public Stage {
 public:
  /// Finds it as find_plugin() does, in its process, and makes an instance with default parameters. Throws Error{kPluginLoad}, PluginFailure, and
  /// Error{kIo} if there can be no process.
  IsolatedPlugin(const std::string& wanted, std::span<const std::filesystem::path> folders,
                 const Isolation& isolation, const LogSink& log = {});
  ~IsolatedPlugin() override;

  /// What this kernel does not keep the plugin from, one sentence each.
  const std::vector<std::string>& missing() const { return started_.missing; }

  const PluginInfo& info() const override { return started_.info; }
  const std::filesystem::path& file() const override { return file_; }
  std::span<const Parameter> parameters() const override { return started_.parameters; }
  std::string parameter_text(std::size_t index) override { return parameter_state(index).text; }
  bool parameter_is_from_sensor(std::size_t index) override { return parameter_state(index).from_sensor; }
  void set_parameter(std::string_view name, std::string_view value, const Where& where = {}) override;
  void activate(const Activation& facts) override;
  void reset() override;
  std::size_t capacity() const override { return kSlots / 2; }
  using Stage::submit;
  void submit(const hw_frame_t& frame, std::span<const std::byte> bytes) override;
  const Outputs& collect() override;
  const Outputs& report(bool refine) override;
  const CallTime& last_call() const override { return last_call_; }
  void close() override;

 private:
  /// What the answer to a frame is checked against, out of reach of the plugin's process.
  struct Pending {
    std::vector<std::uint32_t> indices;  ///< for each sample that was sent, its index in the frame
    std::vector<hw_sample_t> samples;
    std::vector<Payload> payloads;  ///< for how many elements they have; their arrays are not looked at
    std::vector<const hw_sample_t*> pointers;
    hw_frame_t frame{};

    void remember(const hw_frame_t& sent, std::span<const std::uint32_t> sent_indices);
  };

  struct ParameterState {
    std::string text;
    bool from_sensor;
  };
  struct Setting {
    std::string name, value;
    Where where;
  };

  void start();
  void send_parameter(const Setting& setting);
  void start_with(const std::string& writable_path);
  ParameterState parameter_state(std::size_t index);
  template <typename Write>
  void submit(Request request, Write&& write);
  template <typename Read>
  void await(Request request, Read&& read);
  template <typename Write>
  void call(Request request, Write&& write);
  void read_answer(Request request, AlignedByteReader& reader, const hw_frame_t* frame,
                   std::span<const std::uint32_t> indices);

  std::string wanted_;
  std::vector<std::filesystem::path> folders_;
  Isolation isolation_;
  LogSink log_;
  std::vector<std::string> writable_;  ///< files and folders that parameters let the plugin write
  std::vector<Setting> settings_;      ///< those that were made
  std::optional<PluginProcess> process_;
  StartReply started_;
  std::filesystem::path file_;
  bool active_ = false;
  bool closed_ = false;
  std::vector<std::uint32_t> sent_kinds_;
  SampleSelection selection_;
  FrameWriter writer_;
  std::array<Pending, kSlots / 2> pending_;
  std::size_t submitted_ = 0;
  std::size_t collected_ = 0;
  OutputCollector collector_;
  CallTime last_call_;
};

}  // namespace hallway::host

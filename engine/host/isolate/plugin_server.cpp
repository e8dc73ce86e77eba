// SPDX-License-Identifier: MIT
#include "host/isolate/plugin_server.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <memory>
#include <new>
#include <optional>

#include "base/helper.hpp"
#include "base/sandbox.hpp"
#include "host/isolate/channel.hpp"
#include "host/isolate/plugin_messages.hpp"
#include "host/load/load_step.hpp"
#include "host/output/outputs_bytes.hpp"
#include "host/plugin.hpp"
#include "host/samples/frame_bytes.hpp"

namespace hallway::host {
namespace {

/// Sends what the plugin logs; on any thread.
void send_log(PluginChannel& channel, std::uint32_t level, const std::string& message) {
  std::string packet;
  ByteAppender writer(packet);
  writer.put(LogHead{level});
  writer.put_raw(message);
  ::send(kLogDescriptor, packet.data(), packet.size(), MSG_NOSIGNAL);
  channel.nudge();
}

/// Passes calls on to one plugin.
class Server {
 public:
  explicit Server(PluginChannel& channel) : channel_(channel) {}

  /// Serves one call. @return whether there are more to come
  bool serve() {
    const PluginChannel::Call call = channel_.receive();
    AlignedByteReader reader(call.bytes);
    AlignedByteWriter writer(call.room);
    std::optional<CallTime> time;
    try {
      if (call.request == Request::kProcess) {
        time = process(call.bytes, writer);
      } else {
        time = perform(call.request, reader, writer);
      }
      if (!writer.fits())
        throw failure(call, fmt::format("put more than {} bytes in one call", call.room.size()));
      channel_.answer(Reply::kDone, writer.size(), time->wall_ns, time->cpu_ns);
    } catch (const Error& error) {
      answer_error(call, error);
    } catch (const std::bad_alloc&) {
      answer_error(call, failure(call, "there is no memory left"));
    }
    return call.request != Request::kClose;
  }

 private:
  CallTime perform(Request request, AlignedByteReader& reader, AlignedByteWriter& writer) {
    switch (request) {
      case Request::kStart:
        start(read_start(reader), writer);
        return {};
      case Request::kSetParameter:
        set_parameter(reader);
        return {};
      case Request::kGetParameter:
        get_parameter(reader.get<std::uint64_t>(), writer);
        return {};
      case Request::kActivate:
        plugin_->activate(read_activation(reader));
        return {};
      case Request::kReset:
        plugin_->reset();
        return {};
      case Request::kReport:
        write_outputs(writer, plugin_->report(reader.get<std::uint64_t>() != 0), 0);
        return plugin_->last_call();
      case Request::kDescribe:
        describe(read_start(reader), writer);
        return {};
      case Request::kClose:
        plugin_.reset();  // and with it the library
        library_.reset();
        return {};
      case Request::kProcess:
        break;
    }
    throw Error(ErrorCode::kPluginFault, "an unknown request");
  }

  static std::vector<std::string> confine_as(const StartRequest& request) {
    return confine({.data_bytes = request.data_bytes,
                    .file_bytes = request.file_bytes,
                    .open_files = 256,
                    .scratch = request.scratch,
                    .writable = {request.writable.begin(), request.writable.end()}});
  }

  void describe(const StartRequest& request, AlignedByteWriter& writer) {
    confine_as(request);
    library_ = Library::load(request.wanted);
    write_infos(writer, library_->plugins());
  }

  void start(const StartRequest& request, AlignedByteWriter& writer) {
    StartReply reply;
    reply.missing = confine_as(request);
    const std::vector<std::filesystem::path> folders(request.folders.begin(), request.folders.end());
    plugin_ =
        std::make_unique<Plugin>(find_plugin(request.wanted, folders),
                                 [this](const std::string&, std::uint32_t level, const std::string& message) {
                                   send_log(channel_, level, message);
                                 });
    reply.file = plugin_->file().string();
    reply.info = plugin_->info();
    reply.parameters.assign(plugin_->parameters().begin(), plugin_->parameters().end());
    write_started(writer, reply);
  }

  void get_parameter(std::size_t index, AlignedByteWriter& writer) {
    writer.put_text(plugin_->parameter_text(index));
    writer.put<std::uint64_t>(plugin_->parameter_is_from_sensor(index) ? 1 : 0);
  }

  void set_parameter(AlignedByteReader& reader) {
    const std::string name = reader.get_text();
    const std::string value = reader.get_text();
    plugin_->set_parameter(name, value, read_where(reader));
  }

  CallTime process(std::span<const std::byte> bytes, AlignedByteWriter& writer) {
    const hw_frame_t& frame = frames_.read(bytes);
    write_outputs(writer, plugin_->process(frame), frame.n_samples);
    return plugin_->last_call();
  }

  PluginFailure failure(const PluginChannel::Call& call, const std::string& what) const {
    const std::string name = call_name(call.request, channel_.crash().load_step);
    const std::string message = fmt::format("{}(): {}", name, what);
    Where where;
    if (plugin_) where = {plugin_->file().string(), 0, fmt::format("plugin `{}`", plugin_->info().id)};
    return {
        ErrorCode::kPluginFault, message, where, {.what = Misdeed::kFault, .call = name, .message = message}};
  }

  void answer_error(const PluginChannel::Call& call, const Error& error) {
    AlignedByteWriter writer(call.room);
    write_error(writer, error);
    channel_.answer(Reply::kError, writer.size());
  }

  PluginChannel& channel_;
  FrameReader frames_;
  std::unique_ptr<Plugin> plugin_;
  std::shared_ptr<const Library> library_;  ///< of kDescribe
};

}  // namespace

void serve_plugin(long parent) {
  try {
    if (!end_with_parent(parent)) ::_exit(1);
    PluginChannel channel(kRequestDescriptor, kReplyDescriptor);
    keep_crash_record(channel.crash());
    note_load_steps_in(&channel.crash().load_step);
    ::signal(SIGXFSZ, SIG_IGN);  // a file that is too large is an error of write()
    Server server(channel);
    while (server.serve()) {
    }
    ::_exit(0);
  } catch (...) {  // nobody can be told: the host sees it end
    ::_exit(1);
  }
}

}  // namespace hallway::host

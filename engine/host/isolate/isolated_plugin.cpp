// SPDX-License-Identifier: MIT
#include "host/isolate/isolated_plugin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/text.hpp"
#include "host/isolate/isolated_list.hpp"
#include "host/output/outputs_bytes.hpp"
#include "host/text_parameter.hpp"

namespace hallway::host {
IsolatedPlugin::IsolatedPlugin(const std::string& wanted, std::span<const std::filesystem::path> folders,
                               const Isolation& isolation, const LogSink& log)
    : wanted_(wanted), folders_(folders.begin(), folders.end()), isolation_(isolation), log_(log) {
  start();
}

/// Makes the process, and in it the plugin with default parameters.
void IsolatedPlugin::start() {
  process_.emplace(isolation_, log_, wanted_);
  StartRequest request{.wanted = find_plugin_file(wanted_, folders_, isolation_),
                       .folders = {},
                       .data_bytes = data_limit(isolation_),
                       .file_bytes = isolation_.file_bytes,
                       .scratch = process_->scratch().string(),
                       .writable = writable_};
  for (const std::filesystem::path& folder : folders_) request.folders.push_back(folder.string());
  submit(Request::kStart, [&](AlignedByteWriter& writer) { write_start(writer, request); });
  await(Request::kStart, [&](AlignedByteReader& reader) { started_ = read_started(reader); });
  if (!isolation_.temporary.empty() && process_->scratch().empty()) {
    started_.missing.push_back("no scratch folder can be made in " +
                               printable(isolation_.temporary.string(), kMaxMessageText));
  }
  file_ = started_.file;
  process_->set_plugin(started_.info.id, file_);
  sent_kinds_.clear();
  // Samples of other kinds cannot be sent; see FrameWriter.
  for (const SampleKind* kind : sample_kinds()) {
    if (started_.info.takes(kind->kind)) sent_kinds_.push_back(kind->kind);
  }
}

/// A process can only lose rights, and has lost them before the plugin's code says which paths it writes: so a new one begins with the right.
void IsolatedPlugin::start_with(const std::string& writable_path) {
  if (std::ranges::count(writable_, writable_path) > 0) return;
  writable_.push_back(writable_path);
  process_->end();
  start();
  for (const Setting& setting : settings_) send_parameter(setting);
}

IsolatedPlugin::~IsolatedPlugin() {
  try {
    close();
  } catch (const std::exception&) {  // nobody asked
  }
}

template <typename Write>
void IsolatedPlugin::submit(Request request, Write&& write) {
  AlignedByteWriter writer(process_->room());
  write(writer);
  if (!writer.fits())
    throw Error(ErrorCode::kBadInput, "a request to the plugin is larger than the room for it");
  process_->submit(request, writer.size());
}

template <typename Read>
void IsolatedPlugin::await(Request request, Read&& read) {
  const HostChannel::Answer answer = process_->await(request);
  AlignedByteReader reader(answer.bytes);
  try {
    if (answer.reply == Reply::kError) throw_error(reader, started_.info.id);
    read(reader);
  } catch (const BadBytes& bad) {
    process_->fail_protocol(request, bad.what);
  }
  last_call_ = {answer.wall_ns, answer.cpu_ns};
}

template <typename Write>
void IsolatedPlugin::call(Request request, Write&& write) {
  if (closed_) throw Error(ErrorCode::kInternal, fmt::format("{}() after close()", call_name(request)));
  submit(request, write);
  await(request, [](AlignedByteReader& reader) { reader.expect_end(); });
}

IsolatedPlugin::ParameterState IsolatedPlugin::parameter_state(std::size_t index) {
  submit(Request::kGetParameter, [&](AlignedByteWriter& writer) { writer.put<std::uint64_t>(index); });
  ParameterState state{};
  await(Request::kGetParameter, [&](AlignedByteReader& reader) {
    state.text = printable(reader.get_text(), kMaxMessageText);
    state.from_sensor = reader.get<std::uint64_t>() != 0;
    reader.expect_end();
  });
  return state;
}

void IsolatedPlugin::send_parameter(const Setting& setting) {
  call(Request::kSetParameter, [&](AlignedByteWriter& writer) {
    writer.put_text(setting.name);
    writer.put_text(setting.value);
    write_where(writer, setting.where);
  });
}

void IsolatedPlugin::set_parameter(std::string_view name, std::string_view value, const Where& where) {
  if (active_) throw Error(ErrorCode::kInternal, "set_parameter() after activate()");
  Setting setting{std::string(name), std::string(value), where};
  const auto parameter = std::ranges::find(started_.parameters, name, &Parameter::name);
  if (parameter != started_.parameters.end() && parameter->is_path()) {
    try {
      setting.value = text_parameter_value(*parameter, value, where);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("plugin `{}`: {}", info().id, error.message()), where);
    }
    if (parameter->writable && !setting.value.empty()) start_with(setting.value);
  }
  send_parameter(setting);
  settings_.push_back(std::move(setting));
}

void IsolatedPlugin::activate(const Activation& facts) {
  call(Request::kActivate, [&](AlignedByteWriter& writer) { write_activation(writer, facts); });
  active_ = true;
}

void IsolatedPlugin::reset() {
  call(Request::kReset, [](AlignedByteWriter&) {});
}

void IsolatedPlugin::Pending::remember(const hw_frame_t& sent, std::span<const std::uint32_t> sent_indices) {
  indices.assign(sent_indices.begin(), sent_indices.end());
  samples.assign(sent.n_samples, {});
  if (payloads.size() < sent.n_samples) payloads.resize(sent.n_samples);
  pointers.clear();
  for (std::uint32_t i = 0; i < sent.n_samples; ++i) {
    payloads[i].assign(*find_sample_kind(sent.samples[i]->kind), sent.samples[i]->payload);
    samples[i].kind = sent.samples[i]->kind;
    samples[i].payload = payloads[i].get();
    pointers.push_back(&samples[i]);
  }
  frame = {};
  frame.n_samples = sent.n_samples;
  frame.t_ns = sent.t_ns;  // no pose is of a later time
  frame.samples = pointers.data();
}

void IsolatedPlugin::submit(const hw_frame_t& frame, std::span<const std::byte> bytes) {
  if (!active_) throw Error(ErrorCode::kInternal, "process() before activate()");
  if (submitted_ - collected_ >= capacity()) throw Error(ErrorCode::kInternal, "too many frames under way");
  const hw_frame_t& selected = selection_.select(frame, sent_kinds_);
  const bool is_whole = !bytes.empty() && selected.n_samples == frame.n_samples;
  const std::size_t size = is_whole ? bytes.size() : writer_.measure(selected);
  const std::span<std::byte> room = process_->room();
  if (size > room.size()) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("a frame of {} bytes; an isolated plugin takes {} at most", size, room.size()));
  }
  if (is_whole) {
    // std::ranges::copy would be a loop over single bytes (libstdc++ 12).
    std::memcpy(room.data(), bytes.data(), size);
  } else {
    writer_.write(room.first(size));
  }
  pending_[submitted_ % pending_.size()].remember(selected, selection_.indices());
  ++submitted_;
  process_->submit(Request::kProcess, size);
}

const Outputs& IsolatedPlugin::collect() {
  if (submitted_ == collected_) throw Error(ErrorCode::kInternal, "collect() without a frame");
  const Pending& pending = pending_[collected_++ % pending_.size()];
  await(Request::kProcess, [&](AlignedByteReader& reader) {
    read_answer(Request::kProcess, reader, &pending.frame, pending.indices);
  });
  return collector_.outputs();
}

const Outputs& IsolatedPlugin::report(bool refine) {
  if (!active_) throw Error(ErrorCode::kInternal, "report() before activate()");
  if (submitted_ != collected_) throw Error(ErrorCode::kInternal, "report() with frames under way");
  submit(Request::kReport, [&](AlignedByteWriter& writer) { writer.put<std::uint64_t>(refine ? 1 : 0); });
  await(Request::kReport,
        [&](AlignedByteReader& reader) { read_answer(Request::kReport, reader, nullptr, {}); });
  return collector_.outputs();
}

/// The other side has checked its outputs with the same code, so one that is wrong here was not written by it.
void IsolatedPlugin::read_answer(Request request, AlignedByteReader& reader, const hw_frame_t* frame,
                                 std::span<const std::uint32_t> indices) {
  collector_.begin(frame, indices);
  read_outputs(reader, collector_);
  reader.expect_end();
  const std::string problem = collector_.finish();
  if (!problem.empty()) process_->fail_protocol(request, problem);
}

void IsolatedPlugin::close() {
  if (std::exchange(closed_, true) || !process_ || !process_->runs()) return;
  try {
    while (process_->under_way() != 0) process_->await(Request::kProcess);
    submit(Request::kClose, [](AlignedByteWriter&) {});
    await(Request::kClose, [](AlignedByteReader& reader) { reader.expect_end(); });
  } catch (...) {
    process_->end();
    throw;
  }
  process_->end();
}

}  // namespace hallway::host

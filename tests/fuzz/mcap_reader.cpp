// SPDX-License-Identifier: MIT
// The bytes as an MCAP log. Whatever they are, reading ends, with an Error, with damage or at the end; what was read can be
// written as a whole log that gives the same; what a replay takes of it is a sequence of sound frames; and
// a topology in it is a sound one.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "host/samples/sample_kind.hpp"
#include "log/mcap_copy.hpp"
#include "log/run_log.hpp"
#include "run/sources/recorded_run.hpp"

using hallway::Error;
namespace log_ = hallway::log;
namespace run = hallway::run;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void check_copy(const log_::ByteInput& input) {
  log_::StringOutput out;
  const log_::McapCopy copy = log_::copy_mcap(input, out);
  const log_::MemoryInput again(out.text());
  log_::McapReader reader(again);
  std::uint64_t messages = 0;
  while (const log_::McapItem* item = reader.next())
    messages += std::holds_alternative<log_::McapMessage>(*item) ? 1u : 0u;
  if (reader.damage() || messages != copy.messages) std::abort();
  if (copy.damage && (copy.damage->offset > input.size() || copy.damage->cause.empty())) std::abort();
}

void check_frames(run::RecordedRun&& recorded) {
  run::RecordedSource source(std::move(recorded), 0);
  run::SourceFrame frame;
  std::int64_t t_ns = 0;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    if (frame.t_ns() < t_ns || frame.samples().sequence != i) std::abort();
    t_ns = frame.t_ns();
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      if (!hallway::host::find_not_finite(frame.sample(k)).empty()) std::abort();
    }
    if (source.has_identities() && frame.identities.size() != frame.n_elements()) std::abort();
  }
}

/// What is read as a topology is one that is written, and read back, the same.
void check_answers(const log_::ByteInput& input) {
  log_::McapReader reader(input);
  while (const log_::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log_::McapMessage>(item);
    if (message == nullptr) continue;
    try {
      const auto answer = log_::parse_answer_message(reader.channels().at(message->channel_id), *message);
      const auto* read = std::get_if<log_::TopologyMessage>(&answer);
      if (read == nullptr) continue;
      if (log_::parse_topology(log_::print_topology(read->topology), "again") != read->topology) std::abort();
      if (log_::print_graphml(read->topology).empty()) std::abort();
    } catch (const Error& error) {
      if (error.code() != hallway::ErrorCode::kBadInput) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const log_::MemoryInput input(std::string_view(reinterpret_cast<const char*>(data), size));
  try {
    check_copy(input);
  } catch (const Error&) {  // no MCAP file, or a message that is larger than we write
  }
  try {
    check_answers(input);
  } catch (const Error&) {  // no MCAP file
  }
  try {
    check_frames(run::read_recorded_run(input));
  } catch (const Error&) {
    return 0;
  }
  return 0;
}

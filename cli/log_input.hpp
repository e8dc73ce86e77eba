// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "run/feed/run.hpp"
#include "run/sources/source.hpp"

namespace hallway::cli {

/// Which log to read, as the command line names it.
struct LogChoice {
  std::string log;                   ///< a CSV file of observations, an MCAP file, or a run folder
  std::string true_poses{};          ///< CSV; empty: what stands beside the log, or in it
  std::string true_landmarks{};      ///< CSV, as above
  std::optional<double> period_s{};  ///< from frame to frame, where the log itself does not say
  std::uint32_t steps = 0;           ///< how many frames; 0 for all
  std::string form{};                ///< "csv" or "mcap"; empty: .mcap files are MCAP, others CSV
};

/// A recorded log of either form, with what is known of it.
struct OpenedLog {
  std::unique_ptr<run::Source> source;
  std::optional<nlohmann::ordered_json> manifest;  ///< of the run that wrote it
  std::string name;
  std::int64_t period_ns = 0;
  std::vector<run::Attachment> inputs;  ///< the files that were read
  std::vector<std::string> warnings;    ///< such as damage; already printed
  /// What the frames that were read so far lacked; empty where nobody counts that.
  std::function<std::vector<std::string>()> missing;
};

/// Opens a log. A CSV file that stands in a run folder brings the run's facts and truth with it; an MCAP log holds them.
/// Damage is a warning: what stands before it is there. Throws Error{kBadInput, kIo}, and Error{kUsage} where options and
/// the form of the log do not fit.
OpenedLog open_log(const LogChoice& choice);

/// Throws Error{kUsage} where options are given that an MCAP log has no use for.
void check_no_csv_options(const LogChoice& choice);

/// A name from a log, which may come from anywhere, made fit for that of a file or folder: letters, digits, `_` and `-`.
std::string plain_name(std::string name);

/// The MCAP file that a path names: itself, or the log of a run folder.
std::filesystem::path mcap_file(const std::string& path);

/// Does something with a file; an Error that names none gets it.
template <typename Work>
auto in_file(const std::filesystem::path& file, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (!error.where().file.empty()) throw;
    throw Error(error.code(), error.message(), {.file = printable(file.string())});
  }
}

}  // namespace hallway::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "batch/plan.hpp"

namespace hallway::batch {

/// What became of one run.
struct Result {
  std::string name{};
  std::vector<Label> labels{};
  int status = 0;                    ///< exit status; 128 + signal where it was ended by one
  std::string problem{};             ///< the last line of its standard error, where it failed; printable
  nlohmann::ordered_json metrics{};  ///< of its metrics.json; null where there is none
  nlohmann::ordered_json verdict{};  ///< of its run.json: what a plugin did wrong; else null
  double wall_s = 0.0;
  bool reused = false;  ///< taken over from an earlier batch with the same input

  bool good() const { return status == 0; }
};

/// What is made of all results, in the folder of the batch.
inline constexpr const char* kTableFile = "results.csv";
inline constexpr const char* kDocumentFile = "results.json";

/// The environment variable that tells a run the number of the process that started it, with which it has to end: a batch that is killed shall not
/// leave runs behind that write into the folders of the next one.
inline constexpr const char* kStartedBy = "HALLWAY_STARTED_BY";

/// The file of a picture in the folder `cells`.
std::string picture_name(const Cell& cell, const PictureRequest& picture);

/// How a batch is run, and where.
struct RunnerSetup {
  std::filesystem::path program{};  ///< `hallway`
  std::filesystem::path folder{};   ///< of the batch: a folder for each run is in its `cells`
  unsigned jobs = 1;                ///< how many runs at a time
  bool resume = false;              ///< keep results whose program, arguments and files are the same as now
  bool replace =
      false;  ///< remove all runs and tables of an earlier batch first, also those that are not in the plan
  std::vector<std::string> environment{};  ///< "NAME=value"s that each process is given beside ours
  std::function<void(std::size_t done)> progress{};
  std::function<bool()> stop{};  ///< true: ends what runs and returns what there is
};

/// Runs the cells of a plan, each as a process of its own, and draws its pictures. One that fails stops no other. The result of each stands in
/// `cells/NAME.json` when it is done, so that a batch that was ended can be resumed. Results are in the order of the cells; those
/// that were not run are missing.
/// Throws Error{kIo} where the folder cannot be written, or another batch is at work in it.
std::vector<Result> run_cells(const Plan& plan, const RunnerSetup& setup);

}  // namespace hallway::batch

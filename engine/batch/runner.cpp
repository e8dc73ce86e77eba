// SPDX-License-Identifier: MIT
#include "batch/runner.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <set>
#include <thread>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/spawn.hpp"
#include "base/text.hpp"
#include "batch/content.hpp"
#include "batch/table.hpp"

namespace hallway::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

/// Of what runs say.
constexpr std::size_t kMaxLogBytes = std::size_t{64} << 20;

/// One batch at a time works in a folder.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) {
    const fs::path file = folder / ".lock";
    file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0)
      throw Error(ErrorCode::kIo, std::string("cannot be opened: ") + std::strerror(errno),
                  {file.string(), 0, {}});
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(file_);
    throw Error(ErrorCode::kIo, "another batch is at work in this folder", {folder.string(), 0, {}});
  }
  ~FolderLock() { ::close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

Json to_json(const Result& result, const std::string& hash) {
  return {{"schema", "hallway.cell/1"}, {"hash", hash},
          {"name", result.name},        {"labels", labels_json(result)},
          {"status", result.status},    {"problem", result.problem},
          {"wall_s", result.wall_s},    {"metrics", result.metrics},
          {"verdict", result.verdict}};
}

/// The end of a process that ended without a good reason may lie in its last line.
std::string last_line(const fs::path& file) {
  std::string text;
  try {
    text = read_file(file, kMaxLogBytes);
  } catch (const Error&) {
    return "what it said cannot be read";
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  constexpr std::string_view kName = "hallway: ";
  std::string_view line = std::string_view(text).substr(text.rfind('\n') + 1);
  if (line.starts_with(kName)) line.remove_prefix(kName.size());
  return printable(line, 500);
}

/// Whether a name is that of the folder in which a run works that has not come to its end.
bool is_working_folder(const std::string& name, const std::string& cell) {
  constexpr std::string_view kPart = ".part-";
  if (!name.starts_with(cell + std::string(kPart))) return false;
  const std::string number = name.substr(cell.size() + kPart.size());
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

/// A cell that is under way: its run, then its pictures, one process after the other.
class Job {
 public:
  /// @param hash  of what it is given
  Job(const Cell& cell, std::size_t index, std::string hash, const Plan& plan, const RunnerSetup& setup)
      : cell_(cell),
        index_(index),
        hash_(std::move(hash)),
        plan_(plan),
        setup_(setup),
        folder_(setup.folder / "cells" / cell.name),
        begin_(Clock::now()) {
    remove_old();
    std::vector<std::string> arguments = cell.arguments;
    arguments.insert(arguments.end(), {"--out", folder_.string(), "--force", "--quiet"});
    start(arguments);
  }

  std::size_t index() const { return index_; }
  const std::string& hash() const { return hash_; }

  /// Whether it has ended, with all that follows it.
  bool step() {
    if (!process_->ended_by(Clock::now())) return false;
    const ProcessEnd end = process_->kill();
    const int status = end.signalled ? 128 + end.number : end.number;
    if (next_picture_ == 0) status_ = status;
    if (next_picture_ > 0 && status != 0 && status_ == 0) status_ = status;
    std::error_code none;
    const bool drawn = fs::exists(folder_ / "run.json", none) && next_picture_ < plan_.pictures.size();
    if (!drawn) return true;
    const PictureRequest& picture = plan_.pictures[next_picture_++];
    std::vector<std::string> arguments{"render", folder_.string()};
    arguments.insert(arguments.end(), picture.arguments.begin(), picture.arguments.end());
    arguments.insert(arguments.end(), {"--out", picture_file(picture).string()});
    start(arguments);
    return false;
  }

  Result result() const {
    Result result{.name = cell_.name, .labels = cell_.labels, .status = status_};
    if (status_ != 0) result.problem = last_line(log_file());
    if (Json metrics = json_file(folder_ / "metrics.json"); !metrics.is_null())
      result.metrics = std::move(metrics);
    if (const Json run = json_file(folder_ / "run.json"); run.contains("verdict"))
      result.verdict = run["verdict"];
    result.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    return result;
  }

 private:
  fs::path picture_file(const PictureRequest& picture) const {
    return folder_.parent_path() / picture_name(cell_, picture);
  }

  /// What an earlier batch made, which is not to be taken for what this one does not come to make.
  void remove_old() const {
    std::error_code none;
    if (fs::exists(folder_ / "run.json", none)) fs::remove_all(folder_, none);
    for (const PictureRequest& picture : plan_.pictures) fs::remove(picture_file(picture), none);
  }

  fs::path log_file() const {
    fs::path file = folder_;
    return file += ".log";
  }

  void start(const std::vector<std::string>& arguments) {
    const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (process_ ? O_APPEND : O_TRUNC);
    int log = ::open(log_file().c_str(), flags, 0666);
    if (log < 0 || !move_above_standard(log))
      throw Error(ErrorCode::kIo, std::string("cannot be written: ") + std::strerror(errno),
                  {log_file().string(), 0, {}});
    ProcessSetup setup;
    setup.arguments = arguments;
    setup.descriptors = {-1, -1, log};
    setup.environment = setup_.environment;
    setup.environment.push_back(std::string(kStartedBy) + "=" + std::to_string(::getpid()));
    try {
      process_ = std::make_unique<ProcessGroup>(setup_.program, setup);
    } catch (...) {
      ::close(log);
      throw;
    }
    ::close(log);
  }

  const Cell& cell_;
  std::size_t index_;
  std::string hash_;
  const Plan& plan_;
  const RunnerSetup& setup_;
  fs::path folder_;
  Clock::time_point begin_;
  std::unique_ptr<ProcessGroup> process_;
  std::size_t next_picture_ = 0;
  int status_ = 0;
};

/// Cells, and what is known of them.
class Runner {
 public:
  Runner(const Plan& plan, const RunnerSetup& setup)
      : plan_(plan),
        setup_(setup),
        results_(plan.cells.size()),
        program_hash_(content_hash(read_file(setup.program))) {}

  std::vector<Result> run() {
    make_folder(setup_.folder / "cells");
    const FolderLock lock(setup_.folder);
    remove_unfinished();
    if (setup_.replace) remove_earlier();
    if (setup_.resume) take_over_results();
    while (!stopped() && (start_jobs() || !jobs_.empty())) {
      if (!step_jobs()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    jobs_.clear();  // what still runs is ended
    std::vector<Result> done;
    for (auto& result : results_) {
      if (result) done.push_back(std::move(*result));
    }
    return done;
  }

 private:
  bool stopped() const { return setup_.stop && setup_.stop(); }

  fs::path result_file(const Cell& cell) const { return setup_.folder / "cells" / (cell.name + ".json"); }

  /// What runs that were killed, with a batch or without, had begun to write.
  void remove_unfinished() const {
    std::set<std::string, std::less<>> cells;
    std::set<std::string, std::less<>> files;
    for (const Cell& cell : plan_.cells) {
      cells.insert(cell.name);
      files.insert(result_file(cell).filename().string());
      for (const PictureRequest& picture : plan_.pictures) files.insert(picture_name(cell, picture));
    }
    std::error_code none;
    std::vector<fs::path> left;
    for (const auto& entry : fs::directory_iterator(setup_.folder, none)) {
      const std::string name = entry.path().filename().string();
      const std::string_view table = unfinished_file_of(name);
      if (table == kTableFile || table == kDocumentFile) left.push_back(entry.path());
    }
    for (const auto& entry : fs::directory_iterator(setup_.folder / "cells", none)) {
      const std::string name = entry.path().filename().string();
      const std::string cell = name.substr(0, name.rfind(".part-"));
      const bool folder = cells.contains(cell) && is_working_folder(name, cell);
      if (folder || files.contains(unfinished_file_of(name))) left.push_back(entry.path());
    }
    for (const fs::path& path : left) fs::remove_all(path, none);
  }

  void remove_earlier() const {
    std::error_code none;
    if (!fs::exists(setup_.folder / kDocumentFile, none)) return;
    for (const char* file : {kDocumentFile, kTableFile}) fs::remove(setup_.folder / file, none);
    for (const auto& entry : fs::directory_iterator(setup_.folder / "cells", none))
      fs::remove_all(entry.path(), none);
  }

  void take_over_results() {
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      const Cell& cell = plan_.cells[i];
      const Json json = json_file(result_file(cell));
      if (json.is_null() || json.value("hash", "") != cell_hash(cell, plan_, program_hash_)) continue;
      // What is not there, or did not come to say what it read, cannot be known to be the same.
      if (!reads_the_same(cell, json_file(setup_.folder / "cells" / cell.name / "run.json"))) continue;
      // What was interrupted was not its own fault.
      const int status = json.value("status", -1);
      if (status < 0 || status >= 128) continue;
      results_[i] = Result{.name = cell.name,
                           .labels = cell.labels,
                           .status = status,
                           .problem = json.value("problem", ""),
                           .metrics = json.value("metrics", Json()),
                           .verdict = json.value("verdict", Json()),
                           .wall_s = json.value("wall_s", 0.0),
                           .reused = true};
      count();
    }
  }

  /// Fills the free places. @return whether one was filled
  bool start_jobs() {
    bool any = false;
    while (jobs_.size() < std::max(setup_.jobs, 1u)) {
      while (next_ < plan_.cells.size() && results_[next_]) ++next_;
      if (next_ == plan_.cells.size()) return any;
      any = true;
      const std::size_t index = next_++;
      // As it is before the run: what is changed while that reads it shall not be taken for what it has read.
      const std::string hash = cell_hash(plan_.cells[index], plan_, program_hash_);
      try {
        jobs_.push_back(std::make_unique<Job>(plan_.cells[index], index, hash, plan_, setup_));
      } catch (const Error& error) {
        keep_failure(index, hash, error);
      }
    }
    return any;
  }

  /// Looks after those that run. @return whether one has ended
  bool step_jobs() {
    const std::size_t before = jobs_.size();
    std::erase_if(jobs_, [&](const std::unique_ptr<Job>& job) {
      try {
        if (!job->step()) return false;
        keep(job->index(), job->hash(), job->result());
      } catch (const Error& error) {
        keep_failure(job->index(), job->hash(), error);
      }
      return true;
    });
    return jobs_.size() != before;
  }

  void keep_failure(std::size_t index, const std::string& hash, const Error& error) {
    const Cell& cell = plan_.cells[index];
    keep(index, hash,
         {.name = cell.name,
          .labels = cell.labels,
          .status = exit_status(error.code()),
          .problem = error.what()});
  }

  /// A result that cannot be written is one all the same, and is run again by the next batch.
  void keep(std::size_t index, const std::string& hash, Result result) {
    const Cell& cell = plan_.cells[index];
    try {
      write_file_atomically(result_file(cell), to_json(result, hash).dump(1) + "\n");
    } catch (const Error& error) {
      if (result.status == 0) result.status = exit_status(error.code());
      if (result.problem.empty()) result.problem = error.what();
    }
    results_[index] = std::move(result);
    count();
  }

  void count() {
    ++done_;
    if (setup_.progress) setup_.progress(done_);
  }

  const Plan& plan_;
  const RunnerSetup& setup_;
  std::vector<std::optional<Result>> results_;
  std::string program_hash_;
  std::vector<std::unique_ptr<Job>> jobs_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
};

}  // namespace

std::string picture_name(const Cell& cell, const PictureRequest& picture) {
  return cell.name + "." + picture.name + ".png";
}

std::vector<Result> run_cells(const Plan& plan, const RunnerSetup& setup) {
  return Runner(plan, setup).run();
}

}  // namespace hallway::batch

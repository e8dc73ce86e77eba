// SPDX-License-Identifier: MIT
#include "console.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::cli {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

volatile std::sig_atomic_t wake_descriptor = -1;

void on_signal(int number) {
  caught_signal = number;
  if (wake_descriptor < 0) return;
  const int error = errno;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(static_cast<int>(wake_descriptor), &one, sizeof one);
  errno = error;
}

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

Json failure_json(const std::exception& failure, int status) {
  Json error;
  if (const auto* known = dynamic_cast<const Error*>(&failure)) {
    error["kind"] = error_code_name(known->code());
    error["message"] = known->message();
    if (!known->where().file.empty()) error["file"] = known->where().file;
    if (known->where().line > 0) error["line"] = known->where().line;
    if (!known->where().element.empty()) error["element"] = known->where().element;
  } else {
    error["kind"] = error_code_name(ErrorCode::kInternal);
    error["message"] = failure.what();
  }
  return {{"schema", "hallway.error/1"}, {"status", status}, {"error", error}};
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

int report_failure(const std::exception& failure, bool json) {
  const auto* known = dynamic_cast<const Error*>(&failure);
  int status = exit_status(known ? known->code() : ErrorCode::kInternal);
  if (known && known->code() == ErrorCode::kInterrupted && interrupted()) status = interrupt_status();
  const std::string text = known ? failure.what() : fmt::format("internal error: {}", failure.what());
  if (json) {
    // What cannot be printed has still its exit status.
    const std::string document =
        failure_json(failure, status).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    std::fwrite(document.data(), 1, document.size(), stdout);
    std::fflush(stdout);
  } else {
    fmt::print(stderr, "hallway: {}\n", text);
  }
  return status;
}

void print_result(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if ((!written || std::fflush(stdout) != 0) && errno != EPIPE) {
    throw Error(ErrorCode::kIo, "cannot write: " + std::generic_category().message(errno),
                {.file = "standard output"});
  }
}

void print_json(const Json& document) {
  print_result(document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void OutputOptions::print(const Json& document, const std::string& text) const {
  if (json) {
    print_json(document);
  } else if (!quiet) {
    print_result(text);
  }
}

void print_notice(const std::string& text) {
  fmt::print(stderr, "hallway: {}\n", text);
}

void print_warning(const std::string& text) {
  fmt::print(stderr, "hallway: warning: {}\n", text);
}

void print_warning(std::vector<std::string>& warnings, std::string text) {
  print_warning(text);
  warnings.push_back(std::move(text));
}

std::string path_text(const fs::path& path) {
  constexpr std::size_t kLongest = 4096;
  return printable(path.string(), kLongest);
}

std::vector<std::string> path_texts(const std::vector<fs::path>& paths) {
  std::vector<std::string> texts;
  for (const fs::path& path : paths) texts.push_back(path_text(path));
  return texts;
}

void prepare_standard_streams() {
  for (int fd = 0; fd <= 2; ++fd) {
    // open() takes the lowest free number, which is this one.
    if (::fcntl(fd, F_GETFD) == -1 && ::open("/dev/null", O_RDWR) == -1) return;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void catch_interrupts(int wake) {
  wake_descriptor = wake;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
  return caught_signal != 0;
}

int interrupt_status() {
  return 128 + static_cast<int>(caught_signal);
}

Progress::Progress(std::string what, std::uint64_t total, bool quiet)
    : what_(std::move(what)),
      total_(std::max<std::uint64_t>(total, 1)),
      shown_(!quiet && ::isatty(2) == 1),
      start_ns_(now_ns()) {}

Progress::~Progress() {
  if (shown_ && drawn_ns_ != 0) fmt::print(stderr, "\r\x1b[K");
}

void Progress::update(std::uint64_t done) {
  if (!shown_) return;
  const std::int64_t now = now_ns();
  constexpr std::int64_t kBetweenDraws_ns = 100'000'000;
  if (now - drawn_ns_ >= kBetweenDraws_ns) draw(done, now);
}

void Progress::draw(std::uint64_t done, std::int64_t now) {
  drawn_ns_ = now;
  const double seconds = std::max(1e-3, static_cast<double>(now - start_ns_) * 1e-9);
  const double rate = static_cast<double>(done) / seconds;
  const double left = rate > 0.0 ? static_cast<double>(total_ - std::min(done, total_)) / rate : 0.0;
  constexpr std::uint64_t kBarWidth = 30;
  const auto filled = static_cast<std::size_t>(kBarWidth * std::min(done, total_) / total_);
  fmt::print(stderr, "\r\x1b[K{} [{}{}] {}/{}  {:.0f}/s  {} left", what_, std::string(filled, '#'),
             std::string(kBarWidth - filled, '.'), done, total_, rate, clock_text(left));
  std::fflush(stderr);
}

}  // namespace hallway::cli

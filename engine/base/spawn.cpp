// SPDX-License-Identifier: MIT
#include "base/spawn.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <thread>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway {
namespace {

using Clock = std::chrono::steady_clock;

/// Attributes of posix_spawn, freed with the object.
class Attributes {
 public:
  explicit Attributes(bool own_session) {
    ::posix_spawnattr_init(&value_);
    sigset_t signals;
    sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&value_, &signals);
    sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&value_, &signals);
    ::posix_spawnattr_setpgroup(&value_, 0);
    // A new session is a new group.
    const int group = own_session ? POSIX_SPAWN_SETSID : POSIX_SPAWN_SETPGROUP;
    ::posix_spawnattr_setflags(&value_,
                               static_cast<short>(group | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK));
  }
  ~Attributes() { ::posix_spawnattr_destroy(&value_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &value_; }

 private:
  posix_spawnattr_t value_{};
};

/// What happens to descriptors, freed with the object. Those of ours stand above those they become: they may be one another's number, so
/// the caller's are first moved out of the way.
class FileActions {
 public:
  explicit FileActions(const std::vector<int>& descriptors) {
    ::posix_spawn_file_actions_init(&value_);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      const int target = static_cast<int>(i);
      if (descriptors[i] < 0) {
        ::posix_spawn_file_actions_addopen(&value_, target, "/dev/null", O_RDWR, 0);
      } else {
        ::posix_spawn_file_actions_adddup2(&value_, descriptors[i], target);
      }
    }
    ::posix_spawn_file_actions_addclosefrom_np(&value_, static_cast<int>(descriptors.size()));
  }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&value_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &value_; }

 private:
  posix_spawn_file_actions_t value_{};
};

/// Copies above every number that a started program gets, closed with the object.
class Raised {
 public:
  explicit Raised(const std::vector<int>& descriptors) {
    for (const int fd : descriptors) {
      copies_.push_back(fd < 0 ? -1 : ::fcntl(fd, F_DUPFD_CLOEXEC, static_cast<int>(descriptors.size())));
      if (fd < 0 || copies_.back() >= 0) continue;
      const int problem = errno;
      close_all();
      throw Error(ErrorCode::kIo, "cannot copy a descriptor: " + std::generic_category().message(problem));
    }
  }
  ~Raised() { close_all(); }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;
  const std::vector<int>& copies() const { return copies_; }

 private:
  void close_all() {
    for (const int fd : copies_) {
      if (fd >= 0) ::close(fd);
    }
  }

  std::vector<int> copies_;
};

bool names_same(const std::string& a, const char* b) {
  const std::size_t equals = a.find('=');
  return a.compare(0, equals + 1, std::string(b).substr(0, equals + 1)) == 0;
}

/// Our environment with `changes`.
std::vector<std::string> environment_with(const std::vector<std::string>& changes) {
  std::vector<std::string> all = changes;
  for (char** entry = ::environ; entry != nullptr && *entry != nullptr; ++entry) {
    const bool changed =
        std::ranges::any_of(changes, [&](const std::string& change) { return names_same(change, *entry); });
    if (!changed) all.emplace_back(*entry);
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

bool move_above_standard(int& fd) {
  if (fd > 2) return true;
  const int moved = ::fcntl(fd, F_DUPFD_CLOEXEC, 3);
  if (fd >= 0) ::close(fd);
  fd = moved;
  return moved >= 0;
}

ProcessGroup::ProcessGroup(const std::filesystem::path& program, const ProcessSetup& setup) {
  const Raised raised(setup.descriptors);
  const FileActions actions(raised.copies());
  const Attributes attributes(setup.own_session);
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), setup.arguments.begin(), setup.arguments.end());
  std::vector<std::string> environment = environment_with(setup.environment);
  const int problem = ::posix_spawn(&pid_, program.c_str(), actions.get(), attributes.get(),
                                    pointers(words).data(), pointers(environment).data());
  if (problem != 0) {
    throw Error(ErrorCode::kIo, "cannot be started: " + std::generic_category().message(problem),
                {.file = printable(program.string(), 4096)});
  }
}

ProcessGroup::~ProcessGroup() {
  kill();
}

bool ProcessGroup::ended_by(Clock::time_point deadline) const {
  using namespace std::chrono_literals;
  if (reaped_) return true;
  for (auto nap = 100us;; nap = std::min<std::chrono::microseconds>(2 * nap, 10ms)) {
    siginfo_t info{};
    // WNOWAIT: it stays a zombie, so that its number still names its group when what is left of that is killed.
    const int problem = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (problem != 0 && errno != EINTR) return true;
    if (problem == 0 && info.si_pid == pid_) return true;
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(nap);
  }
}

void ProcessGroup::signal(int number) const {
  if (!reaped_) ::kill(-pid_, number);
}

ProcessEnd ProcessGroup::kill() {
  if (reaped_) return end_;
  ::kill(-pid_, SIGKILL);
  int status = 0;
  pid_t got = -1;
  do {
    got = ::waitpid(pid_, &status, 0);
  } while (got < 0 && errno == EINTR);
  reaped_ = true;
  // A program that ignores SIGCHLD has its children reaped by the kernel, and nobody knows how they ended.
  if (got == pid_) {
    end_.signalled = WIFSIGNALED(status);
    end_.number = end_.signalled ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  return end_;
}

}  // namespace hallway

// SPDX-License-Identifier: MIT
#include "ros1/master.hpp"

#include <netdb.h>
#include <poll.h>
#include <ros/common.h>
#include <sys/socket.h>
#include <unistd.h>
#include <hallway/driver.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "base/text.hpp"
#include "ros1/console.hpp"

namespace hallway::ros1 {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kWatchPeriod{1000};
constexpr std::size_t kMaxAnswerBytes = 64 * 1024;

/// Why a master did not answer.
struct NoAnswer {
  std::string cause{};
};

class Socket {
 public:
  explicit Socket(const addrinfo& to)
      : file_(::socket(to.ai_family, to.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, to.ai_protocol)) {}
  ~Socket() {
    if (file_ >= 0) ::close(file_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int file() const { return file_; }

 private:
  int file_;
};

void wait_for(int file, short events, Clock::time_point until) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now()).count();
    if (left <= 0) throw NoAnswer{"no answer in time"};
    pollfd entry{file, events, 0};
    const int found = ::poll(&entry, 1, static_cast<int>(std::min<std::int64_t>(left, 60'000)));
    if (found > 0) return;
    if (found < 0 && errno != EINTR) throw NoAnswer{std::strerror(errno)};
  }
}

void connect_to(const Socket& socket, const addrinfo& to, Clock::time_point until) {
  if (socket.file() < 0) throw NoAnswer{std::strerror(errno)};
  if (::connect(socket.file(), to.ai_addr, to.ai_addrlen) == 0) return;
  if (errno != EINPROGRESS) throw NoAnswer{std::strerror(errno)};
  wait_for(socket.file(), POLLOUT, until);
  int failure = 0;
  socklen_t size = sizeof failure;
  ::getsockopt(socket.file(), SOL_SOCKET, SO_ERROR, &failure, &size);
  if (failure != 0) throw NoAnswer{std::strerror(failure)};
}

void send_all(int file, const std::string& text, Clock::time_point until) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t n = ::send(file, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN) {
      wait_for(file, POLLOUT, until);
    } else if (errno != EINTR) {
      throw NoAnswer{std::strerror(errno)};
    }
  }
}

std::string receive_until(int file, const std::string& mark, Clock::time_point until) {
  std::string text;
  while (text.find(mark) == std::string::npos) {
    char bytes[4096];
    const ssize_t n = ::recv(file, bytes, sizeof bytes, 0);
    if (n > 0) {
      text.append(bytes, static_cast<std::size_t>(n));
      if (text.size() > kMaxAnswerBytes) throw NoAnswer{"what answers there is no ROS master"};
    } else if (n == 0) {
      throw NoAnswer{"what answers there is no ROS master"};
    } else if (errno == EAGAIN) {
      wait_for(file, POLLIN, until);
    } else if (errno != EINTR) {
      throw NoAnswer{std::strerror(errno)};
    }
  }
  return text;
}

/// A call of XML-RPC as the master's interface has it: getPid(caller) gives [code, text, pid].
std::string request_of(const MasterAddress& address) {
  const std::string body =
      "<?xml "
      "version=\"1.0\"?><methodCall><methodName>getPid</methodName><params><param><value><string>/hallway"
      "</string></value></param></params></methodCall>";
  return "POST /RPC2 HTTP/1.1\r\nHost: " + address.host + ":" + address.port +
         "\r\nContent-Type: text/xml\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\n\r\n" + body;
}

/// The last whole number of the answer.
std::string pid_of(const std::string& answer) {
  const std::size_t end = answer.rfind("</int>");
  const std::size_t begin = end == std::string::npos ? end : answer.rfind("<int>", end);
  if (begin == std::string::npos) throw NoAnswer{"what answers there is no ROS master"};
  return answer.substr(begin + 5, end - begin - 5);
}

std::string ask(const MasterAddress& address, const addrinfo& to, Clock::time_point until) {
  const Socket socket(to);
  connect_to(socket, to, until);
  send_all(socket.file(), request_of(address), until);
  return pid_of(receive_until(socket.file(), "</methodResponse>", until));
}

}  // namespace

MasterAddress parse_master(const std::string& uri) {
  const auto refuse = [&]() -> MasterAddress {
    throw sdk::Failure(HW_ERROR_ARGUMENT,
                       "master: \"" + printable(uri) + "\" is not of the form http://HOST:PORT");
  };
  constexpr std::string_view kScheme = "http://";
  if (uri.substr(0, kScheme.size()) != kScheme) return refuse();
  std::string rest = uri.substr(kScheme.size());
  if (!rest.empty() && rest.back() == '/') rest.pop_back();
  const std::size_t colon = rest.find(':');
  if (colon == 0 || colon == std::string::npos) return refuse();
  const std::string host = rest.substr(0, colon);
  const auto port = parse_uint(rest.substr(colon + 1));
  const bool plain =
      host.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_") ==
      std::string::npos;
  if (!plain || !port || *port < 1 || *port > 65535) return refuse();
  return {"http://" + host + ":" + std::to_string(*port), host, std::to_string(*port)};
}

MasterAnswer ask_master(const MasterAddress& address, milliseconds limit) {
  const Clock::time_point until = Clock::now() + limit;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_family = AF_INET;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
  if (failed != 0) return {{}, ::gai_strerror(failed)};
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> list(found, &::freeaddrinfo);
  MasterAnswer answer;
  for (const addrinfo* to = list.get(); to != nullptr && !answer.pid; to = to->ai_next) {
    try {
      answer = {ask(address, *to, until), {}};
    } catch (const NoAnswer& failure) {
      answer.problem = failure.cause;
    }
  }
  return answer;
}

MasterAnswer wait_for_master(const MasterAddress& address, milliseconds limit) {
  const Clock::time_point until = Clock::now() + limit;
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now());
    MasterAnswer answer = ask_master(address, std::max(left, milliseconds(1)));
    const auto pause = milliseconds(100);
    if (answer.pid || Clock::now() + pause >= until) return answer;
    std::this_thread::sleep_for(pause);
  }
}

MasterWatch::MasterWatch(MasterAddress address, std::string pid)
    : address_(std::move(address)), pid_(std::move(pid)), thread_([this] { watch(); }) {}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MasterWatch::watch() {
  ros::disableAllSignalsInThisThread();
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kWatchPeriod, [this] { return ending_; })) {
    lock.unlock();
    take(ask_master(address_, kWatchPeriod));
    lock.lock();
  }
}

void MasterWatch::take(const MasterAnswer& answer) {
  const bool answered = answers_.exchange(answer.pid.has_value());
  if (!answer.pid) {
    if (!answered) return;
    ++times_lost_;
    say(HW_LOG_WARNING, "the ROS master at " + address_.uri + " no longer answers (" + answer.problem +
                            "); topics that are connected go on, new nodes cannot be found");
    return;
  }
  if (*answer.pid != pid_) {
    say(HW_LOG_ERROR,
        "another ROS master answers at " + address_.uri +
            " now; it does not know this node, which has to be started again to be found by new nodes");
  } else if (!answered) {
    say(HW_LOG_INFO, "the ROS master at " + address_.uri + " answers again");
  }
  pid_ = *answer.pid;
}

}  // namespace hallway::ros1

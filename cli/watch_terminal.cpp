// SPDX-License-Identifier: MIT
#define NCURSES_WIDECHAR 1
#define NCURSES_NOMACROS 1
#include "watch_terminal.hpp"

#include <langinfo.h>
#include <ncurses.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

#include "watch/keys.hpp"

namespace hallway::cli {
namespace {

using watch::Role;

/// What a signal handler needs to leave the terminal whole. It may be read at any time, so it is no object with an owner.
struct Rescue {
  termios modes{};
  std::array<char, 256> text{};
  std::size_t length = 0;
  std::array<struct sigaction, NSIG> before{};
  volatile std::sig_atomic_t interrupts = 0;
};
Rescue rescue;

constexpr std::array kInterrupts{SIGINT, SIGTERM};
constexpr std::array kCrashes{SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGHUP, SIGQUIT};

void add_to_rescue(const char* capability) {
  const char* text = ::tigetstr(const_cast<char*>(capability));
  if (text == nullptr || text == reinterpret_cast<char*>(-1)) return;
  for (const char one : std::string_view(text)) {
    if (rescue.length < rescue.text.size()) rescue.text[rescue.length++] = one;
  }
}

/// Only with functions that a signal handler may call.
void end_by(int signal) {
  ::tcsetattr(STDIN_FILENO, TCSANOW, &rescue.modes);
  [[maybe_unused]] const auto written = ::write(STDOUT_FILENO, rescue.text.data(), rescue.length);
  ::sigaction(signal, &rescue.before[static_cast<std::size_t>(signal)], nullptr);
  ::raise(signal);
}

/// The first one is passed on, and the view closes in good order. At the second one the program does not answer any more.
void on_interrupt(int signal) {
  rescue.interrupts = rescue.interrupts + 1;
  const struct sigaction& before = rescue.before[static_cast<std::size_t>(signal)];
  if (rescue.interrupts == 1 && before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN) {
    before.sa_handler(signal);
    return;
  }
  rescue.before[static_cast<std::size_t>(signal)].sa_handler = SIG_DFL;
  end_by(signal);
}

void catch_signal(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, &rescue.before[static_cast<std::size_t>(signal)]);
}

void prepare_rescue() {
  ::tcgetattr(STDIN_FILENO, &rescue.modes);
  rescue.length = 0;
  rescue.interrupts = 0;
}

void catch_signals() {
  for (const char* capability : {"sgr0", "rmkx", "rmcup", "cnorm"}) add_to_rescue(capability);
  for (const int signal : kInterrupts) catch_signal(signal, &on_interrupt);
  for (const int signal : kCrashes) catch_signal(signal, &end_by);
}

void release_signals() {
  for (const int signal : kCrashes)
    ::sigaction(signal, &rescue.before[static_cast<std::size_t>(signal)], nullptr);
  for (const int signal : kInterrupts)
    ::sigaction(signal, &rescue.before[static_cast<std::size_t>(signal)], nullptr);
}

/// A row for each role.
struct Look {
  short colour = -1;  ///< of the terminal's eight; -1: its own
  attr_t attributes = A_NORMAL;
};

Look look_of(Role role) {
  switch (role) {
    case Role::kText:
      return {};
    case Role::kDim:
      return {-1, A_DIM};
    case Role::kTitle:
      return {-1, A_REVERSE};
    case Role::kWall:
      return {COLOR_WHITE, A_NORMAL};
    case Role::kRay:
      return {COLOR_CYAN, A_DIM};
    case Role::kSeen:
      return {COLOR_CYAN, A_BOLD};
    case Role::kTruth:
      return {COLOR_GREEN, A_NORMAL};
    case Role::kEstimate:
      return {COLOR_MAGENTA, A_BOLD};
    case Role::kContact:
      return {COLOR_RED, A_BOLD};
    case Role::kLandmark:
      return {COLOR_BLUE, A_BOLD};
    case Role::kMapped:
      return {COLOR_MAGENTA, A_NORMAL};
    case Role::kDrawn:
      return {COLOR_YELLOW, A_NORMAL};
    case Role::kRobot:
      return {COLOR_YELLOW, A_BOLD | A_REVERSE};
  }
  return {};
}

constexpr int kRoles = static_cast<int>(Role::kRobot) + 1;

short pair_of(Role role) {
  return static_cast<short>(static_cast<int>(role) + 1);
}

bool is_terminal() {
  const char* kind = std::getenv("TERM");
  if (kind == nullptr || *kind == '\0' || std::string_view(kind) == "dumb") return false;
  return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1;
}

bool set_locale(bool wants_utf8) {
  const auto is_utf8 = [] { return std::string_view(::nl_langinfo(CODESET)) == "UTF-8"; };
  std::setlocale(LC_CTYPE, "");
  if (!is_utf8() && wants_utf8) std::setlocale(LC_CTYPE, "C.UTF-8");
  return is_utf8();
}

int key_of(wint_t typed) {
  switch (typed) {
    case KEY_LEFT:
      return watch::kKeyLeft;
    case KEY_RIGHT:
      return watch::kKeyRight;
    case KEY_UP:
      return watch::kKeyUp;
    case KEY_DOWN:
      return watch::kKeyDown;
    case KEY_HOME:
      return watch::kKeyHome;
    case KEY_END:
      return watch::kKeyEnd;
    case KEY_RESIZE:
      return Terminal::kResized;
    default:
      return 0;
  }
}

}  // namespace

struct Terminal::Curses {
  SCREEN* screen = nullptr;
};

std::unique_ptr<Terminal> Terminal::open(bool wants_utf8) {
  if (!is_terminal()) return nullptr;
  const bool has_utf8 = set_locale(wants_utf8);
  prepare_rescue();
  SCREEN* screen = ::newterm(nullptr, stdout, stdin);
  if (screen == nullptr) return nullptr;
  catch_signals();
  ::set_term(screen);
  ::cbreak();  // Ctrl-C stays a signal
  ::noecho();
  ::nonl();
  ::set_escdelay(50);
  ::keypad(stdscr, TRUE);
  ::nodelay(stdscr, TRUE);
  ::curs_set(0);
  if (::has_colors()) {
    ::start_color();
    ::use_default_colors();
    for (int i = 0; i < kRoles; ++i) ::init_pair(pair_of(Role(i)), look_of(Role(i)).colour, -1);
  }
  auto curses = std::make_unique<Curses>();
  curses->screen = screen;
  return std::unique_ptr<Terminal>(new Terminal(std::move(curses), has_utf8));
}

Terminal::Terminal(std::unique_ptr<Curses> curses, bool has_utf8)
    : curses_(std::move(curses)), has_utf8_(has_utf8) {}

Terminal::~Terminal() {
  ::endwin();
  ::delscreen(curses_->screen);
  release_signals();
}

int Terminal::width() const {
  return std::max(getmaxx(stdscr), 1);
}

int Terminal::height() const {
  return std::max(getmaxy(stdscr), 1);
}

void Terminal::show(const watch::Grid& grid) {
  ::erase();
  const int rows = std::min(grid.height(), height());
  const int columns = std::min(grid.width(), width());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const watch::Cell& cell = grid.at(column, row);
      if (cell == watch::Cell{}) continue;
      const bool shown = has_utf8_ || cell.glyph < 0x80;
      const std::array<wchar_t, 2> text{static_cast<wchar_t>(shown ? cell.glyph : U'?'), L'\0'};
      cchar_t character;
      ::setcchar(&character, text.data(), look_of(cell.role).attributes, pair_of(cell.role), nullptr);
      ::mvadd_wch(row, column, &character);
    }
  }
  ::refresh();
}

std::optional<int> Terminal::key() {
  wint_t typed = 0;
  const int kind = ::get_wch(&typed);
  if (kind == ERR) return std::nullopt;
  // Terminals move or join lines when their size changes, each in its own way.
  if (kind == KEY_CODE_YES && typed == KEY_RESIZE) ::clearok(stdscr, TRUE);
  if (kind == KEY_CODE_YES) return key_of(typed);
  constexpr wint_t kRedraw = 12;  // Ctrl-L: something else has written on the terminal
  if (typed == kRedraw) ::clearok(stdscr, TRUE);
  return typed < 0x80 ? static_cast<int>(typed) : 0;
}

void Terminal::wait(int limit_ms) {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  ::poll(&input, 1, limit_ms);
}

}  // namespace hallway::cli

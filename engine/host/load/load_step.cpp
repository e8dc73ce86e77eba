// SPDX-License-Identifier: MIT
#include "host/load/load_step.hpp"

#include <array>

namespace hallway::host {
namespace {

thread_local std::atomic<std::uint32_t>* the_word = nullptr;

}  // namespace

const char* load_step_name(std::uint32_t step) {
  static constexpr std::array kNames = {"load", "init", "describe", "create", "parameters"};
  return step < kNames.size() ? kNames[step] : kNames[0];
}

void note_load_steps_in(std::atomic<std::uint32_t>* word) {
  the_word = word;
}

void enter(LoadStep step) {
  if (the_word != nullptr) the_word->store(static_cast<std::uint32_t>(step));
}

}  // namespace hallway::host

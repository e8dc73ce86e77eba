// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "base/error.hpp"
#include "base/helper.hpp"
#include "base/text.hpp"

namespace hallway::loaders {

constexpr std::uint64_t kMaxRequestBytes = 1 << 20;

/// The main() of a helper program.
/// @param who     for messages: "the mesh loader"
/// @param answer  answers the request, which it is given as it was read from standard input
/// @param encode  what is written for an Error
template <typename Answer, typename Encode>
int helper_main(int argc, char** argv, const std::string& who, Answer answer, Encode encode) {
  if (argc != 2 || !begin_helper(argv[1])) return 2;
  const auto fail = [&](const Error& failure) { write_standard_output(encode(failure)); };
  try {
    try {
      answer(read_standard_input(kMaxRequestBytes));
    } catch (const Error& failure) {
      fail(failure);
    } catch (const std::bad_alloc&) {
      fail(Error(ErrorCode::kBadInput, "cannot be read: it needs more memory than " + who + " may use"));
    } catch (const std::exception& failure) {
      fail(Error(ErrorCode::kBadInput, "cannot be read: " + printable(failure.what(), 500)));
    }
  } catch (...) {
    return 3;  // whoever started it no longer reads
  }
  std::_Exit(0);  // nothing to save, and freeing a large scene takes its time
}

}  // namespace hallway::loaders

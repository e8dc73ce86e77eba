// SPDX-License-Identifier: MIT
#include "host/isolate/verdict.hpp"

namespace hallway::host {

const char* misdeed_name(Misdeed what) {
  switch (what) {
    case Misdeed::kFault:
      return "fault";
    case Misdeed::kCrash:
      return "crash";
    case Misdeed::kExit:
      return "exit";
    case Misdeed::kTimeout:
      return "timeout";
    case Misdeed::kMemory:
      return "memory";
    case Misdeed::kThreads:
      return "threads";
    case Misdeed::kProtocol:
      return "protocol";
  }
  return "fault";
}

}  // namespace hallway::host

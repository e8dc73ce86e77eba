// SPDX-License-Identifier: MIT
#include "base/error.hpp"

#include <utility>

namespace hallway {
namespace {

std::string compose(const std::string& message, const Where& where) {
  std::string text = where.file;
  if (where.line > 0) text += (text.empty() ? "line " : ":") + std::to_string(where.line);
  if (!text.empty()) text += ": ";
  if (!where.element.empty()) text += where.element + ": ";
  return text + message;
}

}  // namespace

Error::Error(ErrorCode code, std::string message, Where where)
    : code_(code), message_(std::move(message)), where_(std::move(where)), what_(compose(message_, where_)) {}

const char* error_code_name(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::kUsage:
      return "usage";
    case ErrorCode::kBadInput:
      return "bad_input";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kPluginLoad:
      return "plugin_load";
    case ErrorCode::kPluginFault:
      return "plugin_fault";
    case ErrorCode::kInterrupted:
      return "interrupted";
    case ErrorCode::kInternal:
      return "internal";
  }
  return "internal";
}

int exit_status(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::kUsage:
      return 2;
    case ErrorCode::kBadInput:
    case ErrorCode::kIo:
      return 3;
    case ErrorCode::kPluginLoad:
      return 4;
    case ErrorCode::kPluginFault:
      return 5;
    case ErrorCode::kInterrupted:
      return 130;
    case ErrorCode::kInternal:
      return 6;
  }
  return 6;
}

}  // namespace hallway

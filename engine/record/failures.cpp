// SPDX-License-Identifier: MIT
#include "record/failures.hpp"

#include <utility>

#include "base/error.hpp"
#include "record/plugin_json.hpp"

namespace hallway::record {

void Failures::note(host::Verdict verdict, std::optional<std::uint32_t> iteration) {
  ++count;
  if (verdicts.size() < kMaxVerdicts) verdicts.push_back({std::move(verdict), iteration});
}

std::optional<host::Verdict> catch_failure(const std::function<void()>& work) {
  try {
    work();
    return std::nullopt;
  } catch (const host::PluginFailure& failure) {
    host::Verdict verdict = failure.verdict();
    verdict.message = failure.what();
    return verdict;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kPluginFault) throw;
    return host::Verdict{.message = error.what()};
  }
}

void describe_failures(host::OnFailure policy, const Failures& failures, nlohmann::ordered_json& manifest) {
  const auto print = [](const Failure& failure) { return print_verdict(failure.verdict, failure.iteration); };
  manifest["on_failure"] = host::on_failure_name(policy);
  manifest["failures"] = failures.count;
  manifest["restarts"] = failures.restarts;
  manifest["verdict"] =
      failures.verdicts.empty() ? nlohmann::ordered_json() : print(failures.verdicts.front());
  if (failures.verdicts.size() < 2) return;
  for (const Failure& failure : failures.verdicts) manifest["verdicts"].push_back(print(failure));
}

}  // namespace hallway::record

// SPDX-License-Identifier: MIT
#include <memory>

#include "study/study.hpp"

namespace hallway::study {

std::vector<StudyRun> make_runs(const std::vector<RunSpec>& specs, const RunnerSetup& setup) {
  std::vector<StudyRun> runs;
  std::unique_ptr<Ground> ground;
  std::string key;
  std::uint64_t done = 0;
  for (const RunSpec& spec : specs) {
    if (!ground || key != ground_key(spec)) {
      ground.reset();  // one at a time: a large one takes much memory
      ground = make_ground(spec, setup.folders, setup.data, setup.threads);
      key = ground_key(spec);
    }
    host::Pipeline pipeline =
        host::Pipeline::unstarted(ground->stages(spec.plugin), setup.plugin_folders,
                                  ground->source().activation(), setup.log, setup.isolation);
    const std::uint64_t before = done;
    const auto progress = [&] {
      ++done;
      if (setup.progress) setup.progress(done);
    };
    runs.push_back({spec, trace_run(ground->source(), pipeline, spec.sample_every, {progress, setup.stop})});
    if (runs.back().trace.stopped) break;
    done = before + spec.iterations();  // a run that failed has fewer
  }
  return runs;
}

}  // namespace hallway::study

#include "run/study.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "files/files.hpp"

namespace dygita {

void Study::finish(const std::filesystem::path& out, bool writes_files) const {
  for (const auto& [problem, cases] : cases_) {
    const bool is_told = std::any_of(cases.begin(), cases.end(), [](const StudyCase& c) { return !c.at.empty(); });
    const bool is_checked =
        std::any_of(cases.begin(), cases.end(), [](const StudyCase& c) { return c.cold_iterations.has_value(); });
    if (!(is_told && cases.size() > 1) && !is_checked) continue;
    say(study_summary(problem, cases));
    if (!writes_files) continue;
    const std::filesystem::path folder = out / file_name_of(problem);
    write_study(folder, problem, cases);
    say(fmt::format("  table and figure: {}, {}", (folder / "study.csv").string(), (folder / "study.svg").string()));
  }
}

}  // namespace dygita

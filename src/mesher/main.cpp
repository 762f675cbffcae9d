// dygita-mesher: reads a task from standard input, answers on standard output. Started by dygita (mesh/mesher_process).
#include <link.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <new>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/overloaded.hpp"
#include "mesher/read.hpp"
#include "mesher/sandbox.hpp"

namespace dygita {

namespace {

bool write_all(int stream, const std::string& bytes) {
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(stream, bytes.data() + done, bytes.size() - done);
    if (n <= 0) return false;
    done += static_cast<size_t>(n);
  }
  return true;
}

std::vector<std::string> loaded_libraries() {
  std::vector<std::string> paths;
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void* all) {
        if (info->dlpi_name[0] == '/') static_cast<std::vector<std::string>*>(all)->emplace_back(info->dlpi_name);
        return 0;
      },
      &paths);
  return paths;
}

MesherAnswer answer_to(const MesherTask& task) {
  MesherAnswer answer;
  try {
    if (!task.is_trusted) confine(task.memory_limit, task.readable);
    answer = std::visit(overloaded{[&](const GmshOptions& options) { return read_file(options, task.path); },
                                   [&](const StepOptions& options) { return read_assembly(options); }},
                        task.options);
  } catch (const InputError& error) {
    answer.error = error.what();
  } catch (const std::bad_alloc&) {
    const auto& file = std::visit([](const auto& options) -> const std::string& { return options.file; }, task.options);
    answer.error = file + ": gmsh requires more memory than this machine has\n    use larger cells, or check 'unit'";
  }
  answer.warnings = take_warnings();
  answer.libraries = loaded_libraries();
  return answer;
}

}  // namespace

void tell(const std::string& doing) {
  using Clock = std::chrono::steady_clock;
  static Clock::time_point last;
  if (Clock::now() - last < std::chrono::milliseconds(100)) return;
  last = Clock::now();
  write_all(STDERR_FILENO, told_mark + doing + "\n");
}

}  // namespace dygita

// Ends without a clean-up: what libraries do then is nobody's business any more, and some fail at it.
int main() {
  using namespace dygita;
  if (isatty(STDIN_FILENO)) {
    std::fputs("dygita starts dygita-mesher; do not start it by hand\n", stderr);
    return 2;
  }
  const std::string bytes((std::istreambuf_iterator<char>(std::cin)), {});
  const int answers = dup(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);  // libraries print to it
  try {
    _exit(write_all(answers, to_bytes(answer_to(task_of(bytes)))) ? 0 : 4);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    _exit(4);
  }
}

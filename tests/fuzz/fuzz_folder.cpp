// The folder of a run: run.json, scenes.json, tables, the list of files, the lock beside it. An input is a text with
// a line "==> NAME" before the content of each file.
#include "files/manifest.hpp"
#include "files/run_lock.hpp"
#include "files/run_record.hpp"
#include "fuzz/target.hpp"
#include "report/report.hpp"
#include "run/repetition.hpp"

namespace dygita::fuzz {

namespace {

constexpr std::string_view mark = "==> ";

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() < 60 && name != "." && name != ".." &&
         name.find_first_of(std::string("/\0", 2)) == std::string::npos;
}

void write_files(const Scratch& scratch, const std::string& text) {
  for (size_t at = text.find(mark); at != std::string::npos;) {
    const size_t line = std::min(text.find('\n', at), text.size());
    const std::string name = text.substr(at + mark.size(), line - std::min(line, at + mark.size()));
    size_t next = text.find("\n==> ", line);
    const size_t begin = std::min(line + 1, text.size()), end = std::min(next, text.size());
    if (is_plain_name(name)) scratch.write(name, text.substr(begin, end > begin ? end - begin : 0));
    at = next == std::string::npos ? next : next + 1;
  }
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita;
  using namespace dygita::fuzz;
  static const Scratch scratch;
  scratch.empty();
  write_files(scratch, text_of(data, size));
  const std::filesystem::path& folder = scratch.folder();
  attempt([&] { read_run_record(folder); });
  attempt([&] { report_html(folder); });
  attempt([&] { const Repetition repetition(folder / "run.json"); });
  const std::filesystem::path lock = folder.parent_path() / ".inner.lock";
  std::error_code ignored;
  std::filesystem::copy_file(folder / "lock", lock, ignored);
  attempt([&] { const RunLock held(folder); });
  std::filesystem::remove(lock, ignored);
  attempt([&] { Manifest(folder).add("new"); });  // removes what a list names
  scratch.demand_nothing_outside_was_touched();
  return 0;
}

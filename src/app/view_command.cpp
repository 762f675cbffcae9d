#include "app/view_command.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "files/files.hpp"
#include "report/view_script.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

// view.py of the run.
fs::path script_of(const fs::path& folder) {
  const fs::path script = folder / view_file;
  require_file(script);
  if (fs::exists(script)) return fs::absolute(script);
  if (!fs::is_directory(folder)) throw InputError("no folder '" + folder.string() + "'");
  if (!fs::exists(folder / "run.json"))
    throw InputError("'" + folder.string() + "' contains no run\n    give the folder of a run, out/<problem>/<case>");
  throw InputError("'" + folder.string() +
                   "' contains no frames for ParaView\n    list output.vtk{} in the problem's outputs and run the deck "
                   "again, without --no-frames");
}

// Its first values: a view.py that is longer than any of ours has the rest for nothing.
std::string text_of(const fs::path& path) {
  constexpr size_t most = 1 << 16;
  std::ifstream file(path, std::ios::binary);
  std::string text(most, '\0');
  file.read(text.data(), most);
  text.resize(static_cast<size_t>(file.gcount()));
  return text;
}

// The script in a folder that nobody else can write to; it takes the folder away when ParaView has read it.
class PrivateScript {
 public:
  PrivateScript(const std::string& kept, const fs::path& run) {
    view_script_again(kept, run, "");  // may throw
    folder_ = (fs::temp_directory_path() / "dygita-view-XXXXXX").string();
    if (!mkdtemp(folder_.data())) throw InputError("cannot make '" + folder_ + "': " + std::strerror(errno));
    write_text(path(), view_script_again(kept, run, folder_));
  }
  ~PrivateScript() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  PrivateScript(const PrivateScript&) = delete;
  PrivateScript& operator=(const PrivateScript&) = delete;
  std::string path() const { return folder_ + "/" + view_file; }

 private:
  std::string folder_;
};

}  // namespace

void start_view(const ViewCommand& command) {
  const fs::path kept = script_of(command.run), folder = kept.parent_path();
  const PrivateScript script(text_of(kept), folder);
  const std::string option = "--script=" + script.path();
  say("starting " + command.program + " " + option);
  std::fflush(stdout);
  execlp(command.program.c_str(), command.program.c_str(), option.c_str(), nullptr);
  if (errno != ENOENT) throw InputError("cannot start '" + command.program + "': " + std::strerror(errno));
  throw InputError(
      "no program '" + command.program +
      "' here: install ParaView (Debian, Ubuntu: apt-get install paraview; else https://www.paraview.org), "
      "or say where it is with --paraview\n    on another machine: paraview --script=" +
      kept.string());
}

}  // namespace dygita

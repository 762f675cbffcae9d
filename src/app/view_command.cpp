#include "app/view_command.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
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
    throw InputError("'" + folder.string() + "' holds no run\n    give the folder of one, out/<problem>/<case>");
  throw InputError("'" + folder.string() +
                   "' holds no frames for ParaView\n    list output.vtk{} in the problem's outputs and run the deck "
                   "again, without --no-frames");
}

}  // namespace

void start_view(const ViewCommand& command) {
  const fs::path script = script_of(command.run);
  const std::string option = "--script=" + script.string();
  say("starting " + command.program + " " + option);
  std::fflush(stdout);
  setenv("DYGITA_RUN", script.parent_path().c_str(), 1);  // the script is not told where it is
  execlp(command.program.c_str(), command.program.c_str(), option.c_str(), nullptr);
  if (errno != ENOENT) throw InputError("cannot start '" + command.program + "': " + std::strerror(errno));
  throw InputError(
      "no program '" + command.program +
      "' here: install ParaView (Debian, Ubuntu: apt-get install paraview; else https://www.paraview.org), "
      "or say where it is with --paraview\n    on another machine: paraview --script=" +
      script.string());
}

}  // namespace dygita

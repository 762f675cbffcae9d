#include "app/check_command.hpp"

#include "base/error.hpp"
#include "base/log.hpp"
#include "checks/check_problem.hpp"
#include "files/files.hpp"
#include "report/check_picture.hpp"

namespace dygita {

namespace fs = std::filesystem;

CheckWithPicture::CheckWithPicture(const fs::path& file) : file_(file) {
  if (!file.empty() && file.extension() != ".svg" && file.extension() != ".html")
    throw InputError("--picture " + file.string() + ": the file must end in .svg or .html");
}

std::string CheckWithPicture::operator()(const Problem& problem) {
  check_problem(problem);
  if (file_.empty() || !drawn_.insert(problem.name).second) return check_report(problem);
  fs::path file = file_;
  if (drawn_.size() > 1)
    file.replace_filename(file_.stem().string() + "_" + file_name_of(problem.name) + file_.extension().string());
  write_text(file, file.extension() == ".svg" ? check_picture_svg(problem) : check_picture_html(problem));
  say("problem '" + problem.name + "' is drawn in " + file.string());
  return check_report(problem);
}

}  // namespace dygita

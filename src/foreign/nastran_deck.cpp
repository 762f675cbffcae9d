#include "foreign/nastran_deck.hpp"

#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "foreign/nastran_cases.hpp"

namespace dygita {

namespace {

class NastranDeck : public ImportedDeck {
 public:
  NastranDeck(const ImportOptions& options, NastranModel& read, NastranAnalysis analysis)
      : ImportedDeck(options, read.model(), "mesh.nastran"), read_(read), analysis_(std::move(analysis)) {
    remarks_ = std::move(analysis_.remarks);
    untranslated_ = std::move(analysis_.untranslated);
  }

  std::string text() {
    const bool has_gravity = std::any_of(analysis_.cases.begin(), analysis_.cases.end(), [](const NastranCase& one) {
      return std::any_of(one.acting.begin(), one.acting.end(),
                         [](const FileAction& action) { return action.kind == FileAction::Kind::gravity; });
    });
    write_parts(has_gravity || analysis_.kind == NastranAnalysis::Kind::modes);
    write_welds();
    for (const FileBody& body : analysis_.bodies) put_body(body);
    for (const FileSpring& spring : analysis_.springs)
      if (const std::string name = put_spring(spring, springs_.size() + 1); !name.empty()) springs_.push_back(name);
    if (analysis_.kind != NastranAnalysis::Kind::other)
      for (const NastranCase& one : analysis_.cases) write_case(one);
    return head() + body_;
  }

 private:
  std::string orientation_of(const ForeignGroup& group) override {
    if (group.orientation.empty()) return "";
    const std::string given = fmt::format("system {} of part '{}' (PSOLID CORDM)", group.orientation, group.name);
    const long number = std::stol(group.orientation);
    if (number < 0) {
      leave(given + ": axes by each element");
      return "";
    }
    const NastranSystem& system = read_.places().system(number, read_.file().cards().front());
    const Vec3 x = system.axes.col(0), y = system.axes.col(1), z = system.axes.col(2);
    if (system.kind == 'R') return fmt::format(", orientation = {{ {}, {} }}", lua_vector(x), lua_vector(y));
    if (system.kind == 'S') {
      leave(given + ": axes of a sphere");
      return "";
    }
    // Axis 1 outward, axis 2 around.
    const std::string name = names_.of("axes", group.name);
    put("local function {}(x, y, z)  -- outward from the axis of system {} and around it", name, number);
    put("  local o, a = {}, {}", lua_vector(file_units(options_.units).length * system.origin), lua_vector(z));
    put("  local d = {{ x - o[1], y - o[2], z - o[3] }}");
    put("  local h = d[1]*a[1] + d[2]*a[2] + d[3]*a[3]");
    put("  local r = {{ d[1] - h*a[1], d[2] - h*a[2], d[3] - h*a[3] }}");
    put("  return r, {{ a[2]*r[3] - a[3]*r[2], a[3]*r[1] - a[1]*r[3], a[1]*r[2] - a[2]*r[1] }}");
    put("end");
    return ", orientation = " + name;
  }

  // Names of the supports of a set, which cases share.
  const std::vector<std::string>& supports_of(const NastranCase& one, std::vector<std::string>& loads) {
    std::vector<FileAction> held, moved;
    for (const FileAction& action : one.held) (action.kind == FileAction::Kind::held ? held : moved).push_back(action);
    const auto [known, is_new] = supports_.try_emplace(one.supports);
    std::vector<std::string> none;
    if (is_new) add(held, known->second, none);
    add(moved, none, loads);
    return known->second;
  }

  void write_case(const NastranCase& one) {
    const bool is_modes = analysis_.kind == NastranAnalysis::Kind::modes;
    std::string name = deck_name_of(std::filesystem::path(options_.file).stem().string());
    if (analysis_.cases.size() > 1) name += " " + deck_name_of(one.name);
    std::vector<std::string> loads, supports = supports_of(one, loads);
    supports.insert(supports.end(), springs_.begin(), springs_.end());
    if (is_modes && !loads.empty()) leave(one.where + ": modes under a prescribed motion");
    if (is_modes && !one.acting.empty()) leave(one.where + ": modes under loads");
    if (!is_modes) {
      std::vector<std::string> none;
      add(one.acting, none, loads);
    }
    const std::string step = names_.of(is_modes ? "rest" : "step", std::to_string(++n_steps_));
    put("local {} = step.static{{ name = {}, loads = {{ {} }} }}{}", step, lua_quoted(step), comma_list(loads),
        one.where.empty() ? "" : "  -- " + one.where);
    write_problem(name, supports, {step}, is_modes ? modes_of(name, one.modes) : "output.vtk{ frames = 1 }");
  }

  NastranModel& read_;
  NastranAnalysis analysis_;
  std::map<long, std::vector<std::string>> supports_;  // by the number of the set
  std::vector<std::string> springs_;
  int n_steps_ = 0;
};

}  // namespace

std::string deck_of_nastran(const ImportOptions& options) {
  NastranModel read({options.file, file_units(options.units).length, options.skip});
  NastranAnalysis analysis = analysis_of(read);
  return NastranDeck(options, read, std::move(analysis)).text();
}

}  // namespace dygita

#include "deck/build_specification.hpp"

#include <spdlog/fmt/fmt.h>

namespace dygita {

std::shared_ptr<const Specification> specification_of(const Declaration& declaration) {
  const Arguments& a = declaration.arguments;
  if (!a.has("specification")) return nullptr;
  if (!a.is_table("specification")) {
    const std::string written = a.text("specification");
    const std::filesystem::path path = declaration.folder / written;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
      throw InputError(fmt::format("'specification': no file '{}'\n    looked for {}", written, path.string()));
    auto specification = std::make_shared<Specification>(read_specification(path.string()));
    specification->source = written;
    return specification;
  }
  auto specification = std::make_shared<Specification>();
  specification->source = "deck";
  std::vector<std::string> where;
  const std::vector<double> flat =
      a.numbers("specification");  // as lua/check.lua leaves the pairs: one after the other
  for (size_t i = 0; i + 1 < flat.size(); i += 2) {
    specification->frequency.push_back(flat[i]);
    specification->level.push_back(flat[i + 1]);
    where.push_back(fmt::format("'specification[{}]'", i / 2 + 1));
  }
  check_specification(*specification, where);
  return specification;
}

}  // namespace dygita

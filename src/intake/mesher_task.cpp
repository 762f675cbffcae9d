#include "intake/mesher_task.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace dygita {

namespace {

using Json = nlohmann::json;

template <class T>
Json packed(const std::vector<T>& values) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  return Json::binary(std::vector<std::uint8_t>(bytes, bytes + values.size() * sizeof(T)));
}

template <class T>
std::vector<T> unpacked(const Json& json) {
  const auto& bytes = json.get_binary();
  if (bytes.size() % sizeof(T) != 0) throw InputError("a list that ends within a number");
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::string bytes_of(const Json& json) {
  std::string bytes;
  Json::to_cbor(json, bytes);
  return bytes;
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::optional<double> number_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

Json options_of(const GmshOptions& options) {
  return {{"file", options.file},
          {"size", json_of(options.size)},
          {"unit", options.unit},
          {"order", options.order},
          {"complete", options.is_complete}};
}

Json options_of(const StepOptions& options) {
  Json json = {{"file", options.file},           {"size", json_of(options.size)},   {"unit", options.unit},
               {"order", options.order},         {"complete", options.is_complete}, {"sizes", options.sizes},
               {"a_turn", options.cells_a_turn}, {"sweep", options.sweep},          {"parts", options.parts}};
  if (options.fine) json["fine"] = {options.fine->size, options.fine->growth};
  return json;
}

template <class Options>
Options common_options(const Json& json) {
  Options options;
  options.file = json.at("file");
  options.size = number_of(json.at("size"));
  options.unit = json.at("unit");
  options.order = json.at("order");
  options.is_complete = json.at("complete");
  return options;
}

StepOptions step_options(const Json& json) {
  StepOptions options = common_options<StepOptions>(json);
  options.sizes = json.at("sizes").get<std::map<std::string, double>>();
  options.cells_a_turn = json.at("a_turn");
  options.sweep = json.at("sweep");
  options.parts = json.at("parts").get<std::vector<std::string>>();
  if (json.contains("fine")) options.fine = {json["fine"].at(0), json["fine"].at(1)};
  return options;
}

using FacetNumbers = std::array<std::uint64_t, most_facet_corners + 1>;  // how many corners, then their tags

Json json_of(const TaggedSurface& surface) {
  std::vector<FacetNumbers> all;
  for (const TaggedFacet& facet : surface.facets) {
    FacetNumbers& numbers = all.emplace_back(FacetNumbers{static_cast<std::uint64_t>(facet.n_corners)});
    std::copy_n(facet.corners.begin(), facet.n_corners, numbers.begin() + 1);
  }
  return {{"name", surface.name}, {"facets", packed(all)}};
}

TaggedSurface surface_of(const Json& json) {
  TaggedSurface surface{json.at("name"), {}};
  for (const FacetNumbers& numbers : unpacked<FacetNumbers>(json.at("facets"))) {
    if (numbers[0] < 3 || numbers[0] > most_facet_corners)
      throw InputError(fmt::format("a facet of {} corners on surface '{}'", numbers[0], surface.name));
    TaggedFacet facet{{}, static_cast<int>(numbers[0])};
    std::copy_n(numbers.begin() + 1, facet.n_corners, facet.corners.begin());
    surface.facets.push_back(facet);
  }
  return surface;
}

Json json_of(const std::vector<TaggedSurface>& surfaces) {
  Json json = Json::array();
  for (const TaggedSurface& surface : surfaces) json.push_back(json_of(surface));
  return json;
}

std::vector<TaggedSurface> surfaces_of(const Json& json) {
  std::vector<TaggedSurface> surfaces;
  for (const Json& surface : json) surfaces.push_back(surface_of(surface));
  return surfaces;
}

Json json_of(const TaggedVolume& volume) {
  Json cells = Json::array();
  for (const auto& [type, tags] : volume.cells) cells.push_back({cell_shape(type).name, packed(tags)});
  return {{"name", volume.name}, {"cells", cells}};
}

const CellShape& cell_called(const std::string& name) {
  for (const CellShape& shape : cell_shapes)
    if (name == shape.name) return shape;
  throw InputError("cells of type '" + name + "'");
}

TaggedVolume volume_of(const Json& json, const std::unordered_map<size_t, Vec3>& nodes) {
  TaggedVolume volume{json.at("name"), {}};
  for (const Json& block : json.at("cells")) {
    const CellShape& shape = cell_called(block.at(0));
    std::vector<size_t> tags = unpacked<size_t>(block.at(1));
    if (tags.size() % shape.shape.nodes.size() != 0) throw InputError("a cell without all of its nodes");
    for (const size_t tag : tags)
      if (!nodes.contains(tag)) throw InputError(fmt::format("a cell with node {}, which is not there", tag));
    volume.cells[shape.type] = std::move(tags);
  }
  return volume;
}

Json json_of(const TaggedModel& model) {
  std::vector<size_t> tags;
  std::vector<double> at;
  for (const auto& [tag, x] : model.nodes) {
    tags.push_back(tag);
    at.insert(at.end(), {x[0], x[1], x[2]});
  }
  Json volumes = Json::array();
  for (const TaggedVolume& volume : model.volumes) volumes.push_back(json_of(volume));
  return {{"tags", packed(tags)}, {"at", packed(at)}, {"volumes", volumes}, {"surfaces", json_of(model.surfaces)}};
}

TaggedModel model_of(const Json& json) {
  TaggedModel model;
  const std::vector<size_t> tags = unpacked<size_t>(json.at("tags"));
  const std::vector<double> at = unpacked<double>(json.at("at"));
  if (at.size() != 3 * tags.size()) throw InputError("nodes without places");
  for (size_t i = 0; i < tags.size(); ++i) {
    const Vec3 x = Eigen::Map<const Vec3>(&at[3 * i]);
    if (!x.allFinite()) throw InputError(fmt::format("node {}, which is at no finite place", tags[i]));
    model.nodes[tags[i]] = x;
  }
  for (const Json& volume : json.at("volumes")) model.volumes.push_back(volume_of(volume, model.nodes));
  model.surfaces = surfaces_of(json.at("surfaces"));
  return model;
}

Json json_of(const std::optional<SolidCopy>& copy) {
  if (!copy) return Json();
  std::vector<double> numbers(copy->turn.data(), copy->turn.data() + 9);
  numbers.insert(numbers.end(), copy->shift.data(), copy->shift.data() + 3);
  return {{"of", copy->of}, {"place", packed(numbers)}};
}

// before: those of the solids before it.
std::optional<SolidCopy> copy_of(const Json& json, const std::vector<std::optional<SolidCopy>>& before) {
  if (json.is_null()) return {};
  SolidCopy copy;
  copy.of = json.at("of");
  const std::vector<double> numbers = unpacked<double>(json.at("place"));
  if (copy.of < 0 || copy.of >= static_cast<int>(before.size()) || before[copy.of] || numbers.size() != 12)
    throw InputError("a copy of nothing");
  copy.turn = Eigen::Map<const Mat3>(numbers.data());
  copy.shift = Eigen::Map<const Vec3>(numbers.data() + 9);
  if (!copy.shift.allFinite() || !copy.turn.isUnitary(1e-9) || copy.turn.determinant() < 0.0)
    throw InputError("a copy that is not turned and moved");
  return copy;
}

// Lists within lists are read by recursion: bytes that are no answer could go deeper than the stack.
class Depth final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(size_t) override { return ++depth_ < deepest; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(size_t) override { return ++depth_ < deepest; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(size_t, const std::string&, const Json::exception&) override { return false; }

 private:
  static constexpr int deepest = 20;
  int depth_ = 0;
};

Json parsed(const std::string& bytes) {
  Depth depth;
  if (!Json::sax_parse(bytes, &depth, Json::input_format_t::cbor)) throw InputError("bytes that are no answer");
  return Json::from_cbor(bytes);
}

MesherAnswer read_answer(const std::string& bytes) {
  const Json json = parsed(bytes);
  MesherAnswer answer;
  answer.error = json.at("error");
  answer.warnings = json.at("warnings").get<std::vector<std::string>>();
  if (!answer.error.empty()) return answer;
  if (json.contains("libraries")) answer.libraries = json["libraries"].get<std::vector<std::string>>();
  answer.model = model_of(json.at("model"));
  for (const Json& solid : json.at("solids")) {
    answer.solids.push_back({solid.at("name"), solid.at("product"), solid.at("instance")});
    answer.surfaces.push_back(surfaces_of(solid.at("surfaces")));
    answer.copies.push_back(copy_of(solid.value("copy", Json()), answer.copies));
  }
  if (!answer.solids.empty() && answer.solids.size() != answer.model.volumes.size())
    throw InputError("solids without cells");
  return answer;
}

}  // namespace

std::string to_bytes(const MesherTask& task) {
  Json json = std::visit([](const auto& options) { return options_of(options); }, task.options);
  json.update({{"is_step", std::holds_alternative<StepOptions>(task.options)},
               {"path", task.path},
               {"memory_limit", task.memory_limit},
               {"is_trusted", task.is_trusted},
               {"readable", task.readable}});
  return bytes_of(json);
}

MesherTask task_of(const std::string& bytes) {
  const Json json = Json::from_cbor(bytes);
  MesherTask task;
  if (json.at("is_step"))
    task.options = step_options(json);
  else
    task.options = common_options<GmshOptions>(json);
  task.path = json.at("path");
  task.memory_limit = json.at("memory_limit");
  task.is_trusted = json.at("is_trusted");
  task.readable = json.at("readable").get<std::vector<std::string>>();
  return task;
}

std::string to_bytes(const MesherAnswer& answer) {
  Json json = {{"error", answer.error}, {"warnings", answer.warnings}};
  if (!answer.error.empty()) return bytes_of(json);
  json["model"] = json_of(answer.model);
  json["libraries"] = answer.libraries;
  json["solids"] = Json::array();
  for (size_t i = 0; i < answer.solids.size(); ++i) {
    const SolidNames& solid = answer.solids[i];
    json["solids"].push_back({{"name", solid.name},
                              {"product", solid.product},
                              {"instance", solid.instance},
                              {"surfaces", json_of(answer.surfaces[i])},
                              {"copy", json_of(answer.copies[i])}});
  }
  return bytes_of(json);
}

MesherAnswer answer_of(const std::string& bytes, const std::string& file) {
  const auto refuse = [&](const std::string& why) {
    return InputError(fmt::format("{}: gmsh returned no valid mesh: {}", file, why));
  };
  try {
    MesherAnswer answer = read_answer(bytes);
    answer.model.file = file;
    return answer;
  } catch (const InputError& error) {
    throw refuse(error.what());
  } catch (const Json::exception& error) {
    throw refuse(error.what());
  }
}

}  // namespace dygita

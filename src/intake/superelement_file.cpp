#include "intake/superelement_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "intake/condensed_builder.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

class Description {
 public:
  explicit Description(const std::string& file) : file_(file), text_(text_of_file(file)) {
    try {
      json_ = Json::parse(text_);
    } catch (const Json::exception&) {
      refuse("it is no JSON");
    }
    const Json what = json_.is_object() ? json_.value("what", Json()) : Json();
    if (what != "dygita superelement") refuse("its 'what' is not \"dygita superelement\"");
    if (json_.value("version", Json()) != 1)
      refuse(
          "it was written by a later version of the program: condense the body again with this one, or use the later "
          "one");
  }

  MeshPtr read() const {
    try {
      return read_body();
    } catch (const Json::exception& error) {
      const std::string text = error.what();  // "[json.exception.out_of_range.403] key 'rows' not found"
      refuse("an entry is missing or of the wrong type, " + text.substr(std::min(text.find("] ") + 2, text.size())));
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(
        fmt::format("'{}' does not describe a superelement: {}\n    output.superelement writes "
                    "<name>.json; give matrices of other programs by 'stiffness', 'mass' and 'points'",
                    file_, why));
  }

  Mat matrix(const char* what) const {
    const Json& entry = json_.at(what);
    const std::string name = entry.at("file");
    if (fs::path(name).filename() != name) refuse(fmt::format("'{}' is in another folder", printable(name)));
    const std::string path = (fs::path(file_).parent_path() / name).string();
    MatrixFile read = read_matrix_market(path);
    if (read.digest != entry.at("digest"))
      throw InputError(fmt::format(
          "'{}' is not the {} that '{}' describes: it has been changed, or belongs to another run", path, what, file_));
    if (read.matrix.rows() != json_.at("n_rows").get<long>())
      throw InputError(fmt::format("'{}' has {} rows, '{}' says {}", path, read.matrix.rows(), file_,
                                   json_.at("n_rows").get<long>()));
    return std::move(read.matrix);
  }

  Vec3 vector(const Json& json) const {
    constexpr double farthest = 1e6;  // m
    const Vec3 x(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
    if (!(x.cwiseAbs().maxCoeff() < farthest)) refuse("a point is 1000 km or more from the origin");
    return x;
  }

  int row_of(const Json& json) const {
    const long row = json.get<long>();
    if (row == -1)
      throw InputError(fmt::format(
          "'{}': a motion of one of its faces is that of another face, because they are tied or share nodes along an "
          "oblique support: it has no row of its own\n    condense the assembly with one of the two in 'on'",
          file_));
    if (row < 0 || row > json_.at("n_rows").get<long>()) refuse(fmt::format("there is no row {}", row));
    return row == 0 ? no_row : static_cast<int>(row) - 1;
  }
  std::array<int, 3> rows(const Json& json, size_t first = 0) const {
    return {row_of(json.at(first)), row_of(json.at(first + 1)), row_of(json.at(first + 2))};
  }

  // Nodes of the face's facets, as the mesh has them.
  std::vector<Facet> facets(const Json& json, const std::vector<int>& node_of) const {
    std::vector<Facet> all;
    for (const Json& entry : json) {
      const std::vector<int> nodes = numbered(entry.at("nodes"), node_of);
      const int type = entry.at("type");
      const auto shape = std::find_if(std::begin(facet_shapes), std::end(facet_shapes),
                                      [&](const FacetShape& one) { return one.vtk_type == type; });
      if (shape == std::end(facet_shapes) || static_cast<int>(nodes.size()) != nodes_per_facet(shape->type))
        refuse(fmt::format("a facet of type {} with {} nodes", type, nodes.size()));
      all.emplace_back(shape->type, nodes);
    }
    return all;
  }

  std::vector<int> numbered(const Json& numbers, const std::vector<int>& node_of) const {
    std::vector<int> nodes;
    for (const Json& json : numbers) {
      const long number = json.get<long>();
      if (number < 1 || number > static_cast<long>(node_of.size())) refuse(fmt::format("there is no node {}", number));
      nodes.push_back(node_of[static_cast<size_t>(number) - 1]);
    }
    return nodes;
  }

  // Of each node of the description its node in the mesh.
  std::vector<int> add_points(CondensedBuilder& builder) const {
    std::vector<int> node_of;
    for (const Json& node : json_.at("nodes"))
      node_of.push_back(builder.add(NodeKind::point, vector(node.at("place")), rows(node.at("rows"))));
    return node_of;
  }

  // A face that moves as a whole, and its nodes.
  std::vector<int> add_rigid(const Json& face, CondensedBuilder& builder) const {
    const Json &own = face.at("rows"), &nodes = face.at("nodes");
    const Vec3 centre = vector(face.at("centre"));
    double size = 0.0;
    for (const Json& place : nodes) size = std::max(size, (vector(place) - centre).norm());
    const int point = builder.add(NodeKind::point, centre, rows(own));
    const bool turns = own.size() == 6 && size > 0.0;
    int turn = -1;
    if (turns) {
      turn = builder.add(NodeKind::turn, centre, rows(own, 3));
      sizes_.emplace_back(rows(own, 3), size);
    }
    std::vector<int> node_of;
    for (const Json& place : nodes) {
      node_of.push_back(builder.n_nodes());
      builder.add_follower(vector(place), point, turn, std::max(size, 1e-12));
    }
    return node_of;
  }

  MeshPtr read_body() const {
    CondensedBuilder builder;
    auto mesh = std::make_shared<Mesh>();
    mesh->source = file_;
    const bool has_points = json_.at("motion") == "nodes";
    const std::vector<int> points = has_points ? add_points(builder) : std::vector<int>();
    for (const Json& face : json_.at("faces")) {
      const std::string name = face.at("name");
      if (mesh->faces.contains(name) || mesh->point_groups.contains(name))
        refuse(fmt::format("face '{}' comes twice", printable(name)));
      const std::vector<int> node_of = has_points ? points : add_rigid(face, builder);
      std::vector<Facet> all = facets(face.at("facets"), node_of);
      if (!all.empty())
        mesh->faces[name] = std::move(all);
      else
        mesh->point_groups[name] = has_points ? numbered(face.at("points"), node_of) : node_of;
    }
    if (builder.n_nodes() == 0) refuse("it has no node");
    Mat stiffness = matrix("stiffness"), mass = matrix("mass");
    Mat damping = json_.contains("damping") ? matrix("damping") : Mat();
    for (Mat* one : {&stiffness, &mass, &damping})
      if (one->size() > 0) scale_turns(*one);
    if (const int missed = json_.at("increments_not_converged"); missed > 0)
      warn(fmt::format("superelement '{}' was made after {} increment{} that had not converged", file_, missed,
                       missed == 1 ? "" : "s"));
    builder.body().mass_of_parts = json_.at("mass_of_parts");
    builder.body().valid_to = json_.at("valid_to");
    return builder.finish(stiffness, mass, damping, std::move(mesh));
  }

  // Rows of rotations (rad) become those of rotations times the face's size (m).
  void scale_turns(Mat& matrix) const {
    for (const auto& [turn_rows, size] : sizes_)
      for (const int row : turn_rows) {
        if (row == no_row) continue;
        matrix.row(row) /= size;
        matrix.col(row) /= size;
      }
  }

  std::string file_, text_;
  Json json_;
  mutable std::vector<std::pair<std::array<int, 3>, double>> sizes_;
};

}  // namespace

MeshPtr read_superelement(const std::string& file) { return Description(file).read(); }

}  // namespace dygita

// From checked tables to the model: one builder a constructor of the schema.
#pragma once

#include <map>
#include <string>

#include "deck/arguments.hpp"
#include "deck/lua_state.hpp"

namespace dygita {

// One call of a constructor.
struct Declaration {
  LuaState& lua;
  std::string path;  // "interface.contact"
  Origin origin;
  LuaArguments arguments;
};

using Builder = Content (*)(const Declaration&);
using Builders = std::map<std::string, Builder>;

const Builders& part_builders();  // mesh, material, substructure, interface, support
const Builders& history_builders();
const Builders& study_builders();  // step, solver, output, problem

// Builds the object of `declaration.path`. InputErrors of the modules below come out with the deck's line and the
// constructor's name.
Content build(const Declaration& declaration);

// The volume `name` of a mesh file and the face `group` of a part (InputError at `origin` for an unknown one).
MeshPtr volume_of(const GmshMeshes& file, const std::string& name, const Origin& origin);
Face face_of(const SubstructurePtr& part, const std::string& group, const Origin& origin);

// What all kinds of substructures have: their place, and doubts of a size that tells a wrong unit.
void set_place(const std::vector<double>& place, Substructure& part);
void doubt_size(const Substructure& part);
Content build_rigid(const Declaration& declaration);
Content build_superelement(const Declaration& declaration);
Content build_interface(const Declaration& declaration);  // by the law of its word
Content build_cyclic(const Declaration& declaration);
Content build_abaqus(const Declaration& declaration);
Content build_nastran(const Declaration& declaration);
Content build_unv(const Declaration& declaration);
Damping damping_in(const LuaArguments& arguments);
// Of `strength` and `criterion`.
std::shared_ptr<const Strength> strength_in(const LuaArguments& arguments);

template <class T>
std::shared_ptr<T> new_named(const Declaration& declaration) {
  auto object = std::make_shared<T>();
  object->name = declaration.arguments.text("name");
  object->origin = declaration.origin;
  return object;
}

}  // namespace dygita

// Assemblies from CAD: every solid of a STEP or BREP file a mesh of its own, with the names of the file.
#pragma once

#include <optional>

#include "mesh/mesh.hpp"

namespace dygita {

struct StepOptions {
  std::string file;  // .step .stp .brep
  int order = 1;
  bool is_complete = false;             // order two: hex27 and prism18 in place of hex20 and prism15
  std::optional<double> size;           // m, of the cells of parts that `sizes` does not name; else by their extent
  std::map<std::string, double> sizes;  // m, by the name of a part (a pattern with *), on "contacts"
  struct Fine {
    double size = 0.0;  // m, at the edges of faces that touch another part
    double growth = 0.35;
  };
  std::optional<Fine> fine;
  int cells_a_turn = 16;  // where surfaces are round
  // Hexahedra in solids that are a flat face moved along its normal: in none, in those that are, or in all.
  enum class Sweep { none, where_possible, all };
  Sweep sweep = Sweep::none;
  double unit = 1e-3;              // m, of a .brep, which states none
  std::vector<std::string> parts;  // names, or patterns with *, of those to mesh; empty: all
};

// Names of a solid.
struct SolidNames {
  std::string name;               // unique: the instance's where products repeat
  std::string product, instance;  // as the file has them, may be empty

  // Does one of them fit a pattern whose * stands for any text?
  bool fit(const std::string& pattern) const;
};

struct StepPart : SolidNames {
  MeshPtr mesh;
  std::string copy_of;  // the part whose mesh it has, turned and moved; empty: its own
};

// The parts of a file, found by their names.
class NamedParts {
 public:
  virtual ~NamedParts() = default;
  // The part of that name, product or instance. Throws InputError where there is none (with the closest) or more than
  // one.
  const StepPart& part(const std::string& name) const;
  const std::string& file() const { return file_; }
  const std::vector<StepPart>& parts() const { return parts_; }
  // Those whose name, product or instance fits a pattern with *, in the order of the file. Throws where there is none.
  std::vector<const StepPart*> parts(const std::string& pattern) const;

 protected:
  std::string file_;
  std::vector<StepPart> parts_;
};

class StepAssembly : public NamedParts {
 public:
  // Reads and meshes; says what it found. Faces of a part are called as in the file, others surface1, surface2, ... in
  // the order of the part's. Throws InputError: file missing or unreadable, gmsh without OpenCASCADE's documents (names
  // would be empty), no solid, a name in `sizes` that no part has, a part that is to have hexahedra and cannot.
  explicit StepAssembly(const StepOptions& options);
};

// Says the extent of all, and a line for each part; warns of cells that are inverted at a corner.
void say_parts(const std::string& file, const std::vector<StepPart>& parts);

// Does a text fit a pattern, whose * stands for any text?
bool fits_pattern(const std::string& text, const std::string& pattern);

}  // namespace dygita

// A file of another program as decks have it: parts with their faces and regions, materials, and what was not used.
#pragma once

#include "foreign/file_units.hpp"
#include "foreign/foreign_model.hpp"

namespace dygita {

struct ForeignOptions {
  std::string file;
  double unit = 1.0;               // m
  bool has_unit = false;           // has the user given it?
  std::optional<FileUnits> units;  // what materials need
  std::vector<std::string> skip;   // types of elements that are left out
};

// A material in SI, by the numbers that its word takes beside the density.
struct FileMaterial {
  std::string name, word;
  std::map<std::string, double> numbers;
  std::optional<double> density;                       // kg/m^3
  std::string density_word;                            // of the file: "*DENSITY"
  double mass_damping = 0.0, stiffness_damping = 0.0;  // 1/s, s
};

class ForeignMeshes : public NamedParts {
 public:
  // An .inp of Abaqus, CalculiX and others. Says what it found. Throws InputError with file and line.
  static std::shared_ptr<const ForeignMeshes> of_abaqus(const ForeignOptions& options);

  // A .bdf, .nas or .dat of Nastran.
  static std::shared_ptr<const ForeignMeshes> of_nastran(const ForeignOptions& options);

  // A universal file, .unv.
  static std::shared_ptr<const ForeignMeshes> of_unv(const ForeignOptions& options);

  // Throws InputError: unknown (with the closest), without elasticity, not that of the file, no units.
  FileMaterial material(const std::string& name) const;
  // What the file says and this program has not used, line by line.
  const std::string& report() const { return report_; }
  // Sets of nodes of a part of this file; null: a mesh of something else.
  const std::map<std::string, std::vector<int>>* regions(const MeshPtr& mesh) const;
  // Surfaces that lie inside a part, the same way.
  const std::map<std::string, std::vector<InnerFacet>>* inner_surfaces(const MeshPtr& mesh) const;

 private:
  ForeignMeshes(ForeignModel model, const ForeignOptions& options);

  std::map<MeshPtr, std::map<std::string, std::vector<int>>> regions_;
  std::map<MeshPtr, std::map<std::string, std::vector<InnerFacet>>> inner_surfaces_;
  std::vector<ForeignMaterial> materials_;
  std::optional<FileUnits> units_;
  std::string report_, elasticity_, density_;
};

}  // namespace dygita

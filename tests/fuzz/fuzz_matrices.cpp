// Matrices of other programs: DMIG, OUTPUT4, Matrix Market, those of Abaqus and CalculiX, and the table of points.
#include <cmath>

#include "fuzz/target.hpp"
#include "intake/labelled_matrix.hpp"
#include "intake/superelement_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita;
  using namespace dygita::fuzz;
  static const Scratch scratch;
  const std::string text = text_of(data, size);
  const size_t half = text.find("\n%%%\n");  // what follows is the table of points, or CalculiX's .dof
  const std::string matrix = text.substr(0, half), rest = half == std::string::npos ? text : text.substr(half + 5);
  scratch.write("input.dof", rest);
  scratch.write("points.csv", rest);
  for (const char* name : {"input.pch", "input.op4", "input.mtx", "input.sti"}) {
    scratch.write(name, matrix);
    const std::string file = (scratch.folder() / name).string();
    for (const MatrixRole role : {MatrixRole::stiffness, MatrixRole::mass})
      attempt([&] {
        const LabelledMatrix read = read_matrix(file, role, "");
        demand(read.matrix.allFinite() && read.matrix == read.matrix.transpose(), "a matrix is finite and symmetric");
        demand(read.rows.empty() || static_cast<Eigen::Index>(read.rows.size()) == read.matrix.rows(),
               "a name for each row");
      });
    attempt([&] {
      MatrixFiles files{file, file, {}, (scratch.folder() / "points.csv").string()};
      files.units = MatrixUnits();
      const MeshPtr mesh = read_matrices(files);
      demand(mesh->nodes.allFinite() && std::isfinite(mesh->inside->mass(0.0)), "a body has finite places and mass");
    });
  }
  return 0;
}

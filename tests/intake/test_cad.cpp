// .step and .brep files, written here through gmsh itself.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "intake/gmsh_reader.hpp"
#include "meeting/facing.hpp"
#include "mesh/expect_input_error.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

// Two blocks that touch, 10 x 10 x 10 and 20 x 20 x 5, in the unit that OpenCASCADE writes: millimetres.
std::string write_blocks(const std::string& name) {
  const std::string file = (fs::temp_directory_path() / name).string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.Verbosity", 0);
  gmsh::model::occ::addBox(0, 0, 0, 10, 10, 10);
  gmsh::model::occ::addBox(-5, -5, 10, 20, 20, 5);
  gmsh::model::occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  return file;
}

void expect_two_blocks(const GmshMeshes& meshes) {
  ASSERT_EQ(meshes.volume_names(), (std::vector<std::string>{"volume1", "volume2"}));
  const MeshPtr small = meshes.volume("volume1"), large = meshes.volume("volume2");
  EXPECT_NEAR(volume(*small), 1e-6, 1e-15);
  EXPECT_NEAR(volume(*large), 2e-6, 1e-15);
  EXPECT_EQ(small->blocks[0].type, CellType::tet4);

  // The touching faces match: some surface of both covers the common square.
  double common = 0;
  for (const auto& [name, facets] : small->faces)
    if (large->faces.count(name))
      common += match_faces({small.get(), facets, Vec3::Zero(), name},
                            {large.get(), large->faces.at(name), Vec3::Zero(), name})
                    ->areas.sum();
  EXPECT_NEAR(common, 1e-4, 1e-13);
}

TEST(Cad, in_a_step_file_is_read_in_the_unit_that_the_file_states) {
  const std::string file = write_blocks("dygita_blocks.step");
  expect_two_blocks(GmshMeshes({file, {}, 0.004, 1.0}));
  expect_two_blocks(GmshMeshes({file, {}, 0.004, 1e-3}));
  expect_input_error(
      [&] {
        GmshMeshes({file, {}, 0.004, 1e-2});
      },
      {"dygita_blocks.step", "states its unit", "0.001 m"});
  fs::remove(file);
}

TEST(Cad, in_a_brep_file_is_read_in_the_unit_given) {
  const std::string file = write_blocks("dygita_blocks.brep");
  expect_two_blocks(GmshMeshes({file, {}, 0.004, 1e-3}));
  fs::remove(file);
}

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  const CellBlock& tetrahedra = mesh.blocks[0];
  for (int i = 0; i < tetrahedra.n_cells(); ++i)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b)
        sum += (mesh.nodes.col(tetrahedra.cell(i)[a]) - mesh.nodes.col(tetrahedra.cell(i)[b])).norm();
  return sum / (6 * tetrahedra.n_cells());
}

TEST(Cad, is_meshed_to_the_asked_size) {
  const std::string file = write_blocks("dygita_sized.brep");
  for (const double size : {0.005, 0.0025, 0.001}) {
    const GmshMeshes meshes({file, {}, size, 1e-3});
    for (const std::string& name : meshes.volume_names())
      EXPECT_NEAR(mean_edge(*meshes.volume(name)) / size, 1.1, 0.2) << name << " at " << size;
  }
  fs::remove(file);
}

}  // namespace
}  // namespace dygita

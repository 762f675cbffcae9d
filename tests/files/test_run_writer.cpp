// The output directory of a run: frames read back with VTK's own reader, tables, record, a second run over the first.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/team.hpp"
#include "files/run_writer.hpp"
#include "model/load.hpp"
#include "recording/given_output.hpp"
#include "scratch.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

// A hexahedron, a wedge beside it and a tetrahedron on top, in VTK's numbering.
MeshPtr mixed_mesh() {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes.resize(3, 11);
  mesh->nodes << 0, 1, 1, 0, 0, 1, 1, 0, 2, 2, 0.5,  //
      0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0.5,             //
      0, 0, 0, 0, 1, 1, 1, 1, 0, 1, 2;
  mesh->blocks = {{CellType::hex8, {0, 1, 2, 3, 4, 5, 6, 7}},
                  {CellType::prism6, {1, 2, 8, 5, 6, 9}},
                  {CellType::tet4, {4, 5, 6, 10}}};
  mesh->source = "mixed";
  mesh->digest = "0123456789abcdef";
  return mesh;
}

SubstructurePtr part(const std::string& name, const Vec3& place) {
  auto part = std::make_shared<Substructure>();
  part->name = name;
  part->mesh = mixed_mesh();
  part->material.name = "steel";
  part->place = place;
  return part;
}

struct Scene {
  std::vector<SubstructurePtr> parts{part("lower & \"first\"", {0, 0, 0}), part("upper", {5, 0.25, 1e-3})};

  Frame frame(double time, double scale) const {
    Frame frame;
    frame.time = time;
    frame.label_time = time + 1.0;
    frame.step = "shock";
    for (const SubstructurePtr& p : parts) frame.parts.push_back(part_frame(*p, scale));
    frame.interfaces = {interface("quads", {FacetType::quad4, {0, 1, 2, 3}}, 0.5 * scale),
                        interface("triangle", {FacetType::tri3, {0, 1, 2}}, 2.0 * scale)};
    frame.interfaces[1].fields.push_back({"plastic_opening", Mat::Constant(1, 3, 7.0)});
    return frame;
  }

  static PartFrame part_frame(const Substructure& p, double scale) {
    PartFrame frame;
    frame.part = &p;
    frame.displacement = scale * 1e-9 * p.mesh->nodes.array().sin().matrix();
    Mat stress(6, p.mesh->n_nodes());
    for (Eigen::Index i = 0; i < stress.size(); ++i) stress(i) = scale * 1e6 * static_cast<double>(i);
    frame.fields = {{"displacement", frame.displacement}, {"stress", stress}, {"von_mises", stress.row(2)}};
    return frame;
  }

  static InterfaceFrame interface(const std::string& name, const Facet& facet, double value) {
    const auto n = static_cast<Eigen::Index>(facet.nodes().size());
    InterfaceFrame frame;
    frame.name = name;
    frame.points = mixed_mesh()->nodes.leftCols(n);
    frame.facets = {facet};
    frame.fields = {{"pressure", Mat::Constant(1, n, value)}, {"displacement", Mat::Constant(3, n, value)}};
    return frame;
  }
};

vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

// VTK's type of a cell, then its nodes.
std::vector<int> cell(vtkUnstructuredGrid* grid, int i) {
  std::vector<int> cell{grid->GetCellType(i)};
  for (int k = 0; k < grid->GetCell(i)->GetNumberOfPoints(); ++k) {
    cell.push_back(static_cast<int>(grid->GetCell(i)->GetPointId(k)));
  }
  return cell;
}

TEST(RunWriter, writes_substructures_that_vtk_reads_back) {
  const Scratch scratch;
  const Scene scene;
  RunWriter writer(scratch.path() / "crush" / "base", "crush");
  writer.write_frame(scene.frame(0.0, 1.0));
  const auto grid = read(writer.directory() / "frames" / "upper_00000.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), 11);
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  EXPECT_EQ(cell(grid, 0), (std::vector<int>{VTK_HEXAHEDRON, 0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(cell(grid, 1), (std::vector<int>{VTK_WEDGE, 1, 2, 8, 5, 6, 9}));
  EXPECT_EQ(cell(grid, 2), (std::vector<int>{VTK_TETRA, 4, 5, 6, 10}));

  const PartFrame expected = Scene::part_frame(*scene.parts[1], 1.0);
  vtkDataArray* displacement = grid->GetPointData()->GetArray("displacement");
  vtkDataArray* stress = grid->GetPointData()->GetArray("stress");
  ASSERT_NE(displacement, nullptr);
  ASSERT_NE(stress, nullptr);
  EXPECT_EQ(grid->GetPointData()->GetNumberOfArrays(), 3);  // displacement once
  EXPECT_EQ(displacement->GetNumberOfComponents(), 3);
  EXPECT_STREQ(stress->GetComponentName(3), "XY");
  EXPECT_STREQ(stress->GetComponentName(5), "XZ");
  for (int j = 0; j < 11; ++j) {
    const Vec3 point = scene.parts[1]->mesh->nodes.col(j) + scene.parts[1]->place;
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(grid->GetPoint(j)[i], point[i]);
      EXPECT_EQ(displacement->GetComponent(j, i), expected.displacement(i, j));
    }
    for (int i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(stress->GetComponent(j, i), expected.fields[1].values(i, j));
  }
  EXPECT_EQ(grid->GetFieldData()->GetArray("time")->GetComponent(0, 0), 0.0);
}

TEST(RunWriter, writes_all_interfaces_of_a_frame_in_one_grid_with_their_names) {
  const Scratch scratch;
  RunWriter writer(scratch.path(), "crush");
  writer.write_frame(Scene().frame(0.0, 1.0));
  const auto grid = read(scratch.path() / "frames" / "interfaces" / "interfaces_00000.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), 7);
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(cell(grid, 0), (std::vector<int>{VTK_QUAD, 0, 1, 2, 3}));
  EXPECT_EQ(cell(grid, 1), (std::vector<int>{VTK_TRIANGLE, 4, 5, 6}));
  EXPECT_EQ(grid->GetCellData()->GetArray("interface")->GetComponent(1, 0), 1.0);
  const auto* names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("interface_name"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(const_cast<vtkStringArray*>(names)->GetValue(1), "triangle");
  vtkDataArray* pressure = grid->GetPointData()->GetArray("pressure");
  EXPECT_EQ(pressure->GetComponent(3, 0), 0.5);
  EXPECT_EQ(pressure->GetComponent(4, 0), 2.0);
  vtkDataArray* opening = grid->GetPointData()->GetArray("plastic_opening");
  EXPECT_TRUE(std::isnan(opening->GetComponent(0, 0)));  // the first interface has none
  EXPECT_EQ(opening->GetComponent(6, 0), 7.0);
}

// One rank has the hexahedron and the wedge, the other the tetrahedron on top; nodes 4, 5 and 6 lie on the cut.
TEST(RunWriter, writes_a_substructure_in_pieces_that_vtk_reads_back_as_one_grid) {
  const Scratch scratch;
  const Scene scene;
  const auto piece = [&](int rank, const std::vector<int>& nodes, std::vector<CellBlock> blocks) {
    Frame frame = scene.frame(0.25, 1.0);
    frame.missed = 3;
    PartFrame& of_part = frame.parts[1];
    auto cells = std::make_shared<Mesh>();
    cells->nodes = of_part.part->mesh->nodes(Eigen::all, nodes);
    cells->blocks = std::move(blocks);
    of_part.displacement = Points(of_part.displacement(Eigen::all, nodes));
    for (NamedField& field : of_part.fields) field.values = Mat(field.values(Eigen::all, nodes));
    of_part.cells = cells;
    of_part.ranks = {0, 3};
    of_part.rank = rank;
    of_part.is_own.assign(nodes.size(), 1);
    return frame;
  };
  const std::vector<int> below{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, above{4, 5, 6, 10};
  const Frame first = piece(0, below, {scene.parts[1]->mesh->blocks[0], scene.parts[1]->mesh->blocks[1]});
  Frame other = piece(3, above, {{CellType::tet4, {0, 1, 2, 3}}});
  other.parts[0].displacement.resize(3, 0);  // rank 0 has it
  RunWriter writer(scratch.path(), "crush");
  writer.begin_frame(first);
  write_parts(other, 0, scratch.path());
  writer.end_frame(first, summary_of(first));
  EXPECT_NE(text_of(scratch.path() / "crush.pvd").find("name=\"upper\" file=\"frames/upper_00000.pvtu\""),
            std::string::npos);

  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName((scratch.path() / "frames" / "upper_00000.pvtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfPoints(), 14);
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  EXPECT_EQ(cell(grid, 1), (std::vector<int>{VTK_WEDGE, 1, 2, 8, 5, 6, 9}));
  EXPECT_EQ(cell(grid, 2), (std::vector<int>{VTK_TETRA, 10, 11, 12, 13}));
  const PartFrame expected = Scene::part_frame(*scene.parts[1], 1.0);
  vtkDataArray* displacement = grid->GetPointData()->GetArray("displacement");
  vtkDataArray* stress = grid->GetPointData()->GetArray("stress");
  ASSERT_NE(displacement, nullptr);
  ASSERT_NE(stress, nullptr);
  EXPECT_STREQ(stress->GetComponentName(4), "YZ");
  for (int j = 0; j < 14; ++j) {
    const int node = j < 10 ? below[j] : above[j - 10];
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(grid->GetPoint(j)[i], scene.parts[1]->mesh->nodes(i, node) + scene.parts[1]->place[i]);
      EXPECT_EQ(displacement->GetComponent(j, i), expected.displacement(i, node));
    }
    for (int i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(stress->GetComponent(j, i), expected.fields[1].values(i, node));
  }
  ASSERT_NE(grid->GetFieldData()->GetArray("time"), nullptr);
  EXPECT_EQ(grid->GetFieldData()->GetArray("time")->GetComponent(0, 0), 0.25);
  EXPECT_EQ(grid->GetFieldData()->GetArray("increments_not_converged")->GetComponent(0, 0), 3);
  // The next run takes all of it away.
  RunWriter again(scratch.path(), "crush");
  EXPECT_FALSE(fs::exists(scratch.path() / "frames" / "upper_00000_rank_3.vtu"));
  EXPECT_FALSE(fs::exists(scratch.path() / "frames" / "upper_00000.pvtu"));
}

TEST(RunWriter, lists_the_frames_after_each_of_them) {
  const Scratch scratch;
  const Scene scene;
  RunWriter writer(scratch.path(), "crush");
  writer.write_frame(scene.frame(0.0, 1.0));
  writer.write_frame(scene.frame(1e-6, 2.0));
  EXPECT_EQ(text_of(scratch.path() / "crush.pvd"),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"0.1\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"1\" part=\"0\" name=\"lower &amp; &quot;first&quot;\" "
            "file=\"frames/lower &amp; &quot;first&quot;_00000.vtu\"/>\n"
            "    <DataSet timestep=\"1\" part=\"1\" name=\"upper\" file=\"frames/upper_00000.vtu\"/>\n"
            "    <DataSet timestep=\"1.000001\" part=\"0\" name=\"lower &amp; &quot;first&quot;\" "
            "file=\"frames/lower &amp; &quot;first&quot;_00001.vtu\"/>\n"
            "    <DataSet timestep=\"1.000001\" part=\"1\" name=\"upper\" file=\"frames/upper_00001.vtu\"/>\n"
            "  </Collection>\n</VTKFile>\n");
  const std::string interfaces = text_of(scratch.path() / "interfaces.pvd");
  EXPECT_NE(interfaces.find("timestep=\"1.000001\" part=\"0\" name=\"interfaces\" "
                            "file=\"frames/interfaces/interfaces_00001.vtu\""),
            std::string::npos);
  EXPECT_TRUE(fs::exists(scratch.path() / "frames" / "lower & \"first\"_00001.vtu"));
  EXPECT_THROW(writer.write_frame(scene.frame(1e-6, 2.0)), ContractError);
}

TEST(RunWriter, writes_binary_data_inline_and_compressed_because_paraview_cannot_read_it_appended) {
  const Scratch scratch;
  RunWriter writer(scratch.path(), "crush");
  writer.write_frame(Scene().frame(0.0, 1.0));
  int n_files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(scratch.path() / "frames")) {
    if (!entry.is_regular_file()) continue;
    ++n_files;
    const std::string text = text_of(entry.path());
    EXPECT_EQ(text.find("<AppendedData"), std::string::npos) << entry.path();
    EXPECT_NE(text.find("format=\"binary\""), std::string::npos) << entry.path();
    EXPECT_EQ(text.find("format=\"appended\""), std::string::npos) << entry.path();
    EXPECT_NE(text.find("vtkZLibDataCompressor"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(n_files, 3);
}

TEST(RunWriter, writes_the_same_bytes_with_any_number_of_threads) {
  const Scratch scratch;
  Scene scene;
  for (int i = 0; i < 20; ++i) scene.parts.push_back(part("part " + std::to_string(i), {10.0 + i, 0.0, 0.0}));
  const int before = thread_limit();
  for (const int n : {1, 3}) {
    set_thread_limit(n);
    RunWriter writer(scratch.path() / std::to_string(n), "crush");
    for (const double time : {0.0, 1e-6}) writer.write_frame(scene.frame(time, 1.0 + time));
  }
  set_thread_limit(before);
  int n_files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(scratch.path() / "1" / "frames")) {
    if (!entry.is_regular_file()) continue;
    ++n_files;
    EXPECT_EQ(text_of(entry.path()), text_of(scratch.path() / "3" / fs::relative(entry.path(), scratch.path() / "1")));
  }
  EXPECT_EQ(n_files, 2 * 23);
}

TEST(RunWriter, of_a_substructure_called_interfaces_keeps_both) {
  const Scratch scratch;
  Scene scene;
  scene.parts = {part("interfaces", {0, 0, 0})};
  RunWriter writer(scratch.path(), "crush");
  writer.write_frame(scene.frame(0.0, 1.0));
  EXPECT_EQ(read(scratch.path() / "frames" / "interfaces_00000.vtu")->GetNumberOfCells(), 3);
  EXPECT_EQ(read(scratch.path() / "frames" / "interfaces" / "interfaces_00000.vtu")->GetNumberOfCells(), 2);
}

// A problem with a step, a load, a history and the energies, and a result of it.
struct Done {
  Problem problem;
  RunResult result;
  RunIdentity identity;

  Done() {
    problem.name = "crush";
    problem.substructures = {part("punch", {0, 0, 0})};
    GivenArguments pressure("load.pressure", {});
    pressure.on = {Face{problem.substructures[0], "zmax"}};
    pressure.values_of_time["history"] = {History::half_sine(2.5, 1e-3), false};
    auto step = std::make_shared<Step>();
    step->name = "shock";
    step->loads = {make_load(pressure)};
    problem.steps = {step};
    add_output(make_history("spread", {}, "displacement"), "displacement", "m");
    add_output(make_output(given_output("energy", "")), "kinetic", "J");
    result.convergence = {{"time", "iterations"}, {"s", ""}, {{1e-6}, {5.0}}, {0}};
    StepSummary& shock = result.steps.emplace_back();
    shock.name = "shock";
    shock.increments = 10;
    shock.increments_not_converged = 1;
    shock.iterations = 50;
    shock.worst_indicator = 2e-6;
    shock.seconds = 0.25;
    result.iterations = 50;
    result.figures.largest_penetration = 1e-9;
    result.figures.mesh_error = std::nan("");
    result.seconds = {{"factor", 0.5}};
    identity = {"crush.lua",
                "feed",
                {{"mu", 0.3}},
                "latin{ window = 5 }",
                {{"punch", "beef"}},
                2,
                "generic",
                {{"gmsh", "4.8.4"}},
                "base",
                true,
                true,
                ""};
  }

  void add_output(const OutputPtr& output, const std::string& column, const std::string& unit) {
    problem.outputs.push_back(output);
    result.tables[output.get()] = {{"time", column}, {"s", unit}, {{0.0}, {1.5}}, {0}};
  }
};

void write_result(RunWriter& writer, const Done& run, const std::vector<std::string>& warnings = {}) {
  writer.write_tables(run.problem, run.result);
  writer.write_record(run.problem, run.result, run.identity, warnings);
}

TEST(RunWriter, writes_a_table_an_output_and_the_convergence) {
  const Scratch scratch;
  const Done run;
  RunWriter writer(scratch.path(), "crush");
  write_result(writer, run);
  EXPECT_EQ(text_of(scratch.path() / "spread.csv"), "time [s],step,displacement [m]\n0,shock,1.5\n");
  EXPECT_EQ(text_of(scratch.path() / "energy.csv"), "time [s],step,kinetic [J]\n0,shock,1.5\n");
  EXPECT_EQ(text_of(scratch.path() / "convergence.csv"), "time [s],step,iterations\n1e-06,shock,5\n");
}

TEST(RunWriter, writes_a_record_that_tells_what_was_run_and_how_it_went) {
  const Scratch scratch;
  Done run;
  RunWriter writer(scratch.path(), "crush");
  put(writer.path_of("state.h5"), "x");
  writer.write_frame(Scene().frame(0.0, 1.0));
  write_result(writer, run, {"a \"quoted\" warning\n\xff"});
  const auto json = nlohmann::json::parse(text_of(scratch.path() / "run.json"));
  EXPECT_EQ(json["program"]["version"], program_version());
  EXPECT_EQ(json["problem"], "crush");
  EXPECT_EQ(json["verdict"], "converged");
  EXPECT_EQ(json["warnings"][0], "a \"quoted\" warning\n\xEF\xBF\xBD");
  EXPECT_EQ(json["deck"]["digest"], "feed");
  EXPECT_EQ(json["parameters"]["mu"], 0.3);
  EXPECT_EQ(json["solver"]["command_line"], "latin{ window = 5 }");
  EXPECT_EQ(json["kernels"], "generic");
  EXPECT_EQ(json["substructures"][0]["digest"], "beef");
  EXPECT_EQ(json["substructures"][0]["nodes"], 11);
  EXPECT_EQ(json["steps"][0]["increments_not_converged"], 1);
  EXPECT_EQ(json["steps"][0]["loads"][0]["on"][0], "punch.zmax");
  EXPECT_EQ(json["steps"][0]["loads"][0]["value"], nlohmann::json({"half_sine(peak 2.5, duration 0.001)"}));
  EXPECT_EQ(json["steps"][0]["loads"][0]["unit"], "Pa");
  EXPECT_EQ(json["figures"]["largest penetration [m]"], 1e-9);
  EXPECT_TRUE(json["figures"]["error estimate, mesh [%]"].is_null());
  EXPECT_EQ(json["figures"].size(), 2);
  EXPECT_EQ(json["libraries"]["gmsh"], "4.8.4");
  EXPECT_TRUE(json["libraries"]["VTK"].get<std::string>().starts_with("9."));
  EXPECT_EQ(json["files"], nlohmann::json({"state.h5", "crush.pvd", "interfaces.pvd", "spread.csv", "energy.csv",
                                           "convergence.csv", "run.json"}));
}

TEST(RunWriter, says_when_a_run_did_not_converge_or_was_interrupted) {
  const Scratch scratch;
  Done run;
  const auto verdict = [&] {
    RunWriter writer(scratch.path(), "crush");
    write_result(writer, run);
    return nlohmann::json::parse(text_of(scratch.path() / "run.json"))["verdict"];
  };
  run.result.converged = false;
  EXPECT_EQ(verdict(), "not converged");
  run.result.interrupted = true;
  EXPECT_EQ(verdict(), "interrupted");
}

TEST(RunWriter, removes_a_former_run_and_leaves_what_is_not_its_own) {
  const Scratch scratch;
  const Done run;
  {
    RunWriter writer(scratch.path(), "crush");
    writer.write_frame(Scene().frame(0.0, 1.0));
    write_result(writer, run);
  }
  put(scratch.path() / "my notes.txt", "keep");
  put(scratch.path() / "frames" / "my view.pvsm", "keep");
  const RunWriter writer(scratch.path(), "crush");
  std::vector<std::string> left;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(scratch.path())) {
    left.push_back(fs::relative(entry.path(), scratch.path()).string());
  }
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (std::vector<std::string>{".dygita-files", "frames", "frames/my view.pvsm", "my notes.txt"}));
}

TEST(RunWriter, where_nothing_can_be_written_is_an_input_error) {
  const Scratch scratch;
  put(scratch.path() / "file", "x");
  EXPECT_THROW(RunWriter(scratch.path() / "file" / "base", "crush"), InputError);
  EXPECT_THROW(RunWriter(scratch.path() / "file", "crush"), InputError);
  EXPECT_THROW(RunWriter(scratch.path(), "interfaces"), InputError);
  RunWriter blocked(scratch.path() / "blocked", "crush");
  fs::create_directories(scratch.path() / "blocked" / "frames" / "upper_00000.vtu");
  EXPECT_THROW(blocked.write_frame(Scene().frame(0.0, 1.0)), InputError);
  RunWriter writer(scratch.path() / "out", "crush");
  put(scratch.path() / "out" / "frames", "in the way");
  EXPECT_THROW(writer.write_frame(Scene().frame(0.0, 1.0)), InputError);
}

TEST(RunWriter, says_that_its_folder_was_taken_away_whichever_file_meets_it_first) {
  const Scratch scratch;
  RunWriter writer(scratch.path() / "out", "crush");
  writer.write_frame(Scene().frame(0.0, 1.0));
  writer.write("known.csv", "1\n");
  fs::rename(scratch.path() / "out", scratch.path() / "elsewhere");
  const auto said_by = [](const auto& write) {
    try {
      write();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const std::string removed = "was removed or emptied while the run wrote there";
  for (const std::string& said : {said_by([&] { writer.write("known.csv", "2\n"); }),  // a list rewritten, as of frames
                                  said_by([&] { writer.write("new.csv", "1\n"); }),
                                  said_by([&] { writer.write_frame(Scene().frame(1.0, 1.0)); })})
    EXPECT_NE(said.find(removed), std::string::npos) << said;
}

// As a full disk is met: no file grows beyond a thousand bytes, and the system says so.
class FullDisk {
 public:
  FullDisk() {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {1000, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(RunWriter, that_meets_a_full_disk_says_so_and_leaves_no_part_of_a_frame) {
  const Scratch scratch;
  RunWriter writer(scratch.path(), "crush");
  std::string said;
  {
    const FullDisk full;
    try {
      writer.write_frame(Scene().frame(0.0, 1.0));
    } catch (const InputError& error) {
      said = error.what();
    }
  }
  EXPECT_NE(said.find("_00000.vtu': the file would be larger than this process may write"), std::string::npos) << said;
  for (const auto& entry : fs::recursive_directory_iterator(scratch.path()))
    EXPECT_FALSE(entry.path().extension() == ".vtu" || entry.path().extension() == ".tmp") << entry.path();
}

}  // namespace
}  // namespace dygita

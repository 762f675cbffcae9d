#include "files/vtk_writer.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVersion.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/markup.hpp"
#include "base/memory.hpp"
#include "files/files.hpp"

namespace dygita {

namespace {

constexpr const char* displacement_name = "displacement";
constexpr const char* tensor_components[] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

// Cells gathered one by one, for all grids here.
class Cells {
 public:
  Cells() { types_->SetNumberOfComponents(1); }

  void add(int vtk_type, std::span<const int> nodes, int first_node) {
    cells_->InsertNextCell(static_cast<vtkIdType>(nodes.size()));
    for (const int node : nodes) cells_->InsertCellPoint(first_node + node);
    types_->InsertNextValue(static_cast<unsigned char>(vtk_type));
  }
  void give_to(vtkUnstructuredGrid* grid) const { grid->SetCells(types_, cells_); }

 private:
  vtkNew<vtkUnsignedCharArray> types_;
  vtkNew<vtkCellArray> cells_;
};

void set_points(vtkUnstructuredGrid* grid, const Points& x) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(x.cols());
  std::copy_n(x.data(), x.size(), coordinates->GetPointer(0));
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  grid->SetPoints(points);
}

template <class Array>
void add_point_array(vtkUnstructuredGrid* grid, const std::string& name, const Eigen::Ref<const Mat>& values) {
  CHECK(values.cols() == grid->GetNumberOfPoints(), "field '" + name + "' has a value for each point");
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(values.rows()));
  array->SetNumberOfTuples(values.cols());
  if (values.rows() == 6) {
    for (int i = 0; i < 6; ++i) array->SetComponentName(i, tensor_components[i]);
  }
  auto* to = array->GetPointer(0);
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      *to++ = static_cast<std::remove_reference_t<decltype(*to)>>(values(i, j));
    }
  }
  grid->GetPointData()->AddArray(array);
}

void add_field(vtkUnstructuredGrid* grid, const std::string& name, const Mat& values) {
  if (name == displacement_name) {
    add_point_array<vtkDoubleArray>(grid, name, values);
  } else {
    add_point_array<vtkFloatArray>(grid, name, values);
  }
}

void add_text(vtkUnstructuredGrid* grid, const char* name, const std::vector<std::string>& texts) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts) array->InsertNextValue(text);
  grid->GetFieldData()->AddArray(array);
}

void add_instant(vtkUnstructuredGrid* grid, const Frame& frame) {
  vtkNew<vtkDoubleArray> time;
  time->SetName("time");
  time->InsertNextValue(frame.time);
  grid->GetFieldData()->AddArray(time);
  add_text(grid, "step", {frame.step});
  for (const auto& [name, value] :
       {std::pair{"converged", frame.converged ? 1 : 0}, {"increments_not_converged", frame.missed}}) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    grid->GetFieldData()->AddArray(array);
  }
}

// By way of a text: VTK 9.1 ends in a segmentation fault where a disk is full, and leaves half a file behind; and where
// memory is, so that it is asked for before.
void write(vtkUnstructuredGrid* grid, const std::filesystem::path& path) {
  require_memory(4 * 1024 * static_cast<std::size_t>(grid->GetActualMemorySize()) + 2 * heap_growth);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetWriteToOutputString(true);
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);        // files 3 % larger than by the default, in two thirds of its time
  vtkObject::GlobalWarningDisplayOff();  // VTK would print pages where one line does
  if (writer->Write() != 1 || writer->GetErrorCode() != vtkErrorCode::NoError)
    throw InputError("cannot write '" + path.string() + "': VTK gives no reason");
  write_text(path, writer->GetOutputString());
}

// Names of all fields of all interfaces, in the order of their first appearance, and their numbers of components.
std::vector<std::pair<std::string, Eigen::Index>> all_fields(const std::vector<InterfaceFrame>& interfaces) {
  std::vector<std::pair<std::string, Eigen::Index>> all;
  for (const InterfaceFrame& interface : interfaces) {
    for (const NamedField& field : interface.fields) {
      const auto known = std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.first == field.name; });
      if (known == all.end()) {
        all.emplace_back(field.name, field.values.rows());
      } else {
        CHECK(known->second == field.values.rows(), "field '" + field.name + "' has the same components everywhere");
      }
    }
  }
  return all;
}

Mat gathered(const std::vector<InterfaceFrame>& interfaces, const std::string& name, Eigen::Index n_components,
             Eigen::Index n_points) {
  const double missing = name == displacement_name ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  Mat all = Mat::Constant(n_components, n_points, missing);
  Eigen::Index first = 0;
  for (const InterfaceFrame& interface : interfaces) {
    for (const NamedField& field : interface.fields) {
      if (field.name == name) all.middleCols(first, interface.points.cols()) = field.values;
    }
    first += interface.points.cols();
  }
  return all;
}

}  // namespace

void write_part(const PartFrame& frame_of_part, const Frame& frame, const std::filesystem::path& path) {
  const Mesh& mesh = frame_of_part.mesh();
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, mesh.nodes.colwise() + frame_of_part.part->place);
  Cells cells;
  for (const CellBlock& block : mesh.blocks) {
    const CellShape& shape = cell_shape(block.type);
    for (int i = 0; i < block.n_cells(); ++i) cells.add(shape.vtk_type, {block.cell(i), shape.shape.nodes.size()}, 0);
  }
  if (!mesh.has_cells())
    for (const Facet& facet : boundary_facets(mesh)) cells.add(facet_shape(facet.type()).vtk_type, facet.nodes(), 0);
  cells.give_to(grid);
  add_field(grid, displacement_name, frame_of_part.displacement);
  for (const NamedField& field : frame_of_part.fields) {
    if (field.name != displacement_name) add_field(grid, field.name, field.values);
  }
  add_instant(grid, frame);
  write(grid, path);
}

namespace {

// One of the arrays that all pieces have.
std::string array_text(const std::string& name, Eigen::Index n_components) {
  std::string text = fmt::format("      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"",
                                 name == displacement_name ? "Float64" : "Float32", escaped(name), n_components);
  for (int i = 0; i < 6 && n_components == 6; ++i)
    text += fmt::format(" ComponentName{}=\"{}\"", i, tensor_components[i]);
  return text + "/>\n";
}

}  // namespace

void write_pieces(const PartFrame& frame_of_part, const Frame& frame, const std::vector<std::filesystem::path>& files,
                  const std::filesystem::path& path) {
  const auto field = [](const char* type, const char* name, const auto& value) {
    return fmt::format(
        "      <DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n", type, name,
        value);
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <FieldData>\n";
  text += field("Float64", "time", frame.time);
  text += field("Int32", "converged", frame.converged ? 1 : 0);
  text += field("Int32", "increments_not_converged", frame.missed);
  text += "    </FieldData>\n    <PPointData>\n" + array_text(displacement_name, 3);
  for (const NamedField& named : frame_of_part.fields)
    if (named.name != displacement_name) text += array_text(named.name, named.values.rows());
  text +=
      "    </PPointData>\n    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" "
      "NumberOfComponents=\"3\"/>\n    </PPoints>\n";
  for (const std::filesystem::path& file : files)
    text += fmt::format("    <Piece Source=\"{}\"/>\n", escaped(file.generic_string()));
  write_text(path, text + "  </PUnstructuredGrid>\n</VTKFile>\n");
}

void write_interfaces(const Frame& frame, const std::filesystem::path& path) {
  // Put the interfaces' points one after the other.
  Eigen::Index n_points = 0;
  for (const InterfaceFrame& interface : frame.interfaces) n_points += interface.points.cols();
  Points points(3, n_points);
  Cells cells;
  vtkNew<vtkIntArray> index;
  index->SetName("interface");
  std::vector<std::string> names;
  int first = 0;
  for (const InterfaceFrame& interface : frame.interfaces) {
    points.middleCols(first, interface.points.cols()) = interface.points;
    for (const Facet& facet : interface.facets) {
      cells.add(facet_shape(facet.type()).vtk_type, facet.nodes(), first);
      index->InsertNextValue(static_cast<int>(names.size()));
    }
    names.push_back(interface.name);
    first += static_cast<int>(interface.points.cols());
  }

  // Fill the grid.
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, points);
  cells.give_to(grid);
  grid->GetCellData()->AddArray(index);
  add_text(grid, "interface_name", names);
  for (const auto& [name, n_components] : all_fields(frame.interfaces)) {
    add_field(grid, name, gathered(frame.interfaces, name, n_components, n_points));
  }
  add_instant(grid, frame);
  write(grid, path);
}

std::string vtk_version() { return vtkVersion::GetVTKVersion(); }

}  // namespace dygita

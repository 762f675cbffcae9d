// Matrices of Nastran, Abaqus and CalculiX.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "intake/labelled_matrix.hpp"
#include "intake/superelement_file.hpp"

namespace dygita::labelled_matrix_tests {
namespace {

namespace fs = std::filesystem;

class LabelledMatrixFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dygita_labelled_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  LabelledMatrix read(const std::string& name, const std::string& text, MatrixRole role = MatrixRole::stiffness,
                      const std::string& called = "") const {
    return read_matrix(write(name, text), role, called);
  }
  std::string refusal(const std::string& name, const std::string& text, MatrixRole role = MatrixRole::stiffness,
                      const std::string& called = "") const {
    try {
      read(name, text, role, called);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

// 5 N/m between 12.1 and 30.1, and a scalar point beside.
void expect_spring(const LabelledMatrix& read) {
  Mat k(3, 3);
  k << 5.25, -5.25, 0, -5.25, 5.25, 0, 0, 0, 1e3;
  EXPECT_EQ(read.matrix, k);
  const std::vector<MatrixRow> rows{{12, 1}, {30, 1}, {101, 0}};
  EXPECT_EQ(read.rows, rows);
}

TEST_F(LabelledMatrixFile, reads_dmig_in_small_large_and_free_fields) {
  const std::string small =
      "$ punched\nSOL 103\nBEGIN BULK\nGRID    12              0.0     0.0     0.0\n"
      "DMIG    KAAX    0       6       1       0\n"
      "DMIG    KAAX    12      1               12      1       5.25\n"
      "        30      1       -5.25\n"
      "DMIG    KAAX    30      1               30      1       5.25    0.0\n"
      "DMIG    MAAX    0       6       1       0\n"
      "DMIG    MAAX    12      1               12      1       7.\n"
      "DMIG    KAAX    101     0               101     0       1.+3\nENDDATA\n";
  expect_spring(read("a.pch", small));
  expect_spring(read("a.bdf", small, MatrixRole::stiffness, "kaax"));
  EXPECT_EQ(read("a.pch", small, MatrixRole::mass).matrix, Mat::Constant(1, 1, 7.0));
  expect_spring(read("b.pch",
                     "DMIG*   KAAX                           0               6               2               0\n"
                     "*                                                                                      3\n"
                     "DMIG*   KAAX                          30               1\r\n"
                     "*                     12               1-5.250000000D+00\r\n"
                     "*                     30               1 5.250000000D+00$ a comment\n"
                     "DMIG*   KAAX                          12               1\n"
                     "*                     12               1 5.250000000D+00\n"
                     "DMIG*   KAAX                         101               0\n"
                     "*                    101               0 1.000000000D+03\n"));
  expect_spring(read("c.dat",
                     "DMIG,K2GG,0,1,2,0\nDMIG,K2GG,12,1,,12,1,5.25\n+,30,1,-5.25\nDMIG*,K2GG,30,1\n*,12,1,-5.25\n"
                     "*,30,1,.525E1\nDMIG,K2GG,101,,,101,,1000.\n"));
}

TEST_F(LabelledMatrixFile, refuses_dmig_by_line) {
  const std::string head = "DMIG    KAAX    0       6       1       0\n";
  const auto says = [&](const std::string& text, const std::string& what, const std::string& called = "") {
    const std::string said = refusal("a.pch", text, MatrixRole::stiffness, called);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  says("GRID    1\n", "has no matrix");
  says(head, "has no matrix 'KGG'\n    it has KAAX", "KGG");
  says(head + "DMIG    KGG     0       6       1       0\n",
       "more than one matrix whose name begins as that of a stiffness");
  says("DMIG    KAAX    12      1               12      1       5.\n", ":1: matrix 'KAAX' has no header before this");
  says(head + head, ":2: matrix 'KAAX' has a second header");
  says("DMIG    KAAX    0       6       3       0\n", ":1: matrix 'KAAX' is of type 3: real entries");
  says("DMIG    KAAX    0       2       1       0\n", ":1: matrix 'KAAX' has form 2: 1 (square) or 6");
  says(head + "DMIG    KAAX    12      1               12      1       5.x\n", ":2: an entry is expected, not '5.x'");
  says(head + "DMIG    KAAX    12      1               12      1       5.      1.\n",
       ":2: an entry of matrix 'KAAX' has an imaginary part");
  says(head + "DMIG    KAAX    12      7               12      1       5.\n", ":2: component 7 is not one of 0 to 6");
  says(head + "DMIG    KAAX    12      1               12      1       5.\n        12      1       5.\n",
       ":3: the entry of 12.1 and 12.1 is given twice");
  says(head +
           "DMIG    KAAX    12      1               30      1       5.\nDMIG    KAAX    30      1               12     "
           " 1       5.\n",
       "twice in a matrix that is said to be symmetric");
  says("DMIG    KAAX    0       1       1       0\nDMIG    KAAX    12      1               30      1       5.\n",
       "is not symmetric");
}

TEST_F(LabelledMatrixFile, reads_op4_in_columns_and_in_strings) {
  Mat k(3, 3);
  k << 4, -1, 0, -1, 4, 0, 0, 0, 2;
  const std::string dense =
      "       3       3       6       2KAAX    1P,3E16.9\n"
      "       1       1       2\n 4.000000000E+00-1.000000000E+00\n"
      "       2       1       2\n-1.000000000E+00 4.000000000E+00\n"
      "       3       3       1\n 2.000000000E+00\n"
      "       4       1       1\n 1.000000000E+00\n";
  const std::string strings =  // two words a number; length + 1 times 65536 and the row
      "       3       3       6       2MAAX    1P,3E16.9\n"
      "       1       0       5\n  327681\n 4.000000000D+00-1.000000000D+00\n"
      "       2       0       5\n  327681\n-1.000000000D+00 4.000000000D+00\n"
      "       3       0       3\n  196611\n 2.000000000D+00\n"
      "       4       1       1\n 1.000000000D+00\n";
  const std::string large =
      "       3      -3       6       2BAAX    1P,3E16.9\n"
      "       1       0       6\n       5       1\n 4.000000000E+00-1.000000000E+00\n"
      "       2       0       6\n       5       1\n-1.000000000E+00 4.000000000E+00\n"
      "       3       0       4\n       3       3\n 2.000000000E+00\n"
      "       4       1       1\n 1.000000000E+00\n";
  for (const MatrixRole role : {MatrixRole::stiffness, MatrixRole::mass, MatrixRole::damping}) {
    const LabelledMatrix found = read("a.op4", dense + strings + large, role);
    EXPECT_EQ(found.matrix, k) << text_of(role);
    EXPECT_TRUE(found.rows.empty());
  }
  EXPECT_NE(refusal("a.op4", dense.substr(0, 90)).find(":3: an entry is expected, not the end of the line"),
            std::string::npos)
      << refusal("a.op4", dense.substr(0, 90));
  EXPECT_NE(refusal("a.op4", "binary\n").find(":1: this is no OUTPUT4 text"), std::string::npos);
  EXPECT_NE(refusal("a.op4",
                    "       3       2       2       2KAAX    1P,3E16.9\n       4       1       1\n 1.000000000E+00\n")
                .find("2 x 3: a square matrix is expected"),
            std::string::npos);
  EXPECT_NE(refusal("a.op4",
                    "  100000  100000       6       2KAAX    1P,3E16.9\n  100001       1       1\n 1.000000000E+00\n")
                .find("at most 8000"),
            std::string::npos);
}

TEST_F(LabelledMatrixFile, reads_what_abaqus_and_calculix_write) {
  Mat k(2, 2);
  k << 5.25, -5.25, -5.25, 5.25;
  const std::vector<MatrixRow> rows{{12, 1}, {30, 1}};
  const LabelledMatrix input = read("a.mtx", "12,1,12,1,5.25\n30,1,12,1,-5.25\n30,1,30,1,5.25\n");
  EXPECT_EQ(input.matrix, k);
  EXPECT_EQ(input.rows, rows);
  const std::string element =
      "**\n** GENERATION OF SUBSTRUCTURE\n*USER ELEMENT,NODES=         2,LINEAR\n** ELEMENT NODES\n"
      "**        30,        12\n         1\n*MATRIX,TYPE=STIFFNESS\n 0.525E+01,\n-0.525E+01, 0.525E+01,\n"
      "*MATRIX,TYPE=MASS\n2.,\n0., 3.,\n";
  EXPECT_EQ(read("b.mtx", element).matrix, k);
  EXPECT_EQ(read("b.mtx", element).rows, rows);
  EXPECT_EQ(read("b.mtx", element, MatrixRole::mass).matrix.diagonal(), Eigen::Vector2d(3.0, 2.0));
  write("c.dof", "12.1\n30.1\n");
  const LabelledMatrix stored = read("c.sti", "1 1  5.2500000000000e+00\n1 2 -5.2500000000000e+00\n2 2  5.25e+00\n");
  EXPECT_EQ(stored.matrix, k);
  EXPECT_EQ(stored.rows, rows);
  EXPECT_NE(refusal("b.mtx", element, MatrixRole::damping).find("is a user element, which has no damping"),
            std::string::npos);
  EXPECT_NE(refusal("d.sti", "1 1 5\n").find("d.dof"), std::string::npos);
  EXPECT_NE(refusal("c.sti", "1 1 5\n3 3 5\n").find(":2: there is no row 3 of 2"), std::string::npos);
  EXPECT_NE(refusal("a.mtx", "12,1,12,1,5.25\n12,1,12\n").find(":2: 3 fields"), std::string::npos);
}

// The same body in millimetres, tonnes and seconds.
TEST_F(LabelledMatrixFile, makes_a_body_by_units_and_checks_its_mass) {
  std::string text = "DMIG    KAAX    0       6       2       0\nDMIG    MAAX    0       6       2       0\n";
  for (const char* d : {"1", "2", "3"}) {
    text += std::string("DMIG,KAAX,7,") + d + ",,7," + d + ",5.\n,9," + d + ",-5.\n";
    text += std::string("DMIG,KAAX,9,") + d + ",,9," + d + ",5.\n";
    for (const char* node : {"7", "9"})
      text += std::string("DMIG,MAAX,") + node + "," + d + ",," + node + "," + d + ",2.E-3\n";
  }
  MatrixFiles files{write("a.pch", text),
                    write("a.pch", text),
                    {},
                    write("p.csv", "face,node,x,y,z\nend,9,100,0,0\nstart,7,0,0,0\n")};
  const auto said = [&] {
    try {
      read_matrices(files);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(said().find("'units' is missing"), std::string::npos) << said();
  files.units = MatrixUnits{1e-3, 1e3, 1.0};
  files.total_mass = 4.0;
  const MeshPtr mesh = read_matrices(files);
  EXPECT_NEAR(mesh->inside->mass(0.0), 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(mesh->inside->matrices()->stiffness.coeff(0, 0), 5e3);
  EXPECT_EQ(mesh->nodes.col(0), Vec3(0.1, 0.0, 0.0));
  files.total_mass = 4e-3;
  EXPECT_NE(said().find("the body weighs 4 kg, but 'total_mass' is 0.004 kg"), std::string::npos) << said();
  files.total_mass = {};
  files.points = write("p.csv", "face,node,x,y,z\nend,8,100,0,0\n");
  EXPECT_NE(said().find(":2: the matrices have no row of node 8 along x"), std::string::npos) << said();
  files.points = write("p.csv", "face,x,y,z\nend,100,0,0\n");
  EXPECT_NE(said().find("has no column 'node'"), std::string::npos) << said();
}

}  // namespace
}  // namespace dygita::labelled_matrix_tests

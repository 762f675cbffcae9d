// Reading of condensed bodies: Matrix Market, points, descriptions; and what a condensed body knows of itself.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.hpp"
#include "intake/matrix_market.hpp"
#include "intake/superelement_file.hpp"

namespace dygita::superelement_file_tests {
namespace {

namespace fs = std::filesystem;

class SuperelementFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dygita_matrices_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string refusal(const std::string& text) const {
    try {
      read_matrix_market(write("matrix.mtx", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  // Of two points that a spring of 5 N/m joins along x and 1 N/m across, 2 kg each.
  MatrixFiles spring(const std::string& points = "face,x,y,z\nend,0,0,0\nend,1,0,0\n") const {
    std::string k = "%%MatrixMarket matrix coordinate real symmetric\n6 6 9\n",
                m = "%%MatrixMarket matrix coordinate integer general\n6 6 6\n";
    for (int i = 1; i <= 6; ++i) {
      k += std::to_string(i) + " " + std::to_string(i) + (i % 3 == 1 ? " 5\n" : " 1\n");
      m += std::to_string(i) + " " + std::to_string(i) + " 2\n";
    }
    for (int i = 1; i <= 3; ++i) k += std::to_string(i + 3) + " " + std::to_string(i) + (i == 1 ? " -5\n" : " -1\n");
    return {write("k.mtx", k), write("m.mtx", m), {}, write("points.csv", points)};
  }
  std::string refusal(const MatrixFiles& files) const {
    try {
      read_matrices(files);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(SuperelementFile, reads_arrays_and_coordinates_of_one_triangle_or_both) {
  Mat expected(2, 2);
  expected << 3, -1.5, -1.5, 2;
  for (const char* text :
       {"%%MatrixMarket matrix array real symmetric\n% of a test\n2 2\n3\n-1.5\n2\n",
        "%%matrixmarket MATRIX Array Real General\n%\n% two lines\n2 2\n3\n-1.5\n-1.5\n2\n",
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 3\n2 1 -1.5\n2 2 2.0e0\n",
        "%%MatrixMarket matrix coordinate real general\r\n2 2 4\r\n1 1 3\r\n2 1 -1.5\r\n1 2 -1.5\r\n2 2 +2\r\n"})
    EXPECT_EQ(read_matrix_market(write("matrix.mtx", text)).matrix, expected) << text;
}

TEST_F(SuperelementFile, refuses_what_is_no_symmetric_matrix) {
  const std::string head = "%%MatrixMarket matrix array real general\n";
  EXPECT_NE(refusal("1 2\n3 4\n").find("not in Matrix Market format"), std::string::npos);
  EXPECT_NE(refusal("%%MatrixMarket matrix array complex general\n").find("got 'array complex general'"),
            std::string::npos);
  EXPECT_NE(refusal(head + "2 3\n").find("2 x 3: a square matrix is expected"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2\n1\n2\n3\n").find("an entry is expected, not the end of the file"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2\n1\n2\n2\n1\n7\n").find("the end of the matrix is expected, not '7'"),
            std::string::npos);
  EXPECT_NE(refusal(head + "2 2\n1\n2\nx\n1\n").find(":5: an entry is expected, not 'x'"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2\n1\n2\n3\n1\n").find("is not symmetric: 2 in row 2, column 1, but 3 transposed"),
            std::string::npos);
  EXPECT_NE(refusal(head + "1 1\nnan\n").find("an entry that is not finite"), std::string::npos);
  EXPECT_NE(refusal(head + "1000000 1000000\n").find("at most 8000 are allowed"), std::string::npos);
  EXPECT_NE(refusal("%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n3 1 5\n")
                .find("an entry in row 3, column 1 of 2 x 2"),
            std::string::npos);
}

TEST_F(SuperelementFile, knows_its_mass_and_which_motions_nothing_resists) {
  const MeshPtr mesh = read_matrices(spring());
  const CondensedBody& body = *mesh->inside->matrices();
  EXPECT_EQ(mesh->point_groups.at("end"), (std::vector<int>{0, 1}));
  EXPECT_EQ(body.n_rows(), 6);
  EXPECT_DOUBLE_EQ(body.mass_of_parts, 4.0);
  // The springs across resist a rotation about y or z, and nothing else is resisted.
  const auto resisted = body.resisted_motions(mesh->nodes);
  ASSERT_EQ(resisted.cols(), 2);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(resisted.col(i).head<4>().norm() * resisted(3, i), 0.0, 1e-9);
  EXPECT_FALSE(body.resists(mesh->nodes, Vec3(1, 2, 3)));
}

TEST_F(SuperelementFile, turns_with_its_matrices) {
  const MeshPtr mesh = read_matrices(spring());
  const Mat3 quarter = Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vec3::UnitZ()).toRotationMatrix();
  const MeshPtr turned = turned_mesh(*mesh, quarter, Vec3::Zero());
  EXPECT_NEAR(turned->nodes(1, 1), 1.0, 1e-15);
  EXPECT_NEAR(turned->inside->matrices()->stiffness.coeff(1, 1), 5.0, 1e-12);  // what was along x is along y
  EXPECT_NEAR(turned->inside->matrices()->stiffness.coeff(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(turned->inside->matrices()->stiffness.coeff(4, 1), -5.0, 1e-12);
  EXPECT_NE(turned->digest, mesh->digest);
}

// Rows that are no modes move with the body.
TEST_F(SuperelementFile, carries_rows_without_a_point_along) {
  const MeshPtr mesh = read_matrices(spring("face;x;y;z;row_x;row_y;row_z\nend;0;0;0;1;2;3\n"));
  const CondensedBody& body = *mesh->inside->matrices();
  const Points moved = body.rigid_motion(mesh->nodes, Vec3(1, 2, 3), Vec3::Zero());
  EXPECT_LT((moved.col(0) - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((moved.col(1) - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_NEAR(body.mass_of_parts, 4.0, 1e-12);
}

TEST_F(SuperelementFile, refuses_points_and_matrices_that_do_not_belong_together) {
  EXPECT_NE(refusal(spring("face,x,y,z\n")).find("has no point"), std::string::npos);
  EXPECT_NE(refusal(spring("end,0,0,0\n")).find("the first line must have titles"), std::string::npos);
  EXPECT_NE(refusal(spring("face,x,y\nend,0,0\n")).find("column 'z' is missing"), std::string::npos);
  EXPECT_NE(refusal(spring("face,x,y,z,row_x\nend,0,0,0,1\n")).find("give all of row_x, row_y and row_z, or none"),
            std::string::npos);
  EXPECT_NE(refusal(spring("face,x,y,z\nend,0,0\n")).find(":2: 3 columns, but the line of titles has 4"),
            std::string::npos);
  EXPECT_NE(refusal(spring("face,x,y,z\nend,0,zero,0\n")).find("'zero' of column 'y' is not a finite number"),
            std::string::npos);
  EXPECT_NE(refusal(spring("face,x,y,z,row_x,row_y,row_z\nend,0,0,0,5,6,7\n")).find("has row 7, and"),
            std::string::npos);
  EXPECT_NE(
      refusal(spring("face,x,y,z,row_x,row_y,row_z\nend,0,0,0,5,6,1.5\n")).find("must be the number of a row, from 1,"),
      std::string::npos);
  MatrixFiles files = spring();
  files.mass = write("m.mtx", "%%MatrixMarket matrix array real general\n1 1\n2\n");
  EXPECT_NE(refusal(files).find("they do not belong to one body"), std::string::npos);
  files = spring();
  files.mass = write("m.mtx", "%%MatrixMarket matrix coordinate real general\n6 6 1\n6 6 -2\n");
  EXPECT_NE(refusal(files).find("is no mass matrix: its diagonal entry in row 6 is -2"), std::string::npos);
  files = spring();
  files.stiffness = write(
      "k.mtx",
      "%%MatrixMarket matrix coordinate real symmetric\n6 6 7\n1 1 1\n2 2 1\n3 3 1\n4 4 1\n5 5 1\n6 6 1\n2 1 1.5\n");
  EXPECT_NE(refusal(files).find("is no stiffness matrix: it is not positive semidefinite"), std::string::npos);
}

// What output.superelement writes; its matrices are told by their digests.
TEST_F(SuperelementFile, reads_a_description_and_refuses_what_has_been_changed) {
  const MatrixFiles files = spring();
  const auto described = [&](const std::string& digest, const std::string& rest) {
    return write(
        "spring.json",
        "{\"what\": \"dygita superelement\", \"version\": 1, \"motion\": \"nodes\", \"n_rows\": 6, \"valid_to\": 10, "
        "\"mass_of_parts\": 4, \"increments_not_converged\": 0,\n\"mass\": {\"file\": \"m.mtx\", \"digest\": \"" +
            read_matrix_market(files.mass).digest + "\"}, \"stiffness\": {\"file\": \"k.mtx\", \"digest\": \"" +
            digest + "\"},\n" + rest + "}");
  };
  const auto told = [](const std::string& file) -> std::string {
    try {
      read_superelement(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string digest = read_matrix_market(files.stiffness).digest;
  const std::string nodes =
      "\"nodes\": [{\"place\": [0, 0, 0], \"rows\": [1, 2, 3]}, {\"place\": [1, 0, 0], \"rows\": [4, 5, 6]}, "
      "{\"place\": [0, 1, 0], \"rows\": [0, 0, 0]}]";
  const std::string faces =
      ", \"faces\": [{\"name\": \"side\", \"points\": [1, 2, 3], \"facets\": [{\"type\": 5, \"nodes\": [1, 2, 3]}]}]";
  const MeshPtr mesh = read_superelement(described(digest, nodes + faces));
  EXPECT_EQ(mesh->faces.at("side").size(), 1u);
  EXPECT_EQ(mesh->inside->held.size(), 3u);  // rows 0: a support was condensed with it
  EXPECT_EQ(mesh->inside->valid_to, 10.0);
  EXPECT_NE(told(described("0123", nodes + faces)).find("is not the stiffness that"), std::string::npos);
  EXPECT_NE(told(described(digest, nodes)).find("an entry is missing"), std::string::npos);
  EXPECT_NE(told(described(digest, "\"nodes\": [{\"place\": [0, 0, 0], \"rows\": [1, 2, 9]}]" + faces))
                .find("there is no row 9"),
            std::string::npos);
  EXPECT_NE(told(described(digest, "\"nodes\": [{\"place\": [0, 0, 0], \"rows\": [1, 2, 2]}], \"faces\": []"))
                .find("has row 2 twice"),
            std::string::npos);
  EXPECT_NE(told(described(digest, "\"nodes\": [{\"place\": [0, 0, 0], \"rows\": [1, 2, -1]}]" + faces))
                .find("is that of another face"),
            std::string::npos);
  EXPECT_NE(told(described(digest, nodes + ", \"faces\": [{\"name\": \"side\", \"points\": [1], \"facets\": "
                                           "[{\"type\": 5, \"nodes\": [1, 2]}]}]"))
                .find("a facet of type 5 with 2 nodes"),
            std::string::npos);
  EXPECT_NE(told(write("other.json", "{\"what\": 5}")).find("its 'what' is not"), std::string::npos);
  EXPECT_NE(
      told(write("later.json", "{\"what\": \"dygita superelement\", \"version\": \"2\"}")).find("by a later version"),
      std::string::npos);
  EXPECT_NE(told(write("none.json", "[[[")).find("it is no JSON"), std::string::npos);
}

// Bytes changed, left out or doubled: it is read, or refused with a message, and nothing else.
TEST_F(SuperelementFile, reads_or_refuses_what_has_been_spoiled) {
  const MatrixFiles files = spring();
  const std::string good =
      "{\"what\": \"dygita superelement\", \"version\": 1, \"motion\": \"mean\", \"n_rows\": 6, \"valid_to\": 10, "
      "\"mass_of_parts\": 4, \"increments_not_converged\": 0, \"mass\": {\"file\": \"m.mtx\", \"digest\": \"" +
      read_matrix_market(files.mass).digest + "\"}, \"stiffness\": {\"file\": \"k.mtx\", \"digest\": \"" +
      read_matrix_market(files.stiffness).digest +
      "\"}, \"faces\": [{\"name\": \"end\", \"centre\": [0.3, 0.3, 0], \"rows\": [1, 2, 3, 4, 5, 6], \"nodes\": [[0, "
      "0, 0], [1, 0, 0], "
      "[0, 1, 0]], \"facets\": [{\"type\": 5, \"nodes\": [1, 2, 3]}]}]}";
  ASSERT_EQ(read_superelement(write("good.json", good))->faces.at("end").size(), 1u);
  const std::string alphabet = "{}[],:\"0123456789-+.eE xn";
  std::mt19937 random(3);
  int n_read = 0, n_refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = good;
    for (int k = 0; k <= round % 3; ++k) {
      const size_t at = random() % text.size();
      const char with = alphabet[random() % alphabet.size()];
      if (round % 4 == 0)
        text.erase(at, 1 + random() % 20);
      else if (round % 4 == 1)
        text.insert(at, text.substr(at, random() % 30));
      else
        text[at] = with;
    }
    try {
      read_superelement(write("spoiled.json", text));
      ++n_read;
    } catch (const InputError&) {
      ++n_refused;
    }
  }
  EXPECT_GT(n_read, 50);
  EXPECT_GT(n_refused, 1000);
}

}  // namespace
}  // namespace dygita::superelement_file_tests

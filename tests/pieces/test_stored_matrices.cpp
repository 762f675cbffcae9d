// Matrices that are given up come back as they were.
#include <gtest/gtest.h>

#include "pieces/piece_case.hpp"
#include "pieces/stored_matrices.hpp"

namespace dygita {
namespace {

MeshPtr stored_mesh() { return box_mesh(Vec3::Zero(), {0.01, 0.02, 0.03}, {2, 3, 4}); }

void expect_same_bits(const SparseMatrix& a, const SparseMatrix& b) {
  ASSERT_EQ(a.nonZeros(), b.nonZeros());
  EXPECT_TRUE(std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()));
  EXPECT_TRUE(std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()));
  EXPECT_TRUE(std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()));
}

TEST(StoredMatrices, are_there_as_long_as_somebody_holds_them_and_assembled_again_to_the_same_bits) {
  const MeshPtr mesh = stored_mesh();
  const BodyMatrices plain = assemble(*mesh, steel());
  for (const bool keeps : {true, false}) {
    const StoredMatrices stored(mesh, steel(), keeps);
    EXPECT_EQ(stored.mass(), plain.mass);
    EXPECT_EQ(stored.n_pairs(), 0.5 * (plain.stiffness.nonZeros() / 9.0 - mesh->n_nodes()));
    EXPECT_EQ(stored.bytes(), keeps ? 12.0 * plain.stiffness.nonZeros() : 0.0);
    {
      const StiffnessPtr held = stored.stiffness();
      expect_same_bits(*held, plain.stiffness);
      stored.give_up();
      EXPECT_EQ(stored.bytes(), 0.0);
      EXPECT_EQ(stored.stiffness(), held) << "who comes later shares it";
    }
    expect_same_bits(*stored.stiffness(), plain.stiffness);
  }
}

TEST(StoredMatrices, have_the_edges_of_the_matrix_before_and_after) {
  const MeshPtr mesh = stored_mesh();
  const EdgeBlocks plain(assemble(*mesh, steel()).stiffness, mesh->nodes);
  const Vec x = Vec::Random(4 * mesh->n_nodes());
  const auto times = [&](const EdgeBlocks& edges) {
    Vec y = Vec::Zero(x.size());
    edges.add_product(x.data(), y.data());
    return y;
  };
  for (const bool keeps : {true, false}) {
    const StoredMatrices stored(mesh, steel(), keeps);
    EXPECT_EQ(times(*stored.edges()), times(plain));
    EXPECT_EQ(stored.edges(), stored.edges());
    const std::shared_ptr<const EdgeBlocks> held = stored.edges();
    stored.give_up();
    EXPECT_EQ(stored.edges(), held);
  }
  const StoredMatrices stored(mesh, steel(), false);
  stored.give_up();
  EXPECT_EQ(times(*stored.edges()), times(plain)) << "made of a matrix that was assembled for them";
}

TEST(StoredMatrices, in_memory_of_others_are_the_same_to_the_bit) {
  SpareMatrices spares;
  for (const int n : {5, 3, 4, 7, 2}) {
    const MeshPtr mesh = box_mesh(Vec3::Zero(), {0.01, 0.02, 0.03}, {2, n, 4});
    const BodyMatrices plain = assemble(*mesh, steel());
    const std::unique_ptr<SparseMatrix> memory = spares.take();
    const BodyMatrices again = assemble(*mesh, steel(), memory.get());
    expect_same_bits(again.stiffness, plain.stiffness);
    EXPECT_EQ(again.mass, plain.mass);
    EXPECT_EQ(memory->nonZeros(), 0);
    const StoredMatrices stored(mesh, steel(), false, &spares);
    const EdgeBlocks edges(plain.stiffness, mesh->nodes);
    const Vec x = Vec::Random(4 * mesh->n_nodes());
    Vec y = Vec::Zero(x.size()), y_plain = y;
    stored.edges()->add_product(x.data(), y.data());
    edges.add_product(x.data(), y_plain.data());
    EXPECT_EQ(y, y_plain);
    const std::unique_ptr<SparseMatrix> spared = spares.take();
    EXPECT_EQ(spared->nonZeros(), plain.stiffness.nonZeros()) << "what it was made of, for the next";
    spares.give(std::make_unique<SparseMatrix>(*spared));
  }
}

TEST(StoredMatrices, given_as_they_are_stay) {
  const MeshPtr mesh = stored_mesh();
  BodyMatrices own = assemble(*mesh, steel());
  own.stiffness *= 2.0;
  const SparseMatrix expected = own.stiffness;
  const StoredMatrices stored(std::move(own));
  stored.give_up();
  expect_same_bits(*stored.stiffness(), expected);
}

}  // namespace
}  // namespace dygita

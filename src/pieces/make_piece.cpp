#include "pieces/make_piece.hpp"

#include <algorithm>
#include <cmath>

#include "pieces/equal_pieces.hpp"

namespace dygita {

namespace {

// What is known of a piece before anything is factorised.
struct Layout {
  FreeUnknowns unknowns;
  std::vector<char> is_interface, none;  // of the free unknowns

  explicit Layout(const PieceSetup& setup)
      : unknowns(unknowns_of(setup)), is_interface(unknowns.at_rows(setup.rows)), none(unknowns.size(), 0) {}
  double n_interface() const { return static_cast<double>(std::count(is_interface.begin(), is_interface.end(), 1)); }
};

// Of an entry of H that is stored with such an error: fitted to the operators of the bolted flanges.
double bytes_of_entry(double error) { return std::max(0.0, 0.1 * std::log2(1.0 / error) - 1.5); }

double bytes_of_operator_entry(const PieceSetup& setup) {
  return setup.precision == Precision::double_precision ? 8.0 : bytes_of_entry(setup.storage_error / 16.0);
}

double factor_bytes(const PieceSetup& setup, const SparseMatrix& matrix, const Layout& layout,
                    const std::vector<char>& is_interface) {
  return Factor::predicted_bytes(matrix, layout.unknowns.node_of_unknown(), is_interface, setup.precision,
                                 setup.storage_error);
}

// Bytes that an iteration reads in each form, the two condensed substitutions of a time step spread over the usual
// number of iterations. Gives the bytes of the factor in full where that is less, else nothing.
std::optional<double> cheaper_in_full(const PieceSetup& setup, const SparseMatrix& matrix, const Layout& layout) {
  constexpr double solves = 6.0;
  const double n_b = layout.n_interface(), n = layout.unknowns.size();
  if (n_b < 0.3 * n || n_b < 300) return {};  // never seen to pay; saves the second ordering
  const double full = factor_bytes(setup, matrix, layout, layout.none);
  const double interior = n_b < n ? factor_bytes(setup, matrix, layout, layout.is_interface) : 0.0;
  const double products = solves * bytes_of_operator_entry(setup) * 0.5 * n_b * n_b;
  return solves * 2.0 * full < 2.0 * interior + products ? std::optional(full) : std::nullopt;
}

// With the operator of another.
std::unique_ptr<ImplicitPiece> make_equal(const PieceSetup& setup, bool is_plain, const Twin& twin) {
  PieceOperator op(setup, FreeUnknowns(twin.piece->op().unknowns(), twin.turn, setup.held));
  Condensation condensation = *twin.piece->condensation();
  if (!have_equal_rows(twin.piece->op(), op)) condensation.set_diagonal(op);
  if (is_plain) return std::make_unique<FullPiece>(std::move(op), std::move(condensation), true);
  return std::make_unique<CondensedPiece>(std::move(op), std::move(condensation),
                                          static_cast<const CondensedPiece*>(twin.piece));
}

}  // namespace

std::unique_ptr<ImplicitPiece> make_piece(const PieceSetup& setup, bool is_plain, const Twin& twin) {
  if (twin.piece && twin.piece->condensation()) return make_equal(setup, is_plain, twin);
  if (const auto* full = twin.is_same ? dynamic_cast<const FullPiece*>(twin.piece) : nullptr)
    return std::make_unique<FullPiece>(PieceOperator(setup, unknowns_of(setup)), *full);
  Layout layout(setup);
  FreeUnknowns& unknowns = layout.unknowns;
  if (unknowns.size() == 0) return std::make_unique<ImplicitPiece>(PieceOperator(setup, unknowns));
  const SparseMatrix matrix = matrix_with_reference(setup, unknowns);
  if (cheaper_in_full(setup, matrix, layout))
    return std::make_unique<FullPiece>(PieceOperator(setup, unknowns), std::nullopt, false);
  auto own = std::make_unique<Factor>(matrix, unknowns.node_of_unknown(), layout.is_interface, setup.what,
                                      setup.precision, setup.storage_error);
  unknowns.put_in_order(own->order());
  PieceOperator op(setup, std::move(unknowns));
  Condensation condensation(std::move(own), op);
  if (is_plain) return std::make_unique<FullPiece>(std::move(op), std::move(condensation), false);
  return std::make_unique<CondensedPiece>(std::move(op), std::move(condensation), nullptr);
}

double predicted_bytes(const PieceSetup& setup, bool has_twin) {
  const Layout layout(setup);
  const double vectors = 8.0 * 12.0 * layout.unknowns.size();
  if (layout.unknowns.size() == 0) return vectors;
  const SparseMatrix matrix = matrix_with_reference(setup, layout.unknowns);
  if (const std::optional<double> full = cheaper_in_full(setup, matrix, layout)) return *full + vectors;
  if (has_twin) return vectors;
  const double n_b = layout.n_interface();
  const double entry =
      bytes_of_operator_entry(setup) + (setup.half_error > 0.0 ? bytes_of_entry(setup.half_error) : 0.0);
  return factor_bytes(setup, matrix, layout, layout.is_interface) + entry * 0.5 * n_b * n_b + vectors;
}

}  // namespace dygita

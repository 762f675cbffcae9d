// Every kind of kernels that this processor can run, against plain loops over the same entries.
#include <gtest/gtest.h>

#include <random>

#include "base/error.hpp"
#include "numerics/panel_choice.hpp"
#include "numerics/panels.hpp"

namespace dygita {
namespace {

constexpr int room = Panels::height;

// A panel of numbers that fall off downwards, so that all ways of storing tiles occur; pivots are inverted.
struct PanelCase {
  int n_rows, n_columns;
  Precision precision;
  Panels panels;
  Mat entries;  // as they are stored

  PanelCase(int rows, int columns, Precision how, bool is_symmetric)
      : n_rows(rows), n_columns(columns), precision(how), panels(how), entries(rows, columns) {
    std::mt19937 generator(static_cast<unsigned>(17 * rows + columns));
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    Mat values(rows, columns);
    for (int c = 0; c < columns; ++c)
      for (int r = 0; r < rows; ++r) values(r, c) = number(generator) * std::pow(10.0, -r / 12.0);
    for (int c = 0; c < columns; ++c) {
      values(c, c) = 1.5 + number(generator);
      for (int r = 0; r < c; ++r) values(r, c) = is_symmetric ? values(c, r) : 0.0;
    }
    const Vec tolerance = Vec::Constant(rows, 1e-6);
    const Mat top = values.topRows(columns);
    values.topRows(columns).setConstant(1e30);  // must not be read
    panels.add(top.data(), values.data(), rows, rows, columns, tolerance.data());
    panels.unpack(0, entries.data(), rows);
  }

  double tolerance() const { return precision == Precision::double_precision ? 1e-14 : 3e-6; }
  Vec vector(int n = 1) const {
    return Vec::NullaryExpr((n_rows + room) * n, [](Eigen::Index i) { return std::sin(1.0 + i); });
  }

  // L x = y for the first rows, the others less their products; U with the transposed: plain loops.
  Vec forward(Vec y) const {
    for (int c = 0; c < n_columns; ++c) {
      y[c] *= entries(c, c);
      for (int r = c + 1; r < n_rows; ++r) y[r] -= entries(r, c) * y[c];
    }
    return y;
  }
  Vec backward(Vec y) const {
    for (int c = n_columns; c-- > 0;) {
      for (int r = c + 1; r < n_rows; ++r) y[c] -= entries(r, c) * y[r];
      y[c] *= entries(c, c);
    }
    return y;
  }
  Vec product(const Vec& x, Vec y) const {
    for (int c = 0; c < n_columns; ++c)
      for (int r = 0; r < n_rows; ++r) {
        y[r] += entries(r, c) * x[c];
        if (r >= n_columns) y[c] += entries(r, c) * x[r];
      }
    return y;
  }
};

class Kernels : public ::testing::TestWithParam<std::string> {
 protected:
  Kernels() { use_panel_kernels(GetParam()); }
  ~Kernels() override { use_panel_kernels(available_panel_kernels().front()); }

  template <class Check>
  void for_each_case(bool is_symmetric, Check check) {
    for (const Precision precision : {Precision::double_precision, Precision::single_precision})
      for (int columns = 1; columns <= Panels::width; ++columns)
        for (const int rows : {columns, 15, 16, 33, 100, 400}) {
          SCOPED_TRACE(testing::Message()
                       << rows << " x " << columns << (precision == Precision::double_precision ? "" : ", single"));
          if (rows >= columns) check(PanelCase(rows, columns, precision, is_symmetric));
        }
  }
};

void expect_close(const Vec& found, const Vec& expected, double tolerance) {
  EXPECT_LT((found - expected).norm(), tolerance * expected.norm());
}

TEST_P(Kernels, are_those_in_use) { EXPECT_EQ(panel_kernels().name, GetParam()); }

TEST_P(Kernels, substitute_as_plain_loops_do) {
  for_each_case(false, [](const PanelCase& c) {
    Vec y = c.vector();
    c.panels.forward(0, y.data());
    expect_close(y.head(c.n_rows), c.forward(c.vector()).head(c.n_rows), c.tolerance());
    y = c.vector();
    y.tail(room).setZero();
    c.panels.backward(0, 0, y.data());
    expect_close(y.head(c.n_rows), c.backward(c.vector()).head(c.n_rows), c.tolerance());
  });
}

TEST_P(Kernels, substitute_several_right_hand_sides_as_plain_loops_do) {
  for_each_case(false, [](const PanelCase& c) {
    for (const int n : {1, 2}) {
      const int side = 8 * n;
      const Vec all = c.vector(side);
      Vec down = all, up = all;
      up.tail(room * side).setZero();
      c.panels.forward(0, down.data(), n);
      c.panels.backward(0, up.data(), n);
      for (int s = 0; s < side; ++s) {
        const auto one = [&](const Vec& y) {
          return Vec(
              Eigen::Map<const Vec, 0, Eigen::InnerStride<>>(y.data() + s, c.n_rows, Eigen::InnerStride<>(side)));
        };
        expect_close(one(down), c.forward(one(all)), 1e-13);
        expect_close(one(up), c.backward(one(all)), 1e-13);
      }
    }
  });
}

// One of sixteen vectors that lie side by side.
Vec of_sixteen(const Vec& y, int which, int n_rows) {
  return Eigen::Map<const Vec, 0, Eigen::InnerStride<>>(y.data() + which, n_rows,
                                                        Eigen::InnerStride<>(Panels::together));
}

TEST_P(Kernels, substitute_sixteen_right_hand_sides_as_plain_loops_do) {
  for_each_case(false, [](const PanelCase& c) {
    if (c.precision == Precision::double_precision) return;  // those have no sums in single precision
    const int side = Panels::together;
    const Vec all = c.vector(side), left = 0.25 * c.vector(side).reverse();
    Vec down = all, up = all;
    up.tail(room * side).setZero();
    Eigen::VectorXf below = left.cast<float>(), rows = up.cast<float>();
    c.panels.forward(0, down.data(), below.data());
    c.panels.backward(0, up.data(), rows.data());
    const Vec sum = down + below.cast<double>();
    for (int s = 0; s < side; ++s) {
      const auto one = [&](const Vec& y) { return of_sixteen(y, s, c.n_rows); };
      expect_close(one(sum), c.forward(one(all) + one(left)), c.tolerance());
      expect_close(one(up), c.backward(one(all)), c.tolerance());
      expect_close(one(rows.cast<double>()).head(c.n_columns), one(up).head(c.n_columns), 1e-7);
    }
  });
}

TEST_P(Kernels, multiply_sixteen_vectors_as_plain_loops_do) {
  for_each_case(true, [](const PanelCase& c) {
    const int side = Panels::together;
    Vec x = c.vector(side), y = 0.5 * c.vector(side).reverse();
    const Vec before = y;
    x.tail(room * side).setZero();
    if (c.precision == Precision::double_precision) {
      c.panels.multiply_together(0, x.data(), y.data());
    } else {
      const Eigen::VectorXf single = x.cast<float>();
      Eigen::VectorXf below = Eigen::VectorXf::Zero(y.size());
      c.panels.multiply_together(0, single.data(), below.data(), y.data());
      y += below.cast<double>();
    }
    for (int s = 0; s < side; ++s) {
      const auto one = [&](const Vec& v) { return of_sixteen(v, s, c.n_rows + room); };
      expect_close(one(y).head(c.n_rows), c.product(one(x), one(before)).head(c.n_rows), c.tolerance());
    }
  });
}

TEST_P(Kernels, multiply_as_plain_loops_do) {
  for_each_case(true, [](const PanelCase& c) {
    Vec x = c.vector(), y = 0.5 * c.vector();
    x.tail(room).setZero();
    const Vec expected = c.product(x, y);
    if (c.precision == Precision::double_precision) {
      c.panels.multiply_symmetric(0, x.data(), y.data());
    } else {
      const Eigen::VectorXf single = x.cast<float>();
      c.panels.multiply_symmetric(0, single.data(), y.data());
    }
    expect_close(y.head(c.n_rows), expected.head(c.n_rows), c.tolerance());
  });
}

INSTANTIATE_TEST_SUITE_P(Available, Kernels, ::testing::ValuesIn(available_panel_kernels()),
                         [](const auto& kernels) { return kernels.param; });

// A factor of other numbers has a few tiles more or fewer: it is written where the one before was.
TEST(Chunks, stay_where_they_are_once_a_second_filling_of_about_the_same_size_has_begun) {
  constexpr size_t piece = 100000;
  Chunks chunks;
  const auto fill = [&](int n_pieces) {
    const std::byte* const first = chunks.room(piece);
    for (int i = 0; i < n_pieces; ++i, chunks.take(piece)) chunks.room(piece)[piece - 1] = std::byte{1};
    const std::byte* const last = chunks.room(piece) - piece;
    chunks.clear();
    return std::pair(first, last);
  };
  fill(40);
  const auto [first, last] = fill(41);
  EXPECT_EQ(last, first + 40 * piece);
  EXPECT_EQ(fill(42), std::pair(first, first + 41 * piece));
}

TEST(KernelChoice, names_what_this_processor_has) {
  const std::vector<std::string> names = available_panel_kernels();
  EXPECT_EQ(names.back(), "generic");
  try {
    use_panel_kernels("abacus");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'abacus'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("generic"), std::string::npos);
  }
  EXPECT_EQ(panel_kernels().name, names.front());
}

}  // namespace
}  // namespace dygita

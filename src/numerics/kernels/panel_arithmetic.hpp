// The kernels of panels for one kind of processor: DYGITA_ISA names it, compile options choose it.
//
// Included once by each panel_kernels_<isa>.cpp. Everything here belongs to a namespace of that name, and nothing of
// Eigen or the standard library that is compiled out of line is used: a function that the linker shares between
// translation units must not hold instructions that the processor may lack.
#pragma once

#include "numerics/kernels/edge_product.hpp"
#include "numerics/kernels/many_vectors.hpp"
#include "numerics/kernels/one_vector.hpp"
#include "numerics/kernels/sixteen_vectors.hpp"

namespace dygita::DYGITA_ISA {

namespace {

void forward(const View& view, double* y) {
  with_width(view.n_columns, [&](auto n) { forward_panel<n>(view, y); });
}
void backward(const View& view, double* y) {
  with_width(view.n_columns, [&](auto n) { backward_panel<n>(view, y); });
}
void forward_many(const View& view, double* y, int n_vectors) {
  with_width(view.n_columns, [&](auto n) {
    n_vectors == 1 ? forward_panel_many<n, 8 / n_doubles>(view, y) : forward_panel_many<n, 16 / n_doubles>(view, y);
  });
}
void backward_many(const View& view, double* y, int n_vectors) {
  with_width(view.n_columns, [&](auto n) {
    n_vectors == 1 ? backward_panel_many<n, 8 / n_doubles>(view, y) : backward_panel_many<n, 16 / n_doubles>(view, y);
  });
}
void multiply_double(const View& view, const double* x, double* y) {
  with_width(view.n_columns, [&](auto n) { multiply_panel<n>(view, x, y); });
}
void multiply_single(const View& view, const float* x, double* y) {
  with_width(view.n_columns, [&](auto n) { multiply_panel<n>(view, x, y); });
}
void forward_sixteen(const View& view, double* y, float* below) {
  with_width(view.n_columns, [&](auto n) { forward_panel_sixteen<n>(view, y, below); });
}
void backward_sixteen(const View& view, double* y, float* rows) {
  with_width(view.n_columns, [&](auto n) { backward_panel_sixteen<n>(view, y, rows); });
}
void multiply_double_sixteen(const View& view, const double* x, double* y) {
  with_width(view.n_columns, [&](auto n) { multiply_panel_sixteen<n>(view, x, y); });
}
void multiply_single_sixteen(const View& view, const float* x, float* below, double* y) {
  with_width(view.n_columns, [&](auto n) { multiply_panel_sixteen<n>(view, x, below, y); });
}

#define DYGITA_TEXT_OF(name) #name
#define DYGITA_TEXT(name) DYGITA_TEXT_OF(name)
const PanelKernels kernels{DYGITA_TEXT(DYGITA_ISA),
                           forward,
                           backward,
                           forward_many,
                           backward_many,
                           multiply_double,
                           multiply_single,
                           forward_sixteen,
                           backward_sixteen,
                           multiply_double_sixteen,
                           multiply_single_sixteen,
                           add_edge_product,
                           add_scalar_edge_product,
                           move_nodes};

}  // namespace

const PanelKernels& panel_kernels() { return kernels; }

}  // namespace dygita::DYGITA_ISA

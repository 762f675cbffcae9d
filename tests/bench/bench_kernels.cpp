// Kernels against what the machine allows, measured in the same run: read bandwidth and dgemm. Reports; judges nothing.
//
// Run: ./run.sh bench kernels, or build/release/tests/bench_kernels [--benchmark_filter=assembly]
//
// Matrices are those of a time step at CFL 1 of a cube of hexahedra, n cells per side, interface: none.
#include <benchmark/benchmark.h>
#include <cblas.h>
#include <cholmod.h>

#include <ctime>
#include <map>
#include <numeric>

#include "base/team.hpp"
#include "base/threads.hpp"
#include "fem/assembly.hpp"
#include "fem/lanes.hpp"
#include "fem/meshes.hpp"
#include "numerics/factor.hpp"

namespace {

using namespace dygita;

// Of processor time: a busy machine distorts it less.
double seconds_since(std::clock_t t) { return static_cast<double>(std::clock() - t) / CLOCKS_PER_SEC; }

// Four registers' sums at once hide the latency of additions.
double sum_of(const Lanes* values, size_t n) {
  Lanes sums[8] = {};
  for (size_t i = 0; i + 8 <= n; i += 8)
    for (int j = 0; j < 8; ++j) sums[j] += values[i + j];
  double sum = 0.0;
  for (const Lanes& s : sums)
    for (int lane = 0; lane < n_lanes; ++lane) sum += s[lane];
  return sum;
}

// arg 0: MiB, all threads together; arg 1: threads, each with a part of its own.
void read_bandwidth(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(1));
  const size_t bytes = static_cast<size_t>(state.range(0)) << 20, n = bytes / sizeof(Lanes) / threads;
  const std::unique_ptr<Lanes[]> values(new Lanes[n * threads]);
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (int t = 0; t < threads; ++t) std::fill_n(values.get() + t * n, n, Lanes{} + 1.0);
  for (auto _ : state) {
    double sum = 0.0;
#pragma omp parallel for num_threads(threads) schedule(static, 1) reduction(+ : sum)
    for (int t = 0; t < threads; ++t) sum += sum_of(values.get() + t * n, n);
    benchmark::DoNotOptimize(sum);
  }
  state.counters["bytes/s"] = benchmark::Counter(static_cast<double>(n * threads * sizeof(Lanes)),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

// arg 0: order of the matrices; arg 1: threads inside BLAS.
void dgemm(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  openblas_set_num_threads(static_cast<int>(state.range(1)));
  const Mat a = Mat::Random(n, n), b = Mat::Random(n, n);
  Mat c = Mat::Zero(n, n);
  for (auto _ : state) {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1.0, a.data(), n, b.data(), n, 0.0, c.data(), n);
    benchmark::DoNotOptimize(c.data());
  }
  openblas_set_num_threads(1);
  state.counters["flop/s"] = benchmark::Counter(2.0 * std::pow(n, 3), benchmark::Counter::kIsIterationInvariantRate);
}

struct Cube {
  SparseMatrix matrix;
  std::vector<int> node_of_dof;
};

Cube cube(int n) {
  const Elastic steel = test::material_of(1.0, 0.3);
  const BodyMatrices body = assemble(*box_mesh(Vec3::Zero(), Vec3::Constant(n), {n, n, n}), steel);
  const double dt = 1.0 / steel.p_wave_speed();
  Cube c{dt / 4 * body.stiffness, std::vector<int>(body.stiffness.rows())};
  for (int i = 0; i < c.matrix.rows(); ++i) {
    c.matrix.coeffRef(i, i) += body.mass[i / 3] / dt;
    c.node_of_dof[i] = i / 3;
  }
  return c;
}

Factor factor_of(const Cube& c) {
  return Factor(c.matrix, c.node_of_dof, std::vector<char>(c.node_of_dof.size(), 0), "cube");
}

// CHOLMOD's own factor in a given order: the operations it counts, and its own solve.
struct CholmodFactor {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  cholmod_sparse view{};

  CholmodFactor(const Cube& c, const std::vector<int>& order) {
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    view.nrow = view.ncol = static_cast<size_t>(c.matrix.rows());
    view.nzmax = static_cast<size_t>(c.matrix.nonZeros());
    view.p = const_cast<int*>(c.matrix.outerIndexPtr());
    view.i = const_cast<int*>(c.matrix.innerIndexPtr());
    view.x = const_cast<double*>(c.matrix.valuePtr());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    factor = cholmod_analyze_p(&view, const_cast<int*>(order.data()), nullptr, 0, &common);
  }
  ~CholmodFactor() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;
};

// The factor of a cube is dear: made once for all benchmarks of a size.
struct Made {
  Cube matrix;
  std::unique_ptr<Factor> factor, single;  // stored in double and in single precision
  double order_seconds = 0.0, all_seconds = 0.0, flops = 0.0;
};

const Made& made(int n) {
  static std::map<int, Made> known;
  Made& m = known[n];
  if (m.factor) return m;
  prepare_thread();
  m.matrix = cube(n);
  auto begin = std::clock();
  Factor::predicted_bytes(m.matrix.matrix, m.matrix.node_of_dof, std::vector<char>(m.matrix.node_of_dof.size(), 0));
  m.order_seconds = seconds_since(begin);
  begin = std::clock();
  m.factor = std::make_unique<Factor>(factor_of(m.matrix));
  m.all_seconds = seconds_since(begin);
  m.single =
      std::make_unique<Factor>(m.matrix.matrix, m.matrix.node_of_dof, std::vector<char>(m.matrix.node_of_dof.size(), 0),
                               "cube", Precision::single_precision);
  m.flops = CholmodFactor(m.matrix, m.factor->order()).common.fl;
  return m;
}

// arg: cells per side. Time of one factorisation less that of ordering and analysis alone.
void factor(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  for (auto _ : state) state.SetIterationTime(std::max(1e-9, made(n).all_seconds - made(n).order_seconds));
  state.counters["dof"] = made(n).factor->size();
  state.counters["ordering_s"] = made(n).order_seconds;
  state.counters["MiB"] = made(n).factor->bytes() / 1048576;
  state.counters["flop/s"] = made(n).flops / (made(n).all_seconds - made(n).order_seconds);
}

const Factor& factor_in(int n, bool is_single) { return is_single ? *made(n).single : *made(n).factor; }

// Forward and backward; bytes: what is stored, read twice. arg: cells per side.
void solve_one(benchmark::State& state, bool is_single) {
  const Factor& l = factor_in(static_cast<int>(state.range(0)), is_single);
  Vec x = Vec::Random(l.size());
  for (auto _ : state) {
    x.setLinSpaced(1.0, 2.0);
    l.solve(x);
    benchmark::DoNotOptimize(x.data());
  }
  state.counters["dof"] = l.size();
  state.counters["bytes/s"] = benchmark::Counter(is_single ? 2.0 * l.bytes() : 16.0 * l.nonzeros(),
                                                 benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bytes per entry"] = l.bytes() / l.nonzeros();
}

// The plain substitution that every user has, with its workspace kept. args: cells per side, right-hand sides.
void solve_cholmod(benchmark::State& state) {
  const Made& m = made(static_cast<int>(state.range(0)));
  const auto n_columns = static_cast<size_t>(state.range(1));
  CholmodFactor c(m.matrix, m.factor->order());
  cholmod_factorize(&c.view, c.factor, &c.common);
  cholmod_dense* b = cholmod_ones(m.matrix.matrix.rows(), n_columns, CHOLMOD_REAL, &c.common);
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
  for (auto _ : state) {
    cholmod_solve2(CHOLMOD_A, c.factor, b, nullptr, &x, nullptr, &y, &e, &c.common);
    benchmark::DoNotOptimize(x->x);
  }
  for (cholmod_dense** d : {&b, &x, &y, &e}) cholmod_free_dense(d, &c.common);
  state.counters["dof"] = m.factor->size();
  state.counters["bytes/s"] =
      benchmark::Counter(16.0 * m.factor->nonzeros(), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["flop/s"] = benchmark::Counter(4.0 * m.factor->nonzeros() * static_cast<double>(n_columns),
                                                benchmark::Counter::kIsIterationInvariantRate);
}

// args: cells per side, right-hand sides.
void solve_several(benchmark::State& state, bool is_single) {
  const Factor& l = factor_in(static_cast<int>(state.range(0)), is_single);
  Mat x(l.size(), state.range(1));
  for (auto _ : state) {
    x.setOnes();
    l.solve(x);
    benchmark::DoNotOptimize(x.data());
  }
  state.SetLabel("together");
  state.counters["dof"] = l.size();
  state.counters["flop/s"] = benchmark::Counter(4.0 * l.nonzeros() * static_cast<double>(state.range(1)),
                                                benchmark::Counter::kIsIterationInvariantRate);
}

// The product by the interface operator, of which one triangle is read. arg: unknowns.
void interface_operator(benchmark::State& state) {
  const auto n = state.range(0);
  const Mat random = Mat::Random(n, n);
  const Mat positive = random + random.transpose() + 4.0 * static_cast<double>(n) * Mat::Identity(n, n);
  const SymmetricOperator h(positive, Precision::double_precision);
  const Vec x = Vec::Random(n);
  Vec y(n);
  for (auto _ : state) {
    h.multiply(x, y);
    benchmark::DoNotOptimize(y.data());
  }
  state.counters["bytes/s"] = benchmark::Counter(4.0 * static_cast<double>(n) * static_cast<double>(n + 1),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

enum Shape { boxes, distorted, prisms, tetrahedra };
const char* const shape_names[] = {"hex8 boxes", "hex8 distorted", "prism6 distorted", "tet4 distorted"};

// args: shape, cubes a side (of one, two or six cells each), threads.
void assembly(benchmark::State& state) {
  const int n = static_cast<int>(state.range(1));
  const CellType types[] = {CellType::hex8, CellType::hex8, CellType::prism6, CellType::tet4};
  Mesh mesh = test::box_of(types[state.range(0)], Vec3::Constant(n), {n, n, n});
  if (state.range(0) != boxes) test::distort(mesh, Vec3::Constant(n), 0.1);
  const Elastic steel = test::material_of(1.0, 0.3);
  set_thread_limit(static_cast<int>(state.range(2)));
  assemble(mesh,
           steel);  // the first touch of memory that a virtual machine has not yet got from its host is no kernel's
  for (auto _ : state) {
    const BodyMatrices body = assemble(mesh, steel);
    benchmark::DoNotOptimize(body.mass.data());
  }
  set_thread_limit(1);
  state.SetLabel(shape_names[state.range(0)]);
  state.counters["cells"] = mesh.n_cells();
  state.counters["s/Mcell"] = benchmark::Counter(
      mesh.n_cells() / 1e6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

constexpr int sizes[] = {12, 19, 31};  // cells per side: 6.6k, 24k, 98k unknowns

void sized(benchmark::internal::Benchmark* b) {
  for (const int n : sizes) b->Arg(n);
}
void sized_16(benchmark::internal::Benchmark* b) {
  for (const int n : sizes) b->Args({n, 16});
}
void sized_1_16(benchmark::internal::Benchmark* b) {
  for (const int n : sizes)
    for (const int columns : {1, 16}) b->Args({n, columns});
}

// Larger than any cache of the machine; and the sizes of the factors and operators below, which caches may hold.
template <int threads>
void probed(benchmark::internal::Benchmark* b) {
  for (const int mib : {16, 34, 92, 137, 664, 3072}) b->Args({mib, threads});
}

}  // namespace

// On one thread processor time counts, which a busy machine distorts less; on two what has elapsed.
BENCHMARK(read_bandwidth)->ArgNames({"MiB", "threads"})->Apply(probed<1>)->Unit(benchmark::kMillisecond);
BENCHMARK(read_bandwidth)->ArgNames({"MiB", "threads"})->Apply(probed<2>)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(dgemm)->ArgNames({"n", "threads"})->Args({1500, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(dgemm)->ArgNames({"n", "threads"})->Args({1500, 2})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(factor)->ArgName("cells")->Apply(sized)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve_one, double, false)->ArgName("cells")->Apply(sized)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve_one, single, true)->ArgName("cells")->Apply(sized)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve_several, double, false)
    ->ArgNames({"cells", "columns"})
    ->Apply(sized_16)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve_several, single, true)
    ->ArgNames({"cells", "columns"})
    ->Apply(sized_16)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(solve_cholmod)->ArgNames({"cells", "columns"})->Apply(sized_1_16)->Unit(benchmark::kMillisecond);
BENCHMARK(interface_operator)->ArgName("n")->Arg(2048)->Arg(6000)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly)
    ->ArgNames({"shape", "cubes", "threads"})
    ->Args({boxes, 64, 1})
    ->Args({distorted, 64, 1})
    ->Args({prisms, 40, 1})
    ->Args({tetrahedra, 32, 1})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(assembly)
    ->ArgNames({"shape", "cubes", "threads"})
    ->Args({distorted, 64, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

int main(int argc, char** argv) {
  dygita::set_up_process(argv, dygita::better_blas_kernels());
  dygita::prepare_thread();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

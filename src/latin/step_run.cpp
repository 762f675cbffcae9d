#include "latin/step_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "fem/mass.hpp"
#include "partition/all_pieces.hpp"
#include "step/finite_energies.hpp"
#include "step/step_ends.hpp"

namespace dygita {

namespace {

// One by one: Eigen's root of eight numbers at once (AVX-512) has other last digits than that of one, so that what an
// unknown gets would depend on where it stands among those of its rank.
double inverse_root(double k) { return 1.0 / std::sqrt(k); }

// Times the assembly's size, of a static increment.
constexpr double too_far = 10.0;

}  // namespace

StepRun::StepRun(const StepSettings& settings, StepModel& model, const Vec& k, const RunFiles& files)
    : settings_(settings),
      files_(files),
      model_(model),
      start_time_(files.state.time),
      weight_(model.near.part(k).head(model.near.n_own()).unaryExpr(&inverse_root)),
      coarse_(settings.has_correction ? CoarseCorrection(model, k) : CoarseCorrection()),
      n_inner_(ranks::any(std::any_of(model.here.begin(), model.here.end(),
                                      [&](int i) { return model.pieces[i]->has_rough_operator(); }))
                   ? settings.n_inner
                   : 0),
      local_(model, files.state, model.near.part(k)),
      direct_(model, files.state),
      pulls_(model),
      at_{local_.initial_q(), Vec::Zero(model.near.n()), {}, {}},
      warm_start_({files.start_from, static_cast<size_t>(settings.i_step), &model.near}, weight_, InterfaceSums(model)),
      anderson_(settings.of_increment.depth, settings.of_increment.n_problems, settings.of_increment.relaxation,
                weight_, InterfaceSums(model)),
      window_sums_(model),
      indicator_(model.scheme.is_static ? k.sum() * settings.assembly_size * settings.assembly_size : 0.0,
                 settings.is_assembled ? 1e-1 : 1e-2) {
  if (settings.is_assembled) assembled_.emplace(model, local_, k, settings.assembly_size);
  const Energies& energies = files.state.energies;
  const double before = energies.held() + std::abs(energies.loads);
  if (model.scheme.is_static) {
    loose_.emplace(model);
    indicator_.start_from(before);
  } else if (before > energies.kinetic) {
    indicator_.start_motion(before, model.scheme.dt, settings.tolerance);
  }
  books_.energy.resize(model.pieces.size());
  if (!ranks::is_alone()) {
    books_.piece_seconds.resize(model.pieces.size());
    if (!model.is_assembled) distant_.emplace(model, files.state);
  }
  for (const auto& piece : model.pieces) explicit_.push_back(piece->as_explicit());
  StepFigures& figures = books_.figures;
  figures.substeps = model.n_substeps();
  for (size_t i = 0; i < model.integration.parts.size(); ++i) {
    const Integration::Part& part = model.integration.parts[i];
    if (!part.is_explicit) continue;
    const Substructure& body = *model.problem->substructures[i];
    figures.explicit_parts.push_back(body.name);
    if (has_consistent_mass(*body.mesh)) figures.diagonal_parts.push_back(body.name);
    if (part.is_tuned) figures.tuned_parts.push_back(body.name);
    if (model.problem->mass().is_chosen) figures.phases.emplace_back(body.name, part.phase);
    figures.stable_step = figures.stable_step > 0.0 ? std::min(figures.stable_step, part.longest) : part.longest;
  }
  if (model.has_explicit()) piece_threads_ = ThreadChoice::measured();
  is_all_direct_ = model.has_explicit() && model.n_q() == 0 && !model.problem->solver.plain &&
                   std::all_of(model.here.begin(), model.here.end(), [&](int i) { return explicit_[i] != nullptr; });
  largest_first_ = model.here;
  std::stable_sort(largest_first_.begin(), largest_first_.end(), [&](int a, int b) {
    return model.pieces[a]->node_masses().size() > model.pieces[b]->node_masses().size();
  });
  const auto in_turn = [&](const std::vector<int>& border) {
    InTurn turns;
    for (const int i : largest_first_)
      (std::find(border.begin(), border.end(), i) != border.end() ? turns.border : turns.interior).push_back(i);
    return turns;
  };
  telling_ = in_turn(direct_.border_pieces());
  iterating_ = in_turn(model.near.border_pieces());
}

// The first iteration only measures what the kept fields are worth.
StepRun::Goal StepRun::goal_of(bool has_start) const {
  const double furthest = local_.has_preloads()     ? settings_.assembly_size
                          : model_.scheme.is_static ? too_far * settings_.assembly_size
                                                    : 0.0;
  if (settings_.more_iterations == 0 || !has_start) return {settings_.tolerance, settings_.limit, furthest};
  const int most = 1 + settings_.more_iterations;
  return {settings_.round_off, {most, most}, furthest};
}

// Where the iteration of an increment starts; false: not from another case's fields.
bool StepRun::predict(int increment, Vec& q) {
  const InterfaceFields* fields = files_.start_from;
  const bool has_start = warm_start_.predict(increment, own(q)) && fields;
  if (fields && !has_start && increment == 0 && fields->n_increments(settings_.i_step) > 0)
    warn(
        fmt::format("step '{}': the initial case does not match (different interfaces, pieces or increments): the "
                    "iteration starts from scratch",
                    model_.step->name));
  return has_start;
}

void StepRun::accept_increment(int increment, int iterations, double eta) {
  {
    const Stopwatch watch(books_.seconds.accept);
    books_.of_points.assign(model_.pieces.size(), {});
    local_.accept(files_.state, books_.of_points);
  }
  if (!model_.scheme.is_static) files_.state.time = time_of(increment);
  keep(at_.q);
  if (distant_) distant_->forget();
  accept_interval(increment, iterations, eta, model_.scheme.dt * at_.sums.force_distance);
}

// Books a time step of the deck, and shows it.
void StepRun::accept_interval(int increment, int iterations, double eta, double interface_energy) {
  State& state = files_.state;
  Energies& energies = state.energies;
  book_increment(all_energies(), energies);
  if (!std::isfinite(energies.balance())) complete_energies(books_.energy);  // to tell where
  check_energies(model_, state, books_.energy, increment);
  if (has_flown_off()) eta = std::numeric_limits<double>::infinity();
  indicator_.raise_floor(energies.held() + std::abs(energies.loads), model_.scheme.dt);
  StepFigures& figures = books_.figures;
  ++figures.increments;
  figures.iterations += iterations;
  figures.worst_indicator = std::max(figures.worst_indicator, eta);
  if (eta > settings_.tolerance) ++figures.not_converged;
  const Stopwatch watch(books_.seconds.output);
  Instant shown = instant(increment, iterations, eta);
  shown.interface_energy = interface_energy;
  files_.observer.accept(shown);
}

// Of all pieces, with those of the points that are booked with each.
std::vector<IncrementEnergy> StepRun::all_energies() const {
  std::vector<IncrementEnergy> all = books_.energy;
  for (size_t i = 0; i < books_.of_points.size(); ++i) {
    const IncrementEnergy& points = books_.of_points[i];
    all[i].loads += points.loads;
    all[i].friction += points.friction;
    all[i].plastic += points.plastic;
    all[i].damping += points.damping;
    all[i].scheme += points.scheme;
    all[i].stored += points.stored;
  }
  complete_energies(all);
  return all;
}

// Those of pieces elsewhere.
void StepRun::complete_energies(std::vector<IncrementEnergy>& energies) const {
  if (ranks::is_alone()) return;
  constexpr int n = 8;
  const std::vector<double> all = of_all_pieces(*model_.cut, n, [&](int i, double* to) {
    const IncrementEnergy& e = energies[i];
    const double own[n] = {e.loads, e.friction, e.plastic, e.damping, e.scheme, e.kinetic, e.strain, e.stored};
    std::copy_n(own, n, to);
  });
  for (size_t i = 0; i < energies.size(); ++i) {
    const double* e = all.data() + n * i;
    energies[i] = {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7]};
  }
}

// Those first and last tell enough of a step that misses everywhere.
void StepRun::note_missed(const Missed& missed) {
  std::vector<Missed>& all = books_.figures.missed;
  if (missed.indicator <= settings_.tolerance) return;
  if (all.size() < 1000) all.push_back(missed);
}

// Each rank those of its pieces.
void StepRun::keep(const Vec& q) { files_.kept.append(model_.near.kept_part(q)); }

double StepRun::largest_velocity() const {
  const int n = model_.near.n_own();
  const double own = n > 0 ? at_.velocity.head(n).cwiseAbs().maxCoeff() : 0.0;
  return assembled_ ? own : ranks::largest(own);
}

// A static increment that moves bodies by many times the assembly's size has found no equilibrium, whatever the
// indicator says.
bool StepRun::has_flown_off() const {
  if (!model_.scheme.is_static || model_.n_q() == 0) return false;
  const double moved = largest_velocity(), size = settings_.assembly_size;
  if (moved <= too_far * size) return false;
  warn(fmt::format(
      "static step '{}': an increment moves a substructure by {:.3g} m, {:.0f} times the size of the assembly: it is "
      "unconstrained, a limit load is exceeded, or the iteration failed to converge",
      model_.step->name, moved, moved / size));
  return true;
}

void StepRun::check_finite(const Outcome& outcome, int increment) const {
  if (std::isfinite(outcome.eta) && std::isfinite(outcome.size)) return;
  throw NumericalError(
      fmt::format("step '{}', increment {} (t = {:.6g} s): the iteration has diverged{}; likely cause: a load, "
                  "search direction, stiffness or density out of proportion, or a time step far too large",
                  model_.step->name, increment + 1, files_.state.time, place_of_divergence()));
}

// " at substructure 'rod', interface 'thread'": where a velocity is not a number, or else is largest; collective.
std::string StepRun::place_of_divergence() const {
  const Exchange& exchange = model_.exchange;
  const Port* worst = nullptr;
  const Point* at = nullptr;
  double largest = -1.0;
  for (const int i : model_.near.points()) {
    const Point& point = exchange.points[static_cast<size_t>(i)];
    for (int p = point.first_port; p < point.end_port && std::isfinite(largest); ++p)
      for (int d = 0; d < 3; ++d) {
        const int unknown = model_.unknown(exchange.ports[p], d);
        const double size = unknown < 0 || unknown >= at_.velocity.size() ? -1.0 : std::abs(at_.velocity[unknown]);
        if (size <= largest) continue;
        largest = std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
        worst = &exchange.ports[p];
        at = &point;
      }
  }
  std::string place;
  if (worst) place = fmt::format(" at substructure '{}'", model_.problem->substructures[worst->part]->name);
  if (worst && !at->members.empty())
    place += fmt::format(", interface '{}'", (*model_.surfaces)[at->members.front().surface].name());
  if (model_.near.is_all()) return place;
  // Of the first rank where it is largest.
  const std::vector<std::vector<double>> of_all = ranks::of_all({largest});
  const auto first = std::max_element(of_all.begin(), of_all.end());
  const std::vector<std::string> places = ranks::gathered(place);
  return ranks::shared(places.empty() ? "" : places[static_cast<size_t>(first - of_all.begin())]);
}

std::string StepRun::describe_progress() const {
  const StepFigures& figures = books_.figures;
  const double mean = figures.increments ? static_cast<double>(figures.iterations) / figures.increments : 0.0;
  return model_.scheme.is_static
             ? fmt::format("{} iterations", figures.iterations)
             : fmt::format("t = {:.4g} us, {:.1f} iterations per step", files_.state.time * 1e6, mean);
}

Instant StepRun::instant(int increment, int iterations, double eta) const {
  Instant now{model_, files_.state, settings_.i_step, increment, iterations, eta, eta <= settings_.tolerance};
  if (distant_) now.distant = &*distant_;
  return now;
}

void StepRun::add_to(SolverFigures& figures) const {
  figures.n_dofs = 0;
  for (const SubstructurePtr& part : model_.problem->substructures) figures.n_dofs += 3 * part->mesh->n_nodes();
  enum { bytes, solved, spared, in_full, equal };
  std::vector<double> sums(5, 0.0);
  for (size_t i = 0; i < model_.pieces.size(); ++i) {
    if (!model_.cut->is_here(static_cast<int>(i))) continue;
    const Piece& piece = *model_.pieces[i];
    const PieceFigures of_piece = piece.figures();
    sums[bytes] += of_piece.bytes;
    sums[solved] += static_cast<double>(of_piece.n_solved);
    sums[spared] += static_cast<double>(of_piece.n_spared);
    sums[in_full] += of_piece.is_mostly_interface;
    sums[equal] += piece.shares_operator();
  }
  if (assembled_) sums[bytes] += assembled_->bytes();
  sums = ranks::sums(sums);
  figures.factor_bytes = std::max(figures.factor_bytes, sums[bytes]);
  figures.n_solved += static_cast<long>(sums[solved]);
  figures.n_spared += static_cast<long>(sums[spared]);
  figures.n_in_full += static_cast<int>(sums[in_full]);
  figures.n_equal += static_cast<int>(sums[equal]);
  figures.n_interface_unknowns = model_.n_q();
  figures.gap_difference =
      std::max(figures.gap_difference, ranks::largest(std::max(local_.gap_difference(), direct_.gap_difference())));
  figures.sharing.pieces.resize(books_.piece_seconds.size());
  for (size_t i = 0; i < books_.piece_seconds.size(); ++i) figures.sharing.pieces[i].seconds += books_.piece_seconds[i];
  const Seconds& seconds = books_.seconds;
  figures.seconds["forward"] += seconds.forward;
  figures.seconds["interface operator"] += seconds.interface;
  figures.seconds["local stage"] += seconds.local;
  figures.seconds["acceleration"] += seconds.accelerate;
  figures.seconds["backward"] += seconds.backward;
  figures.seconds["laws and energies"] += seconds.accept;
  figures.seconds["output"] += seconds.output;
}

}  // namespace dygita

// One rank: what there is where the program is built without MPI.
#ifndef DYGITA_HAS_MPI
#include "base/error.hpp"
#include "ranks/launcher.hpp"
#include "ranks/neighbours.hpp"
#include "ranks/ranks.hpp"

namespace dygita::ranks {

void start(Say) {
  if (launched_ranks() > 1)
    throw InputError(
        "started as one of several MPI ranks, and this dygita was "
        "built without MPI\n    build it where "
        "libopenmpi-dev is installed (cmake -DDYGITA_MPI=ON), or "
        "start it without mpirun");
}

void finish() {}

int count() { return 1; }

int me() { return 0; }

int count_on_machine() { return 1; }

bool is_first_on_machine() { return true; }

void stop_all(const std::string& message, int) { contract_broken("several ranks", __FILE__, __LINE__, message); }

std::string shared(std::string bytes) { return bytes; }

std::vector<double> shared(std::vector<double> values) { return values; }

std::vector<std::string> gathered(const std::string& bytes) { return {bytes}; }

std::vector<double> to_first(int, std::vector<double> values) { return values; }

double largest(double value) { return value; }

bool any(bool is_so) { return is_so; }

std::vector<double> sums(const std::vector<double>& values) { return values; }

Segments::Segments(const std::vector<int>&, const std::vector<int>&) {}

void Segments::complete(double*, int) const {}

void Segments::bring(double*) const {}

Neighbours::Neighbours(const std::vector<int>&, const std::vector<std::vector<int>>&, int width) : width_(width) {}

void Neighbours::exchange(double*) const {}

void Neighbours::exchange(std::initializer_list<double*>) const {}

std::vector<double> ask(int, const Question&, std::span<const double>) {
  CHECK(false, "there is nobody to ask");
  return {};
}

void answer_until_released(const Answer&) {}

void release_all() {}

Traffic traffic() { return {}; }

}  // namespace dygita::ranks
#endif

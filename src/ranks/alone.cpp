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

const std::string& name_of_job() {
  static const std::string name = "alone";
  return name;
}

void before_stop(void (*)()) {}

void stop_all(const std::string& message, int) { contract_broken("several ranks", __FILE__, __LINE__, message); }

std::string shared(std::string bytes) { return bytes; }

std::vector<double> shared(std::vector<double> values) { return values; }

std::vector<std::string> gathered(const std::string& bytes) { return {bytes}; }

std::vector<std::vector<double>> of_all(const std::vector<double>& own) { return {own}; }

std::vector<std::vector<int>> swapped(const std::vector<std::vector<int>>& to_each) { return to_each; }

std::vector<double> to_first(int, std::vector<double> values) { return values; }

double largest(double value) { return value; }

bool any(bool is_so) { return is_so; }

std::vector<double> sums(const std::vector<double>& values) { return values; }

Segments::Segments(const std::vector<int>&, const std::vector<int>&) {}

void Segments::complete(double*, int) const {}

void Segments::bring(double*) const {}

Neighbours::Neighbours(const std::vector<int>&, const std::vector<std::vector<int>>&, int width) : width_(width) {}

struct Neighbours::Flight {};

void Neighbours::begin(const double*) const {}

void Neighbours::end(double*) const {}

void Neighbours::begin(std::initializer_list<const double*>) const {}

void Neighbours::end(std::initializer_list<double*>) const {}

void Neighbours::exchange(double*) const {}

void Neighbours::exchange(const std::vector<double*>&) const {}

void Neighbours::exchange(std::initializer_list<double*>) const {}

struct LaterLargest::Flight {
  double value;
};

void LaterLargest::begin(double value) { flight_ = std::make_shared<Flight>(Flight{value}); }

double LaterLargest::end() {
  const double value = flight_->value;
  flight_.reset();
  return value;
}

std::vector<double> ask(int, const Question&, std::span<const double>) {
  CHECK(false, "there is nobody to ask");
  return {};
}

void answer_until_released(const Answer&) {}

void release_all() {}

Traffic traffic() { return {}; }

}  // namespace dygita::ranks
#endif

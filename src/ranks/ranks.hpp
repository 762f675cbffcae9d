// Several processes that run the same deck side by side (manual/parallel.md), called ranks 0, 1, ...; one process is
// rank 0 of one. The only module that names MPI; built without it there is one rank.
//
// All functions but `stop_all` are collective: every rank calls them in the same order, from the thread that called
// `start`, except `ask`.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dygita::ranks {

// Joins the other ranks where mpirun or srun has started the process; else it stays alone, and MPI is not touched.
// say: how rank 0 reports the error that ends all. Throws InputError where it was started so and the program was built
// without MPI.
using Say = void (*)(const std::string&);
void start(Say say);
// Waits for the others and leaves. Not after an error: that is what stop_all is for.
void finish();

int count();
int me();
int count_on_machine();            // those that share this machine's memory
const std::string& name_of_job();  // the same on all ranks, and that of no other job of this machine
inline bool is_first() { return me() == 0; }
inline bool is_alone() { return count() == 1; }

// What a rank does before it ends all, to leave nothing behind; null: nothing. Rank 0 does it once more when the others
// have, or had two seconds for it.
void before_stop(void (*tidy)());
// Ends all ranks with an exit code and one message: rank 0 says it, whoever has failed. Called by a rank alone, where
// there are several.
[[noreturn]] void stop_all(const std::string& message, int code);

// Rank 0's bytes, on all.
std::string shared(std::string bytes);
std::vector<double> shared(std::vector<double> values);
// Every rank's bytes, on rank 0 in their order; empty on the others.
std::vector<std::string> gathered(const std::string& bytes);
// Every rank's numbers, on all in the ranks' order.
std::vector<std::vector<double>> of_all(const std::vector<double>& own);
// Numbers for each rank; returns what each has for this one.
std::vector<std::vector<int>> swapped(const std::vector<std::vector<int>>& to_each);
// Values of rank `owner`, on rank 0; on the others as they were given.
std::vector<double> to_first(int owner, std::vector<double> values);
double largest(double value);
bool any(bool is_so);
// `largest` in two halves, between which the caller continues.
class LaterLargest {
 public:
  void begin(double value);
  bool is_begun() const { return flight_ != nullptr; }
  double end();

 private:
  struct Flight;
  std::shared_ptr<Flight> flight_;
};
// To round-off: for figures.
std::vector<double> sums(const std::vector<double>& values);

// Values that belong to pieces, each piece on one rank: `complete` gives every rank those of the others.
class Segments {
 public:
  Segments() = default;
  // owner: rank of each piece; offset: where its values begin, one entry more than pieces.
  Segments(const std::vector<int>& owner, const std::vector<int>& offset);
  // values: of all pieces, of which a rank has filled those of its own; `width` numbers for each of the values.
  void complete(double* values, int width = 1) const;
  // The same for rank 0 alone.
  void bring(double* values) const;

 private:
  struct Run {
    int at, n;
  };
  void collect(double* values, int width, bool on_all) const;
  std::vector<std::vector<Run>> of_rank_;
  std::vector<int> counts_, starts_;
  int n_ = 0;  // values
  mutable std::vector<double> own_, all_;
};

// Rank 0 asks others for what they alone have, while they `answer_until_released`. Any thread of rank 0 may ask.
struct Question {
  int what = 0, of = 0;  // of: a piece or a surface
};
std::vector<double> ask(int rank, const Question& question, std::span<const double> with);
using Answer = std::function<std::vector<double>(const Question&, std::span<const double>)>;
void answer_until_released(const Answer& answer);
void release_all();

// What this rank has sent so far, and how long it has waited for others.
enum Receivers { neighbours, everybody, asker, n_receivers };  // asker: rank 0, or whom it asks
struct Traffic {
  std::array<double, n_receivers> messages{}, bytes{};
  double seconds_waited = 0.0;
};
Traffic traffic();

}  // namespace dygita::ranks

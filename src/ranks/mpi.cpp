// Ranks that MPI has started: the only source that names it.
#include "ranks/transport.hpp"

#ifdef DYGITA_HAS_MPI
#include <mpi.h>

#include <cstdlib>

#include "base/error.hpp"

namespace dygita::ranks {

namespace {

MPI_Datatype type_of(int width) { return width == 8 ? MPI_DOUBLE : width == 4 ? MPI_INT : MPI_BYTE; }

std::vector<int> starts_of(const std::vector<int>& counts) {
  std::vector<int> starts(counts.size(), 0);
  long sum = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    starts[i] = as_count(static_cast<size_t>(sum));
    sum += counts[i];
  }
  return starts;
}

class MpiFlight final : public Flight {
 public:
  bool is_done() override {
    int is_done = 0;
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    return is_done != 0;
  }

  MPI_Request request = MPI_REQUEST_NULL;
  std::vector<int> counts, starts, more_counts, more_starts;  // that a call reads until it is done
};

class Mpi final : public Transport {
 public:
  Mpi() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    CHECK(provided >= MPI_THREAD_SERIALIZED, "an MPI that no two threads may use in turn");
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    MPI_Comm_rank(MPI_COMM_WORLD, &me_);
    MPI_Comm on_machine;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &on_machine);
    MPI_Comm_size(on_machine, &on_machine_);
    MPI_Comm_free(&on_machine);
  }

  int count() const override { return count_; }
  int me() const override { return me_; }
  int count_on_machine() const override { return on_machine_; }

  FlightPtr send(const Outgoing& items, int rank, Tag tag) override {
    auto flight = std::make_unique<MpiFlight>();
    MPI_Isend(items.at, as_count(items.n), type_of(items.width), rank, tag, MPI_COMM_WORLD, &flight->request);
    return flight;
  }
  FlightPtr receive(const Incoming& items, int rank, Tag tag) override {
    auto flight = std::make_unique<MpiFlight>();
    MPI_Irecv(items.at, as_count(items.n), type_of(items.width), rank, tag, MPI_COMM_WORLD, &flight->request);
    return flight;
  }
  std::optional<Letter> letter(int rank, Tag tag, int width) override {
    int is_there = 0, n = 0;
    MPI_Status status;
    MPI_Iprobe(rank < 0 ? MPI_ANY_SOURCE : rank, tag, MPI_COMM_WORLD, &is_there, &status);
    if (!is_there) return std::nullopt;
    MPI_Get_count(&status, type_of(width), &n);
    return Letter{status.MPI_SOURCE, static_cast<size_t>(n)};
  }

  FlightPtr broadcast(const Incoming& items) override {
    auto flight = std::make_unique<MpiFlight>();
    MPI_Ibcast(items.at, as_count(items.n), type_of(items.width), 0, MPI_COMM_WORLD, &flight->request);
    return flight;
  }
  FlightPtr gather(const Outgoing& own, void* all, const std::vector<int>& counts, bool on_all) override {
    auto flight = std::make_unique<MpiFlight>();
    flight->counts = counts;
    flight->starts = starts_of(counts);
    const MPI_Datatype type = type_of(own.width);
    if (on_all)
      MPI_Iallgatherv(own.at, as_count(own.n), type, all, flight->counts.data(), flight->starts.data(), type,
                      MPI_COMM_WORLD, &flight->request);
    else
      MPI_Igatherv(own.at, as_count(own.n), type, all, flight->counts.data(), flight->starts.data(), type, 0,
                   MPI_COMM_WORLD, &flight->request);
    return flight;
  }
  FlightPtr swap(const Outgoing& to_all, const std::vector<int>& to_each, void* from_all,
                 const std::vector<int>& from_each) override {
    auto flight = std::make_unique<MpiFlight>();
    flight->counts = to_each;
    flight->starts = starts_of(to_each);
    flight->more_counts = from_each;
    flight->more_starts = starts_of(from_each);
    const MPI_Datatype type = type_of(to_all.width);
    MPI_Ialltoallv(to_all.at, flight->counts.data(), flight->starts.data(), type, from_all, flight->more_counts.data(),
                   flight->more_starts.data(), type, MPI_COMM_WORLD, &flight->request);
    return flight;
  }
  FlightPtr largest(const double& own, double& of_all) override {
    auto flight = std::make_unique<MpiFlight>();
    MPI_Iallreduce(&own, &of_all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD, &flight->request);
    return flight;
  }
  FlightPtr sums(std::span<const double> own, std::span<double> of_all) override {
    auto flight = std::make_unique<MpiFlight>();
    MPI_Iallreduce(own.data(), of_all.data(), as_count(own.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD,
                   &flight->request);
    return flight;
  }

  void finish() override {
    MpiFlight all_are_here;
    MPI_Ibarrier(MPI_COMM_WORLD, &all_are_here.request);
    wait(all_are_here);
    MPI_Finalize();
  }
  void abort(int code) override {
    MPI_Abort(MPI_COMM_WORLD, code);
    std::abort();
  }

 private:
  int count_ = 1, me_ = 0, on_machine_ = 1;
};

}  // namespace

std::unique_ptr<Transport> join_mpi() { return std::make_unique<Mpi>(); }

}  // namespace dygita::ranks
#else
namespace dygita::ranks {

std::unique_ptr<Transport> join_mpi() { return nullptr; }

}  // namespace dygita::ranks
#endif

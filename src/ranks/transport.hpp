// What carries the messages of ranks: MPI, nothing where there is one rank, threads of one process in tests. Ranks make
// of it what others see (ranks.hpp, neighbours.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "ranks/ranks.hpp"

namespace dygita::ranks {

enum Tag { failed = 1, asked, answered, passed, brought };

// What is sent: items of 1, 4 or 8 bytes (bytes, int, double), alike on both ends.
struct Outgoing {
  const void* at = nullptr;
  size_t n = 0;
  int width = 1;
};
struct Incoming {
  void* at = nullptr;
  size_t n = 0;
  int width = 1;
};
template <class Item>
Outgoing outgoing(std::span<const Item> items) {
  return {items.data(), items.size(), sizeof(Item)};
}
template <class Item>
Incoming incoming(std::span<Item> items) {
  return {items.data(), items.size(), sizeof(Item)};
}

// As transports count. Fails a check beyond 2^31 - 1.
int as_count(size_t n);

// A message or a collective call that is under way. Its memory must stay until it is done.
class Flight {
 public:
  virtual ~Flight() = default;
  virtual bool is_done() = 0;
};
using FlightPtr = std::unique_ptr<Flight>;

class Transport {
 public:
  virtual ~Transport() = default;
  virtual int count() const = 0;
  virtual int me() const = 0;
  virtual int count_on_machine() const = 0;

  virtual FlightPtr send(const Outgoing& items, int rank, Tag tag) = 0;
  virtual FlightPtr receive(const Incoming& items, int rank, Tag tag) = 0;
  // A message that has come and not been received: its rank and its items.
  struct Letter {
    int rank;
    size_t n;
  };
  // From a rank, or from any (-1).
  virtual std::optional<Letter> letter(int rank, Tag tag, int width) = 0;

  // Collective: every rank calls them in the same order. counts: items of each rank.
  virtual FlightPtr broadcast(const Incoming& items) = 0;  // rank 0's
  virtual FlightPtr gather(const Outgoing& own, void* all, const std::vector<int>& counts, bool on_all) = 0;
  virtual FlightPtr swap(const Outgoing& to_all, const std::vector<int>& to_each, void* from_all,
                         const std::vector<int>& from_each) = 0;
  virtual FlightPtr largest(const double& own, double& of_all) = 0;
  virtual FlightPtr sums(std::span<const double> own, std::span<double> of_all) = 0;

  virtual void finish() = 0;
  [[noreturn]] virtual void abort(int code) = 0;
};

// This process as a rank.
struct Office {
  std::unique_ptr<Transport> transport;  // null: one rank
  std::string job = "alone";
  Traffic so_far;
  std::mutex asking;
  Say say_error = nullptr;
  void (*tidy_up)() = nullptr;
};
Office& office();
// Tests: this thread is a rank of its own from now on; null: it is the process's again.
void set_office(Office* office);

// MPI's, of a process that has been started as one of several; null: the program was built without it.
std::unique_ptr<Transport> join_mpi();

// Until it is done, and no longer than until another rank fails: then the run ends here.
void wait(Flight& flight);
void note_sent(Receivers to, double n_messages, double n_bytes);

}  // namespace dygita::ranks

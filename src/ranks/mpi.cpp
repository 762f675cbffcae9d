// The ranks of MPI. Whoever waits looks out for errors of others meanwhile, so that one of them ends all.
#ifdef DYGITA_HAS_MPI
#include <mpi.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <mutex>

#include "base/error.hpp"
#include "ranks/launcher.hpp"
#include "ranks/neighbours.hpp"
#include "ranks/ranks.hpp"

namespace dygita::ranks {

namespace {

enum Tag { failed = 1, asked, answered, passed, brought };

int n_ranks = 1, own_rank = 0, n_on_machine = 1;
std::string job = "alone";
Traffic so_far;
std::mutex asking;
Say say_error = nullptr;
void (*tidy_up)() = nullptr;

// Rank 0 hears that another has failed: its exit code, four bytes, and its message.
void look_out() {
  if (own_rank != 0) return;
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, failed, MPI_COMM_WORLD, &is_there, &status);
  if (!is_there) return;
  int n = 0;
  MPI_Get_count(&status, MPI_BYTE, &n);
  std::string bytes(static_cast<size_t>(n), '\0');
  MPI_Recv(bytes.data(), n, MPI_BYTE, status.MPI_SOURCE, failed, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  int code = 0;
  std::memcpy(&code, bytes.data(), sizeof code);
  say_error(bytes.substr(sizeof code));
  MPI_Abort(MPI_COMM_WORLD, code);
}

void wait(MPI_Request request) {
  using clock = std::chrono::steady_clock;
  const auto start = clock::now();
  constexpr int between_looks = 64;
  int is_done = 0;
  for (int i = 1;; ++i) {
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done) break;
    if (i % between_looks == 0) look_out();
  }
  so_far.seconds_waited += std::chrono::duration<double>(clock::now() - start).count();
}

void note_sent(Receivers to, double n_messages, double n_bytes) {
  so_far.messages[to] += n_messages;
  so_far.bytes[to] += n_bytes;
}

int as_count(size_t n) {
  CHECK(n <= static_cast<size_t>(std::numeric_limits<int>::max()), "a message of more than 2^31 values");
  return static_cast<int>(n);
}

// Rank 0's values to all, which know how many: meshes are larger than what one call takes.
template <class Values>
void broadcast(Values& values, MPI_Datatype type) {
  constexpr size_t most = size_t{1} << 28;
  for (size_t at = 0; at < values.size(); at += most) {
    MPI_Request request;
    MPI_Ibcast(values.data() + at, as_count(std::min(most, values.size() - at)), type, 0, MPI_COMM_WORLD, &request);
    wait(request);
  }
  if (own_rank == 0) note_sent(everybody, n_ranks - 1, (n_ranks - 1.0) * values.size() * sizeof(values[0]));
}

template <class Values>
Values shared_values(Values values, MPI_Datatype type) {
  if (n_ranks == 1) return values;
  std::vector<long> size{static_cast<long>(values.size())};
  broadcast(size, MPI_LONG);
  values.resize(static_cast<size_t>(size[0]));
  if (size[0] > 0) broadcast(values, type);
  return values;
}

void send(const double* values, size_t n, int rank, Tag tag) {
  MPI_Request request;
  MPI_Isend(values, as_count(n), MPI_DOUBLE, rank, tag, MPI_COMM_WORLD, &request);
  wait(request);
  note_sent(asker, 1, 8.0 * n);
}

std::vector<double> receive(int rank, Tag tag) {
  int is_there = 0, n = 0;
  MPI_Status status;
  const auto start = std::chrono::steady_clock::now();
  while (!is_there) {
    MPI_Iprobe(rank, tag, MPI_COMM_WORLD, &is_there, &status);
    if (!is_there) look_out();
  }
  so_far.seconds_waited += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  MPI_Get_count(&status, MPI_DOUBLE, &n);
  std::vector<double> values(static_cast<size_t>(n));
  MPI_Recv(values.data(), n, MPI_DOUBLE, rank, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return values;
}

}  // namespace

void start(Say say) {
  say_error = say;
  if (launched_ranks() < 2) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  CHECK(provided >= MPI_THREAD_SERIALIZED, "an MPI that no two threads may use in turn");
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &own_rank);
  MPI_Comm on_machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &on_machine);
  MPI_Comm_size(on_machine, &n_on_machine);
  MPI_Comm_free(&on_machine);
  const long now = std::chrono::system_clock::now().time_since_epoch().count();
  job = shared(fmt::format("{:x}_{}", now, getpid()));
}

void finish() {
  if (n_ranks == 1) return;
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait(request);
  MPI_Finalize();
}

int count() { return n_ranks; }

int me() { return own_rank; }

int count_on_machine() { return n_on_machine; }

const std::string& name_of_job() { return job; }

void before_stop(void (*tidy)()) { tidy_up = tidy; }

void stop_all(const std::string& message, int code) {
  if (tidy_up) tidy_up();
  if (own_rank == 0) {
    say_error(message);
    MPI_Abort(MPI_COMM_WORLD, code);
  }
  std::string bytes(sizeof code, '\0');
  std::memcpy(bytes.data(), &code, sizeof code);
  bytes += message;
  MPI_Request request;
  MPI_Isend(bytes.data(), as_count(bytes.size()), MPI_BYTE, 0, failed, MPI_COMM_WORLD, &request);
  // Rank 0 ends this one, too.
  for (int is_done = 0;;) MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
}

std::string shared(std::string bytes) { return shared_values(std::move(bytes), MPI_BYTE); }

std::vector<double> shared(std::vector<double> values) { return shared_values(std::move(values), MPI_DOUBLE); }

std::vector<std::string> gathered(const std::string& bytes) {
  if (n_ranks == 1) return {bytes};
  std::vector<int> sizes(static_cast<size_t>(n_ranks)), starts(static_cast<size_t>(n_ranks) + 1, 0);
  const int size = as_count(bytes.size());
  MPI_Request request;
  MPI_Igather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD, &request);
  wait(request);
  for (size_t i = 0; i < sizes.size(); ++i) starts[i + 1] = starts[i] + (own_rank == 0 ? sizes[i] : 0);
  std::string all(static_cast<size_t>(starts.back()), '\0');
  MPI_Igatherv(bytes.data(), size, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE, 0, MPI_COMM_WORLD,
               &request);
  wait(request);
  if (own_rank != 0) {
    note_sent(everybody, 1, size);
    return {};
  }
  std::vector<std::string> texts;
  for (size_t i = 0; i < sizes.size(); ++i)
    texts.push_back(all.substr(static_cast<size_t>(starts[i]), static_cast<size_t>(sizes[i])));
  return texts;
}

std::vector<std::vector<int>> swapped(const std::vector<std::vector<int>>& to_each) {
  if (n_ranks == 1) return to_each;
  const auto n = static_cast<size_t>(n_ranks);
  std::vector<int> sent, sizes(n), found(n), starts(n + 1, 0), places(n + 1, 0);
  for (size_t rank = 0; rank < n; ++rank) {
    sizes[rank] = as_count(to_each[rank].size());
    starts[rank + 1] = starts[rank] + sizes[rank];
    sent.insert(sent.end(), to_each[rank].begin(), to_each[rank].end());
    if (sizes[rank] > 0) note_sent(everybody, 1, 4.0 * sizes[rank]);
  }
  MPI_Request request;
  MPI_Ialltoall(sizes.data(), 1, MPI_INT, found.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
  wait(request);
  for (size_t rank = 0; rank < n; ++rank) places[rank + 1] = places[rank] + found[rank];
  std::vector<int> received(static_cast<size_t>(places.back()));
  MPI_Ialltoallv(sent.data(), sizes.data(), starts.data(), MPI_INT, received.data(), found.data(), places.data(),
                 MPI_INT, MPI_COMM_WORLD, &request);
  wait(request);
  std::vector<std::vector<int>> from_each;
  for (size_t rank = 0; rank < n; ++rank)
    from_each.emplace_back(received.begin() + places[rank], received.begin() + places[rank + 1]);
  return from_each;
}

std::vector<double> to_first(int owner, std::vector<double> values) {
  if (owner == 0) return values;
  if (own_rank == owner) send(values.data(), values.size(), 0, brought);
  return own_rank == 0 ? receive(owner, brought) : values;
}

double largest(double value) {
  if (n_ranks == 1) return value;
  double of_all = value;
  MPI_Request request;
  MPI_Iallreduce(&value, &of_all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD, &request);
  wait(request);
  note_sent(everybody, 1, 8);
  return of_all;
}

bool any(bool is_so) { return largest(is_so ? 1.0 : 0.0) > 0.0; }

std::vector<double> sums(const std::vector<double>& values) {
  if (n_ranks == 1) return values;
  std::vector<double> of_all(values.size());
  MPI_Request request;
  MPI_Iallreduce(values.data(), of_all.data(), as_count(values.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD, &request);
  wait(request);
  note_sent(everybody, 1, 8.0 * values.size());
  return of_all;
}

Segments::Segments(const std::vector<int>& owner, const std::vector<int>& offset) {
  if (n_ranks == 1) return;
  of_rank_.resize(static_cast<size_t>(n_ranks));
  counts_.assign(static_cast<size_t>(n_ranks), 0);
  starts_.assign(static_cast<size_t>(n_ranks), 0);
  for (size_t i = 0; i < owner.size(); ++i) {
    const size_t rank = static_cast<size_t>(owner[i]);
    of_rank_[rank].push_back({offset[i], offset[i + 1] - offset[i]});
    counts_[rank] += of_rank_[rank].back().n;
  }
  for (size_t r = 1; r < counts_.size(); ++r) starts_[r] = starts_[r - 1] + counts_[r - 1];
  n_ = offset.back() - offset.front();
}

void Segments::complete(double* values, int width) const { collect(values, width, true); }

void Segments::bring(double* values) const { collect(values, 1, false); }

void Segments::collect(double* values, int width, bool on_all) const {
  if (n_ranks == 1 || n_ == 0) return;
  const size_t me_here = static_cast<size_t>(own_rank), w = static_cast<size_t>(width);
  std::vector<int> counts, starts;
  for (size_t r = 0; r < counts_.size(); ++r) {
    counts.push_back(as_count(w * static_cast<size_t>(counts_[r])));
    starts.push_back(as_count(w * static_cast<size_t>(starts_[r])));
  }
  own_.resize(static_cast<size_t>(counts[me_here]));
  all_.resize(on_all || own_rank == 0 ? w * static_cast<size_t>(n_) : 0);
  double* to = own_.data();
  for (const Run& run : of_rank_[me_here])
    to = std::copy_n(values + w * static_cast<size_t>(run.at), w * static_cast<size_t>(run.n), to);
  MPI_Request request;
  if (on_all)
    MPI_Iallgatherv(own_.data(), counts[me_here], MPI_DOUBLE, all_.data(), counts.data(), starts.data(), MPI_DOUBLE,
                    MPI_COMM_WORLD, &request);
  else
    MPI_Igatherv(own_.data(), counts[me_here], MPI_DOUBLE, all_.data(), counts.data(), starts.data(), MPI_DOUBLE, 0,
                 MPI_COMM_WORLD, &request);
  wait(request);
  if (on_all)
    note_sent(everybody, n_ranks - 1, 8.0 * (n_ranks - 1) * own_.size());
  else if (own_rank != 0)
    note_sent(asker, 1, 8.0 * own_.size());
  for (size_t r = 0; r < of_rank_.size() && !all_.empty(); ++r) {
    if (r == me_here) continue;
    const double* from = all_.data() + starts[r];
    for (const Run& run : of_rank_[r]) {
      std::copy_n(from, w * static_cast<size_t>(run.n), values + w * static_cast<size_t>(run.at));
      from += w * static_cast<size_t>(run.n);
    }
  }
}

Neighbours::Neighbours(const std::vector<int>& owner, const std::vector<std::vector<int>>& readers, int width)
    : width_(width) {
  std::vector<Peer> of_rank(static_cast<size_t>(n_ranks));
  for (size_t i = 0; i < owner.size(); ++i)
    for (const int reader : readers[i]) {
      if (reader == owner[i]) continue;
      if (owner[i] == own_rank) of_rank[static_cast<size_t>(reader)].sends.push_back(static_cast<int>(i));
      if (reader == own_rank) of_rank[static_cast<size_t>(owner[i])].receives.push_back(static_cast<int>(i));
    }
  for (size_t r = 0; r < of_rank.size(); ++r) {
    Peer& peer = of_rank[r];
    if (peer.sends.empty() && peer.receives.empty()) continue;
    peer.rank = static_cast<int>(r);
    peers_.push_back(std::move(peer));
  }
}

struct Neighbours::Flight {
  std::vector<MPI_Request> requests;
};

// Of fields that lie in one array, width numbers at each index, or in several, one number at each.
template <class Place>
void Neighbours::send(int n_blocks, int width, Place&& place) const {
  if (peers_.empty()) return;
  CHECK(!flight_, "what was sent before has been received");
  flight_ = std::make_shared<Flight>();
  for (Peer& peer : peers_) {
    const auto n = static_cast<size_t>(n_blocks) * static_cast<size_t>(width);
    peer.in.resize(n * peer.receives.size());
    peer.out.resize(n * peer.sends.size());
    if (peer.in.empty()) continue;
    MPI_Irecv(peer.in.data(), as_count(peer.in.size()), MPI_DOUBLE, peer.rank, passed, MPI_COMM_WORLD,
              &flight_->requests.emplace_back());
  }
  for (Peer& peer : peers_) {
    if (peer.out.empty()) continue;
    double* to = peer.out.data();
    for (int block = 0; block < n_blocks; ++block)
      for (const int i : peer.sends) to = std::copy_n(place(block, i), width, to);
    MPI_Isend(peer.out.data(), as_count(peer.out.size()), MPI_DOUBLE, peer.rank, passed, MPI_COMM_WORLD,
              &flight_->requests.emplace_back());
    note_sent(neighbours, 1, 8.0 * peer.out.size());
  }
}

template <class Place>
void Neighbours::receive(int n_blocks, int width, Place&& place) const {
  if (peers_.empty()) return;
  CHECK(flight_ != nullptr, "what is received has been sent");
  for (MPI_Request& request : flight_->requests) wait(request);
  flight_.reset();
  for (const Peer& peer : peers_) {
    const double* from = peer.in.data();
    for (int block = 0; block < n_blocks; ++block)
      for (const int i : peer.receives) {
        std::copy_n(from, width, place(block, i));
        from += width;
      }
  }
}

void Neighbours::begin(const double* values) const {
  send(1, width_, [&](int, int i) { return values + static_cast<std::ptrdiff_t>(width_) * i; });
}

void Neighbours::end(double* values) const {
  receive(1, width_, [&](int, int i) { return values + static_cast<std::ptrdiff_t>(width_) * i; });
}

void Neighbours::begin(std::initializer_list<const double*> fields) const {
  send(static_cast<int>(fields.size()), 1, [&](int field, int i) { return fields.begin()[field] + i; });
}

void Neighbours::end(std::initializer_list<double*> fields) const {
  receive(static_cast<int>(fields.size()), 1, [&](int field, int i) { return fields.begin()[field] + i; });
}

void Neighbours::exchange(double* values) const {
  begin(values);
  end(values);
}

void Neighbours::exchange(std::initializer_list<double*> fields) const {
  send(static_cast<int>(fields.size()), 1, [&](int field, int i) { return fields.begin()[field] + i; });
  end(fields);
}

void Neighbours::exchange(const std::vector<double*>& fields) const {
  const auto place = [&](int field, int i) { return fields[static_cast<size_t>(field)] + i; };
  send(static_cast<int>(fields.size()), 1, place);
  receive(static_cast<int>(fields.size()), 1, place);
}

struct LaterLargest::Flight {
  double own, of_all;
  MPI_Request request;
};

void LaterLargest::begin(double value) {
  CHECK(!flight_, "one at a time");
  flight_ = std::make_shared<Flight>(Flight{value, value, MPI_REQUEST_NULL});
  if (n_ranks == 1) return;
  MPI_Iallreduce(&flight_->own, &flight_->of_all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD, &flight_->request);
  note_sent(everybody, 1, 8);
}

double LaterLargest::end() {
  CHECK(flight_ != nullptr, "it was asked for");
  if (n_ranks > 1) wait(flight_->request);
  const double of_all = flight_->of_all;
  flight_.reset();
  return of_all;
}

std::vector<double> ask(int rank, const Question& question, std::span<const double> with) {
  const std::scoped_lock lock(asking);
  std::vector<double> message{static_cast<double>(question.what), static_cast<double>(question.of)};
  message.insert(message.end(), with.begin(), with.end());
  send(message.data(), message.size(), rank, asked);
  return receive(rank, answered);
}

void answer_until_released(const Answer& answer) {
  for (;;) {
    const std::vector<double> message = receive(0, asked);
    if (message.empty()) return;
    const Question question{static_cast<int>(message[0]), static_cast<int>(message[1])};
    const std::vector<double> values = answer(question, std::span(message).subspan(2));
    send(values.data(), values.size(), 0, answered);
  }
}

void release_all() {
  for (int rank = 1; rank < n_ranks; ++rank) send(nullptr, 0, rank, asked);
}

Traffic traffic() { return so_far; }

}  // namespace dygita::ranks
#endif

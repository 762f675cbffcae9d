// The ranks of MPI. Whoever waits looks out for errors of others meanwhile, so that one of them ends all.
#ifdef DYGITA_HAS_MPI
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <mutex>

#include "base/error.hpp"
#include "ranks/launcher.hpp"
#include "ranks/mpi_request.hpp"

namespace dygita::ranks {

namespace {

int n_ranks = 1, own_rank = 0, n_on_machine = 1;
std::string job = "alone";
Traffic so_far;
std::mutex asking;
Say say_error = nullptr;
void (*tidy_up)() = nullptr;

// What another rank says that has failed: its exit code, four bytes, and its message; empty: none has.
std::string word_of_failed() {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, failed, MPI_COMM_WORLD, &is_there, &status);
  if (!is_there) return "";
  int n = 0;
  MPI_Get_count(&status, MPI_BYTE, &n);
  std::string bytes(static_cast<size_t>(n), '\0');
  MPI_Recv(bytes.data(), n, MPI_BYTE, status.MPI_SOURCE, failed, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

// On rank 0. Errors of a deck are found by all ranks, of which the slowest may still be at work on what is tidied up.
[[noreturn]] void end_all(const std::string& message, int code, int n_failed) {
  constexpr std::chrono::seconds patience(2);
  say_error(message);
  const auto start = std::chrono::steady_clock::now();
  while (tidy_up && n_failed < n_ranks && std::chrono::steady_clock::now() - start < patience)
    n_failed += !word_of_failed().empty();
  if (tidy_up) tidy_up();
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

// Does rank 0 hear that another has failed?
void look_out() {
  if (own_rank != 0) return;
  const std::string word = word_of_failed();
  if (word.empty()) return;
  int code = 0;
  std::memcpy(&code, word.data(), sizeof code);
  end_all(word.substr(sizeof code), code, 2);  // that one, and this, which is at work on nothing else
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
  if (own_rank == 0) end_all(message, code, 1);
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

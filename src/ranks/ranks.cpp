#include "ranks/ranks.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "ranks/launcher.hpp"
#include "ranks/transport.hpp"

namespace dygita::ranks {

namespace {

using clock = std::chrono::steady_clock;

thread_local Office* office_of_thread = nullptr;

Transport& transport() { return *office().transport; }

// What another rank says that has failed: its exit code, four bytes, and its message; empty: none has.
std::string word_of_failed() {
  const std::optional<Transport::Letter> letter = transport().letter(-1, failed, 1);
  if (!letter) return "";
  std::string bytes(letter->n, '\0');
  const FlightPtr flight = transport().receive(incoming(std::span(bytes)), letter->rank, failed);
  while (!flight->is_done()) continue;
  return bytes;
}

// On rank 0. Errors of a deck are found by all ranks, of which the slowest may still be at work on what is tidied up.
[[noreturn]] void end_all(const std::string& message, int code, int n_failed) {
  constexpr std::chrono::seconds patience(2);
  office().say_error(message);
  const auto start = clock::now();
  while (office().tidy_up && n_failed < count() && clock::now() - start < patience)
    n_failed += !word_of_failed().empty();
  if (office().tidy_up) office().tidy_up();
  transport().abort(code);
  std::abort();  // not reached: the call above is virtual, which compilers do not take for an end
}

// Does rank 0 learn that another has failed?
void look_out() {
  if (me() != 0) return;
  const std::string word = word_of_failed();
  if (word.empty()) return;
  int code = 0;
  std::memcpy(&code, word.data(), sizeof code);
  end_all(word.substr(sizeof code), code, 2);  // that one, and this, which is at work on nothing else
}

// Rank 0's values to all, which know how many: meshes are larger than what one call takes.
template <class Item>
void broadcast(std::span<Item> values) {
  constexpr size_t most = size_t{1} << 28;
  for (size_t at = 0; at < values.size(); at += most)
    wait(*transport().broadcast(incoming(values.subspan(at, std::min(most, values.size() - at)))));
  if (me() == 0) note_sent(everybody, count() - 1, (count() - 1.0) * static_cast<double>(values.size_bytes()));
}

template <class Values>
Values shared_values(Values values) {
  if (is_alone()) return values;
  double size = static_cast<double>(values.size());
  broadcast(std::span(&size, 1));
  values.resize(static_cast<size_t>(size));
  if (size > 0) broadcast(std::span(values));
  return values;
}

void send(std::span<const double> values, int rank, Tag tag) {
  wait(*transport().send(outgoing(values), rank, tag));
  note_sent(asker, 1, static_cast<double>(values.size_bytes()));
}

std::vector<double> receive(int rank, Tag tag) {
  const auto start = clock::now();
  std::optional<Transport::Letter> letter;
  while (!(letter = transport().letter(rank, tag, sizeof(double)))) look_out();
  office().so_far.seconds_waited += std::chrono::duration<double>(clock::now() - start).count();
  std::vector<double> values(letter->n);
  const FlightPtr flight = transport().receive(incoming(std::span(values)), rank, tag);
  while (!flight->is_done()) continue;
  return values;
}

}  // namespace

Office& office() {
  static Office of_process;
  return office_of_thread ? *office_of_thread : of_process;
}

void set_office(Office* office) { office_of_thread = office; }

int as_count(size_t n) {
  CHECK(n <= static_cast<size_t>(std::numeric_limits<int>::max()), "a message of more than 2^31 items");
  return static_cast<int>(n);
}

void wait(Flight& flight) {
  constexpr int between_looks = 64;
  const auto start = clock::now();
  for (int i = 1; !flight.is_done(); ++i)
    if (i % between_looks == 0) look_out();
  office().so_far.seconds_waited += std::chrono::duration<double>(clock::now() - start).count();
}

void note_sent(Receivers to, double n_messages, double n_bytes) {
  office().so_far.messages[to] += n_messages;
  office().so_far.bytes[to] += n_bytes;
}

void start(Say say) {
  office().say_error = say;
  if (launched_ranks() < 2) return;
  office().transport = join_mpi();
  if (!office().transport)
    throw InputError(
        "started as one of several MPI ranks, and this dygita was "
        "built without MPI\n    build it where "
        "libopenmpi-dev is installed (cmake -DDYGITA_MPI=ON), or "
        "start it without mpirun");
  const long now = std::chrono::system_clock::now().time_since_epoch().count();
  office().job = shared(fmt::format("{:x}_{}", now, getpid()));
}

void finish() {
  if (!is_alone()) transport().finish();
}

int count() { return office().transport ? office().transport->count() : 1; }

int me() { return office().transport ? office().transport->me() : 0; }

int count_on_machine() { return office().transport ? office().transport->count_on_machine() : 1; }

const std::string& name_of_job() { return office().job; }

void before_stop(void (*tidy)()) { office().tidy_up = tidy; }

void stop_all(const std::string& message, int code) {
  CHECK(!is_alone(), "several ranks");
  if (office().tidy_up) office().tidy_up();
  if (me() == 0) end_all(message, code, 1);
  std::string bytes(sizeof code, '\0');
  std::memcpy(bytes.data(), &code, sizeof code);
  bytes += message;
  const FlightPtr flight = transport().send(outgoing(std::span<const char>(bytes)), 0, failed);
  // Rank 0 ends this one, too.
  for (;;) flight->is_done();
}

std::string shared(std::string bytes) { return shared_values(std::move(bytes)); }

std::vector<double> shared(std::vector<double> values) { return shared_values(std::move(values)); }

std::vector<std::string> gathered(const std::string& bytes) {
  if (is_alone()) return {bytes};
  std::vector<int> sizes;
  for (const std::vector<double>& size : of_all({static_cast<double>(bytes.size())}))
    sizes.push_back(as_count(static_cast<size_t>(size[0])));
  std::string all(me() == 0 ? std::accumulate(sizes.begin(), sizes.end(), size_t{0}) : 0, '\0');
  wait(*transport().gather(outgoing(std::span<const char>(bytes)), all.data(), sizes, false));
  if (me() != 0) {
    note_sent(everybody, 1, static_cast<double>(bytes.size()));
    return {};
  }
  std::vector<std::string> texts;
  size_t at = 0;
  for (const int size : sizes) {
    texts.push_back(all.substr(at, static_cast<size_t>(size)));
    at += static_cast<size_t>(size);
  }
  return texts;
}

std::vector<std::vector<int>> swapped(const std::vector<std::vector<int>>& to_each) {
  if (is_alone()) return to_each;
  const auto n = static_cast<size_t>(count());
  std::vector<int> sent, sizes, found(n), one_each(n, 1);
  for (const std::vector<int>& to_one : to_each) {
    sizes.push_back(as_count(to_one.size()));
    sent.insert(sent.end(), to_one.begin(), to_one.end());
    if (!to_one.empty()) note_sent(everybody, 1, 4.0 * static_cast<double>(to_one.size()));
  }
  wait(*transport().swap(outgoing(std::span<const int>(sizes)), one_each, found.data(), one_each));
  std::vector<int> received(std::accumulate(found.begin(), found.end(), size_t{0}));
  wait(*transport().swap(outgoing(std::span<const int>(sent)), sizes, received.data(), found));
  std::vector<std::vector<int>> from_each;
  auto at = received.begin();
  for (const int size : found) {
    from_each.emplace_back(at, at + size);
    at += size;
  }
  return from_each;
}

std::vector<double> to_first(int owner, std::vector<double> values) {
  if (owner == 0) return values;
  if (me() == owner) send(values, 0, brought);
  return me() == 0 ? receive(owner, brought) : values;
}

double largest(double value) {
  LaterLargest of_all;
  of_all.begin(value);
  return of_all.end();
}

bool any(bool is_so) { return largest(is_so ? 1.0 : 0.0) > 0.0; }

std::vector<double> sums(const std::vector<double>& values) {
  if (is_alone()) return values;
  std::vector<double> of_all(values.size());
  wait(*transport().sums(values, of_all));
  note_sent(everybody, 1, 8.0 * static_cast<double>(values.size()));
  return of_all;
}

struct LaterLargest::Flight {
  double own, of_all;
  FlightPtr flight = nullptr;
};

void LaterLargest::begin(double value) {
  CHECK(!flight_, "one at a time");
  flight_ = std::make_shared<Flight>(Flight{value, value});
  if (is_alone()) return;
  flight_->flight = transport().largest(flight_->own, flight_->of_all);
  note_sent(everybody, 1, 8);
}

double LaterLargest::end() {
  CHECK(flight_ != nullptr, "it was asked for");
  if (flight_->flight) wait(*flight_->flight);
  const double of_all = flight_->of_all;
  flight_.reset();
  return of_all;
}

std::vector<double> ask(int rank, const Question& question, std::span<const double> with) {
  CHECK(!is_alone(), "there is nobody to ask");
  const std::scoped_lock lock(office().asking);
  std::vector<double> message{static_cast<double>(question.what), static_cast<double>(question.of)};
  message.insert(message.end(), with.begin(), with.end());
  send(message, rank, asked);
  return receive(rank, answered);
}

void answer_until_released(const Answer& answer) {
  if (is_alone()) return;
  for (;;) {
    const std::vector<double> message = receive(0, asked);
    if (message.empty()) return;
    const Question question{static_cast<int>(message[0]), static_cast<int>(message[1])};
    send(answer(question, std::span(message).subspan(2)), 0, answered);
  }
}

void release_all() {
  for (int rank = 1; rank < count(); ++rank) send({}, rank, asked);
}

Traffic traffic() { return office().so_far; }

}  // namespace dygita::ranks

#include "ranks/thread_ranks.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <deque>
#include <exception>
#include <map>
#include <thread>
#include <tuple>

#include "ranks/transport.hpp"

namespace dygita::ranks {

namespace {

using Bytes = std::vector<std::byte>;

struct AllEnd {};

// A collective call: what each rank has brought so far.
struct Round {
  std::vector<Bytes> brought;
  std::vector<std::vector<int>> counts;
  int n = 0;
};

// What the ranks have in common.
struct Post {
  explicit Post(int n_ranks) : n(n_ranks) {}
  const int n;
  std::mutex mutex;
  std::map<std::tuple<int, int, int>, std::deque<Bytes>> letters;  // from, to, tag
  std::map<long, Round> rounds;
  std::atomic<int> code{0};
};

Bytes bytes_of(const void* at, size_t n) {
  const auto* from = static_cast<const std::byte*>(at);
  return {from, from + n};
}

class ThreadFlight final : public Flight {
 public:
  ThreadFlight(Post& post, std::function<bool()> try_to_land) : post_(post), try_to_land_(std::move(try_to_land)) {}
  bool is_done() override {
    if (post_.code != 0) throw AllEnd();
    std::this_thread::yield();
    const std::scoped_lock lock(post_.mutex);
    if (!is_done_) is_done_ = try_to_land_();
    return is_done_;
  }

 private:
  Post& post_;
  std::function<bool()> try_to_land_;
  bool is_done_ = false;
};

class ThreadRank final : public Transport {
 public:
  ThreadRank(Post& post, int me) : post_(post), me_(me) {}
  int count() const override { return post_.n; }
  int me() const override { return me_; }
  int count_on_machine() const override { return 1; }  // nothing is shared by files

  FlightPtr send(const Outgoing& items, int rank, Tag tag) override {
    const std::scoped_lock lock(post_.mutex);
    post_.letters[{me_, rank, tag}].push_back(bytes_of(items.at, items.n * static_cast<size_t>(items.width)));
    return landing([] { return true; });
  }
  FlightPtr receive(const Incoming& items, int rank, Tag tag) override {
    return landing([=, this] {
      std::deque<Bytes>& box = post_.letters[{rank, me_, tag}];
      if (box.empty()) return false;
      if (box.front().size() != items.n * static_cast<size_t>(items.width)) throw std::logic_error("another size");
      std::copy(box.front().begin(), box.front().end(), static_cast<std::byte*>(items.at));
      box.pop_front();
      return true;
    });
  }
  std::optional<Letter> letter(int rank, Tag tag, int width) override {
    if (post_.code != 0) throw AllEnd();
    std::this_thread::yield();
    const std::scoped_lock lock(post_.mutex);
    for (int from = std::max(rank, 0); from < (rank < 0 ? post_.n : rank + 1); ++from)
      if (const auto box = post_.letters.find({from, me_, tag}); box != post_.letters.end() && !box->second.empty())
        return Letter{from, box->second.front().size() / static_cast<size_t>(width)};
    return std::nullopt;
  }

  FlightPtr broadcast(const Incoming& items) override {
    const size_t n = items.n * static_cast<size_t>(items.width);
    return together(me_ == 0 ? bytes_of(items.at, n) : Bytes(), {}, [=](const Round& all) {
      std::copy(all.brought[0].begin(), all.brought[0].end(), static_cast<std::byte*>(items.at));
    });
  }
  FlightPtr gather(const Outgoing& own, void* to, const std::vector<int>&, bool on_all) override {
    return together(bytes_of(own.at, own.n * static_cast<size_t>(own.width)), {}, [=, this](const Round& all) {
      if (!on_all && me_ != 0) return;
      auto* at = static_cast<std::byte*>(to);
      for (const Bytes& of_one : all.brought) at = std::copy(of_one.begin(), of_one.end(), at);
    });
  }
  FlightPtr swap(const Outgoing& to_all, const std::vector<int>& to_each, void* from_all,
                 const std::vector<int>&) override {
    const auto width = static_cast<size_t>(to_all.width);
    return together(bytes_of(to_all.at, to_all.n * width), to_each, [=, this](const Round& all) {
      auto* at = static_cast<std::byte*>(from_all);
      for (size_t from = 0; from < all.brought.size(); ++from) {
        const std::vector<int>& counts = all.counts[from];
        size_t first = 0;
        for (int r = 0; r < me_; ++r) first += width * static_cast<size_t>(counts[static_cast<size_t>(r)]);
        const std::byte* begin = all.brought[from].data() + first;
        at = std::copy(begin, begin + width * static_cast<size_t>(counts[static_cast<size_t>(me_)]), at);
      }
    });
  }
  FlightPtr largest(const double& own, double& of_all) override {
    return together(bytes_of(&own, sizeof own), {}, [&of_all](const Round& all) {
      for (const Bytes& of_one : all.brought) {
        double value = 0.0;
        std::memcpy(&value, of_one.data(), sizeof value);
        of_all = std::max(of_all, value);
      }
    });
  }
  FlightPtr sums(std::span<const double> own, std::span<double> of_all) override {
    return together(bytes_of(own.data(), own.size_bytes()), {}, [of_all](const Round& all) {
      std::fill(of_all.begin(), of_all.end(), 0.0);
      for (const Bytes& of_one : all.brought)
        for (size_t i = 0; i < of_all.size(); ++i) {
          double value = 0.0;
          std::memcpy(&value, of_one.data() + i * sizeof value, sizeof value);
          of_all[i] += value;
        }
    });
  }

  void finish() override {}
  void abort(int code) override {
    post_.code = code;
    throw AllEnd();
  }

 private:
  FlightPtr landing(std::function<bool()> try_to_land) {
    return std::make_unique<ThreadFlight>(post_, std::move(try_to_land));
  }
  FlightPtr together(Bytes own, const std::vector<int>& counts, std::function<void(const Round&)> land) {
    const std::scoped_lock lock(post_.mutex);
    const long number = n_rounds_++;
    Round& round = post_.rounds[number];
    round.brought.resize(static_cast<size_t>(post_.n));
    round.counts.resize(static_cast<size_t>(post_.n));
    round.brought[static_cast<size_t>(me_)] = std::move(own);
    round.counts[static_cast<size_t>(me_)] = counts;
    ++round.n;
    return landing([=, this] {
      const Round& now = post_.rounds.at(number);
      if (now.n < post_.n) return false;
      land(now);
      return true;
    });
  }

  Post& post_;
  const int me_;
  long n_rounds_ = 0;
};

thread_local std::string said_here;

}  // namespace

Ended run_as_ranks(int n, const std::function<void()>& of_rank) {
  Post post(n);
  Ended ended;
  std::exception_ptr thrown;
  std::vector<std::thread> threads;
  for (int rank = 0; rank < n; ++rank)
    threads.emplace_back([&, rank] {
      Office here;
      here.transport = std::make_unique<ThreadRank>(post, rank);
      here.job = "threads";
      here.say_error = [](const std::string& message) { said_here = message; };
      said_here.clear();
      set_office(&here);
      try {
        of_rank();
      } catch (const AllEnd&) {
      } catch (...) {
        const std::scoped_lock lock(post.mutex);
        if (!thrown) thrown = std::current_exception();
        post.code = -1;  // others would wait for ever
      }
      if (rank == 0) ended.said = said_here;
      set_office(nullptr);
    });
  for (std::thread& thread : threads) thread.join();
  if (thrown) std::rethrow_exception(thrown);
  ended.code = post.code;
  return ended;
}

}  // namespace dygita::ranks

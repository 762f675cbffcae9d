// Fields whose parts the ranks own: completed everywhere, brought to rank 0, or passed between neighbours.
#include <algorithm>

#include "base/error.hpp"
#include "ranks/neighbours.hpp"
#include "ranks/transport.hpp"

namespace dygita::ranks {

Segments::Segments(const std::vector<int>& owner, const std::vector<int>& offset) {
  if (count() == 1) return;
  of_rank_.resize(static_cast<size_t>(count()));
  counts_.assign(static_cast<size_t>(count()), 0);
  starts_.assign(static_cast<size_t>(count()), 0);
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
  if (count() == 1 || n_ == 0) return;
  const size_t me_here = static_cast<size_t>(me()), w = static_cast<size_t>(width);
  std::vector<int> counts, starts;
  for (size_t r = 0; r < counts_.size(); ++r) {
    counts.push_back(as_count(w * static_cast<size_t>(counts_[r])));
    starts.push_back(as_count(w * static_cast<size_t>(starts_[r])));
  }
  own_.resize(static_cast<size_t>(counts[me_here]));
  all_.resize(on_all || me() == 0 ? w * static_cast<size_t>(n_) : 0);
  double* to = own_.data();
  for (const Run& run : of_rank_[me_here])
    to = std::copy_n(values + w * static_cast<size_t>(run.at), w * static_cast<size_t>(run.n), to);
  wait(*office().transport->gather(outgoing(std::span<const double>(own_)), all_.data(), counts, on_all));
  if (on_all)
    note_sent(everybody, count() - 1, 8.0 * (count() - 1) * own_.size());
  else if (me() != 0)
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

std::vector<std::vector<double>> of_all(const std::vector<double>& own) {
  if (count() == 1) return {own};
  std::vector<int> ranks, each{0}, starts{0};
  for (int rank = 0; rank < count(); ++rank) {
    ranks.push_back(rank);
    each.push_back(rank + 1);
  }
  std::vector<double> sizes(ranks.size());
  sizes[static_cast<size_t>(me())] = static_cast<double>(own.size());
  Segments(ranks, each).complete(sizes.data());
  for (const double size : sizes)
    starts.push_back(as_count(static_cast<size_t>(starts.back()) + static_cast<size_t>(size)));
  std::vector<double> values(static_cast<size_t>(starts.back()));
  std::copy(own.begin(), own.end(), values.begin() + starts[static_cast<size_t>(me())]);
  Segments(ranks, starts).complete(values.data());
  std::vector<std::vector<double>> of_all;
  for (size_t rank = 0; rank < ranks.size(); ++rank)
    of_all.emplace_back(values.begin() + starts[rank], values.begin() + starts[rank + 1]);
  return of_all;
}

Neighbours::Neighbours(const std::vector<int>& owner, const std::vector<std::vector<int>>& readers, int width)
    : width_(width) {
  std::vector<Peer> of_rank(static_cast<size_t>(count()));
  for (size_t i = 0; i < owner.size(); ++i)
    for (const int reader : readers[i]) {
      if (reader == owner[i]) continue;
      if (owner[i] == me()) of_rank[static_cast<size_t>(reader)].sends.push_back(static_cast<int>(i));
      if (reader == me()) of_rank[static_cast<size_t>(owner[i])].receives.push_back(static_cast<int>(i));
    }
  for (size_t r = 0; r < of_rank.size(); ++r) {
    Peer& peer = of_rank[r];
    if (peer.sends.empty() && peer.receives.empty()) continue;
    peer.rank = static_cast<int>(r);
    peers_.push_back(std::move(peer));
  }
}

struct Neighbours::Flight {
  std::vector<FlightPtr> messages;
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
    flight_->messages.push_back(office().transport->receive(incoming(std::span(peer.in)), peer.rank, passed));
  }
  for (Peer& peer : peers_) {
    if (peer.out.empty()) continue;
    double* to = peer.out.data();
    for (int block = 0; block < n_blocks; ++block)
      for (const int i : peer.sends) to = std::copy_n(place(block, i), width, to);
    flight_->messages.push_back(
        office().transport->send(outgoing(std::span<const double>(peer.out)), peer.rank, passed));
    note_sent(neighbours, 1, 8.0 * peer.out.size());
  }
}

template <class Place>
void Neighbours::receive(int n_blocks, int width, Place&& place) const {
  if (peers_.empty()) return;
  CHECK(flight_ != nullptr, "what is received has been sent");
  for (const FlightPtr& message : flight_->messages) wait(*message);
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

}  // namespace dygita::ranks

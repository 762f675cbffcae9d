// Values that pass between ranks that share interface points: each is sent to those who read it, and to nobody else.
#pragma once

#include <initializer_list>
#include <memory>
#include <vector>

namespace dygita::ranks {

class Neighbours {
 public:
  Neighbours() = default;
  // Of values in one order on all ranks, `width` numbers each. owner: who has the value; readers: who wants it.
  Neighbours(const std::vector<int>& owner, const std::vector<std::vector<int>>& readers, int width);
  // values: a rank has filled those that it owns, and gets those that it reads.
  void exchange(double* values) const;
  // The same of several fields of one number a value, in one message.
  void exchange(std::initializer_list<double*> fields) const;
  void exchange(const std::vector<double*>& fields) const;
  // Each of them in two halves, between which the caller computes what needs nothing of the others. What is sent is
  // read by the first, what is received is written by the second.
  void begin(const double* values) const;
  void end(double* values) const;
  void begin(std::initializer_list<const double*> fields) const;
  void end(std::initializer_list<double*> fields) const;
  bool is_empty() const { return peers_.empty(); }

 private:
  struct Peer {
    int rank;
    std::vector<int> sends, receives;  // values
    std::vector<double> out, in;
  };
  template <class Place>
  void send(int n_blocks, int width, Place&& place) const;
  template <class Place>
  void receive(int n_blocks, int width, Place&& place) const;

  struct Flight;  // messages that are on their way
  int width_ = 0;
  mutable std::vector<Peer> peers_;
  mutable std::shared_ptr<Flight> flight_;
};

}  // namespace dygita::ranks

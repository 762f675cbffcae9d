// Ranks that are threads of this process: what ranks make of messages is tested without mpirun. A thread that is a rank
// computes on itself alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace dygita::ranks {

// What has become of ranks of which one has ended all.
struct Ended {
  std::string said;  // by rank 0
  int code = 0;      // 0: nobody has ended them
};

// Runs `of_rank` on n ranks and waits for all of them; exceptions of a rank but the end of all are thrown here.
Ended run_as_ranks(int n, const std::function<void()>& of_rank);

}  // namespace dygita::ranks

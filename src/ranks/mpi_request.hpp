// What all messages of MPI go through.
#pragma once

#include <mpi.h>

#include <cstddef>

#include "ranks/ranks.hpp"

namespace dygita::ranks {

enum Tag { failed = 1, asked, answered, passed, brought };

// Until it is done, and no longer than until another rank fails: then the run ends here.
void wait(MPI_Request request);

void note_sent(Receivers to, double n_messages, double n_bytes);

// As MPI counts. Fails a check beyond 2^31 - 1.
int as_count(size_t n);

}  // namespace dygita::ranks

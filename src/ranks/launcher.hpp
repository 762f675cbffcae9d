// What mpirun, srun and mpiexec tell a process of itself before it has joined the others.
#pragma once

#include <cstdlib>

namespace dygita::ranks {

// Ranks that the process was started as one of; 1: by nobody.
inline int launched_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return 1;
}

}  // namespace dygita::ranks

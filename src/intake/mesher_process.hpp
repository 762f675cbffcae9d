// The mesher as a process of its own: started, watched, ended.
#pragma once

#include "intake/mesher_task.hpp"
#include "mesh/mesh_limits.hpp"

namespace dygita {

// The deck's folder, which mesh files may include others from, besides their own.
void set_mesh_folder(const std::string& folder);

// Collective: of several ranks the first has the mesher at work, all get its answer. Hands the task to it and waits;
// says its warnings. Throws InputError, on all ranks: what the mesher says of the file, a mesher that crashes, takes
// too long or is not installed; that the user interrupted it.
MesherAnswer ask_mesher(const MesherTask& task, const std::string& file);

}  // namespace dygita

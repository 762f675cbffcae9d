// Meshes of CAD files, kept beside the deck for its next run: what gmsh answered, signed by the user's own secret.
//
// Nothing in that folder is believed: a deck may come with one from a stranger, and disks lose bytes. What is not
// signed by this user for exactly this question is as if it were not there, and what is taken is checked again as any
// answer.
#pragma once

#include <string>
#include <vector>

#include "intake/mesher_task.hpp"

namespace dygita {

class MeshCache {
 public:
  static constexpr const char* folder_name = ".dygita";

  // For one task, whose file is `file`, beside the deck in `folder`. Never finds or keeps anything: with a limit of 0
  // (mesh_limits), for a script or a STEP file that names others, for a trusted file, and where there is no secret.
  MeshCache(const MesherTask& task, const std::string& file, const std::string& folder);

  // The answer to the same task about the same bytes, by the same program with the same libraries; empty: none.
  std::string find();
  // libraries: files that the mesher has loaded. What was found is not written again. Older meshes go where all would
  // take more than the limit. A folder that cannot be written is no error.
  void keep(const std::string& answer, const std::vector<std::string>& libraries) const;

 private:
  // The task and the bytes of its file; empty: nothing is kept of it.
  std::string question() const;

  MesherTask task_;
  std::string file_, folder_;
  std::string secret_, asked_;  // asked_: what find() was asked
  std::string name_;            // of the file, which other users of the folder cannot guess
  bool is_found_ = false;
};

}  // namespace dygita

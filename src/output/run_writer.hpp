// The output directory of one run: ParaView files while it runs, tables and the run record at its end.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "result/frame.hpp"
#include "result/result.hpp"

namespace dygita {

// What the run record tells beside the result.
struct RunIdentity {
  std::string deck_path, deck_digest;                              // digest of the deck's text
  std::vector<std::pair<std::string, double>> parameters;          // param{} after --set
  std::vector<std::pair<std::string, std::string>> mesh_digests;   // substructure, digest
  int threads = 1;
};

class RunWriter {
 public:
  // Creates `directory` (out/<problem>/<case>); removes the files of a former run of ours in it, nothing else.
  // Throws InputError when it cannot be written.
  RunWriter(std::filesystem::path directory, std::string problem_name);
  ~RunWriter();

  // One .vtu a substructure and one a file of all interfaces; the .pvd files are rewritten after each frame, so that an
  // interrupted run can be opened. Inline binary, zlib: Debian's ParaView cannot read appended data.
  void write_frame(const Frame& frame);

  // <output name>.csv for each table, energy.csv, convergence.csv, run.json (versions, digests, parameters, figures, warnings).
  void write_result(const Problem& problem, const RunResult& result, const RunIdentity& identity,
                    const std::vector<std::string>& warnings);

  const std::filesystem::path& directory() const { return directory_; }

 private:
  struct Index;  // the frames written so far
  std::filesystem::path directory_;
  std::string problem_name_;
  std::unique_ptr<Index> index_;
};

}  // namespace dygita

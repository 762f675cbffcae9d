// The output directory of one run: ParaView files while it runs, tables and the run record at its end.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/files.hpp"
#include "files/frame_summary.hpp"
#include "result/frame.hpp"
#include "result/result.hpp"

namespace dygita {

// What the run record states beside the result.
struct RunIdentity {
  std::string deck_path, deck_digest;                             // digest of the deck's text
  std::vector<std::pair<std::string, double>> parameters;         // param{} after --set
  std::string solver;                                             // --solver; empty: the deck's own
  std::vector<std::pair<std::string, std::string>> mesh_digests;  // substructure, digest; left out: the mesh's own
  int threads = 1;
  std::string kernels;  // of panels: "avx512", "avx2" or "generic"
  std::vector<std::pair<std::string, std::string>>
      libraries;  // name, version, beside those that output itself can name
  std::string case_name = "base";
  bool has_frames = true, has_state = true;  // else --no-frames, --no-state
  std::string from;                          // --from, absolute; empty: none
};

// "0.1.0"
const char* program_version();

// Those parts of the i-th frame that have fields, or the cells of them that are here, into a run's directory. Throws
// InputError when it cannot write.
void write_parts(const Frame& frame, size_t i, const std::filesystem::path& directory);

class RunWriter {
 public:
  // Creates `directory` (out/<problem>/<case>); removes the files of a former run of ours in it (those that its hidden
  // list .dygita-files names), nothing else. Throws InputError when it cannot be written or the name is that of another
  // file here.
  RunWriter(std::filesystem::path directory, std::string problem_name);
  ~RunWriter();

  // <problem>.pvd with one .vtu a substructure (where several ranks have its pieces a .pvtu, which names a .vtu of
  // each) and interfaces.pvd with one .vtu of all interfaces, both in frames/. The .pvd are rewritten after each frame,
  // of many after some of them and every second, so that a run in progress and an interrupted one can be opened. Inline
  // binary, zlib: Debian's ParaView cannot read appended data. `label_time` must increase (else ContractError). Throws
  // InputError when it cannot write.
  void write_frame(const Frame& frame);
  // The same in two halves, where other processes write the parts that have no fields here (write_parts) before the
  // second; the summary is of all parts.
  void begin_frame(const Frame& frame);
  void end_frame(const Frame& frame, const FrameSummary& summary);

  // <output name>.csv for each table, energy.csv, convergence.csv, bolts.csv. Throws InputError when it cannot write.
  void write_tables(const Problem& problem, const RunResult& result);
  // A file that another module makes of the run (scenes, the report). Throws InputError when it cannot write.
  void write(const std::string& file_name, const std::string& text);
  // Last, run.json (versions, digests, parameters, figures, warnings, files): where it stands the run came to its end.
  // Throws InputError when it cannot write.
  void write_record(const Problem& problem, const RunResult& result, const RunIdentity& identity,
                    const std::vector<std::string>& warnings);

  // The path for a file that somebody else writes here (state): run.json names it, the next run removes it.
  std::filesystem::path path_of(const std::string& file_name);
  // The folder for files called 0, 1, ..., n - 1 that others write here; throws InputError where it is a link.
  std::filesystem::path folder_of(const std::string& folder, int n_files);

  const std::filesystem::path& directory() const { return directory_; }
  const std::vector<FrameSummary>& frames() const;  // those written

 private:
  struct Index;  // the frames written so far
  void write_lists();
  void write_of_output(const std::string& file_name, const std::string& text);  // never over a file of the run
  void write_field(const std::string& name, const std::vector<Frame>& frames);

  std::filesystem::path directory_;
  std::string problem_name_;
  std::unique_ptr<Index> index_;
};

}  // namespace dygita

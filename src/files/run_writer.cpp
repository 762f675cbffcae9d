#include "files/run_writer.hpp"

#include <chrono>
#include <set>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/parallel_by_cost.hpp"
#include "base/task.hpp"
#include "files/bolt_table.hpp"
#include "files/collection.hpp"
#include "files/csv.hpp"
#include "files/manifest.hpp"
#include "files/run_record.hpp"
#include "files/vtk_writer.hpp"
#include "model/own_files.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

constexpr const char* interfaces_file = own_file::interfaces;
constexpr const char* frames_folder = "frames";
constexpr const char* interface_frames = "frames/interfaces";

std::string number_of(size_t frame) { return fmt::format("_{:05}.vtu", frame); }

// What the .pvd names.
fs::path part_file(const PartFrame& part, size_t frame) {
  return fs::path(frames_folder) /
         fmt::format("{}_{:05}.{}", file_name_of(part.part->name), frame, part.is_in_pieces() ? "pvtu" : "vtu");
}

// The cells of a rank, where several have some.
fs::path piece_file(const PartFrame& part, size_t frame, int rank) {
  return fs::path(frames_folder) / fmt::format("{}_{:05}_rank_{}.vtu", file_name_of(part.part->name), frame, rank);
}

std::vector<std::string> step_names(const Problem& problem) {
  std::vector<std::string> names;
  for (const StepPtr& step : problem.steps) names.push_back(step->name);
  return names;
}

}  // namespace

struct RunWriter::Index {
  explicit Index(const fs::path& directory) : manifest(directory) {}

  Manifest manifest;
  Collection parts, interfaces;
  std::vector<FrameSummary> frames;
  size_t n_listed = 0;
  std::chrono::steady_clock::time_point listed;
};

RunWriter::RunWriter(fs::path directory, std::string problem_name)
    : directory_(std::move(directory)), problem_name_(std::move(problem_name)) {
  if (file_name_of(problem_name_) + ".pvd" == interfaces_file) {
    throw InputError("a problem cannot be called '" + problem_name_ + "': its file " + interfaces_file +
                     " is that of the interface fields");
  }
  make_directory(directory_);
  refuse_links(directory_, interface_frames);  // before anything is computed
  index_ = std::make_unique<Index>(directory_);
}

RunWriter::~RunWriter() {
  try {
    write_lists();
  } catch (const InputError&) {  // whoever wrote last was told
  }
}

void write_parts(const Frame& frame, size_t i, const fs::path& directory) {
  refuse_links(directory, interface_frames);
  make_directory(directory / interface_frames);
  std::vector<const PartFrame*> here;
  std::vector<double> cost;
  for (const PartFrame& part : frame.parts) {
    if (part.displacement.cols() == 0) continue;
    here.push_back(&part);
    cost.push_back(part.displacement.cols());
  }
  parallel_by_cost(cost, [&](int k) {
    const PartFrame& part = *here[static_cast<size_t>(k)];
    write_part(part, frame, directory / (part.is_in_pieces() ? piece_file(part, i, part.rank) : part_file(part, i)));
  });
}

void RunWriter::write_frame(const Frame& frame) {
  begin_frame(frame);
  end_frame(frame, summary_of(frame));
}

void RunWriter::begin_frame(const Frame& frame) {
  CHECK(index_->frames.empty() || frame.label_time > index_->frames.back().label_time,
        "frames come in the order of their label_time");
  for (const PartFrame& part : frame.parts) {
    index_->manifest.add(part_file(part, index_->frames.size()));
    for (const int rank : part.ranks) index_->manifest.add(piece_file(part, index_->frames.size(), rank));
  }
  index_->manifest.while_there([&] { write_parts(frame, index_->frames.size(), directory_); });
}

// The frame's files first, then the lists that name them: a list never names what is not there.
void RunWriter::end_frame(const Frame& frame, const FrameSummary& summary) {
  const size_t i = index_->frames.size();
  if (!frame.interfaces.empty()) {
    const fs::path file = fs::path(interface_frames) / ("interfaces" + number_of(i));
    index_->manifest.add(file);
    index_->manifest.while_there([&] { write_interfaces(frame, directory_ / file); });
    index_->interfaces.add(frame.label_time, 0, "interfaces", file);
  }
  int i_part = 0;
  for (const PartFrame& part : frame.parts) {
    std::vector<fs::path> pieces;  // names beside the list's own
    for (const int rank : part.ranks) pieces.push_back(piece_file(part, i, rank).filename());
    if (part.is_in_pieces())
      index_->manifest.while_there([&] { write_pieces(part, frame, pieces, directory_ / part_file(part, i)); });
    index_->parts.add(frame.label_time, i_part++, part.part->name, part_file(part, i));
  }
  index_->frames.push_back(summary);
  // A list grows with the frames: rewritten for each of thousands it would take longer than they do.
  const size_t n = index_->frames.size(), n_new = n - index_->n_listed;
  if (20 * n_new >= index_->n_listed || std::chrono::steady_clock::now() - index_->listed > std::chrono::seconds(1))
    write_lists();
}

void RunWriter::write_lists() {
  if (index_->n_listed == index_->frames.size()) return;
  if (!index_->parts.is_empty()) write(file_name_of(problem_name_) + ".pvd", index_->parts.text());
  if (!index_->interfaces.is_empty()) write(interfaces_file, index_->interfaces.text());
  index_->n_listed = index_->frames.size();
  index_->listed = std::chrono::steady_clock::now();
}

const std::vector<FrameSummary>& RunWriter::frames() const { return index_->frames; }

void RunWriter::write_tables(const Problem& problem, const RunResult& result) {
  write_lists();
  const std::vector<std::string> steps = step_names(problem);
  std::set<std::string> written;
  Task task("files", static_cast<int>(problem.outputs.size()), Task::Interrupts::wait);
  for (const OutputPtr& output : problem.outputs) {  // in the deck's order
    task.done(output->known_as());
    const auto table = result.tables.find(output.get());
    if (table == result.tables.end()) continue;
    const Findings& findings = result.findings_of(*output);
    const std::string name = file_name_of(output->name);
    CHECK(written.insert(name).second && name != "convergence", "two tables are called '" + name + "'");
    write(name + ".csv", csv_text(table->second, steps));
    if (findings.files)
      for (const auto& [suffix, text] : findings.files()) write_of_output(name + suffix, text);
    for (const auto& [part, of_part] : findings.parts)
      write_of_output(name + "_" + part + ".csv", csv_text(of_part, steps));
  }
  for (const OutputPtr& output : problem.outputs)
    if (const Findings& findings = result.findings_of(*output); !findings.frames.empty())
      write_field(file_name_of(output->name), findings.frames);
  for (const OutputPtr& output : problem.outputs) {
    const Findings& findings = result.findings_of(*output);
    const std::string name = file_name_of(output->name) + "_band";
    if (findings.band.n_rows() > 0 && written.insert(name).second)
      write(name + ".csv", csv_text(findings.band, steps));  // else an output of the deck has the name
  }
  if (!result.convergence.columns.empty()) write(own_file::convergence, csv_text(result.convergence, steps));
  if (!result.bolts.empty()) {
    CHECK(!written.contains("bolts"), "an output is called 'bolts'");
    write(own_file::bolts, bolts_csv(problem, result));
  }
}

void RunWriter::write_record(const Problem& problem, const RunResult& result, const RunIdentity& identity,
                             const std::vector<std::string>& warnings) {
  // Name the files but for the frames, which the .pvd list.
  const fs::path record = path_of(own_file::record);
  std::vector<std::string> files;
  for (const fs::path& file : index_->manifest.files()) {
    if (*file.begin() != frames_folder && (directory_ / file == record || fs::exists(directory_ / file)))
      files.push_back(file.generic_string());
  }
  index_->manifest.while_there([&] { write_text(record, run_record(problem, result, identity, warnings, files)); });
}

// A .pvd of its own, whose time is what the frames are labelled with.
void RunWriter::write_field(const std::string& name, const std::vector<Frame>& frames) {
  const fs::path folder = fs::path(frames_folder) / name;
  refuse_links(directory_, folder);
  make_directory(directory_ / folder);
  Collection collection;
  Task task("frames of '" + name + "'", static_cast<int>(frames.size()), Task::Interrupts::wait);
  for (size_t i = 0; i < frames.size(); ++i) {
    task.done("written");
    const fs::path file = folder / fmt::format("{}_{:05}.vtu", name, i);
    if (!frames[i].interfaces.empty()) {
      index_->manifest.add(file);
      index_->manifest.while_there([&] { write_interfaces(frames[i], directory_ / file); });
      collection.add(frames[i].label_time, 0, name, file);
    }
    int i_part = 0;
    for (const PartFrame& part : frames[i].parts) {
      const fs::path of_part = folder / fmt::format("{}_{:05}.vtu", file_name_of(part.part->name), i);
      index_->manifest.add(of_part);
      index_->manifest.while_there([&] { write_part(part, frames[i], directory_ / of_part); });
      collection.add(frames[i].label_time, i_part++, part.part->name, of_part);
    }
  }
  if (!collection.is_empty()) write(name + ".pvd", collection.text());
}

fs::path RunWriter::path_of(const std::string& file_name) {
  CHECK(file_name == file_name_of(file_name), "a plain file name: '" + file_name + "'");
  index_->manifest.add(file_name);
  return directory_ / file_name;
}

fs::path RunWriter::folder_of(const std::string& folder, int n_files) {
  refuse_links(directory_, folder);
  make_directory(directory_ / folder);
  for (int i = 0; i < n_files; ++i) index_->manifest.add(fs::path(folder) / std::to_string(i));
  return directory_ / folder;
}

void RunWriter::write_of_output(const std::string& file_name, const std::string& text) {
  CHECK(!own_file_called(file_name), "an output writes " + file_name + ", which is the run's");
  write(file_name, text);
}

void RunWriter::write(const std::string& file_name, const std::string& text) {
  const fs::path path = path_of(file_name);
  index_->manifest.while_there([&] { write_text(path, text); });
}

}  // namespace dygita

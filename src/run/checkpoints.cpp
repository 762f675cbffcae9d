#include "run/checkpoints.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <new>

#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "files/files.hpp"
#include "model/own_files.hpp"
#include "ranks/ranks.hpp"
#include "run/keep_state.hpp"
#include "run/passes.hpp"

namespace dygita {

namespace {

// Increments of all steps and passes, of which each leaves an entry.
long expected_entries(const Problem& problem) {
  long n = 0;
  for (const StepPtr& step : problem.steps) n += step->n_increments();
  return n * static_cast<long>(pass_tolerances(problem).size());
}

// A run that continues another to a tolerance or in time is told apart from any that was asked for something else.
std::string purpose_of(const Problem& problem, const RunRequest& request) {
  if (!request.continues) return "";
  const RunState& from = *request.continues;
  long iterations = 0;
  for (const Effort& effort : from.efforts) iterations += effort.iterations;
  return fmt::format("tolerance {} {}, {} iterations, end {}, from {} increments of {} iterations in {} efforts",
                     problem.solver.tolerance, problem.solver.static_tolerance, problem.solver.more_iterations,
                     problem.steps.back()->duration, from.n_increments(), iterations, from.efforts.size());
}

CheckpointIdentity identity_of(const Problem& problem, const RunRequest& request) {
  RunState state = identity_of_run(problem, request);
  state.interrupted = true;
  return {std::move(state),
          request.identity.kernels,
          purpose_of(problem, request),
          request.start_from && request.start_from->converged && request.start_from->interface_fields,
          request.write_frames,
          request.from.string()};
}

// What an attempt at the same has left, that was killed.
std::shared_ptr<CheckpointFile> left_in(const std::filesystem::path& path, const CheckpointIdentity& wanted,
                                        double every) {
  std::error_code ignored;
  if (wanted.purpose.empty() || !std::filesystem::exists(path, ignored)) return nullptr;
  try {
    auto left = std::make_shared<CheckpointFile>(path, every);
    const CheckpointIdentity& found = left->identity();
    if (found.purpose == wanted.purpose && found.kernels == wanted.kernels &&
        identity_bytes(found.state) == identity_bytes(wanted.state))
      return left;
  } catch (const InputError&) {  // a new one takes its place
  }
  return nullptr;
}

// What a run that was killed cannot say: how it goes on. Not worth a warning where there is no room for it.
void tell_how_to_go_on(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::string command = "dygita continue " + shell_word(std::filesystem::absolute(folder, ignored).string());
  std::string text = "This run has not come to its end. To continue it:\n    " + command + "\n";
  if (!ranks::is_alone())
    text += fmt::format("or on several ranks, as it was started:\n    mpirun -n {} {}\n", ranks::count(), command);
  try {
    write_text(folder / own_file::going_on, text);
  } catch (const InputError&) {
  }
}

}  // namespace

std::shared_ptr<CheckpointFile> checkpoint_of(const Problem& problem, const RunRequest& request,
                                              const std::filesystem::path& folder) {
  if (request.checkpoint) return request.checkpoint;
  const std::filesystem::path path = folder / checkpoint_file_name;
  std::error_code ignored;
  if (!request.write_files || !request.write_state || request.checkpoint_every <= 0.0) return nullptr;
  const CheckpointIdentity identity = identity_of(problem, request);
  if (auto left = left_in(path, identity, request.checkpoint_every)) {
    say(fmt::format("  an earlier attempt was stopped: {} increments are stored", left->n_left()));
    return left;
  }
  try {
    auto checkpoint = std::make_shared<CheckpointFile>(path, identity, request.checkpoint_every);
    checkpoint->expect(expected_entries(problem));
    if (!request.continues) tell_how_to_go_on(folder);
    return checkpoint;
  } catch (const InputError& error) {
    warn(fmt::format("{}\n    the run continues, but cannot be resumed if it is killed", error.what()));
    return nullptr;
  }
}

std::shared_ptr<Trail> part_of_checkpoint(const CheckpointFile* checkpoint, double every) {
  if (ranks::is_alone()) return nullptr;
  const std::string path = ranks::shared(checkpoint ? std::filesystem::absolute(checkpoint->path()).string() : "");
  std::string head(sizeof(std::uint64_t), '\0');
  if (checkpoint) {
    const std::uint64_t own = checkpoint->head();
    std::memcpy(head.data(), &own, sizeof own);
  }
  head = ranks::shared(head);
  std::uint64_t of_first = 0;
  std::memcpy(&of_first, head.data(), sizeof of_first);
  if (path.empty() || ranks::is_first()) return nullptr;
  return std::make_shared<CheckpointPart>(path, ranks::me(), of_first, every);
}

void remove_checkpoint(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::remove(folder / checkpoint_file_name, ignored);
  remove_parts(parts_folder(folder / checkpoint_file_name));
  for (const char* const half : {"", ".tmp"})  // a kill may have come while it was written
    std::filesystem::remove(folder / (std::string(own_file::going_on) + half), ignored);
}

void share_checkpoint(const std::filesystem::path& from, const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  remove_checkpoint(to);
  std::error_code error, ignored;
  const auto link = [&](const fs::path& file) {
    fs::create_hard_link(from / file, to / file, error);
    if (error) fs::copy_file(from / file, to / file, error);
    if (error) warn("the checkpoint cannot be kept: " + error.message());
  };
  const fs::path parts = parts_folder(checkpoint_file_name);
  if (fs::is_directory(from / parts, ignored)) fs::create_directory(to / parts, ignored);
  for (const fs::directory_entry& part : fs::directory_iterator(from / parts, ignored))
    link(parts / part.path().filename());
  link(checkpoint_file_name);
  if (fs::exists(from / own_file::going_on, ignored)) link(own_file::going_on);
}

std::string shell_word(const std::string& text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || std::strchr("/._-+,=@%", c) != nullptr;
  });
  if (is_plain && !text.empty()) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

void rethrow(const std::exception_ptr& error, const std::string& line) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& input) {
    throw InputError(input.what() + line);
  } catch (const NumericalError& numerical) {
    throw NumericalError(numerical.what() + line);
  } catch (const std::bad_alloc&) {
    throw NumericalError("not enough memory on this machine; dygita check reports what a problem needs" + line);
  }
}

}  // namespace dygita

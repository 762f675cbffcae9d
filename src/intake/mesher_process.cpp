#include "intake/mesher_process.hpp"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <spdlog/fmt/fmt.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <optional>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/memory.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "base/progress.hpp"
#include "base/task.hpp"
#include "intake/mesh_cache.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

namespace fs = std::filesystem;

std::string& deck_folder() {
  static std::string folder;
  return folder;
}

// What a file may have gmsh read: what lies beside it or beside the deck, and the script that gives it its parameters.
std::vector<std::string> readable_for(const std::string& file, const std::string& path) {
  std::vector<std::string> readable = {path};
  std::error_code error;
  if (const fs::path folder = fs::canonical(file, error).parent_path(); !error) readable.push_back(folder.string());
  if (const fs::path folder = fs::canonical(deck_folder().empty() ? "." : deck_folder(), error); !error)
    readable.push_back(folder.string());
  return readable;
}

// Beside this program where it was built, in libexec where it is installed.
std::string mesher_program() {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* place : {"dygita-mesher", "../dygita-mesher", "../libexec/dygita/dygita-mesher"})
    if (const fs::path program = here / place; access(program.c_str(), X_OK) == 0) return program.string();
  throw InputError(fmt::format(
      "the program 'dygita-mesher' is neither in {} nor in ../libexec/dygita beside it: is the installation complete?",
      here.string()));
}

// Sockets: to write to one whose reader is gone is an error, where a pipe would end this program.
class Pipe {
 public:
  Pipe() {
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()) != 0)
      throw InputError(std::string("no pipe: ") + std::strerror(errno));
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_end(int i) {
    if (ends_[i] >= 0) close(ends_[i]);
    ends_[i] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// A program with its three streams in our hands.
class Process {
 public:
  explicit Process(const std::string& program) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in_.read_end(), 0);
    posix_spawn_file_actions_adddup2(&actions, out_.write_end(), 1);
    posix_spawn_file_actions_adddup2(&actions, errors_.write_end(), 2);
    // A group of its own: Ctrl-C is for the program that waits, which ends it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::string name = program;
    char* const arguments[] = {name.data(), nullptr};
    const int failed = posix_spawn(&id_, program.c_str(), &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw InputError(fmt::format("cannot start {}: {}", program, std::strerror(failed)));
    in_.close_end(0);
    out_.close_end(1);
    errors_.close_end(1);
  }
  ~Process() {
    if (id_ > 0) end();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  std::string output, errors;

  // Writes `input`, reads both streams until they end; false: `go_on` has answered false, asked ten times a second.
  bool converse(const std::string& input, const std::function<bool()>& go_on) {
    size_t written = 0;
    bool is_open[2] = {true, true};
    while (is_open[0] || is_open[1]) {
      if (!go_on()) return false;
      std::array<pollfd, 3> streams = {pollfd{is_open[0] ? out_.read_end() : -1, POLLIN, 0},
                                       pollfd{is_open[1] ? errors_.read_end() : -1, POLLIN, 0},
                                       pollfd{written < input.size() ? in_.write_end() : -1, POLLOUT, 0}};
      if (poll(streams.data(), streams.size(), 100) <= 0) continue;
      if (streams[0].revents) is_open[0] = read_from(out_.read_end(), output);
      if (streams[1].revents) is_open[1] = read_from(errors_.read_end(), errors);
      if (streams[2].revents) {
        const ssize_t n =
            send(in_.write_end(), input.data() + written, input.size() - written, MSG_NOSIGNAL | MSG_DONTWAIT);
        written = n > 0 ? written + static_cast<size_t>(n) : errno == EAGAIN ? written : input.size();
        if (written == input.size()) in_.close_end(1);
      }
    }
    return true;
  }

  // Waits for its end, which is at hand; answers what waitpid does.
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return status;
  }

  void end() {
    kill(id_, SIGKILL);
    wait();
  }

 private:
  static bool read_from(int stream, std::string& text) {
    std::array<char, 1 << 16> buffer;
    const ssize_t n = read(stream, buffer.data(), buffer.size());
    if (n > 0) text.append(buffer.data(), static_cast<size_t>(n));
    return n > 0 || (n < 0 && errno == EINTR);
  }

  Pipe in_, out_, errors_;
  pid_t id_ = 0;
};

// Of what a program that crashed has said: the last lines, printable.
std::string last_words(const std::string& text) {
  std::string words;
  for (const char c : text.substr(text.size() - std::min<size_t>(text.size(), 300)))
    words += static_cast<unsigned char>(c) < ' ' || c == 127 ? ' ' : c;
  return words.empty() ? "" : "\n    its last words: " + words;
}

InputError crash(const std::string& file, int status, const std::string& errors) {
  const std::string how = WIFSIGNALED(status)
                              ? fmt::format("by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))
                              : fmt::format("with code {}", WEXITSTATUS(status));
  return InputError(
      fmt::format("{}: gmsh terminated {} while reading or meshing the file: the file is damaged, or gmsh has a bug\n  "
                  "  does gmsh itself open it? another size or algorithm may avoid a bug of gmsh{}",
                  file, how, last_words(errors)));
}

}  // namespace

void set_mesh_folder(const std::string& folder) { deck_folder() = folder; }

namespace {

// The last line of those that say what the mesher does, taken out of what it has written; empty: none is whole yet.
std::string take_told(std::string& errors) {
  constexpr size_t longest = 200;
  std::string told;
  for (size_t begin; (begin = errors.find(told_mark)) != std::string::npos;) {
    const size_t end = errors.find('\n', begin);
    if (end == std::string::npos) break;
    told = errors.substr(begin + 1, std::min(end - begin - 1, longest));
    errors.erase(begin, end + 1 - begin);
  }
  return printable(told);
}

// What it answers, as bytes.
std::string run_mesher(MesherTask task, const std::string& file) {
  using Clock = std::chrono::steady_clock;
  require_readable(file);
  task.memory_limit = memory_of_machine();
  task.is_trusted = is_trusted_mesh(file);
  task.readable = readable_for(file, task.path);
  Process mesher(mesher_program());
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Task meshing("meshing " + fs::path(file).filename().string(), 0, Task::Interrupts::wait);
  std::string doing = "reading";
  const bool is_over = mesher.converse(to_bytes(task), [&] {
    if (std::string told = take_told(mesher.errors); !told.empty()) doing = std::move(told);
    meshing.tell(doing);
    return seconds() < mesh_limits().time && !interrupt_requested();
  });
  if (!is_over) {
    mesher.end();
    if (interrupt_requested() && ranks::is_alone()) throw Interrupted();
    if (interrupt_requested()) throw InputError(fmt::format("{}: stopped while gmsh was meshing it", file));
    throw InputError(
        fmt::format("{}: gmsh has taken {:g} s to read and mesh it, and was stopped\n    infinite loop? "
                    "--mesh-time-limit raises the limit",
                    file, mesh_limits().time));
  }
  if (const int status = mesher.wait(); status != 0) throw crash(file, status, mesher.errors);
  return std::move(mesher.output);
}

// Of several ranks the first has the file meshed, and all get what it was answered, or throw what it threw.
std::string run_mesher_once(const MesherTask& task, const std::string& file, std::optional<MeshCache>& cache) {
  if (ranks::is_first()) cache.emplace(task, file, deck_folder());
  std::string kept = cache ? cache->find() : "";
  kept = ranks::shared(std::move(kept));
  if (!kept.empty()) {
    say(fmt::format("{}: meshed before; the mesh is taken from {}", file, MeshCache::folder_name));
    return kept;
  }
  if (ranks::is_alone()) return run_mesher(task, file);
  std::string answer, error;
  if (ranks::is_first()) {
    try {
      answer = run_mesher(task, file);
    } catch (const InputError& thrown) {
      error = thrown.what();
    }
  }
  error = ranks::shared(std::move(error));
  if (!error.empty()) throw InputError(error);
  return ranks::shared(std::move(answer));
}

}  // namespace

MesherAnswer ask_mesher(const MesherTask& task, const std::string& file) {
  std::optional<MeshCache> cache;  // of the first rank
  const std::string bytes = run_mesher_once(task, file, cache);
  MesherAnswer answer = answer_of(bytes, file);
  for (const std::string& warning : answer.warnings) warn(warning);
  if (!answer.error.empty()) throw InputError(answer.error);
  if (cache) {
    answer.libraries.push_back(mesher_program());
    cache->keep(bytes, answer.libraries);
  }
  return answer;
}

}  // namespace dygita

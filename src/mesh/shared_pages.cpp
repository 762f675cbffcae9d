#include "mesh/shared_pages.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <spdlog/fmt/fmt.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>

#include "ranks/ranks.hpp"

namespace dygita {

namespace {

constexpr size_t page = 4096, least = size_t{1} << 20;  // bytes; least: of an array that is worth a mapping
constexpr int most_meshes = 4000;  // a process may have some 65,000 mappings, a mesh takes six or more

struct Array {
  char* data;
  size_t size;  // bytes

  // The whole pages within it.
  char* first_page() const { return data + (page - reinterpret_cast<uintptr_t>(data) % page) % page; }
  size_t n_pages() const {
    const auto before = static_cast<size_t>(first_page() - data);
    return size < before + page ? 0 : (size - before) / page;
  }
  // In a file, which has it where the pages of both begin together.
  size_t lead() const { return reinterpret_cast<uintptr_t>(data) % page; }
  size_t room() const { return (lead() + size + page - 1) / page * page; }
};

std::vector<Array> arrays_of(Mesh& mesh) {
  std::vector<Array> arrays{
      {reinterpret_cast<char*>(mesh.nodes.data()), sizeof(double) * static_cast<size_t>(mesh.nodes.size())}};
  for (CellBlock& block : mesh.blocks)
    arrays.push_back({reinterpret_cast<char*>(block.nodes.data()), sizeof(int) * block.nodes.size()});
  std::erase_if(arrays, [](const Array& array) { return array.size < least; });
  return arrays;
}

// Pages that a file has taken the place of, as long as their mesh lives.
struct Mapped {
  std::weak_ptr<const Mesh> mesh;
  std::vector<Array> arrays;
};
std::vector<Mapped>& mapped() {
  static std::vector<Mapped> all;
  return all;
}

// A copy whose large arrays are each a mapping of their own, at the same place within a page on all ranks.
std::shared_ptr<Mesh> copy_on_own_pages(const Mesh& mesh) {
  constexpr int usual_threshold = 32 << 20;  // bytes, the largest that glibc comes to by itself
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(least / 2));
  auto copy = std::make_shared<Mesh>(mesh);
  mallopt(M_MMAP_THRESHOLD, usual_threshold);
  mallopt(M_TRIM_THRESHOLD, 2 * usual_threshold);
  return copy;
}

class File {
 public:
  File(const std::string& path, int flags) : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~File() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool is_open() const { return descriptor_ >= 0; }
  bool write_at(const char* data, size_t size, size_t offset) const {
    while (size > 0) {
      const ssize_t n = pwrite(descriptor_, data, size, static_cast<off_t>(offset));
      if (n <= 0 && errno != EINTR) return false;
      const size_t written = n > 0 ? static_cast<size_t>(n) : 0;
      data += written, size -= written, offset += written;
    }
    return true;
  }
  bool set_size(size_t bytes) const { return ftruncate(descriptor_, static_cast<off_t>(bytes)) == 0; }
  size_t size() const {
    struct stat status {};
    return fstat(descriptor_, &status) == 0 ? static_cast<size_t>(status.st_size) : 0;
  }
  std::string text_at_start() const {
    std::string text(page, ' ');
    return pread(descriptor_, text.data(), page, 0) == static_cast<ssize_t>(page) ? text : "";
  }
  // The file's bytes in the place of an array's whole pages, which are the same; false: the pages are what they were.
  bool map(const Array& array, size_t offset) const {
    const auto first = static_cast<size_t>(array.first_page() - array.data);
    return mmap(array.first_page(), array.n_pages() * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_FIXED,
                descriptor_, static_cast<off_t>(offset + array.lead() + first)) != MAP_FAILED;
  }

 private:
  int descriptor_;
};

// What tells one file from another: the mesh, and where its arrays lie in a page.
std::string heading(const Mesh& mesh, const std::vector<Array>& arrays) {
  std::string text = mesh.digest;
  for (const Array& array : arrays) text += fmt::format(" {} {}", array.lead(), array.size);
  text.resize(page, ' ');
  return text;
}

size_t end_of(const std::vector<Array>& arrays) {
  size_t end = page;
  for (const Array& array : arrays) end += array.room();
  return end;
}

bool write_file(const std::string& path, const Mesh& mesh, const std::vector<Array>& arrays) {
  const File file(path, O_RDWR | O_CREAT | O_EXCL);
  if (!file.is_open() || !file.write_at(heading(mesh, arrays).data(), page, 0)) return false;
  size_t offset = page;
  for (const Array& array : arrays) {
    if (!file.write_at(array.data, array.size, offset + array.lead())) return false;
    offset += array.room();
  }
  return file.set_size(offset);
}

// Those of the file that another rank has written, if they lie as the arrays here do.
std::vector<Array> map_from(const std::string& path, const Mesh& mesh, const std::vector<Array>& arrays) {
  std::vector<Array> taken;
  const File file(path, O_RDONLY);
  if (!file.is_open() || file.size() != end_of(arrays) || file.text_at_start() != heading(mesh, arrays)) return taken;
  size_t offset = page;
  for (const Array& array : arrays) {
    if (file.map(array, offset)) taken.push_back(array);
    offset += array.room();
  }
  return taken;
}

std::string next_path() {
  static int n_files = 0;
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  const std::string name = fmt::format("dygita-mesh-{}-{}-{}", getpid(), now, n_files++);
  std::error_code ignored;
  return (std::filesystem::temp_directory_path(ignored) / ranks::shared(name)).string();
}

}  // namespace

MeshPtr on_shared_pages(MeshPtr mesh) {
  static int n_meshes = 0;
  if (ranks::is_alone() || sizeof(double) * static_cast<size_t>(mesh->nodes.size()) < least) return mesh;
  if (++n_meshes > most_meshes) return mesh;
  const std::shared_ptr<Mesh> copy = copy_on_own_pages(*mesh);
  const std::vector<Array> arrays = arrays_of(*copy);
  const std::string path = next_path();
  const bool writes = ranks::is_first_on_machine();
  if (writes && !write_file(path, *copy, arrays)) unlink(path.c_str());
  ranks::any(false);  // the file is there
  mapped().push_back({copy, map_from(path, *copy, arrays)});
  ranks::any(false);  // all have it
  if (writes) unlink(path.c_str());
  return copy;
}

void leave_shared_pages() {
  if (ranks::is_alone()) return;
  std::erase_if(mapped(), [](const Mapped& one) { return one.mesh.expired(); });
  for (const Mapped& one : mapped())
    for (const Array& array : one.arrays) madvise(array.first_page(), array.n_pages() * page, MADV_DONTNEED);
  malloc_trim(0);
}

}  // namespace dygita

#include "numerics/panel_choice.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "base/error.hpp"

namespace dygita {

namespace generic {
const PanelKernels& panel_kernels();
}
#if defined(__x86_64__)
namespace avx2 {
const PanelKernels& panel_kernels();
}
namespace avx512 {
const PanelKernels& panel_kernels();
}
#endif

namespace {

// The system's part is asked for too: registers that it does not keep for a program cannot be used.
std::vector<const PanelKernels*> find_available() {
  std::vector<const PanelKernels*> found;
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    found.push_back(&avx512::panel_kernels());
  if (has_avx2) found.push_back(&avx2::panel_kernels());
#endif
  found.push_back(&generic::panel_kernels());
  return found;
}

const std::vector<const PanelKernels*>& available() {
  static const std::vector<const PanelKernels*> kernels = find_available();
  return kernels;
}

const PanelKernels& named(const std::string& name, const std::string& who) {
  std::string known;
  for (const PanelKernels* kernels : available()) {
    if (kernels->name == name) return *kernels;
    known += (known.empty() ? "" : ", ") + std::string(kernels->name);
  }
  throw InputError(who + " = '" + name + "': this processor has the kernels " + known);
}

const PanelKernels& chosen_at_start() {
  const char* name = std::getenv("DYGITA_KERNELS");
  return name && *name ? named(name, "DYGITA_KERNELS") : *available().front();
}

std::atomic<const PanelKernels*>& in_use() {
  static std::atomic<const PanelKernels*> kernels = &chosen_at_start();
  return kernels;
}

}  // namespace

const PanelKernels& panel_kernels() { return *in_use().load(std::memory_order_relaxed); }

void use_panel_kernels(const std::string& name) { in_use() = &named(name, "kernels"); }

std::vector<std::string> available_panel_kernels() {
  std::vector<std::string> names;
  for (const PanelKernels* kernels : available()) names.push_back(kernels->name);
  return names;
}

}  // namespace dygita

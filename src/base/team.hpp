// The threads that share the program's loops. Between two loops they stay awake for a while and give their processor
// to whoever asks for it meanwhile; then they sleep. A time step opens loops every few microseconds: to wake a thread
// for each costs as much as many of them, and one that waits without giving way ruins the program beside it. Nor is
// anybody waited for who has not begun: where other programs have the processors, the caller does what is left.
#pragma once

#include <type_traits>

namespace dygita {

// How many threads loops may take: what was set last, else OMP_NUM_THREADS, else as many as the process may have
// processors.
int thread_limit();
void set_thread_limit(int n);

// Is this thread in a loop that it shares with others? Loops within run on it alone.
bool is_in_team();

using TeamWork = void (*)(void* work, int t);
// work(t) for t = 0 .. n - 1, which must not throw nor wait for another t: 0 by the caller, each of the others by a
// thread of its own or, where that one comes too late, by the caller; back when all are done. One team at a time:
// within another, and while another thread of the program has one, the caller does it all.
void run_on_team(int n, TeamWork work, void* context);

template <class Work>
void run_on_team(int n, Work&& work) {
  using Plain = std::remove_reference_t<Work>;
  run_on_team(
      n, [](void* context, int t) { (*static_cast<Plain*>(context))(t); },
      const_cast<void*>(static_cast<const void*>(&work)));
}

}  // namespace dygita

// Reads a file without what it prints about it.
#pragma once

#include <gtest/gtest.h>

namespace dygita {

template <class Read>
auto quietly(Read&& read) {
  struct Captured {
    Captured() { testing::internal::CaptureStdout(); }
    ~Captured() { testing::internal::GetCapturedStdout(); }
  } const captured;
  return read();
}

}  // namespace dygita

// Expects an InputError and checks the words of its message.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "base/error.hpp"

namespace dygita {

template <typename Action>
void expect_input_error(Action action, std::initializer_list<const char*> words) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const char* word : words)
      EXPECT_NE(message.find(word), std::string::npos) << word << " is not in: " << message;
    return;
  }
  ADD_FAILURE() << "no InputError was thrown";
}

}  // namespace dygita

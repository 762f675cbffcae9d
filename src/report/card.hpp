// A figure that the verdict shows, with its grade.
#pragma once

#include <string>

namespace dygita {

enum class Grade { fine, fair, poor };

struct Card {
  std::string name, value, note;
  Grade grade = Grade::fine;
};

}  // namespace dygita

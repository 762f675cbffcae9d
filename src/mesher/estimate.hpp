// What a request for cells comes to, before gmsh is asked.
#pragma once

#include <functional>
#include <string>

namespace dygita {

// Throws InputError where a volume would take more cells than any machine can mesh, with their size and what is likely
// meant. size_of: of a volume's cells by its tag, 0 where it is not known; in the model's units, of `unit` metres.
void refuse_hopeless(const std::string& file, const std::function<double(int volume)>& size_of, double unit);

}  // namespace dygita

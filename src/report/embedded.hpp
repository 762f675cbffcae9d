// The files of src/report/embedded/, put into the program when it is built: scripts for pages and for ParaView.
#pragma once

#include <string>

namespace dygita {

// The text of one of them by its name ("view.py").
const std::string& embedded_text(const std::string& name);

}  // namespace dygita

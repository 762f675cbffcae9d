#include "reduction/superelement_files.hpp"

#include <cmath>
#include <iterator>

#include "base/log.hpp"
#include "base/names.hpp"

namespace dygita {

namespace {

const char* direction_names[] = {"x", "y", "z", "rx", "ry", "rz"};

const char* motion_text(FaceMotion motion) {
  switch (motion) {
    case FaceMotion::mean:
      return "the mean motion of the face (weights: areas), which may deform; a force on it is spread evenly over the "
             "face";
    case FaceMotion::rigid:
      return "the motion of the face as a rigid body";
    case FaceMotion::nodes:
      return "the displacement of one node";
  }
  return "";
}

// m, without the round-off of a mean that is zero.
double coordinate(double x) { return std::abs(x) < 1e-12 ? 0.0 : x; }

std::string introduction(const std::string& problem, const std::string& name, const Superelement& element) {
  const size_t n_modes = static_cast<size_t>(element.fixed_frequencies.size());
  std::string text = fmt::format(
      "# Superelement `{}` of problem `{}`\n\n"
      "The linear assembly about its state at the end of step `{}`, reduced to {} rows: {} interface coordinates and "
      "{} modes "
      "(Craig and Bampton, 1968), {} of which stand for all that are left out, from {} unknowns.\n\n",
      name, problem, element.step, element.rows.size(), element.rows.size() - n_modes, n_modes, element.n_residual,
      element.n_unknowns);
  if (element.missed > 0) text += "**" + unconverged_text(element) + ".**\n\n";
  text += fmt::format(
      "**To be used up to {:.4g} Hz**, half of the frequency up to which modes with the interface held are kept.\n\n",
      element.valid_to);
  text += fmt::format(
      "Small motions about that state: of the contact points {} are tied, {} are tied along their normal only, {} are "
      "open and free. Bonded and "
      "plastic interfaces are tied, the step's supports hold, prescribed motions of that step do not. Mass of the "
      "parts: {:.9g} kg, lumped at the nodes: the rotary inertia of a slender part about "
      "its own axis is too large, by a half with two cells across it.\n\n",
      element.n_tied, element.n_normal, element.n_open, element.mass_of_parts);
  if (element.n_damped > 0)
    text += fmt::format(
        "{} points of interfaces damp relative motion: they are in the damping matrix, and hold nothing.\n\n",
        element.n_damped);
  return text;
}

std::string file_list(const std::string& name, const Superelement& element, bool as_dmig) {
  std::string text = "## Files\n\n| file | content |\n| --- | --- |\n";
  text += fmt::format(
      "| `{0}_mass.mtx`, `{0}_stiffness.mtx` | symmetric, Matrix Market; SI: kg, N/m; where a row is a rotation in "
      "rad: kg m, kg m^2, N, N m |\n",
      name);
  if (element.damping.size() > 0) text += fmt::format("| `{}_damping.mtx` | the same: N s/m |\n", name);
  if (as_dmig)
    text += fmt::format(
        "| `{0}.pch`, `{0}_points.csv` | the same matrices for Nastran, as DMIG: `K2GG = KAAX`, `M2GG = MAAX`{1}; and "
        "the grid points of its rows |\n",
        name, element.damping.size() > 0 ? ", `B2GG = BAAX`" : "");
  text +=
      fmt::format("| `{}.csv` | natural frequencies of the superelement itself, and their damping ratios |\n\n", name);
  text += fmt::format(
      "```python\nimport numpy, scipy.io, scipy.linalg\nM = scipy.io.mmread(\"{0}_mass.mtx\")\nK = "
      "scipy.io.mmread(\"{0}_stiffness.mtx\")\n"
      "w2, modes = scipy.linalg.eigh(K, M)\nprint(numpy.sqrt(numpy.maximum(w2, 0)) / (2 * numpy.pi))       # Hz, as in "
      "{0}.csv\n"
      "f = numpy.zeros(len(M)); f[2] = 1                                    # a force of 1 N on the third row\n"
      "w = 2 * numpy.pi * 1000\na = -w**2 * numpy.linalg.solve(K - w**2 * M, f)                       # m/s^2 of every "
      "row at 1 kHz\n```\n\n",
      name);
  return text;
}

}  // namespace

std::string unconverged_text(const Superelement& element) {
  return fmt::format("NOT CONVERGED: {} increment{} up to the end of step '{}' missed the tolerance", element.missed,
                     element.missed == 1 ? "" : "s", element.step);
}

std::string matrix_market_text(const Mat& symmetric, const std::string& comment) {
  CHECK(symmetric.rows() == symmetric.cols(), "a square matrix");
  std::string text = "%%MatrixMarket matrix array real symmetric\n% " + comment + "\n";
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {}\n", symmetric.rows(), symmetric.cols());
  for (int j = 0; j < symmetric.cols(); ++j)
    for (int i = j; i < symmetric.rows(); ++i) fmt::format_to(out, "{:.17g}\n", symmetric(i, j) + 0.0);  // + 0: no "-0"
  return text;
}

std::vector<std::pair<std::string, std::string>> superelement_files(const std::string& problem,
                                                                    const SuperelementRequest& request,
                                                                    const Superelement& element) {
  std::string page =
      introduction(problem, request.name, element) + file_list(file_name_of(request.name), element, request.as_dmig);
  page += fmt::format(
      "## Rows\n\nA coordinate is {}. Rotations turn about the point given, the face's centroid. The force of an "
      "interface row works on "
      "that motion: N, or N m about the point. Rows of modes are amplitudes (sqrt(kg) m), without force as long as "
      "nothing acts inside.\n\n"
      "| row | what | node | direction | x (m) | y (m) | z (m) |\n| --- | --- | --- | --- | --- | --- | --- |\n",
      motion_text(request.motion));
  const int n = static_cast<int>(element.rows.size()),
            n_interface = n - static_cast<int>(element.fixed_frequencies.size());
  for (int i = 0; i < n_interface; ++i) {
    const Superelement::Row& row = element.rows[i];
    page +=
        fmt::format("| {} | {} | {} | {} | {:.9g} | {:.9g} | {:.9g} |\n", i + 1, label(element.on[row.on]),
                    row.node < 0 ? std::string("all") : std::to_string(row.node + 1), direction_names[row.direction],
                    coordinate(row.place[0]), coordinate(row.place[1]), coordinate(row.place[2]));
  }
  page +=
      "\nNodes are counted from 1 in the part's mesh, as in its file for ParaView plus 1; rows from 1, as in the "
      "files.\n\n";
  page += "| row | mode with the interface held (Hz) |\n| --- | --- |\n";
  for (int i = 0; i < element.fixed_frequencies.size(); ++i)
    page += fmt::format("| {} | {:.6g}{} |\n", n_interface + i + 1, element.fixed_frequencies[i],
                        i + element.n_residual >= element.fixed_frequencies.size() ? " (for those left out)" : "");
  page +=
      "\n## Natural frequencies\n\nOf the superelement with nothing attached (about zero: a rigid motion), those up to "
      "the frequency it is made for:\n\n"
      "| | Hz | damping ratio |\n| --- | --- | --- |\n";
  for (int i = 0; i < element.frequencies.size() && element.frequencies[i] <= element.valid_to; ++i)
    page += fmt::format("| {} | {:.6g} | {:.4g} |\n", i + 1, element.frequencies[i], element.damping_ratios[i]);

  std::vector<std::pair<std::string, std::string>> files;
  const auto add = [&](const char* what, const char* unit, const Mat& matrix) {
    files.emplace_back(
        std::string("_") + what + ".mtx",
        matrix_market_text(matrix, fmt::format("{} ({}) of superelement '{}' after step '{}': see {}.md{}", what, unit,
                                               request.name, element.step, file_name_of(request.name),
                                               element.missed > 0 ? "\n% " + unconverged_text(element) : "")));
  };
  add("mass", "kg", element.mass);
  add("stiffness", "N/m", element.stiffness);
  if (element.damping.size() > 0) add("damping", "N s/m", element.damping);
  const std::string described = superelement_description(problem, request, element, files);
  files.emplace_back(".json", described);
  if (request.as_dmig)
    for (auto& file : dmig_files(request, element)) files.push_back(std::move(file));
  files.emplace_back(".md", page);
  return files;
}

}  // namespace dygita

// The files that the program itself writes into the folder of a run and of a study: no output and no case is called so.
#pragma once

#include <string>

namespace dygita {

namespace own_file {
inline constexpr const char *record = "run.json", *report = "report.html", *scenes = "scenes.json",
                            *motion = "motion.json", *view = "view.py", *interfaces = "interfaces.pvd",
                            *energy = "energy.csv", *convergence = "convergence.csv", *bolts = "bolts.csv",
                            *state = "state.dygita", *checkpoint = "checkpoint.dygita", *going_on = "continue.txt",
                            *study_table = "study.csv", *study_figure = "study.svg", *converge_table = "converge.csv",
                            *converge_figure = "converge.svg", *ensemble = "ensemble.json",
                            *members = "ensemble_members.csv", *drives = "ensemble_drives.csv";
}

struct OwnFile {
  const char *name, *what;
  bool is_of_study = false;  // beside the folders of its cases
};

inline constexpr OwnFile own_files[] = {{own_file::record, "the record of the run"},
                                        {own_file::report, "the report"},
                                        {own_file::scenes, "the report's pictures"},
                                        {own_file::motion, "the report's picture that turns"},
                                        {own_file::view, "the script for ParaView"},
                                        {own_file::interfaces, "the list of the interfaces' frames"},
                                        {own_file::energy, "the table of energies"},
                                        {own_file::convergence, "the table of iterations"},
                                        {own_file::bolts, "the table of all tightened interfaces"},
                                        {own_file::state, "the state that a run is continued from"},
                                        {own_file::checkpoint, "the checkpoint of the run"},
                                        {own_file::going_on, "the text that says how to continue the run"},
                                        {own_file::ensemble, "the record of an ensemble"},
                                        {own_file::members, "the table of an ensemble's members"},
                                        {own_file::drives, "the table of what drives an ensemble"},
                                        {own_file::study_table, "the table of the study", true},
                                        {own_file::study_figure, "the figure of the study", true},
                                        {own_file::converge_table, "the table of a convergence study", true},
                                        {own_file::converge_figure, "the figure of a convergence study", true}};

// What the program's own file of that name is; null: none is called so.
inline const char* own_file_called(const std::string& name, bool is_of_study = false) {
  for (const OwnFile& file : own_files)
    if (file.is_of_study == is_of_study && name == file.name) return file.what;
  return nullptr;
}

}  // namespace dygita

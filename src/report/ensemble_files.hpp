// What an ensemble leaves in its folder.
#pragma once

#include <filesystem>

#include "estimates/ensemble.hpp"

namespace dygita {

// Throws InputError where the folder, relative to `out`, or one above it is a link: its files would go elsewhere.
void check_ensemble_folder(const std::filesystem::path& out, const std::filesystem::path& folder);
// Members with tables as their files have them, so that those read back of a run before count as they did in it.
void take_as_written(Ensemble& ensemble);

// Of each output <output>.csv, its columns' statistics row by row, of spectra <output>_drives.csv and <output>.svg;
// ensemble_members.csv, a row a member; ensemble_drives.csv; report.html; ensemble.json, last;
// what an earlier ensemble wrote there goes. Throws InputError where it cannot write.
void write_ensemble(const std::filesystem::path& folder, const Ensemble& ensemble,
                    const std::vector<OutputScatter>& scatter);

// Removes the folders, beside `folder`, of the members of the ensemble that was written there before, but for those of
// `ensemble` where it keeps its members' folders: what no run of ours wrote there stays, and what has another name.
void drop_members_before(const std::filesystem::path& folder, const Ensemble& ensemble, bool keeps_members);

}  // namespace dygita

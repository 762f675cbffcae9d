// The sections of a report, each as HTML; empty where the run has nothing for it.
#pragma once

#include <string>

#include "output/run_folder.hpp"
#include "report/report.hpp"
#include "report/time_axis.hpp"

namespace dygita {

std::string title_section(const RunFolder& run);
// Verdict, the numbers that matter and warnings; `spectra` is what spectra_against_specifications tells.
std::string verdict_section(const RunFolder& run, const std::vector<std::string>& findings);
std::string computed_section(const RunFolder& run);
std::string picture_section(const RunFolder& run);
std::string motion_section(const RunFolder& run);
std::string spectra_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request);
// A line for each spectrum with a specification: how far it is above or below.
std::vector<std::string> spectra_findings(const RunFolder& run, const ReportRequest& request);
std::string condensed_section(const RunFolder& run);
std::string attenuation_section(const RunFolder& run);
std::string histories_section(const RunFolder& run, const TimeAxis& time);
std::string bolts_section(const RunFolder& run);
std::string joints_section(const RunFolder& run, const TimeAxis& time);
std::string maps_of_joint(const Json& joint);
std::string energy_section(const RunFolder& run, const TimeAxis& time);
std::string convergence_section(const RunFolder& run);
std::string cost_section(const RunFolder& run);

// "half-sine, peak 100 MPa, duration 40 µs": a history as the record tells it, of values in this unit.
std::string history_text(const std::string& description, const std::string& unit);

}  // namespace dygita
